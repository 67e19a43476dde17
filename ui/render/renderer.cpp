// SPDX-License-Identifier: Apache-2.0
#include "ui/render/passes.h"

#include "core/base/error.h"
#include "ui/render/camera.h"
#include "ui/render/colourmap.h"
#include "ui/render/glstate.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ps {
namespace {

using render::Extent;
using render::Frame;
using render::FrameUniforms;
using render::TileSet;

// Towards the key light, a unit vector: high, from the left and front of the usual view.
const Vector3 kLight = Vector3(-0.34, 0.86, 0.40).normalized();

/// Column by column, as OpenGL wants it.
FrameUniforms::Matrix floats(const Matrix4& a) {
  FrameUniforms::Matrix out;
  Eigen::Matrix4f::Map(out.data()) = a.cast<float>();
  return out;
}

float linear(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

std::array<Vector3, 8> cornersOf(const Extent& extent) {
  std::array<Vector3, 8> corners;
  for (size_t i = 0; i < 8; ++i)
    for (size_t k = 0; k < 3; ++k)
      corners[i][k] = static_cast<double>(i >> k & 1 ? extent.maximum[k] : extent.minimum[k]);
  return corners;
}

void join(Extent& into, const Extent& other) {
  for (size_t k = 0; k < 3; ++k) {
    into.minimum[k] = std::min(into.minimum[k], other.minimum[k]);
    into.maximum[k] = std::max(into.maximum[k], other.maximum[k]);
  }
}

/// Pixels that a box may touch; the whole picture when a corner is behind the eye.
std::array<int, 4> pixelsOf(const Extent& extent, const Camera& camera, int width, int height) {
  double x0 = width, y0 = height, x1 = 0, y1 = 0;
  if (extent.empty()) return {0, 0, 0, 0};
  for (const Vector3& corner : cornersOf(extent)) {
    const std::optional<Vector3> p = project(camera, width, height, corner);
    if (!p) return {0, 0, width, height};
    x0 = std::min(x0, (*p)[0]), x1 = std::max(x1, (*p)[0]);
    y0 = std::min(y0, (*p)[1]), y1 = std::max(y1, (*p)[1]);
  }
  const int left = static_cast<int>(std::clamp(x0 - 3, 0.0, 1.0 * width)),
            right = static_cast<int>(std::clamp(x1 + 4, 0.0, 1.0 * width));
  const int top = static_cast<int>(std::clamp(y0 - 3, 0.0, 1.0 * height)),
            bottom = static_cast<int>(std::clamp(y1 + 4, 0.0, 1.0 * height));
  return {left, height - bottom, right - left, bottom - top};
}

/// Fits the shadow picture around what casts, from the light's side, and reaches down to the ground.
void fitShadow(Frame& frame) {
  Extent casters = frame.instances.sphereExtent;
  if (frame.instances.dense) join(casters, frame.instances.liquidExtent);
  if (casters.empty()) casters.add(0, 0, 0, 1);
  casters.minimum[1] = std::min(casters.minimum[1], frame.furniture.ground);
  const Vector3 right = Vector3::UnitY().cross(kLight).normalized();
  Matrix3 axes;
  axes << right.transpose(), kLight.cross(right).transpose(), -kLight.transpose();
  Vector3 low = Vector3::Constant(1e30), high = -low;
  for (const Vector3& p : cornersOf(casters)) {
    const Vector3 along = axes * p;
    low = low.cwiseMin(along), high = high.cwiseMax(along);
  }
  const Vector3 scale = 2 * (high - low).cwiseMax(1e-6).cwiseInverse();
  Matrix4 toLight = Matrix4::Identity(), half = 0.5 * Matrix4::Identity();
  toLight.topLeftCorner<3, 3>() = scale.asDiagonal() * axes;
  toLight.topRightCorner<3, 1>() = -scale.cwiseProduct(high + low) / 2;
  half.col(3) << 0.5, 0.5, 0.5, 1;
  frame.shadowScale = {static_cast<float>(scale.x()), static_cast<float>(scale.y())};
  frame.toLight = floats(toLight);
  frame.uniforms.shadow = floats(half * toLight);
}

void fillUniforms(Frame& frame, const RenderOptions& options, double time) {
  FrameUniforms& u = frame.uniforms;
  const Camera& camera = options.camera;
  const Matrix4 view = viewMatrix(camera), projection = projectionMatrix(camera, frame.width, frame.height);
  const Vector3 eye = frameOf(camera).eye;
  const render::Furniture& furniture = frame.furniture;
  const auto f = [](double v) { return static_cast<float>(v); };
  u.view = floats(view);
  u.projection = floats(projection);
  u.inverseView = floats(view.inverse());
  u.eye = {f(eye[0]), f(eye[1]), f(eye[2]), 0};
  u.size = {f(frame.width), f(frame.height), 1 / f(frame.width), 1 / f(frame.height)};
  u.lens = {f(1 / projection(0, 0)), f(1 / projection(1, 1)), f(projection(2, 2)), f(projection(2, 3))};
  u.light = {f(kLight[0]), f(kLight[1]), f(kLight[2]), options.dark ? 1.f : 0.f};
  u.plate = {furniture.centre[0], furniture.centre[1], furniture.half[0], furniture.half[1]};
  u.ground = {furniture.floor, furniture.ground, furniture.floorHeat, furniture.hasFloor ? 1.f : 0.f};
  u.contact = {frame.contact.corner[0], frame.contact.corner[1], 1 / frame.contact.size[0], 1 / frame.contact.size[1]};
  // Time only turns clouds: the remainder keeps its float precise in long runs.
  u.matter = {frame.instances.radius, f(std::fmod(time, 3600)), frame.data ? 1.f : 0.f, furniture.size};
  const render::Colour glow = render::sceneColour(options.dark, "glow");
  u.glowTint = {linear(glow[0]) * 1.25f, linear(glow[1]) * 1.25f, linear(glow[2]) * 1.25f, 0};
}

/// Many points to pixels, without the trigonometry of project().
struct Projector {
  Projector(const Camera& camera, int w, int h)
      : matrix(floats(projectionMatrix(camera, w, h) * viewMatrix(camera))),
        width(static_cast<float>(w)),
        height(static_cast<float>(h)),
        near(static_cast<float>(nearPlane(camera))),
        lens(static_cast<float>(projectionMatrix(camera, w, h)(1, 1)) * height / 2) {}

  /// Pixels from the upper left corner and depth in m; a depth less than `near` makes the others meaningless.
  std::array<float, 3> at(float x, float y, float z) const {
    const auto row = [&](size_t r) { return matrix[r] * x + matrix[4 + r] * y + matrix[8 + r] * z + matrix[12 + r]; };
    const float w = row(3), safe = std::max(w, near);
    return {(row(0) / safe * 0.5f + 0.5f) * width, (0.5f - row(1) / safe * 0.5f) * height, w};
  }

  FrameUniforms::Matrix matrix;
  float width, height, near, lens;  // lens: pixels of a metre at a depth of 1 m
};

void markSpheres(TileSet& tiles, const Projector& projector, const render::Instance* first, size_t count, float reach,
                 float margin = 3) {
  for (const render::Instance* p = first; p != first + count; ++p) {
    const auto at = projector.at(p->x, p->y, p->z);
    if (at[2] > -p->radius)
      tiles.mark(at[0], at[1], reach * p->radius * projector.lens / std::max(at[2], projector.near) + margin);
  }
}

void markEdges(TileSet& tiles, const Projector& projector, const std::vector<render::MeshVertex>& mesh) {
  for (size_t i = 0; i + 2 < mesh.size(); i += 3) {
    if (mesh[i].material[3] == static_cast<float>(render::Kind::PlateTop)) continue;
    std::array<std::array<float, 3>, 3> at;
    for (size_t k = 0; k < 3; ++k) {
      const auto& p = mesh[i + k].position;
      at[k] = projector.at(p[0], p[1], p[2]);
      if (at[k][2] < projector.near) return tiles.markAll();
    }
    // Triangles come in pairs along an edge: the longer of two sides runs along it.
    const auto length = [&](size_t k) { return std::hypot(at[k + 1][0] - at[k][0], at[k + 1][1] - at[k][1]); };
    const size_t k = length(0) > length(1) ? 0 : 1;
    tiles.markLine(at[k][0], at[k][1], at[k + 1][0], at[k + 1][1], 4);
  }
}

/// Which parts of the picture have liquid, and which have edges to smooth or crevices to darken. A graphics card does
/// all of the picture faster than a processor finds out.
void findTiles(Frame& frame, const Camera& camera, bool cull) {
  const auto& instances = frame.instances;
  TileSet &liquid = frame.liquid, &detail = frame.detail, &outline = frame.outline;
  liquid.reset(frame.width, frame.height);
  detail.reset(frame.width, frame.height);
  outline.reset(frame.width, frame.height);
  if (cull) {
    const Projector projector(camera, frame.width, frame.height);
    const render::Instance* first = instances.particles.data();
    markSpheres(liquid, projector, first + instances.spheres, instances.liquids, 1.4f);
    markSpheres(detail, projector, first, instances.visible, 2.5f);
    markSpheres(outline, projector, first + instances.particles.size() - instances.outlined, instances.outlined, 1.2f,
                3 + frame.outlined.lineWidth + frame.outlined.haloWidth);
    markEdges(detail, projector, frame.furniture.opaque);
    markEdges(detail, projector, frame.furniture.clear);
  } else {
    liquid.markAll();
    detail.markAll();
    outline.markAll();
  }
  outline.triangles(frame.outlineTiles);
  liquid.triangles(frame.liquidTiles);
  detail.triangles(frame.detailTiles);
}

/// Inner targets have this many pixels for one of the picture's, along each side.
int innerScale(const RenderOptions& options) { return options.still ? 2 : 1; }

std::string sizeText(const RenderOptions& options) {
  return std::to_string(options.width) + " × " + std::to_string(options.height) + " pixels";
}

/// The first OpenGL error that waits, and none waits afterwards. A lost context reports for ever: enough is enough.
GLenum takeErrors() {
  const GLenum first = glGetError();
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
  return first;
}

void placeContactMap(Frame& frame) {
  const render::Furniture& furniture = frame.furniture;
  for (size_t k = 0; k < 2; ++k) {
    const float half = std::max(furniture.half[k], 1e-4f) * 1.1f;
    frame.contact.corner[k] = furniture.centre[k] - half;
    frame.contact.size[k] = 2 * half;
  }
  frame.contact.floor = furniture.floor;
  render::fillContactMap(frame.instances, frame.contact);
}

}  // namespace

struct Renderer::Impl {
  // The state is put back after the constructor's passes are made, so that a context in use stays as it was.
  static std::unique_ptr<render::Passes> makePasses() {
    if (epoxy_gl_version() < 43)
      throw Error("the graphics driver offers OpenGL " + std::to_string(epoxy_gl_version() / 10) + "." +
                  std::to_string(epoxy_gl_version() % 10) + "; the view needs 4.3 or newer");
    const render::GlState state;
    return std::make_unique<render::Passes>();
  }
  std::unique_ptr<render::Passes> passes = makePasses();
  Frame frame;                           // kept for its memory
  std::optional<Environment> furnished;  // what frame.furniture was made of, and for which theme
  bool dark = false;
  int width = 0, height = 0;     // pixels of the inner targets that are known to work
  std::array<bool, 3> layers{};  // and whether theirs are: liquid, vapour, outline

