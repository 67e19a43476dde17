// SPDX-License-Identifier: Apache-2.0
// Pictures, drawn by OpenGL without a window.
#include <epoxy/gl.h>

#include "core/base/error.h"
#include "tests/ui/renderscenes.h"
#include "ui/render/camera.h"

#include <QtTest/QtTest>

#include <cmath>
#include <exception>
#include <numbers>
#include <thread>

using namespace ps;
using namespace ps::testing;

namespace {

Shot options(const std::string& colour = kMatterColour, bool dark = true) {
  Shot o;
  o.look.colour = colour;
  o.look.dark = dark;
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

}  // namespace

class TestRender : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context = std::make_unique<HeadlessContext>(); }
  void cleanupTestCase() { m_context.reset(); }

  void picturesAreNotBlank_data();
  void picturesAreNotBlank();
  void sphereCoversItsProjection_data();
  void sphereCoversItsProjection();
  void nearerSphereWins();
  void onlyClearLiquidIsSeenThrough_data();
  void onlyClearLiquidIsSeenThrough();
  void sizesAtTheEdge_data();
  void sizesAtTheEdge();
  void tooLargeAPictureIsRefused_data();
  void tooLargeAPictureIsRefused();
  void furnitureFollowsItsScene();
  void aSectionShowsWhatIsInside_data();
  void aSectionShowsWhatIsInside();
  void aSectionCutsLids();
  void theSelectedBodyHasAnOutline_data();
  void theSelectedBodyHasAnOutline();
  void aGhostIsToldApart_data();
  void aGhostIsToldApart();
  void restoresState();
  void leavesNothingBehind();
  void twoThreadsDrawAsOneDoes();

 private:
  std::unique_ptr<HeadlessContext> m_context;
};

void TestRender::picturesAreNotBlank_data() {
  QTest::addColumn<QString>("colour");
  QTest::addColumn<bool>("dark");
  QTest::addColumn<double>("elevation");
  QTest::addColumn<bool>("still");
  const QString matter = kMatterColour;
  for (const QString& colour :
       {matter, QString("temperature"), QString("phase"), QString("speed"), QString("density_error"),
        QString("gas_fraction"), QString("body"), QString("no such field")})
    for (const bool dark : {true, false})
      QTest::addRow("%s %s", qPrintable(colour), dark ? "dark" : "light") << colour << dark << 20.0 << false;
  QTest::newRow("from above") << matter << true << 90.0 << false;
  QTest::newRow("from below") << matter << true << -40.0 << false;
  QTest::newRow("still") << matter << true << 20.0 << true;
}

