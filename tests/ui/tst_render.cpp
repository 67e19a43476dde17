// SPDX-License-Identifier: Apache-2.0
#include <epoxy/gl.h>

#include "ui/render/camera.h"
#include "ui/render/furniture.h"
#include "ui/render/instances.h"

#include <QtTest/QtTest>

#include <cmath>
#include <exception>
#include <numbers>
#include <random>
#include <thread>

using namespace ps;

namespace {

constexpr int kWidth = 320, kHeight = 200;

void addParticle(Snapshot& s, const Vec3& p, double radius, uint32_t id, api::Motion motion, double temperature = 280) {
  s.position.push_back(
      {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), static_cast<float>(radius)});
  s.temperature.push_back(static_cast<float>(temperature));
  s.speed.push_back(static_cast<float>(std::abs(p[0])));
  s.densityError.push_back(0.01f);
  s.gasFraction.push_back(motion == api::Motion::Gas ? 1.f : 0.f);
  s.phase.push_back(motion == api::Motion::Gas      ? api::Phase::Gas
                    : motion == api::Motion::Liquid ? api::Phase::Liquid
                                                    : api::Phase::Solid);
  s.motion.push_back(motion);
  s.id.push_back(id);
  s.body.push_back(0);
  s.material.push_back(0);
}

SceneWall wall(const char* id, const Vec3& point, const Vec3& normal, double temperature) {
  SceneWall w;
  w.id = w.name = id;
  w.point = point;
  w.normal = normal;
  if (temperature > 0) {
    w.parameters.values["heat"] = std::string("fixed_temperature");
    w.parameters.values["temperature"] = temperature;
  }
  return w;
}

RenderScene tray() {
  RenderScene scene;
  scene.environment.boundsMinimum = {-0.5, 0, -0.5};
  scene.environment.boundsMaximum = {0.5, 1, 0.5};
  scene.environment.walls = {wall("floor", {0, 0, 0}, {0, 1, 0}, 400), wall("lid", {0, 0.8, 0}, {0, -1, 0}, 283),
                             wall("left", {-0.4, 0, 0}, {1, 0, 0}, 0), wall("right", {0.4, 0, 0}, {-2, 0, 0}, 0),
                             wall("back", {0, 0, -0.4}, {0, 0, 1}, 0), wall("front", {0, 0, 0.4}, {0, 0, -1}, 0)};
  return scene;
}

// A block of ice in a puddle under steam: every kind of matter that is drawn differently.
Snapshot everything() {
  Snapshot s;
  s.materialColour = {{0.75f, 0.87f, 0.98f}};
  uint32_t id = 0;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 8; ++k)
        addParticle(s, {i * 0.02 - 0.07, 0.05 + j * 0.02, k * 0.02 - 0.07}, 0.0124, id++, api::Motion::Solid, 265);
  for (int i = 0; i < 24; ++i)
    for (int k = 0; k < 24; ++k)
      addParticle(s, {i * 0.02 - 0.23, 0.01, k * 0.02 - 0.23}, 0.0124, id++, api::Motion::Liquid, 300 + i);
  for (int i = 0; i < 60; ++i)
    addParticle(s, {0.15 * std::sin(i), 0.25 + 0.008 * i, 0.15 * std::cos(2.1 * i)}, 0.017, id++, api::Motion::Gas,
                374);
  for (int i = 0; i < 10; ++i) addParticle(s, {0.3, 0.01, i * 0.02 - 0.1}, 0.0124, id++, api::Motion::Static);
  return s;
}

RenderOptions options(ColourBy colour = ColourBy::Material, bool dark = true) {
  RenderOptions o;
  o.width = kWidth;
  o.height = kHeight;
  o.colour = colour;
  o.dark = dark;
  o.camera.target = {0, 0.2, 0};
  return o;
}

std::array<int, 3> pixelAt(const std::vector<uint8_t>& image, int x, int y) {
  const size_t at = static_cast<size_t>((y * kWidth + x) * 4);
  return {image[at], image[at + 1], image[at + 2]};
}

int difference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, size_t pixel) {
  int sum = 0;
  for (size_t k = 0; k < 3; ++k) sum += std::abs(int{a[pixel * 4 + k]} - int{b[pixel * 4 + k]});
  return sum;
}

