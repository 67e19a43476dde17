// SPDX-License-Identifier: Apache-2.0
// What a headset asks of a renderer beyond pictures: matter that another thread prepares, and depths.
#include <epoxy/gl.h>

#include "core/base/error.h"
#include "tests/ui/renderscenes.h"

#include <QtTest/QtTest>

#include <cmath>
#include <thread>

using namespace ps;
using namespace ps::testing;

class TestRenderHeadset : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context = std::make_unique<HeadlessContext>(); }
  void cleanupTestCase() { m_context.reset(); }

  void preparedOnAnotherThreadIsTheSame();
  void coarserPicturesKeepWhatIsThere();
  void depthsAreOfTheLastPicture_data();
  void depthsAreOfTheLastPicture();

 private:
  std::unique_ptr<HeadlessContext> m_context;
};

/// Two scenes in turn, with walls of their own, and what hands hold stays.
void TestRenderHeadset::preparedOnAnotherThreadIsTheSame() {
  Shot shot;
  Props props;
  for (const auto& [x, y] : {std::array{-0.1f, 0.2f}, {0.1f, 0.2f}, {0, 0.4f}})
    props.opaque.push_back({{x, y, 0.2f}, {0, 0, 1}, {1, 0, 0, 0}});
  RenderScene open = tray();
  open.environment.walls.resize(1);
  Snapshot later = everything();
  for (api::Float4& p : later.position) p.y += 0.05f;
  const Snapshot before = everything();
  Renderer usual, renderer;
  usual.show(props);
  renderer.show(props);
  Preparation preparation;
  QVERIFY_EXCEPTION_THROWN(renderer.take(preparation), Error);
  for (const bool second : {false, true, false, true}) {
    const RenderScene& scene = second ? open : tray();
    std::thread([&] { preparation.make(later, &before, second ? 1 : 0.5, scene, shot.look); }).join();
    renderer.take(preparation);
    usual.prepare(later, &before, second ? 1 : 0.5, scene, shot.look);
    QVERIFY(renderImage(renderer, shot.eye(), shot.size) == renderImage(usual, shot.eye(), shot.size));
  }
}

/// Light and skins change a little, by steps; nothing stays behind of it.
void TestRenderHeadset::coarserPicturesKeepWhatIsThere() {
  const Shot shot;
  Renderer renderer;
  renderer.prepare(everything(), nullptr, 1, tray(), shot.look);
  const auto picture = [&](int coarser) { return ps::renderImage(renderer, shot.eye(), shot.size, coarser); };
  const auto apart = [](const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
    double all = 0;
    for (size_t i = 0; i < a.size(); ++i) all += std::abs(a[i] - b[i]);
    return all / static_cast<double>(a.size());
  };
  const auto full = picture(0), one = picture(1), two = picture(kSoftSteps);
  QVERIFY2(apart(full, one) > 0.01 && apart(full, one) < 2, qPrintable(QString::number(apart(full, one))));
  QVERIFY2(apart(one, two) > 0.01 && apart(full, two) < 3, qPrintable(QString::number(apart(full, two))));
  QVERIFY(picture(kSoftSteps + 3) == two);
  QVERIFY(picture(0) == full);
}

void TestRenderHeadset::depthsAreOfTheLastPicture_data() {
  QTest::addColumn<bool>("computed");
  QTest::newRow("drawn") << false;
  QTest::newRow("computed") << true;
}

/// A particle, liquid and solid, and a panel before them, in a picture of half the size: where each is. Nothing is
/// where nothing was drawn.
void TestRenderHeadset::depthsAreOfTheLastPicture() {
  QFETCH(bool, computed);
  constexpr int kWide = 160, kHigh = 100;   // pixels
  constexpr double kNear = 0.1, kFar = 10;  // m
  GLuint framebuffer = 0, picture = 0;
  glGenFramebuffers(1, &framebuffer);
  glGenTextures(1, &picture);
  glBindTexture(GL_TEXTURE_2D, picture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kWide, kHigh, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, picture, 0);
  glDrawBuffer(GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  Snapshot scene;
  scene.materialLook = {{0.75f, 0.87f, 0.98f, 1}};
  addParticle(scene, {-0.5, 0, -2}, 0.2, 0, api::Motion::Solid);
  addParticle(scene, {0.5, 0, -3}, 0.2, 1, api::Motion::Liquid);
  auto image = std::make_shared<PanelImage>();
  image->width = image->height = 1;
  image->pixels.assign(4, 255);
  Props props;
  const auto panel = [&](double x, double z) {
    return Panel{{Vector3(x, 0.3, z), Vector3(x + 0.2, 0.3, z), Vector3(x + 0.2, 0.5, z), Vector3(x, 0.5, z)}, image};
  };
  props.panels = {panel(-0.1, -1), panel(-0.5, -1)};
  Renderer renderer(computed ? PixelWork::Computed : PixelWork::Drawn);
  QVERIFY_EXCEPTION_THROWN(renderer.drawDepth({framebuffer, 0, 0, {kWide, kHigh}}, 1), Error);
  renderer.show(props);
  Look look;
  look.backdrop = std::array<float, 3>{};
  renderer.prepare(scene, nullptr, 1, {}, look);
  const Eye eye = eyeThrough(Matrix4::Identity(), -0.8, 0.8, -0.5, 0.5, kNear, kFar);
  (void)ps::renderImage(renderer, eye, {2 * kWide, 2 * kHigh, false});
  const float before = 0.5f;  // as pictures that come round have depths of another frame
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glClearBufferfv(GL_DEPTH, 0, &before);
  renderer.drawDepth({framebuffer, 0, 0, {kWide, kHigh, false}}, 1);
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  std::vector<float> depths(size_t{kWide} * kHigh);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glReadPixels(0, 0, kWide, kHigh, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(1, &picture);
  const auto distance = [&](const Vector3& there) {
    const auto at = project(eye, kWide, kHigh, there);
    const auto column = static_cast<size_t>(at->x()), row = static_cast<size_t>(kHigh - at->y());
    const double depth = double{depths[row * kWide + column]};
    return depth == 1 ? 0 : kNear * kFar / (kFar - depth * (kFar - kNear));
  };
  const double away = std::hypot(0.5, 2);  // on the way to its middle
  QVERIFY(std::abs(distance({-0.5, 0, -2}) - 2 * (away - 0.2) / away) < 0.01);
  const double liquid = distance({0.5, 0, -3});  // smoothed, within its particle
  QVERIFY2(liquid > 3 - 1.25 * 0.2 && liquid < 3, qPrintable(QString::number(liquid)));
  QVERIFY(std::abs(distance({0, 0.4, -1}) - 1) < 0.01);
  QCOMPARE(distance({-0.4, 0.4, -1}), 0.0);  // a panel that does not count
  QCOMPARE(distance({0, -0.4, -1}), 0.0);
}

QTEST_GUILESS_MAIN(TestRenderHeadset)
#include "tst_renderheadset.moc"
