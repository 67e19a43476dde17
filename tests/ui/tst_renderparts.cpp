// SPDX-License-Identifier: Apache-2.0
// What a picture is made of, without OpenGL: camera, colours, instances, furniture.
#include "core/scene/scenewall.h"
#include "core/sketch/drawingplane.h"
#include "tests/ui/renderscenes.h"
#include "ui/render/framing.h"
#include "ui/render/furniture.h"
#include "ui/render/instances.h"
#include "ui/render/projector.h"

#include <Eigen/Geometry>

#include <QtTest/QtTest>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace ps;
using namespace ps::testing;

class TestRenderParts : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void cameraMapsPointsToPixelsAndBack_data();
  void cameraMapsPointsToPixelsAndBack();
  void matricesAgreeWithProject();
  void eyesOffTheAxisMapPointsToPixelsAndBack();
  void aSphereReachesAsFarAsItsRadiiSay();
  void orbitPanAndDollyKeepTheirPromise();
  void frameAllShowsTheWholeBox();
  void aSceneWithoutACameraIsShownWhole_data();
  void aSceneWithoutACameraIsShownWhole();
  void pickFindsTheNearestSphere();
  void colourMapEnds_data();
  void colourMapEnds();
  void automaticRanges();
  void fieldsOfPlugins();
  void interpolatesById();
  void interpolatesThroughTheFaceOfAPeriodicBox();
  void revisionsDoNotMix();
  void hidesOnlyWhatIsCovered();
  void leavesOutWhatIsBuried();
  void outlinesNoDroplets();
  void wallsAreClippedByEachOther();
  void curvedWallsAreGlass();
  void sectionsFaceWhoLooks();
  void aSectionCutsMatter();
  void aSectionCutsWalls();
  void glow_data();
  void glow();
};

void TestRenderParts::cameraMapsPointsToPixelsAndBack_data() {
  QTest::addColumn<double>("azimuth");
  QTest::addColumn<double>("elevation");
  for (const double elevation : {-90.0, -20.0, 0.0, 35.0, 90.0})
    for (const double azimuth : {0.0, 35.0, 180.0, -91.0})
      QTest::addRow("%g around, %g up", azimuth, elevation) << azimuth << elevation;
}

void TestRenderParts::cameraMapsPointsToPixelsAndBack() {
  QFETCH(double, azimuth);
  QFETCH(double, elevation);
  Camera camera;
  camera.azimuth = azimuth;
  camera.elevation = elevation;
  const Vector3 point{0.1, 0.3, -0.2};
  const std::optional<Vector3> pixel = project(camera, kWidth, kHeight, point);
  QVERIFY(pixel);
  const Ray ray = rayThrough(camera, kWidth, kHeight, (*pixel)[0], (*pixel)[1]);
  // The ray must pass the point: distance of the point from the line, in metres, to rounding of doubles.
  Vector3 d{}, offset{};
  double along = 0, miss = 0;
  for (size_t k = 0; k < 3; ++k) d[k] = point[k] - ray.origin[k], along += d[k] * ray.direction[k];
  for (size_t k = 0; k < 3; ++k) offset[k] = d[k] - ray.direction[k] * along, miss += offset[k] * offset[k];
  QVERIFY2(std::sqrt(miss) < 1e-9, qPrintable(QString::number(std::sqrt(miss))));
  QVERIFY(along > 0);
}

void TestRenderParts::matricesAgreeWithProject() {
  Camera camera;
  const Vector3 point{-0.3, 0.1, 0.25};
  const Vector4 clip = projectionMatrix(camera, kWidth, kHeight) * viewMatrix(camera) * point.homogeneous();
  const Vector3 pixel = *project(camera, kWidth, kHeight, point);
  QVERIFY(std::abs((clip[0] / clip[3] + 1) / 2 * kWidth - pixel[0]) < 1e-9);
  QVERIFY(std::abs((1 - clip[1] / clip[3]) / 2 * kHeight - pixel[1]) < 1e-9);
  QVERIFY(std::abs(clip[3] - pixel[2]) < 1e-12);
  QVERIFY((viewMatrix(camera) * viewMatrix(camera).inverse()).isIdentity(1e-12));
  QVERIFY(!project(camera, kWidth, kHeight, frameOf(camera).eye));
}