// Names in use among the first thousand: what one renderer leaves behind shows here.
std::array<int, 5> objectsInUse() {
  std::array<int, 5> count{};
  for (GLuint name = 1; name < 1000; ++name) {
    count[0] += glIsTexture(name);
    count[1] += glIsBuffer(name);
    count[2] += glIsProgram(name);
    count[3] += glIsFramebuffer(name);
    count[4] += glIsVertexArray(name);
  }
  return count;
}

}  // namespace

class TestRender : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context = std::make_unique<HeadlessContext>(); }
  void cleanupTestCase() { m_context.reset(); }

  void cameraMapsPointsToPixelsAndBack_data();
  void cameraMapsPointsToPixelsAndBack();
  void matricesAgreeWithProject();
  void orbitPanAndDollyKeepTheirPromise();
  void frameAllShowsTheWholeBox();
  void pickFindsTheNearestSphere();
  void colourMapEnds_data();
  void colourMapEnds();
  void automaticRanges();
  void colourNamesRoundTrip();
  void interpolatesById();
  void revisionsDoNotMix();
  void hidesOnlyWhatIsCovered();
  void leavesOutWhatIsBuried();
  void wallsAreClippedByEachOther();
  void glow_data();
  void glow();
  void picturesAreNotBlank_data();
  void picturesAreNotBlank();
  void sphereCoversItsProjection_data();
  void sphereCoversItsProjection();
  void nearerSphereWins();
  void sizesAtTheEdge_data();
  void sizesAtTheEdge();
  void restoresState();
  void leavesNothingBehind();
  void twoThreadsDrawAsOneDoes();

 private:
  std::unique_ptr<HeadlessContext> m_context;
};

void TestRender::cameraMapsPointsToPixelsAndBack_data() {
  QTest::addColumn<double>("azimuth");
  QTest::addColumn<double>("elevation");
  for (const double elevation : {-90.0, -20.0, 0.0, 35.0, 90.0})
    for (const double azimuth : {0.0, 35.0, 180.0, -91.0})
      QTest::addRow("%g around, %g up", azimuth, elevation) << azimuth << elevation;
}

void TestRender::cameraMapsPointsToPixelsAndBack() {
  QFETCH(double, azimuth);
  QFETCH(double, elevation);
  Camera camera;
  camera.azimuth = azimuth;
  camera.elevation = elevation;
  const Vec3 point{0.1, 0.3, -0.2};
  const std::optional<Vec3> pixel = project(camera, kWidth, kHeight, point);
  QVERIFY(pixel);
  const Ray ray = rayThrough(camera, kWidth, kHeight, (*pixel)[0], (*pixel)[1]);
  // The ray must pass the point: distance of the point from the line, in metres, to rounding of doubles.
  Vec3 d{}, offset{};
  double along = 0, miss = 0;
  for (size_t k = 0; k < 3; ++k) d[k] = point[k] - ray.origin[k], along += d[k] * ray.direction[k];
  for (size_t k = 0; k < 3; ++k) offset[k] = d[k] - ray.direction[k] * along, miss += offset[k] * offset[k];
  QVERIFY2(std::sqrt(miss) < 1e-9, qPrintable(QString::number(std::sqrt(miss))));
  QVERIFY(along > 0);
}

void TestRender::matricesAgreeWithProject() {
  Camera camera;
  const Vec3 point{-0.3, 0.1, 0.25};
  const auto clip = transform(multiply(projectionMatrix(camera, kWidth, kHeight), viewMatrix(camera)), point);
  const Vec3 pixel = *project(camera, kWidth, kHeight, point);
  QVERIFY(std::abs((clip[0] / clip[3] + 1) / 2 * kWidth - pixel[0]) < 1e-9);
  QVERIFY(std::abs((1 - clip[1] / clip[3]) / 2 * kHeight - pixel[1]) < 1e-9);
  QVERIFY(std::abs(clip[3] - pixel[2]) < 1e-12);
  const Mat4 one = multiply(viewMatrix(camera), inverse(viewMatrix(camera)));
  for (size_t i = 0; i < 16; ++i) QVERIFY(std::abs(one[i] - (i % 5 == 0 ? 1 : 0)) < 1e-12);
  QVERIFY(!project(camera, kWidth, kHeight, frameOf(camera).eye));
}

