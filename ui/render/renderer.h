// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/particlefield.h"
#include "core/simulation/snapshot.h"
#include "ui/render/section.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ps {

/// Orbit camera; y is up. Angles in degrees.
struct Camera {
  Vector3 target{0, 0.2, 0};
  double distance = 1.5, azimuth = 35, elevation = 20, fieldOfView = 35;
};

/// A line around the picture of some bodies' matter (vapour left out), through whatever stands before it.
struct BodyOutline {
  std::vector<uint32_t> bodies;           ///< indices as in Snapshot::body
  std::array<float, 3> colour{}, halo{};  ///< sRGB of the line, and of what sets it off from its ground
  float lineWidth = 2, haloWidth = 1.5f;  ///< device pixels
  bool operator==(const BodyOutline&) const = default;
};

/// Matter of another run over the picture: one colour, hatched and with a line around it, so that it is told apart
/// without the colour too, and with a halo beside each stripe, so that it shows on any ground; fainter where something
/// stands before it, nothing where both have their matter at one place. What is fixed is left out.
struct Ghost {
  SnapshotPtr matter;
  std::array<float, 3> colour{}, halo{};  ///< sRGB
  float lineWidth = 1.5f;                 ///< device pixels
  bool operator==(const Ghost&) const = default;
};

/// A thin line that helps to draw: of a grid, a mirror, an axis. Matter in front hides it.
struct GuideLine {
  Vector3 from{0, 0, 0}, to{0, 0, 0};  ///< m
  double opacity = 1;
  bool operator==(const GuideLine&) const = default;
};

/// What a picture shows of its snapshot, from wherever it is seen.
struct Look {
  std::string colour = kMatterColour;         ///< or a field; one that the snapshot has not is no colour
  double rangeMinimum = 0, rangeMaximum = 0;  ///< of the colour map; equal: automatic
  bool dark = true;
  double meltingPoint = 273.15;  ///< K, pivot of the temperature map
  std::optional<BodyOutline> outline;
  std::optional<Ghost> ghost;
  std::vector<GuideLine> guides;
  std::optional<Section> section;  ///< cuts away matter and walls; a floor stays whole as long as any of it is left
  std::optional<std::array<float, 3>> backdrop;  ///< sRGB of one even ground, in place of the studio
  std::optional<std::array<float, 3>> vapour;    ///< sRGB, in place of the theme's
  bool operator==(const Look&) const = default;
};

struct PictureSize {
  int width = 1280, height = 720;  ///< device pixels
  bool still = false;  ///< four samples per pixel: for pictures rather than motion, about four times the work
  bool operator==(const PictureSize&) const = default;
};

/// Parts of an eye's window through which nobody sees, as behind the edge of a lens: corners of triangles, each as the
/// tangents of its angles to the line of sight, to the right and up.
using HiddenTriangles = std::vector<std::array<float, 2>>;

/// The rectangle of a framebuffer that a picture fills; nothing outside of it is touched.
struct RenderTarget {
  uint32_t framebuffer = 0;  ///< its name in the context that is current; 0: the window's own
  int x = 0, y = 0;          ///< lower left corner, pixels
  PictureSize size;
  /// Two-dimensional texture that is all the framebuffer has of colour, so that programs may compute into it; 0:
  /// unknown.
  uint32_t texture = 0;
  /// What need not be drawn, and is left black, but for an edge; nullptr: all is seen.
  std::shared_ptr<const HiddenTriangles> hidden = nullptr;
  /// By how many steps what is soft (shadows, crevices, the skin of liquids, vapour) is coarser than it could be, for
  /// time: 0..kSoftSteps. Matter keeps its shapes, places and colours.
  int coarser = 0;
};
inline constexpr int kSoftSteps = 2;

/// The scene's furniture that is drawn around particles.
struct RenderScene {
  Environment environment;  ///< walls, bounds
};

/// A corner of a triangle: of the scene's furniture, or of what is shown besides.
struct MeshVertex {
  std::array<float, 3> position, normal;  ///< m; a unit vector outwards
  std::array<float, 4> material;          ///< sRGB; render::Kind (opaque) or opacity (clear)
};

/// What is painted on a panel: RGBA8, sRGB multiplied by its opacity, rows from the top.
struct PanelImage {
  int width = 0, height = 0;  ///< pixels
  std::vector<uint8_t> pixels;
};

/// A flat rectangle that shows a picture, on its front.
struct Panel {
  std::array<Vector3, 4> corners;  ///< m: lower left, lower right, upper right, upper left as one looks at it
  std::shared_ptr<const PanelImage> image;
};