void TestRenderParts::eyesOffTheAxisMapPointsToPixelsAndBack() {
  Camera camera;
  const double left = -1.2, right = 0.5, down = -0.4, up = 0.9;
  const Eye eye = eyeThrough(viewMatrix(camera), left, right, down, up, 0.05, 40);
  QVERIFY(std::abs(nearPlane(eye) - 0.05) < 1e-12);
  QVERIFY((placeOf(eye) - frameOf(camera).eye).norm() < 1e-12);
  // Straight ahead is where the window says, not in the middle.
  const Vector3 ahead = *project(eye, kWidth, kHeight, camera.target);
  QVERIFY(std::abs(ahead.x() - kWidth * -left / (right - left)) < 1e-9);
  QVERIFY(std::abs(ahead.y() - kHeight * up / (up - down)) < 1e-9);
  const Vector3 point{0.1, 0.3, -0.2}, pixel = *project(eye, kWidth, kHeight, point);
  const Ray ray = rayThrough(eye, kWidth, kHeight, pixel.x(), pixel.y());
  QVERIFY((point - ray.origin).cross(ray.direction).norm() < 1e-12);
  Snapshot s;
  addParticle(s, point, 0.001, 0, api::Motion::Solid);
  QCOMPARE(pickParticle(s, ray), std::optional<size_t>(0));
}

/// The picture of a sphere far off the line of sight is an ellipse: no point of it lies farther from the picture of the
/// centre than the longer radius, give or take what the centre is off the ellipse's, and some lie nearly as far.
void TestRenderParts::aSphereReachesAsFarAsItsRadiiSay() {
  const Eye eye = eyeThrough(Matrix4::Identity(), -1, 2, -1, 1, 0.01, 10);
  const render::Projector projector(eye, 900, 600);
  const Vector3 centre{1.5, -0.6, -1};
  const double radius = 0.01;
  const auto at = projector.at(1.5f, -0.6f, -1);
  const auto [least, most] = projector.radiiOf(0.01f, at);
  double farthest = 0;
  for (int i = 0; i < 1000; ++i) {
    const double z = 2 * (i + 0.5) / 1000 - 1, angle = 2.4 * i, across = std::sqrt(1 - z * z);
    const Vector3 p = centre + radius * Vector3{across * std::cos(angle), across * std::sin(angle), z};
    const Vector3 pixel = *project(eye, 900, 600, p);
    farthest =
        std::max(farthest, std::hypot(pixel.x() - static_cast<double>(at.x), pixel.y() - static_cast<double>(at.y)));
  }
  QVERIFY2(std::abs(farthest / static_cast<double>(most) - 1) < 0.03, qPrintable(QString::number(farthest)));
  QVERIFY(std::abs(static_cast<double>(least) - 3) < 1e-3);  // 300 pixels a metre at a depth of 1 m
}

void TestRenderParts::orbitPanAndDollyKeepTheirPromise() {
  Camera camera;
  orbit(camera, 0, 200);
  QCOMPARE(camera.elevation, 90.0);
  camera = {};
  const Vector3 before = *project(camera, kWidth, kHeight, {0, 0.2, 0});
  pan(camera, kHeight, 17, -9);
  const Vector3 after = *project(camera, kWidth, kHeight, {0, 0.2, 0});  // it was the target: at the target's depth
  QVERIFY(std::abs(after[0] - before[0] - 17) < 1e-9 && std::abs(after[1] - before[1] + 9) < 1e-9);

  camera = {};
  const Ray ray = rayThrough(camera, kWidth, kHeight, 40, 150);
  const Vector3 under = *meet(ray, {camera.target, frameOf(camera).forward});
  dollyTo(camera, kWidth, kHeight, 40, 150, 0.4);
  const Vector3 pixel = *project(camera, kWidth, kHeight, under);
  QVERIFY(std::abs(pixel[0] - 40) < 1e-9 && std::abs(pixel[1] - 150) < 1e-9);
  QVERIFY(std::abs(camera.distance - 0.6) < 1e-12);
}