void TestRender::orbitPanAndDollyKeepTheirPromise() {
  Camera camera;
  orbit(camera, 0, 200);
  QCOMPARE(camera.elevation, 90.0);
  camera = {};
  const Vec3 before = *project(camera, kWidth, kHeight, {0, 0.2, 0});
  pan(camera, kHeight, 17, -9);
  const Vec3 after = *project(camera, kWidth, kHeight, {0, 0.2, 0});  // it was the target: at the target's depth
  QVERIFY(std::abs(after[0] - before[0] - 17) < 1e-9 && std::abs(after[1] - before[1] + 9) < 1e-9);

  camera = {};
  const Ray ray = rayThrough(camera, kWidth, kHeight, 40, 150);
  const Vec3 under = *meetPlane(ray, camera.target, frameOf(camera).forward);
  dollyTo(camera, kWidth, kHeight, 40, 150, 0.4);
  const Vec3 pixel = *project(camera, kWidth, kHeight, under);
  QVERIFY(std::abs(pixel[0] - 40) < 1e-9 && std::abs(pixel[1] - 150) < 1e-9);
  QVERIFY(std::abs(camera.distance - 0.6) < 1e-12);
}

void TestRender::frameAllShowsTheWholeBox() {
  for (const auto& [width, height] : {std::pair{320, 200}, {100, 400}}) {
    Camera camera;
    const Vec3 low{-1, 0, -2}, high{0.5, 3, 1};
    frameAll(camera, width, height, low, high);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{corner & 1 ? low[0] : high[0], corner & 2 ? low[1] : high[1], corner & 4 ? low[2] : high[2]};
      const auto pixel = project(camera, width, height, p);
      QVERIFY(pixel && (*pixel)[0] >= 0 && (*pixel)[0] <= width && (*pixel)[1] >= 0 && (*pixel)[1] <= height);
    }
  }
}

void TestRender::pickFindsTheNearestSphere() {
  Camera camera;
  camera.target = {0, 0, 0};
  camera.elevation = camera.azimuth = 0;  // looks along -z
  Snapshot s;
  addParticle(s, {0, 0, -0.2}, 0.1, 5, api::Motion::Solid);
  addParticle(s, {0, 0, 0.2}, 0.1, 6, api::Motion::Solid);
  addParticle(s, {0.5, 0, 0}, 0.1, 7, api::Motion::Liquid);
  QCOMPARE(pickParticle(s, camera, kWidth, kHeight, kWidth / 2.0, kHeight / 2.0), std::optional<size_t>(1));
  const Vec3 third = *project(camera, kWidth, kHeight, {0.5, 0, 0});
  QCOMPARE(pickParticle(s, camera, kWidth, kHeight, third[0], third[1]), std::optional<size_t>(2));
  QVERIFY(!pickParticle(s, camera, kWidth, kHeight, 1, 1));
}

void TestRender::colourMapEnds_data() {
  QTest::addColumn<int>("colour");
  QTest::addColumn<double>("t");
  QTest::addColumn<double>("pivot");
  QTest::addColumn<int>("red");
  QTest::addColumn<int>("green");
  QTest::addColumn<int>("blue");
  const auto row = [](const char* name, ColourBy colour, double t, double pivot, int r, int g, int b) {
    QTest::newRow(name) << static_cast<int>(colour) << t << pivot << r << g << b;
  };
  row("coldest", ColourBy::Temperature, 0, 0.2, 39, 71, 154);
  row("melting, pivot low", ColourBy::Temperature, 0.2, 0.2, 141, 194, 230);
  row("melting, pivot high", ColourBy::Temperature, 0.9, 0.9, 141, 194, 230);
  row("melting at the lower end", ColourBy::Temperature, 0, 0, 141, 194, 230);
  row("melting at the upper end", ColourBy::Temperature, 1, 1, 141, 194, 230);
  row("hottest", ColourBy::Temperature, 1, 0.2, 133, 28, 27);
  row("half of the cold side", ColourBy::Temperature, 0.25, 0.5, 63, 124, 196);
  row("solid", ColourBy::Phase, 0, 0, 58, 99, 184);
  row("melting phase", ColourBy::Phase, 0.25, 0, 181, 82, 143);
  row("liquid", ColourBy::Phase, 0.5, 0, 69, 196, 184);
  row("boiling", ColourBy::Phase, 0.75, 0, 242, 169, 59);
  row("gas", ColourBy::Phase, 1, 0, 245, 241, 230);
  row("at rest", ColourBy::Speed, 0, 0, 43, 27, 77);
  row("fast", ColourBy::Speed, 1, 0, 251, 229, 138);
  row("too thin", ColourBy::DensityError, 0, 0, 123, 63, 160);
  row("right density", ColourBy::DensityError, 0.5, 0, 201, 204, 208);
  row("too dense", ColourBy::DensityError, 1, 0, 30, 122, 70);
}