/// What is shown among the scene and is no part of it: controllers, brushes in hands (triangles), panels (the farthest
/// first).
struct Props {
  std::vector<MeshVertex> opaque, clear;
  std::vector<Panel> panels;
};

struct Eye;

/// What the graphics card took for one of the passes that make a picture.
struct PassTime {
  std::string pass;
  double milliseconds = 0;
};

/// How a renderer works out surfaces and pixels: by drawing triangles, or by programs that compute. The pictures are
/// the same but for rounding.
enum class PixelWork { AsSuitsTheCard, Drawn, Computed };

namespace render {
struct Prepared;
}

/// What the processor does of preparing a snapshot, on any thread and without a context; a renderer takes it later.
class Preparation {
 public:
  Preparation();
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;
  /// As Renderer::prepare().
  void make(const Snapshot& now, const Snapshot* previous, double blend, const RenderScene& scene, const Look& look);

 private:
  friend class Renderer;
  std::unique_ptr<render::Prepared> m;
};

/// Draws snapshots: each is prepared once and then drawn any number of times, for two eyes, a mirror, a thumbnail, a
/// frame of a film. Needs a current OpenGL 4.3 context, whoever made it (viewport, headset, headless), which may be
/// another one for every call as long as all share their objects; knows no widgets. One thread at a time; views on
/// several threads have a Renderer and a context each. All calls restore the OpenGL state that they change.
class Renderer {
 public:
  /// Throws Error when shaders do not compile or the context is too old.
  explicit Renderer(PixelWork work = PixelWork::AsSuitsTheCard);
  ~Renderer();  ///< the same context (or one that shares with it) must be current
  /// Throws Error when the driver cannot draw a picture that large, as draw() does before it changes anything.
  void checkSize(const PictureSize& size) const;
  /// Everything that does not depend on where it is seen from. `previous` (or nullptr) and `blend` in 0..1 interpolate
  /// between two snapshots; neither is needed afterwards.
  void prepare(const Snapshot& now, const Snapshot* previous, double blend, const RenderScene& scene, const Look& look);
  /// What another thread may have made meanwhile, as if it had been prepared here now. What was prepared before goes
  /// there for its memory.
  void take(Preparation& preparation);
  /// What is shown besides from now on, whatever is prepared.
  void show(const Props& props);
  /// Draws what was prepared last. Throws Error when nothing was, and when the driver runs out of memory. The same
  /// picture whatever was drawn before, and for two sizes in turn without new storage.
  void draw(const Eye& eye, const RenderTarget& target);
  /// How far what draw() drew last is, into the depth of a target of any size: 0 at the eye's near plane, 1 at the far
  /// one and where nothing is. Of panels the first so many count. Vapour and glass, through which one sees, are
  /// nowhere. Throws Error when nothing was drawn.
  void drawDepth(const RenderTarget& target, size_t panels);
  /// From now on prepare() and draw() wait for the graphics card and add what each pass took, as long as `times` is not
  /// nullptr: to find out what is slow.
  void timePasses(std::vector<PassTime>* times);

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

/// Range that the legend shows for a snapshot with automatic limits, SI; {0, 0} where the snapshot has not that field.
std::pair<double, double> colourRange(const Snapshot& snapshot, const std::string& colour);
/// Name of a field's map in resources/theme/maps.json: its own, or the one that all others share.
std::string colourMapOf(const std::string& colour);
/// Colour map as sRGB at t in 0..1 of the range, for legends (phase: by api::Phase / 4). `pivot` is the place of the
/// melting point in the range, (melting - minimum) / (maximum - minimum); only temperature uses it. Each side of it is
/// linear; it may lie outside 0..1.
std::array<float, 3> colourAt(const std::string& colour, double t, double pivot);

/// An OpenGL context without a window or display (EGL surfaceless). Throws Error when there is none.
class HeadlessContext {
 public:
  /// Becomes current on this thread. Shares objects with `shared` unless that is nullptr.
  explicit HeadlessContext(const HeadlessContext* shared = nullptr);
  ~HeadlessContext();
  void makeCurrent();
  void release();  ///< so that another thread may make it current
  std::string description() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

/// Draws what is prepared into an image of RGBA8 rows from the top; needs a current context. `coarser`: as RenderTarget
/// has it.
std::vector<uint8_t> renderImage(Renderer& renderer, const Eye& eye, const PictureSize& size, int coarser = 0);

}  // namespace ps