void TestRenderParts::frameAllShowsTheWholeBox() {
  for (const auto& [width, height] : {std::pair{320, 200}, {100, 400}}) {
    Camera camera;
    const Vector3 low{-1, 0, -2}, high{0.5, 3, 1};
    frameAll(camera, width, height, low, high);
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 p{corner & 1 ? low[0] : high[0], corner & 2 ? low[1] : high[1], corner & 4 ? low[2] : high[2]};
      const auto pixel = project(camera, width, height, p);
      QVERIFY(pixel && (*pixel)[0] >= 0 && (*pixel)[0] <= width && (*pixel)[1] >= 0 && (*pixel)[1] <= height);
    }
  }
}

void TestRenderParts::aSceneWithoutACameraIsShownWhole_data() {
  QTest::addColumn<double>("scale");
  QTest::newRow("a cup") << 0.1;
  QTest::newRow("a table") << 1.0;
  QTest::newRow("a lake") << 100.0;
}

/// Whatever its size: every particle and corner of the tray is in the picture, and the eye is not among them.
void TestRenderParts::aSceneWithoutACameraIsShownWhole() {
  QFETCH(double, scale);
  Snapshot s = everything();
  RenderScene scene = tray();
  for (api::Float4& p : s.position)
    for (float* v : {&p.x, &p.y, &p.z, &p.w}) *v *= static_cast<float>(scale);
  for (SceneWall& w : scene.environment.walls) w.point *= scale;
  scene.environment.boundsMinimum *= scale;
  scene.environment.boundsMaximum *= scale;
  const auto [low, high] = boxOf(s, scene.environment);
  QVERIFY((high - Vector3(0.4, 0.8, 0.4) * scale).norm() < 1e-6 * scale);  // the tray's, which holds all matter
  for (const auto& [width, height] : {std::pair{320, 200}, {100, 400}}) {
    const Camera camera = cameraShowing(s, scene.environment, width, height);
    for (const api::Float4& p : s.position) {
      const auto pixel = project(camera, width, height, vectorOf(p));
      QVERIFY(pixel && pixel->x() >= 0 && pixel->x() <= width && pixel->y() >= 0 && pixel->y() <= height);
    }
    const Vector3 eye = frameOf(camera).eye;
    QVERIFY((eye.array() > high.array()).any());
  }
  // Without matter and walls, the bounds.
  const auto [least, most] = boxOf(Snapshot{}, Environment{});
  QCOMPARE(least, Environment{}.boundsMinimum);
  QCOMPARE(most, Environment{}.boundsMaximum);
}

void TestRenderParts::pickFindsTheNearestSphere() {
  Camera camera;
  camera.target = {0, 0, 0};
  camera.elevation = camera.azimuth = 0;  // looks along -z
  Snapshot s;
  addParticle(s, {0, 0, -0.2}, 0.1, 5, api::Motion::Solid);
  addParticle(s, {0, 0, 0.2}, 0.1, 6, api::Motion::Solid);
  addParticle(s, {0.5, 0, 0}, 0.1, 7, api::Motion::Liquid);
  QCOMPARE(pickParticle(s, camera, kWidth, kHeight, kWidth / 2.0, kHeight / 2.0), std::optional<size_t>(1));
  const Vector3 third = *project(camera, kWidth, kHeight, {0.5, 0, 0});
  QCOMPARE(pickParticle(s, camera, kWidth, kHeight, third[0], third[1]), std::optional<size_t>(2));
  QVERIFY(!pickParticle(s, camera, kWidth, kHeight, 1, 1));
}