void TestRender::colourMapEnds() {
  QFETCH(int, colour);
  QFETCH(double, t);
  QFETCH(double, pivot);
  QFETCH(int, red);
  QFETCH(int, green);
  QFETCH(int, blue);
  const auto c = colourAt(static_cast<ColourBy>(colour), t, pivot);
  // Stops are whole 1/255 steps; half a step covers the rounding.
  QVERIFY2(std::abs(c[0] * 255 - static_cast<float>(red)) < 0.5f &&
               std::abs(c[1] * 255 - static_cast<float>(green)) < 0.5f &&
               std::abs(c[2] * 255 - static_cast<float>(blue)) < 0.5f,
           qPrintable(QString("%1 %2 %3").arg(c[0] * 255).arg(c[1] * 255).arg(c[2] * 255)));
}

void TestRender::automaticRanges() {
  Snapshot s;
  addParticle(s, {0.13, 0, 0}, 0.01, 0, api::Motion::Solid, 273.15 - 8);
  addParticle(s, {0.31, 0, 0}, 0.01, 1, api::Motion::Liquid, 273.15 + 112);
  const auto close = [](std::pair<double, double> a, double low, double high) {
    return std::abs(a.first - low) < 1e-6 && std::abs(a.second - high) < 1e-6;
  };
  QVERIFY(close(colourRange(s, ColourBy::Temperature), 273.15 - 10, 273.15 + 120));
  QVERIFY(close(colourRange(s, ColourBy::Speed), 0, 0.5));
  QVERIFY(close(colourRange(s, ColourBy::Phase), 0, 4));
  QVERIFY(close(colourRange(s, ColourBy::DensityError), -0.05, 0.05));
  const auto none = colourRange(Snapshot{}, ColourBy::Temperature);
  QVERIFY(none.first < none.second);
}

void TestRender::colourNamesRoundTrip() {
  for (const char* name : {"material", "temperature", "phase", "speed", "density_error"})
    QCOMPARE(colourName(colourByName(name)), name);
  QVERIFY(colourByName("no such map") == ColourBy::Material);
}

void TestRender::interpolatesById() {
  Snapshot before, now;
  before.materialColour = now.materialColour = {{0.5f, 0.5f, 0.5f}};
  addParticle(before, {0, 0, 0}, 0.01, 7, api::Motion::Solid, 100);
  addParticle(before, {1, 0, 0}, 0.01, 3, api::Motion::Solid, 200);
  addParticle(now, {1, 1, 0}, 0.03, 3, api::Motion::Solid, 300);
  addParticle(now, {5, 5, 5}, 0.01, 9, api::Motion::Solid, 300);  // new: stands where it is
  addParticle(now, {0, 0, 2}, 0.01, 7, api::Motion::Solid, 500);
  render::InstanceRequest request;
  request.now = &now;
  request.previous = &before;
  request.blend = 0.25f;
  request.colour = ColourBy::Temperature;
  request.minimum = 100;
  request.maximum = 500;
  render::Instances out;
  render::collectInstances(request, out);
  QCOMPARE(out.particles.size(), size_t{3});
  QCOMPARE(out.particles[0].y, 0.25f);
  QVERIFY(std::abs(out.particles[0].radius - 0.015f) < 1e-7f);
  QCOMPARE(out.particles[1].x, 5.f);
  QCOMPARE(out.particles[2].z, 0.5f);
  // 7 is at 100 + 0.25 * 400 = 200 K: the colour of a quarter of the range. One step of the table is 1/1023.
  const auto expected = colourAt(ColourBy::Temperature, 0.25, (273.15 - 100) / 400);
  QVERIFY(std::abs(out.particles[2].red - expected[0]) < 0.005f);
}