void TestRender::picturesAreNotBlank() {
  QFETCH(QString, colour);
  QFETCH(bool, dark);
  QFETCH(double, elevation);
  QFETCH(bool, still);
  Renderer renderer;
  const RenderScene scene = tray();
  Shot o = options(colour.toStdString(), dark);
  o.camera.elevation = elevation;
  o.size.still = still;
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
  Shot o = options("phase", false);
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
  Shot o = options("phase");
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

void TestRender::onlyClearLiquidIsSeenThrough_data() {
  QTest::addColumn<float>("clearness");
  QTest::addColumn<QString>("colour");
  QTest::newRow("water") << 1.f << QString("material");
  QTest::newRow("lava") << 0.f << QString("material");
  QTest::newRow("lava coloured by temperature") << 0.f << QString("temperature");
}

/// A sphere behind a curtain of liquid shows in the picture only where the liquid is clear.
void TestRender::onlyClearLiquidIsSeenThrough() {
  QFETCH(float, clearness);
  QFETCH(QString, colour);
  Renderer renderer;
  Snapshot curtain;
  curtain.materialLook = {{0.9f, 0.3f, 0.1f, clearness}, {0, 1, 0, 0}};
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j)
      addParticle(curtain, {i * 0.02 - 0.15, 0.15 + j * 0.02, 0}, 0.0124, static_cast<uint32_t>(16 * i + j),
                  api::Motion::Liquid);
  Snapshot behind = curtain;
  addParticle(behind, {0, 0.3, -0.15}, 0.06, 999, api::Motion::Solid);
  behind.material.back() = 1;
  Shot o = options(colour.toStdString());
  o.camera = Camera{{0, 0.3, 0}, 1, 0, 0};
  const auto without = pixelAt(renderImage(renderer, curtain, RenderScene{}, o), kWidth / 2, kHeight / 2);
  const auto with = pixelAt(renderImage(renderer, behind, RenderScene{}, o), kWidth / 2, kHeight / 2);
  const int seen = std::abs(with[0] - without[0]) + std::abs(with[1] - without[1]) + std::abs(with[2] - without[2]);
  const QByteArray all =
      QByteArray::number(seen) + " red " + QByteArray::number(without[0]) + " blue " + QByteArray::number(without[2]);
  QVERIFY2(clearness > 0.5f ? seen > 60 : seen < 6, all.constData());
  // Opaque matter has its own colour.
  if (clearness < 0.5f && o.look.colour == "material") QVERIFY2(without[0] > 2 * without[2], all.constData());
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
  Shot o = options();
  o.size.width = width;
  o.size.height = height;
  Snapshot broken = everything();
  broken.position[3].x = std::numeric_limits<float>::quiet_NaN();
  broken.position[4].w = 0;
  for (const bool still : {false, true}) {
    o.size.still = still;
    const auto image = renderImage(renderer, broken, tray(), o);
    QCOMPARE(image.size(), static_cast<size_t>(width * height * 4));
    QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
  o.camera.target = {0, 0.1, 0};
  o.camera.distance = 0.01;  // inside the block
  renderImage(renderer, everything(), tray(), o);
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

void TestRender::tooLargeAPictureIsRefused_data() {
  QTest::addColumn<bool>("wide");
  QTest::addColumn<bool>("still");
  QTest::newRow("wide") << true << false;
  QTest::newRow("high") << false << false;
  QTest::newRow("smooth edges take twice the pixels") << true << true;
}

/// One pixel beyond what the driver can: a sentence, not a black picture; and the next picture is as it ever was.
void TestRender::tooLargeAPictureIsRefused() {
  QFETCH(bool, wide);
  QFETCH(bool, still);
  Renderer renderer;
  const Snapshot snapshot = everything();
  const auto before = renderImage(renderer, snapshot, tray(), options());
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  Shot large = options();
  large.size.still = still;
  (wide ? large.size.width : large.size.height) = (still ? most / 2 : most) + 1;
  (wide ? large.size.height : large.size.width) = 2;
  try {
    renderImage(renderer, snapshot, tray(), large);
    QFAIL("drawn");
  } catch (const Error& error) {
    const QString text = QString::fromUtf8(error.what());
    QVERIFY2(text.contains(QString::number(still ? most / 2 : most)) && text.contains(QStringLiteral("smaller")),
             qPrintable(text));
  }
  QCOMPARE(glGetError(), GLenum(GL_NO_ERROR));
  QVERIFY(renderImage(renderer, snapshot, tray(), options()) == before);
}

/// What is kept of the walls from frame to frame is made anew when they, or the theme, change.
void TestRender::furnitureFollowsItsScene() {
  Renderer renderer;
  const Snapshot snapshot = everything();
  RenderScene cold = tray(), small = tray();
  cold.environment.walls[0].parameters.values["temperature"] = 280.0;
  small.environment.walls[3].point = {0.25, 0, 0};
  const Shot dark = options(), light = options("material", false);
  const std::vector<std::pair<const RenderScene*, const Shot*>> all{
      {&cold, &dark}, {&small, &dark}, {&small, &light}, {&cold, &light}, {&cold, &dark}};
  std::vector<std::vector<uint8_t>> pictures;
  for (const auto& [scene, how] : all) {
    pictures.push_back(renderImage(renderer, snapshot, *scene, *how));
    Renderer fresh;
    QVERIFY(renderImage(fresh, snapshot, *scene, *how) == pictures.back());
  }
  for (size_t i = 1; i < 4; ++i) QVERIFY(pictures[i] != pictures[i - 1]);
  QVERIFY(pictures[4] == pictures[0]);
}

void TestRender::aSectionShowsWhatIsInside_data() {
  QTest::addColumn<QString>("colour");
  QTest::addColumn<int>("inside");  // api::Motion
  QTest::newRow("solid in a kettle") << QString(kMatterColour) << static_cast<int>(api::Motion::Solid);
  QTest::newRow("liquid in a kettle") << QString(kMatterColour) << static_cast<int>(api::Motion::Liquid);
  QTest::newRow("by phases") << QStringLiteral("phase") << static_cast<int>(api::Motion::Liquid);
}

/// A red kettle, closed all round and held in place, with something blue in it: of that one sees nothing until the near
/// side is cut away, and then it stands between what is left of the kettle's sides.
void TestRender::aSectionShowsWhatIsInside() {
  QFETCH(QString, colour);
  QFETCH(int, inside);
  Snapshot s;
  s.materialLook = {{0.9f, 0.1f, 0.1f, 0}, {0.1f, 0.2f, 0.9f, 0}};
  constexpr int kHalf = 6;
  constexpr double kStep = 0.02;
  uint32_t id = 0;
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      for (int k = -kHalf; k <= kHalf; ++k) {
        const bool shell = std::max({std::abs(i), std::abs(j), std::abs(k)}) >= kHalf - 1;
        const Vector3 place(i * kStep, 0.2 + j * kStep, k * kStep);
        addParticle(s, place, 0.0124, id++, shell ? api::Motion::Static : static_cast<api::Motion>(inside));
        s.material.back() = shell ? 0 : 1;
      }
    }
  }
  Renderer renderer;
  Shot o = options(colour.toStdString());
  o.camera.azimuth = o.camera.elevation = 0;
  o.camera.distance = 1;
  const int middle = kWidth / 2, height = kHeight / 2;
  const auto wallPixel = *project(o.camera, kWidth, kHeight, {(kHalf - 0.5) * kStep, 0.2, 0});
  const auto draw = [&](std::optional<Section> section) {
    o.look.section = section;
    const auto image = renderImage(renderer, s, RenderScene{}, o);
    return std::pair(pixelAt(image, middle, height), pixelAt(image, static_cast<int>(wallPixel.x()), height));
  };
  const auto differ = [](const std::array<int, 3>& a, const std::array<int, 3>& b) {
    return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) > 60;
  };
  const auto [closed, side] = draw({});
  QVERIFY(!differ(closed, side));  // the same kettle in both places
  const auto [opened, wall] = draw(Section{{Vector3(0, 0, -1), 0}});
  QVERIFY(differ(opened, closed) && differ(opened, wall));
  if (colour == kMatterColour) {
    QVERIFY(closed[0] > closed[2] && wall[0] > wall[2]);  // red
    QVERIFY(opened[2] > opened[0]);                       // blue
  }
  const auto [other, otherWall] = draw(Section{{Vector3(0, 0, 1), 0}});  // its far side is gone
  QVERIFY(!differ(other, closed) && !differ(otherWall, side));
  const auto [gone, goneWall] = draw(Section{{Vector3(0, 0, -1), 1}});  // nothing lies so far back
  QVERIFY(differ(gone, closed) && differ(gone, opened) && !differ(gone, goneWall));
}