void TestRenderParts::colourMapEnds_data() {
  QTest::addColumn<QString>("colour");
  QTest::addColumn<double>("t");
  QTest::addColumn<double>("pivot");
  QTest::addColumn<int>("red");
  QTest::addColumn<int>("green");
  QTest::addColumn<int>("blue");
  const auto row = [](const char* name, const char* colour, double t, double pivot, int r, int g, int b) {
    QTest::newRow(name) << QString(colour) << t << pivot << r << g << b;
  };
  row("coldest", "temperature", 0, 0.2, 39, 71, 154);
  row("melting, pivot low", "temperature", 0.2, 0.2, 141, 194, 230);
  row("melting, pivot high", "temperature", 0.9, 0.9, 141, 194, 230);
  row("melting at the lower end", "temperature", 0, 0, 141, 194, 230);
  row("melting at the upper end", "temperature", 1, 1, 141, 194, 230);
  row("all far above melting", "temperature", 0, -9, 244, 186, 106);
  row("all far below melting", "temperature", 1, 9, 63, 124, 196);
  row("hottest", "temperature", 1, 0.2, 133, 28, 27);
  row("half of the cold side", "temperature", 0.25, 0.5, 63, 124, 196);
  row("solid", "phase", 0, 0, 58, 99, 184);
  row("melting phase", "phase", 0.25, 0, 181, 82, 143);
  row("liquid", "phase", 0.5, 0, 69, 196, 184);
  row("boiling", "phase", 0.75, 0, 242, 169, 59);
  row("gas", "phase", 1, 0, 245, 241, 230);
  row("at rest", "speed", 0, 0, 43, 27, 77);
  row("fast", "speed", 1, 0, 251, 229, 138);
  row("too thin", "density_error", 0, 0, 123, 63, 160);
  row("right density", "density_error", 0.5, 0, 201, 204, 208);
  row("too dense", "density_error", 1, 0, 30, 122, 70);
}

void TestRenderParts::colourMapEnds() {
  QFETCH(QString, colour);
  QFETCH(double, t);
  QFETCH(double, pivot);
  QFETCH(int, red);
  QFETCH(int, green);
  QFETCH(int, blue);
  const auto c = colourAt(colour.toStdString(), t, pivot);
  // Stops are whole 1/255 steps; half a step covers the rounding.
  QVERIFY2(std::abs(c[0] * 255 - static_cast<float>(red)) < 0.5f &&
               std::abs(c[1] * 255 - static_cast<float>(green)) < 0.5f &&
               std::abs(c[2] * 255 - static_cast<float>(blue)) < 0.5f,
           qPrintable(QString("%1 %2 %3").arg(c[0] * 255).arg(c[1] * 255).arg(c[2] * 255)));
}

void TestRenderParts::automaticRanges() {
  Snapshot s;
  addParticle(s, {0.13, 0, 0}, 0.01, 0, api::Motion::Solid, 273.15 - 8);
  addParticle(s, {0.31, 0, 0}, 0.01, 1, api::Motion::Liquid, 273.15 + 112);
  const auto close = [](std::pair<double, double> a, double low, double high) {
    return std::abs(a.first - low) < 1e-6 && std::abs(a.second - high) < 1e-6;
  };
  QVERIFY(close(colourRange(s, "temperature"), 273.15 - 10, 273.15 + 120));
  QVERIFY(close(colourRange(s, "speed"), 0, 0.5));
  QVERIFY(close(colourRange(s, "phase"), 0, 4));
  QVERIFY(close(colourRange(s, "density_error"), -0.05, 0.05));
  const auto none = colourRange(Snapshot{}, "temperature");
  QVERIFY(none.first < none.second);
}