void TestRender::revisionsDoNotMix() {
  Snapshot before, now;
  addParticle(before, {0, 0, 0}, 0.01, 0, api::Motion::Solid);
  addParticle(now, {1, 0, 0}, 0.01, 0, api::Motion::Solid);
  now.revision = 1;
  render::InstanceRequest request;
  request.now = &now;
  request.previous = &before;
  request.blend = 0;
  render::Instances out;
  render::collectInstances(request, out);
  QCOMPARE(out.particles[0].x, 1.f);
}

void TestRender::hidesOnlyWhatIsCovered() {
  Camera camera;
  camera.target = {0, 0, 0};
  camera.elevation = camera.azimuth = 0;
  const Mat4 m = multiply(projectionMatrix(camera, kWidth, kHeight), viewMatrix(camera));
  render::CullView view{{}, kWidth, kHeight};
  for (size_t i = 0; i < 16; ++i) view.viewProjection[i] = static_cast<float>(m[i]);
  const auto sphere = [](float x, float z, float r, float mark) { return render::Instance{x, 0, z, r, 0, 0, 0, mark}; };
  std::vector<render::Instance> list{sphere(0, -0.5f, 0.05f, 1), sphere(0, 0.2f, 0.2f, 2),
                                     sphere(0.25f, -0.5f, 0.1f, 3)};
  QCOMPARE(render::sortVisible(view, list), size_t{2});
  QCOMPARE(list[0].extra, 2.f);
  QCOMPARE(list[1].extra, 3.f);  // peeps out behind the large one
  QCOMPARE(list[2].extra, 1.f);
}

void TestRender::leavesOutWhatIsBuried() {
  std::vector<render::Instance> list;
  render::Extent extent;
  for (int i = 0; i < 1000; ++i) {
    const int x = i % 10, y = i / 10 % 10, z = i / 100;
    list.push_back({0.02f * static_cast<float>(x), 0.02f * static_cast<float>(y), 0.02f * static_cast<float>(z),
                    0.0124f, 0, 0, 0, static_cast<float>(i)});
    extent.add(list.back().x, list.back().y, list.back().z, 0.0124f);
  }
  render::dropBuried(extent, 0.0124f, list);
  QVERIFY(list.size() < 1000);
  const auto outer = [](int i) {
    const auto edge = [](int v) { return v == 0 || v == 9; };
    return edge(i % 10) || edge(i / 10 % 10) || edge(i / 100);
  };
  size_t kept = 0;
  for (const render::Instance& p : list) kept += outer(static_cast<int>(p.extra));
  QCOMPARE(kept, size_t{1000 - 512});  // the whole outer layer
}

void TestRender::wallsAreClippedByEachOther() {
  const RenderScene scene = tray();
  for (const size_t index : {size_t{0}, size_t{1}}) {
    const render::Face face = render::wallFace(scene.environment, index);
    QCOMPARE(face.corners.size(), size_t{4});
    for (const Vec3& p : face.corners) {
      QVERIFY(std::abs(std::abs(p[0]) - 0.4) < 1e-9 && std::abs(std::abs(p[2]) - 0.4) < 1e-9);
      QVERIFY(std::abs(p[1] - (index ? 0.8 : 0)) < 1e-9);
    }
    for (const bool walled : face.walled) QVERIFY(walled);
  }
  const render::Furniture furniture = render::buildFurniture(scene.environment, true);
  QVERIFY(furniture.hasFloor && furniture.hasLid && !furniture.opaque.empty() && !furniture.clear.empty());
  QVERIFY(std::abs(furniture.half[0] - 0.4f) < 1e-6f && std::abs(furniture.lidHeight - 0.8f) < 1e-6f);
  for (const render::MeshVertex& v : furniture.opaque) {
    const float length = std::hypot(v.normal[0], v.normal[1], v.normal[2]);
    QVERIFY(std::isfinite(v.position[0] + v.position[1] + v.position[2]) && std::abs(length - 1) < 1e-4f);
  }
  Environment bare;
  QVERIFY(render::buildFurniture(bare, false).opaque.empty());
  // A wall with nothing left of it: outside of the bounds and behind another one.
  Environment crossed = scene.environment;
  crossed.walls.push_back(wall("gone", {0.45, 0, 0}, {-1, 0, 0}, 0));
  QVERIFY(render::wallFace(crossed, 6).corners.empty());
}