/// The lid's frosted plate goes where a level section lies below it, and comes back with it.
void TestRender::aSectionCutsLids() {
  Renderer renderer;
  Shot o = options();
  o.camera.distance = 3;
  const auto whole = renderImage(renderer, everything(), tray(), o);
  o.look.section = Section{{Vector3(0, -1, 0), -0.75}};
  const auto cut = renderImage(renderer, everything(), tray(), o);
  size_t changed = 0;
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) changed += difference(whole, cut, i) > 12;
  QVERIFY2(changed > 500, qPrintable(QString::number(changed)));
  o.look.section.reset();
  QVERIFY(renderImage(renderer, everything(), tray(), o) == whole);
}

void TestRender::theSelectedBodyHasAnOutline_data() {
  QTest::addColumn<QString>("colour");
  QTest::addColumn<bool>("still");
  QTest::addColumn<int>("motion");
  QTest::newRow("matter") << QString("material") << false << int(api::Motion::Solid);
  QTest::newRow("temperature") << QString("temperature") << false << int(api::Motion::Solid);
  QTest::newRow("a still") << QString("material") << true << int(api::Motion::Solid);
  QTest::newRow("liquid") << QString("material") << false << int(api::Motion::Liquid);
}

/// Two spheres, one selected: a ring of the line's colour around its picture, two pixels wide, and nothing of it on the
/// sphere itself, around the other, or far away.
void TestRender::theSelectedBodyHasAnOutline() {
  QFETCH(QString, colour);
  QFETCH(bool, still);
  QFETCH(int, motion);
  Renderer renderer;
  Snapshot s;
  s.materialLook = {{0.75f, 0.87f, 0.98f, 1}};
  constexpr double kRadius = 0.08;
  const Vector3 chosen{-0.15, 0.3, 0}, other{0.15, 0.3, 0};
  addParticle(s, chosen, kRadius, 0, static_cast<api::Motion>(motion));
  addParticle(s, other, kRadius, 1, static_cast<api::Motion>(motion));
  s.body = {7, 3};
  Shot o = options(colour.toStdString());
  o.camera = Camera{{0, 0.3, 0}, 1.5, 0, 0};
  o.size.still = still;
  const auto plain = renderImage(renderer, s, tray(), o);
  o.look.outline = BodyOutline{{7}, {1, 0, 1}, {0, 0, 0}};
  const auto outlined = renderImage(renderer, s, tray(), o);
  const double pixel = pixelSize(o.camera, kHeight, 1.5);
  const double growth = motion == int(api::Motion::Liquid) ? 1.25 : 1;  // a surface lies outside its particles
  const auto centre = project(o.camera, kWidth, kHeight, chosen);
  QVERIFY(centre);
  int line = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double away = std::hypot(x + 0.5 - (*centre)[0], y + 0.5 - (*centre)[1]) - growth * kRadius / pixel;
      const auto [r, g, b] = pixelAt(outlined, x, y);
      const bool magenta = r > 200 && g < 60 && b > 200;
      line += magenta;
      // Perspective moves the silhouette by less than a pixel here; smoothing spreads the line by another.
      if (magenta) QVERIFY2(away > -1.5 && away < 4, qPrintable(QString::number(away)));
      if (away < -3 || away > 7) QCOMPARE(pixelAt(outlined, x, y), pixelAt(plain, x, y));
    }
  }
  // A ring of two pixels less what smoothing takes.
  const double ring = 2 * std::numbers::pi * (growth * kRadius / pixel + 1);
  QVERIFY2(line > 0.7 * ring && line < 2.5 * ring, qPrintable(QStringLiteral("%1 of %2").arg(line).arg(ring)));
  o.look.outline->bodies = {99};
  QVERIFY(renderImage(renderer, s, tray(), o) == plain);
}