/// A plugin's field is coloured like ours: found by its name, between round numbers or on its own scale, by the map
/// that all share; what is no number has the lower end's colour.
void TestRenderParts::fieldsOfPlugins() {
  Snapshot s;
  addParticle(s, {0, 0, 0}, 0.01, 0, api::Motion::Solid, 280);
  addParticle(s, {1, 0, 0}, 0.01, 1, api::Motion::Solid, 280);
  addParticle(s, {2, 0, 0}, 0.01, 2, api::Motion::Solid, 280);
  s.materialLook = {{0.5f, 0.5f, 0.5f, 1}};
  ParticleField field{.name = "org.example.rust.depth", .label = "Depth of rust", .unit = "m"};
  s.fields = {{std::make_shared<const ParticleField>(field), {2e-6f, 8e-4f, std::nanf("")}}};
  QCOMPARE(colourRange(s, field.name), (std::pair{0.0, 1e-3}));
  s.fields[0].values = {-20, 70, std::nanf("")};
  QCOMPARE(colourRange(s, field.name), (std::pair{-20.0, 70.0}));
  s.fields[0].values = {1000, 1000, std::nanf("")};
  const auto narrow = colourRange(s, field.name);
  QVERIFY(narrow.first == 1000 && narrow.second > 1000 && narrow.second <= 1010);
  field.minimum = -1, field.maximum = 3;
  s.fields = {{std::make_shared<const ParticleField>(field), {-1, 3, std::nanf("")}}};
  QCOMPARE(colourRange(s, field.name), (std::pair{-1.0, 3.0}));
  QCOMPARE(colourRange(s, "org.example.other"), (std::pair{0.0, 0.0}));
  QCOMPARE(colourMapOf(field.name), std::string("ember"));
  QCOMPARE(colourMapOf("temperature"), std::string("temperature"));

  render::InstanceRequest request;
  request.now = &s;
  request.colour = field.name;
  request.minimum = -1, request.maximum = 3;
  render::Instances out;
  render::collectInstances(request, out);
  std::sort(out.particles.begin(), out.particles.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  QCOMPARE(out.particles.size(), size_t{3});
  for (size_t i = 0; i < 3; ++i) QCOMPARE(out.particles[i].red, colourAt(field.name, i == 1 ? 1 : 0, 0)[0]);
}

void TestRenderParts::interpolatesById() {
  Snapshot before, now;
  before.materialLook = now.materialLook = {{0.5f, 0.5f, 0.5f, 1}};
  addParticle(before, {0, 0, 0}, 0.01, 7, api::Motion::Solid, 100);
  addParticle(before, {1, 0, 0}, 0.01, 3, api::Motion::Solid, 200);
  addParticle(now, {1, 1, 0}, 0.03, 3, api::Motion::Solid, 300);
  addParticle(now, {5, 5, 5}, 0.01, 9, api::Motion::Solid, 300);  // new: stands where it is
  addParticle(now, {0, 0, 2}, 0.01, 7, api::Motion::Solid, 500);
  render::InstanceRequest request;
  request.now = &now;
  request.previous = &before;
  request.blend = 0.25f;
  request.colour = "temperature";
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
  const auto expected = colourAt("temperature", 0.25, (273.15 - 100) / 400);
  QVERIFY(std::abs(out.particles[2].red - expected[0]) < 0.005f);
}

void TestRenderParts::interpolatesThroughTheFaceOfAPeriodicBox() {
  Snapshot before, now;
  now.period = before.period = Period({-1, -1, -1}, {1, 1, 1}, {true, false, false});
  addParticle(before, {0.9, 0.9, 0}, 0.01, 0, api::Motion::Liquid);
  addParticle(now, {-0.9, -0.9, 0}, 0.01, 0, api::Motion::Liquid);  // through x, across y
  render::InstanceRequest request;
  request.now = &now;
  request.previous = &before;
  request.blend = 0.25f;
  render::Instances out;
  render::collectInstances(request, out);
  QVERIFY(std::abs(out.particles[0].x - 0.95f) < 1e-6f);
  QVERIFY(std::abs(out.particles[0].y - 0.45f) < 1e-6f);
}

void TestRenderParts::revisionsDoNotMix() {
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

void TestRenderParts::hidesOnlyWhatIsCovered() {
  Camera camera;
  camera.target = {0, 0, 0};
  camera.elevation = camera.azimuth = 0;
  const render::Projector projector(eyeOf(camera, kWidth, kHeight), kWidth, kHeight);
  const auto sphere = [](float x, float z, float r, float mark) { return render::Instance{x, 0, z, r, 0, 0, 0, mark}; };
  const std::vector<render::Instance> all{sphere(0, -0.5f, 0.05f, 1), sphere(0, 0.2f, 0.2f, 2),
                                          sphere(0.25f, -0.5f, 0.1f, 3)};
  std::vector<render::Instance> seen;
  render::sortVisible(projector, all, seen);
  QCOMPARE(seen.size(), size_t{2});
  QCOMPARE(seen[0].extra, 2.f);
  QCOMPARE(seen[1].extra, 3.f);  // peeps out behind the large one
}

void TestRenderParts::leavesOutWhatIsBuried() {
  std::vector<render::Instance> list;
  render::Extent extent;
  for (int i = 0; i < 1000; ++i) {
    const int x = i % 10, y = i / 10 % 10, z = i / 100;
    list.push_back({0.02f * static_cast<float>(x), 0.02f * static_cast<float>(y), 0.02f * static_cast<float>(z),
                    0.0124f, 0, 0, 0, static_cast<float>(i)});
    extent.add(list.back().x, list.back().y, list.back().z, 0.0124f);
  }
  const size_t exposed = render::exposedFirst(extent, 0.0124f, 2 * 0.0124f, 1, list);
  QCOMPARE(list.size(), size_t{1000});
  QVERIFY(exposed < 1000);
  list.resize(exposed);
  const auto outer = [](int i) {
    const auto edge = [](int v) { return v == 0 || v == 9; };
    return edge(i % 10) || edge(i / 10 % 10) || edge(i / 100);
  };
  size_t kept = 0;
  for (const render::Instance& p : list) kept += outer(static_cast<int>(p.extra));
  QCOMPARE(kept, size_t{1000 - 512});  // the whole outer layer
}

void TestRenderParts::wallsAreClippedByEachOther() {
  const RenderScene scene = tray();
  for (const size_t index : {size_t{0}, size_t{1}}) {
    const render::Face face = render::wallFace(scene.environment, index);
    QCOMPARE(face.corners.size(), size_t{4});
    for (const Vector3& p : face.corners) {
      QVERIFY(std::abs(std::abs(p[0]) - 0.4) < 1e-9 && std::abs(std::abs(p[2]) - 0.4) < 1e-9);
      QVERIFY(std::abs(p[1] - (index ? 0.8 : 0)) < 1e-9);
    }
    for (const bool walled : face.walled) QVERIFY(walled);
  }
  const render::Furniture furniture = render::buildFurniture(scene.environment, true);
  QVERIFY(furniture.hasFloor && furniture.hasLid && !furniture.opaque.empty() && !furniture.clear.empty());
  QVERIFY(std::abs(furniture.half[0] - 0.4f) < 1e-6f && std::abs(furniture.lidHeight - 0.8f) < 1e-6f);
  for (const MeshVertex& v : furniture.opaque) {
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

/// On their faces, and no farther than planes let them be seen.
void TestRenderParts::curvedWallsAreGlass() {
  Environment environment = tray().environment;
  const size_t planes = render::buildFurniture(environment, true).clear.size();
  for (const char* shape : {"cylinder", "sphere"}) {
    SceneWall round = wall("round", {0, 0.1, 0}, {0, 1, 0}, 0);
    round.parameters.values["shape"] = std::string(shape);
    round.parameters.values["radius"] = 0.3;
    Environment with = environment;
    with.walls.push_back(round);
    const WallFace face = faceOf(round);
    const render::Furniture furniture = render::buildFurniture(with, true);
    QVERIFY(furniture.clear.size() > planes + 100);
    double lowest = 1, highest = 0;
    for (size_t k = planes; k < furniture.clear.size(); ++k) {
      const auto& [position, normal, material] = furniture.clear[k];
      const Vector3 at(double{position[0]}, double{position[1]}, double{position[2]});
      const Vector3 towards(double{normal[0]}, double{normal[1]}, double{normal[2]});
      QVERIFY(std::abs(face.heightOf(at)) < 0.002);  // facets
      QVERIFY((face.at(at).normal - towards).norm() < 0.01);
      lowest = std::min(lowest, at.y());
      highest = std::max(highest, at.y());
    }
    QVERIFY(std::abs(lowest) < 1e-6);  // on the floor
    QVERIFY(std::abs(highest - (face.form() == WallForm::Sphere ? 0.4 : 0.8)) < 1e-6);
  }
}

/// Droplets around a block get no ring of their own, a rope as thin as one particle does; of what is all droplets each
/// is outlined.
void TestRenderParts::outlinesNoDroplets() {
  constexpr double kRadius = 0.01;
  Snapshot s, drops;
  uint32_t id = 0;
  for (int i = 0; i < 27; ++i)
    addParticle(s, Vector3(i % 3, i / 3 % 3, i / 9) * 2 * kRadius, kRadius, id++, api::Motion::Solid);
  for (int i = 0; i < 12; ++i) addParticle(s, {0.3 + 2 * kRadius * i, 0, 0}, kRadius, id++, api::Motion::Solid);
  for (Snapshot* to : {&s, &drops}) {
    for (int i = 0; i < 5; ++i) addParticle(*to, {0.1 * i, 0.5, 0}, kRadius, id++, api::Motion::Liquid);
    addParticle(*to, {0.02, 0.5, 0}, kRadius, id++, api::Motion::Liquid);  // two of them in one
  }
  render::InstanceRequest request;
  request.outlined = {1};
  const auto outlined = [&](const Snapshot& of) {
    render::Instances out;
    request.now = &of;
    render::collectInstances(request, out);
    return out.outlined;
  };
  QCOMPARE(outlined(s), size_t{27 + 12});
  QCOMPARE(outlined(drops), size_t{6});
  // A crumb that is a body of its own is outlined beside a large one.
  for (int i = 0; i < 3; ++i) {
    addParticle(s, {0.9 + 2 * kRadius * i, 0, 0}, kRadius, id++, api::Motion::Solid);
    s.body.back() = 1;
  }
  QCOMPARE(outlined(s), size_t{27 + 12});
  request.outlined = {1, 1};
  QCOMPARE(outlined(s), size_t{27 + 12 + 3});
}

/// Along an axis the same for everybody; one that faces the viewer cuts away what is near, flipped what is far.
void TestRenderParts::sectionsFaceWhoLooks() {
  ViewSection kept{"x", {0.1, 5, 7}, false};
  const Vector3 forward = Vector3(1, -1, -2).normalized();
  QVERIFY(sectionFor(kept, forward).shows({0.09, 0, 0}) && !sectionFor(kept, forward).shows({0.11, 0, 0}));
  kept.flipped = true;
  QVERIFY(!sectionFor(kept, forward).shows({0.09, 0, 0}) && sectionFor(kept, forward).shows({0.11, 0, 0}));
  kept.across = "view";
  QVERIFY(sectionFor(kept, forward).shows(kept.through - 0.01 * forward));
  kept.flipped = false;
  QVERIFY(!sectionFor(kept, forward).shows(kept.through - 0.01 * forward));
  QVERIFY(sectionFor(kept, forward).shows(kept.through + 0.01 * forward));
  const auto left = leftOf({{{0, 0, 0}, {1, 0, 0}}, {{2, 0, 0}, {3, 0, 0}}}, Section{{Vector3(-1, 0, 0), -0.25}});
  QCOMPARE(left.size(), size_t{1});
  QVERIFY(left[0].first == Vector3(0, 0, 0) && (left[0].second - Vector3(0.25, 0, 0)).norm() < 1e-12);
}

/// Of all kinds of matter, of another run's ghost and of outlines only what lies on the side that is left is drawn, and
/// rays go through the rest.
void TestRenderParts::aSectionCutsMatter() {
  const Snapshot s = everything();
  const Section section{{Vector3(-1, 0, 0), -0.01}};
  render::InstanceRequest request;
  request.now = request.ghost = &s;
  request.outlined = {1};
  render::Instances whole, cut;
  render::collectInstances(request, whole);
  request.section = section;
  render::collectInstances(request, cut);
  QVERIFY(cut.buriedSpheres + cut.spheres > 0 && cut.liquids() > 0 && cut.vapours > 0);
  QVERIFY(cut.ghosts > 0 && cut.ghosts < whole.ghosts);
  QVERIFY(cut.outlined > 0 && cut.outlined < whole.outlined);
  for (const render::Instance& p : cut.particles) QVERIFY(p.x <= 0.0101f);
  Snapshot two;
  addParticle(two, {0.3, 0.2, 0}, 0.05, 0, api::Motion::Solid);
  addParticle(two, {-0.3, 0.2, 0}, 0.05, 1, api::Motion::Solid);
  const Ray ray{{1, 0.2, 0}, {-1, 0, 0}};
  QCOMPARE(pickParticle(two, ray), std::optional<size_t>(0));
  QCOMPARE(pickParticle(two, ray, section), std::optional<size_t>(1));
  QVERIFY(!pickParticle(two, ray, Section{{Vector3(-1, 0, 0), 0.5}}));
}

/// Panes, lids and glass end at the section; floors stay whole as long as any of them is left.
void TestRenderParts::aSectionCutsWalls() {
  Environment environment = tray().environment;
  for (const char* shape : {"cylinder", "sphere"}) {
    SceneWall round = wall(shape, {0, 0.3, 0}, {0, 1, 0}, 0);
    round.parameters.values = {{"shape", std::string(shape)}, {"radius", 0.2}};
    environment.walls.push_back(round);
  }
  const render::Furniture whole = render::buildFurniture(environment, true);
  const auto vector = [](const std::array<float, 3>& p) { return Vector3(double{p[0]}, double{p[1]}, double{p[2]}); };
  constexpr double kMargin = 0.03;  // m: the rounded sides of a lid
  for (const Vector3& kept : {Vector3(0, -1, 0), Vector3(-1, 0, 0), Vector3(Vector3(1, 0, -2).normalized())}) {
    const Section section{{kept, kept.dot(Vector3(0, 0.35, 0))}};
    const render::Furniture cut = render::buildFurniture(environment, true, section);
    QVERIFY(cut.clear.size() > 100 && cut.clear.size() < whole.clear.size() + 500);
    for (const MeshVertex& v : cut.clear) QVERIFY(section.plane.heightOf(vector(v.position)) > -kMargin);
    for (const render::EdgeVertex& v : cut.edges) QVERIFY(section.plane.heightOf(vector(v.position)) > -1e-6);
    QCOMPARE(cut.opaque.size(), whole.opaque.size());
  }
  const render::Furniture above = render::buildFurniture(environment, true, Section{{Vector3(0, 1, 0), 0.1}});
  QVERIFY(above.opaque.empty());
  QVERIFY(whole.hasFloor && !above.hasFloor);  // nor does it cast a shadow
  QVERIFY(above.ground == whole.ground && above.size == whole.size);
}

void TestRenderParts::glow_data() {
  QTest::addColumn<double>("temperature");
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::newRow("not held at a temperature") << 0.0 << 0.0 << 0.0;
  QTest::newRow("room") << 293.15 << 0.0 << 0.0;
  QTest::newRow("90 degrees Celsius") << 363.15 << 0.2 << 0.6;
  QTest::newRow("200 degrees Celsius") << 473.15 << 1.0 << 1.0;
}

void TestRenderParts::glow() {
  QFETCH(double, temperature);
  QFETCH(double, low);
  QFETCH(double, high);
  const double value = render::glowOf(wall("floor", {0, 0, 0}, {0, 1, 0}, temperature));
  QVERIFY2(value >= low && value <= high, qPrintable(QString::number(value)));
}

QTEST_APPLESS_MAIN(TestRenderParts)
#include "tst_renderparts.moc"