void TestRender::glow_data() {
  QTest::addColumn<double>("temperature");
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::newRow("not held at a temperature") << 0.0 << 0.0 << 0.0;
  QTest::newRow("room") << 293.15 << 0.0 << 0.0;
  QTest::newRow("90 degrees Celsius") << 363.15 << 0.2 << 0.6;
  QTest::newRow("200 degrees Celsius") << 473.15 << 1.0 << 1.0;
}

void TestRender::glow() {
  QFETCH(double, temperature);
  QFETCH(double, low);
  QFETCH(double, high);
  const double value = render::glowOf(wall("floor", {0, 0, 0}, {0, 1, 0}, temperature));
  QVERIFY2(value >= low && value <= high, qPrintable(QString::number(value)));
}

void TestRender::picturesAreNotBlank_data() {
  QTest::addColumn<int>("colour");
  QTest::addColumn<bool>("dark");
  QTest::addColumn<double>("elevation");
  QTest::addColumn<bool>("still");
  for (const ColourBy colour :
       {ColourBy::Material, ColourBy::Temperature, ColourBy::Phase, ColourBy::Speed, ColourBy::DensityError})
    for (const bool dark : {true, false})
      QTest::addRow("%s %s", colourName(colour), dark ? "dark" : "light")
          << static_cast<int>(colour) << dark << 20.0 << false;
  QTest::newRow("from above") << 0 << true << 90.0 << false;
  QTest::newRow("from below") << 0 << true << -40.0 << false;
  QTest::newRow("still") << 0 << true << 20.0 << true;
}

void TestRender::picturesAreNotBlank() {
  QFETCH(int, colour);
  QFETCH(bool, dark);
  QFETCH(double, elevation);
  QFETCH(bool, still);
  Renderer renderer;
  const RenderScene scene = tray();
  RenderOptions o = options(static_cast<ColourBy>(colour), dark);
  o.camera.elevation = elevation;
  o.still = still;
  const auto empty = renderImage(renderer, Snapshot{}, RenderScene{}, o);
  const auto image = renderImage(renderer, everything(), scene, o);
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  size_t changed = 0;
  double brightness = 0;
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
    changed += difference(empty, image, i) > 12;
    brightness += empty[i * 4 + 1];
    QCOMPARE(image[i * 4 + 3], uint8_t{255});
  }
  // The tray fills a good part of the picture; themes are far apart.
  QVERIFY2(changed > size_t{kWidth} * kHeight / 8, qPrintable(QString::number(changed)));
  brightness /= kWidth * kHeight;
  QVERIFY2(dark ? brightness < 90 : brightness > 150, qPrintable(QString::number(brightness)));
}

void TestRender::sphereCoversItsProjection_data() {
  QTest::addColumn<double>("x");
  QTest::addColumn<double>("radius");
  QTest::newRow("centre") << 0.0 << 0.2;
  QTest::newRow("off the axis") << 0.45 << 0.15;
  QTest::newRow("small") << 0.1 << 0.05;
}

void TestRender::sphereCoversItsProjection() {
  QFETCH(double, x);
  QFETCH(double, radius);
  Renderer renderer;
  RenderOptions o = options(ColourBy::Phase, false);
  o.camera.target = {0, 0, 0};
  o.camera.azimuth = o.camera.elevation = 0;
  RenderScene scene;
  scene.environment.boundsMinimum[1] = -5;  // the ground is out of the picture
  Snapshot s;
  const auto empty = renderImage(renderer, s, scene, o);
  addParticle(s, {x, 0, 0}, radius, 0, api::Motion::Solid);
  const auto image = renderImage(renderer, s, scene, o);
  double covered = 0;
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) covered += difference(empty, image, i) > 60;
  // A sphere's picture is an ellipse: area pi f^2 r^2 sqrt(z^2 + x^2 - r^2) / (z^2 - r^2)^(3/2) in pixels.
  const double z = o.camera.distance, f = kHeight / 2.0 / std::tan(o.camera.fieldOfView * std::numbers::pi / 360);
  const double expected = std::numbers::pi * f * f * radius * radius * std::sqrt(z * z + x * x - radius * radius) /
                          std::pow(z * z - radius * radius, 1.5);
  // Pixels of the rim are mixed with the background: up to a pixel around, half counted.
  const double rim = 0.6 * 2 * std::sqrt(std::numbers::pi * expected);
  QVERIFY2(std::abs(covered - expected) < rim, qPrintable(QString("%1 of %2").arg(covered).arg(expected)));
}