void TestRender::aGhostIsToldApart_data() {
  QTest::addColumn<bool>("still");
  QTest::addColumn<int>("motion");
  QTest::newRow("solid") << false << int(api::Motion::Solid);
  QTest::newRow("a still") << true << int(api::Motion::Solid);
  QTest::newRow("liquid") << false << int(api::Motion::Liquid);
  QTest::newRow("vapour") << false << int(api::Motion::Gas);
}

/// Of one sphere beside the one that is there: hatched, in its colour or not, and nothing anywhere else. Where both
/// runs have their matter at one place there is none; behind matter it is fainter than before it.
void TestRender::aGhostIsToldApart() {
  QFETCH(bool, still);
  QFETCH(int, motion);
  Renderer renderer;
  const auto sphereAt = [&](const Vector3& place) {
    auto s = std::make_shared<Snapshot>();
    s->materialLook = {{0.75f, 0.87f, 0.98f, 0}};
    addParticle(*s, place, 0.08, 0, static_cast<api::Motion>(motion));
    return s;
  };
  const Snapshot now = *sphereAt({-0.15, 0.3, 0});
  Shot o = options(kMatterColour);
  o.camera = Camera{{0, 0.3, 0}, 1.5, 0, 0};
  o.size.still = still;
  const auto plain = renderImage(renderer, now, tray(), o);
  const Vector3 place{0.15, 0.3, 0};
  o.look.ghost = Ghost{sphereAt(place), {1, 0, 1}, {1, 1, 1}, 1.5f};
  const auto shown = renderImage(renderer, now, tray(), o);
  const Vector3 centre = *project(o.camera, kWidth, kHeight, place);
  const double radius = 0.08 / pixelSize(o.camera, kHeight, 1.5);
  int faint = 0, strong = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double away = std::hypot(x + 0.5 - centre.x(), y + 0.5 - centre.y()) - radius;
      const int change = difference(shown, plain, static_cast<size_t>(y * kWidth + x));
      if (away > 2) QCOMPARE(pixelAt(shown, x, y), pixelAt(plain, x, y));
      if (away < -5) ++(change > 150 ? strong : faint);  // a stripe, or between two
      if (away < -5) QVERIFY2(change > 20, qPrintable(QString::number(change)));
    }
  }
  QVERIFY2(strong > faint / 10 && faint > strong / 2, qPrintable(QStringLiteral("%1, %2").arg(strong).arg(faint)));

  const auto changed = [&](const Vector3& where) {
    o.look.ghost->matter = sphereAt(where);
    const auto image = renderImage(renderer, now, tray(), o);
    int sum = 0;
    for (size_t i = 0; i < image.size() / 4; ++i) sum += difference(image, plain, i);
    return sum;
  };
  if (motion == int(api::Motion::Gas)) return;  // a cloud hides nothing
  QCOMPARE(changed({-0.15, 0.3, 0}), 0);
  // As large in the picture, nearer and farther along the line of sight of the sphere's middle.
  const int before = changed({-0.15 * 0.8, 0.3, 0.3}), behind = changed({-0.15 * 1.2, 0.3, -0.3});
  QVERIFY2(behind > 0 && before > 1.5 * behind, qPrintable(QStringLiteral("%1, %2").arg(before).arg(behind)));
  o.look.ghost->matter = std::make_shared<Snapshot>();
  QVERIFY(renderImage(renderer, now, tray(), o) == plain);
  auto fixed = sphereAt(place);
  fixed->motion = {api::Motion::Static};
  o.look.ghost->matter = fixed;
  QVERIFY(renderImage(renderer, now, tray(), o) == plain);
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

  renderer.prepare(everything(), nullptr, 1, tray(), options().look);
  const auto is = [](GLenum name, GLint expected) {
    GLint value = -1;
    glGetIntegerv(name, &value);
    return value == expected;
  };
  QVERIFY(is(GL_DRAW_FRAMEBUFFER_BINDING, static_cast<GLint>(framebuffer)) && is(GL_DEPTH_FUNC, GL_NEVER));
  renderer.draw(options().eye(), {framebuffer, 0, 0, options().size});

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
  std::array<Shot, 2> views{options(), options("temperature", false)};
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