  void furnish(const Environment& environment, bool forDark) {
    if (furnished && dark == forDark && render::sameFurniture(*furnished, environment)) return;
    frame.furniture = render::buildFurniture(environment, forDark);
    ++frame.furnitureRevision;
    furnished = environment;
    dark = forDark;
  }
};

Renderer::Renderer() : m(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;

void Renderer::checkSize(const RenderOptions& options) const {
  const int most = m->passes->largestPicture() / innerScale(options);
  if (std::max(options.width, options.height) <= most) return;
  throw Error("a picture of " + sizeText(options) + " is larger than the " + std::to_string(most) +
              " pixels a side that this graphics driver draws" + (options.still ? " with smooth edges" : "") +
              "; ask for a smaller one");
}

void Renderer::draw(const Snapshot& now, const Snapshot* previous, double blend, const RenderScene& scene,
                    const RenderOptions& options) {
  if (options.width < 1 || options.height < 1) return;
  checkSize(options);
  Frame& frame = m->frame;
  const int scale = innerScale(options);
  frame.width = options.width * scale;
  frame.height = options.height * scale;
  frame.still = options.still;
  frame.data = options.colour != ColourBy::Material;
  m->furnish(scene.environment, options.dark);
  frame.edgeTint = render::sceneColour(options.dark, "edge");

  render::InstanceRequest request;
  request.now = &now;
  request.previous = previous;
  request.blend = static_cast<float>(blend);
  request.colour = options.colour;
  request.meltingPoint = options.meltingPoint;
  request.minimum = options.rangeMinimum;
  request.maximum = options.rangeMaximum;
  if (options.rangeMinimum == options.rangeMaximum)
    std::tie(request.minimum, request.maximum) = colourRange(now, options.colour);
  request.surfaces = options.colour != ColourBy::DensityError;
  request.steam = render::sceneColour(options.dark, "steam");
  if (options.outline) {
    request.outlined = options.outline->body;
    frame.outlined = *options.outline;
    frame.outlined.lineWidth *= static_cast<float>(scale);
    frame.outlined.haloWidth *= static_cast<float>(scale);
  }
  const CameraFrame axes = frameOf(options.camera);
  if (m->passes->quality().cull) {
    const Matrix4 view = projectionMatrix(options.camera, frame.width, frame.height) * viewMatrix(options.camera);
    request.cull = render::CullView{floats(view), frame.width, frame.height};
  }
  render::collectInstances(request, frame.instances);

  placeContactMap(frame);
  fillUniforms(frame, options, now.stats.time);
  fitShadow(frame);
  frame.lidInFront = axes.eye[1] > static_cast<double>(frame.furniture.lidHeight);
  findTiles(frame, options.camera, m->passes->quality().cull);
  frame.vapourBox = pixelsOf(frame.instances.vapourExtent, options.camera, frame.width, frame.height);

  const render::GlState state;
  const render::Instances& drawn = frame.instances;
  const std::array layers{drawn.liquids > 0, drawn.vapours > 0, drawn.outlined > 0};
  bool first = frame.width != m->width || frame.height != m->height;
  if (first) m->layers = {};
  for (size_t i = 0; i < layers.size(); ++i) first = first || layers[i] > m->layers[i];
  if (first) takeErrors();  // whoever drew before left them
  m->passes->draw(frame, state.drawFramebuffer());
  if (!first) return;
  // Asked once per size: what fails with these targets fails in the first frame, and asking makes the processor wait.
  if (const GLenum error = takeErrors(); error != GL_NO_ERROR)
    throw Error("the graphics driver " +
                (error == GL_OUT_OF_MEMORY ? "has no memory" : "reports error " + std::to_string(error)) +
                " for a picture of " + sizeText(options) + "; ask for a smaller one");
  for (size_t i = 0; i < layers.size(); ++i) m->layers[i] = m->layers[i] || layers[i];
  m->width = frame.width;
  m->height = frame.height;
}

}  // namespace ps