void TestRender::nearerSphereWins() {
  Renderer renderer;
  RenderOptions o = options(ColourBy::Phase);
  o.camera.target = {0, 0, 0};
  o.camera.azimuth = o.camera.elevation = 0;
  RenderScene scene;
  scene.environment.boundsMinimum[1] = -5;
  for (const bool solidInFront : {true, false})
    for (const bool solidFirst : {true, false}) {
      Snapshot s;
      for (const bool solid : {solidFirst, !solidFirst}) {
        addParticle(s, {0, 0, solid == solidInFront ? 0.15 : -0.1}, 0.2, solid, api::Motion::Solid);
        s.phase.back() = solid ? api::Phase::Solid : api::Phase::Boiling;  // blue or orange
      }
      const auto c = pixelAt(renderImage(renderer, s, scene, o), kWidth / 2, kHeight / 2);
      QVERIFY2(solidInFront == (c[2] > c[0]), qPrintable(QString("%1 %2 %3").arg(c[0]).arg(c[1]).arg(c[2])));
    }
}

void TestRender::sizesAtTheEdge_data() {
  QTest::addColumn<int>("width");
  QTest::addColumn<int>("height");
  QTest::newRow("one pixel") << 1 << 1;
  QTest::newRow("odd") << 333 << 127;
  QTest::newRow("tall") << 17 << 400;
}

void TestRender::sizesAtTheEdge() {
  QFETCH(int, width);
  QFETCH(int, height);
  Renderer renderer;
  RenderOptions o = options();
  o.width = width;
  o.height = height;
  Snapshot broken = everything();
  broken.position[3].x = std::numeric_limits<float>::quiet_NaN();
  broken.position[4].w = 0;
  for (const bool still : {false, true}) {
    o.still = still;
    const auto image = renderImage(renderer, broken, tray(), o);
    QCOMPARE(image.size(), static_cast<size_t>(width * height * 4));
    QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
  o.camera.target = {0, 0.1, 0};
  o.camera.distance = 0.01;  // inside the block
  renderImage(renderer, everything(), tray(), o);
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

void TestRender::restoresState() {
  Renderer renderer;
  GLuint framebuffer = 0, picture = 0, stencil = 0, array = 0, buffer = 0, texture = 0;
  glGenFramebuffers(1, &framebuffer);
  glGenTextures(1, &picture);
  glBindTexture(GL_TEXTURE_2D, picture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kWidth, kHeight, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
  glGenRenderbuffers(1, &stencil);  // without one, the reference value reads as 0
  glBindRenderbuffer(GL_RENDERBUFFER, stencil);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, kWidth, kHeight);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, stencil);
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glGenTextures(1, &texture);
  glActiveTexture(GL_TEXTURE3);
  glBindTexture(GL_TEXTURE_2D, texture);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 1, 1);  // must not cut the picture
  glViewport(3, 4, 50, 60);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ZERO, GL_ZERO, GL_DST_ALPHA, GL_ONE);
  glDepthFunc(GL_NEVER);
  glDepthMask(GL_FALSE);
  glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  glStencilFunc(GL_NEVER, 5, 0x0F);
  glStencilOp(GL_INVERT, GL_ZERO, GL_INCR);
  glClearColor(0.1f, 0.2f, 0.3f, 0.4f);

  renderer.draw(everything(), nullptr, 1, tray(), options());

  const auto is = [](GLenum name, GLint expected) {
    GLint value = -1;
    glGetIntegerv(name, &value);
    return value == expected;
  };
  QVERIFY(is(GL_DRAW_FRAMEBUFFER_BINDING, static_cast<GLint>(framebuffer)));
  QVERIFY(is(GL_READ_FRAMEBUFFER_BINDING, static_cast<GLint>(framebuffer)));
  QVERIFY(is(GL_VERTEX_ARRAY_BINDING, static_cast<GLint>(array)));
  QVERIFY(is(GL_ARRAY_BUFFER_BINDING, static_cast<GLint>(buffer)));
  QVERIFY(is(GL_ACTIVE_TEXTURE, GL_TEXTURE3));
  QVERIFY(is(GL_TEXTURE_BINDING_2D, static_cast<GLint>(texture)));
  QVERIFY(is(GL_CURRENT_PROGRAM, 0));
  QVERIFY(is(GL_CULL_FACE_MODE, GL_FRONT));
  QVERIFY(is(GL_BLEND_DST_ALPHA, GL_ONE) && is(GL_BLEND_SRC_ALPHA, GL_DST_ALPHA));
  QVERIFY(is(GL_DEPTH_FUNC, GL_NEVER) && is(GL_DEPTH_WRITEMASK, GL_FALSE));
  QVERIFY(is(GL_STENCIL_FUNC, GL_NEVER) && is(GL_STENCIL_REF, 5) && is(GL_STENCIL_BACK_FAIL, GL_INVERT));
  QVERIFY(glIsEnabled(GL_SCISSOR_TEST) && glIsEnabled(GL_BLEND) && glIsEnabled(GL_CULL_FACE));
  QVERIFY(!glIsEnabled(GL_DEPTH_TEST) && !glIsEnabled(GL_STENCIL_TEST));
  GLint viewport[4];
  glGetIntegerv(GL_VIEWPORT, viewport);
  QVERIFY(viewport[0] == 3 && viewport[1] == 4 && viewport[2] == 50 && viewport[3] == 60);
  GLboolean mask[4];
  glGetBooleanv(GL_COLOR_WRITEMASK, mask);
  QVERIFY(mask[0] && !mask[1] && mask[2] && !mask[3]);
  std::array<uint8_t, 4> corner{};
  glReadPixels(kWidth - 2, kHeight - 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, corner.data());
  QVERIFY(corner[1] > 0 && corner[3] == 255);  // the mask and the scissor box of others did not act on it
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));

  for (const GLenum name : {GL_SCISSOR_TEST, GL_CULL_FACE, GL_BLEND}) glDisable(name);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glBindVertexArray(0);
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteVertexArrays(1, &array);
  glDeleteBuffers(1, &buffer);
  glDeleteTextures(1, &texture);
  glDeleteTextures(1, &picture);
  glDeleteRenderbuffers(1, &stencil);
}

void TestRender::leavesNothingBehind() {
  const auto before = objectsInUse();
  for (int i = 0; i < 3; ++i) {
    Renderer renderer;
    renderImage(renderer, everything(), tray(), options());
  }
  QVERIFY(objectsInUse() == before);
  // Made in one context, used and destroyed in another that shares with it.
  HeadlessContext other(m_context.get());
  m_context->makeCurrent();
  auto renderer = std::make_unique<Renderer>();
  const auto first = renderImage(*renderer, everything(), tray(), options());
  other.makeCurrent();
  const auto second = renderImage(*renderer, everything(), tray(), options());
  renderer.reset();
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  m_context->makeCurrent();
  QVERIFY(objectsInUse() == before);
  QVERIFY(first == second);
}

void TestRender::twoThreadsDrawAsOneDoes() {
  const Snapshot snapshot = everything();
  const RenderScene scene = tray();
  std::array<RenderOptions, 2> views{options(), options(ColourBy::Temperature, false)};
  views[1].camera.azimuth = 120;
  std::array<std::vector<uint8_t>, 2> alone, together;
  for (size_t i = 0; i < 2; ++i) {
    Renderer renderer;
    alone[i] = renderImage(renderer, snapshot, scene, views[i]);
  }
  std::array<std::unique_ptr<HeadlessContext>, 2> contexts;
  for (auto& context : contexts) {
    context = std::make_unique<HeadlessContext>(m_context.get());
    context->release();
  }
  std::array<std::string, 2> problem;
  std::vector<std::thread> threads;
  for (size_t i = 0; i < 2; ++i)
    threads.emplace_back([&, i] {
      try {
        contexts[i]->makeCurrent();
        {
          Renderer renderer;
          for (int frame = 0; frame < 10; ++frame) together[i] = renderImage(renderer, snapshot, scene, views[i]);
        }
        if (glGetError() != GL_NO_ERROR) problem[i] = "OpenGL error";
        contexts[i]->release();
      } catch (const std::exception& error) {
        problem[i] = error.what();
      }
    });
  for (std::thread& thread : threads) thread.join();
  m_context->makeCurrent();
  for (size_t i = 0; i < 2; ++i) {
    QVERIFY2(problem[i].empty(), problem[i].c_str());
    QVERIFY(together[i] == alone[i]);
  }
}

QTEST_GUILESS_MAIN(TestRender)
#include "tst_render.moc"
