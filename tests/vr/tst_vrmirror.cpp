// SPDX-License-Identifier: Apache-2.0
// What a window shows of the headset's picture, by itself and in the editor; neither waits for the other.
#include <epoxy/gl.h>

#include "tests/vr/plate.h"
#include "tests/vr/vrwindow.h"
#include "ui/render/camera.h"
#include "ui/session/preferences.h"
#include "ui/vr/mirror.h"
#include "ui/window/vrmirror.h"

#include <QtCore/QSettings>

#include <array>
#include <cmath>
#include <vector>

using namespace ps;

namespace {

constexpr std::array<int, 3> kRed{200, 30, 7}, kBlue{11, 60, 180}, kGrey{100, 101, 102}, kBlack{0, 0, 0};

}  // namespace

class VrMirrorTest : public VrWindowTest {
  Q_OBJECT

 private Q_SLOTS:
  void cleanup() { leaveAtLast(); }
  void cleanupTestCase() { m_window.reset(); }

  void picturesAreHandedOverAsTheyAre();
  void onlyWhatIsWantedIsCopied();
  void nothingIsWaitedFor();
  void theWindowShowsTheLeftEye();
  void theViewShowsTheHands();
};

/// Stored bits of sRGB are those of the window's; a wide window cuts the picture above and below.
void VrMirrorTest::picturesAreHandedOverAsTheyAre() {
  HeadlessContext window;
  HeadlessContext headset(&window);
  vr::Mirror mirror;
  {
    const Plate eye(GL_SRGB8_ALPHA8, 64, 64);
    eye.fill(kRed, kBlue);
    mirror.want();
    mirror.offer(eye.texture, eye.size);
    glFinish();
    window.makeCurrent();
    const Plate shown(GL_RGBA8, 128, 32);
    shown.fill(kBlack, kBlack);
    QCOMPARE(mirror.drawn(), uint64_t{0});
    QVERIFY(mirror.draw(shown.framebuffer, shown.size, false));
    QCOMPARE(mirror.drawn(), uint64_t{1});
    for (const int y : {0, 16, 31}) {
      QCOMPARE(shown.at(2, y), kRed);
      QCOMPARE(shown.at(125, y), kBlue);
    }
    QVERIFY(!mirror.draw(shown.framebuffer, shown.size, false));  // there is no newer one
    QVERIFY(mirror.draw(shown.framebuffer, shown.size, true));
    headset.makeCurrent();
    // A headset that is late uses a part of its pictures.
    glBindFramebuffer(GL_FRAMEBUFFER, eye.framebuffer);
    mirror.want();
    mirror.offer(eye.texture, {32, 32});
    glFinish();
    window.makeCurrent();
    QVERIFY(mirror.draw(shown.framebuffer, shown.size, false));
    QCOMPARE(shown.at(125, 16), kRed);
    // Only what the window showed was copied, and fills it with other proportions as well.
    const Plate high(GL_RGBA8, 32, 128);
    high.fill(kBlack, kBlack);
    QVERIFY(mirror.draw(high.framebuffer, high.size, true));
    for (const int y : {0, 64, 127}) QCOMPARE(high.at(16, y), kRed);
    headset.makeCurrent();
    eye.fill(kBlue, kRed);
    mirror.want();
    mirror.offer(eye.texture, eye.size);
    glFinish();
    window.makeCurrent();
    QVERIFY(mirror.draw(high.framebuffer, high.size, false));
    for (const int y : {0, 64, 127}) {
      QCOMPARE(high.at(2, y), kBlue);
      QCOMPARE(high.at(29, y), kRed);
    }
    headset.makeCurrent();
    mirror.close();
    window.makeCurrent();
    QVERIFY(!mirror.draw(shown.framebuffer, shown.size, true));
    headset.makeCurrent();
    mirror.want();
    mirror.offer(eye.texture, eye.size);  // comes too late, and does nothing
    QVERIFY(!glIsTexture(0) && glGetError() == GL_NO_ERROR);
  }
  headset.release();
}

void VrMirrorTest::onlyWhatIsWantedIsCopied() {
  HeadlessContext context;
  vr::Mirror mirror;
  const Plate eye(GL_SRGB8_ALPHA8, 16, 16), shown(GL_RGBA8, 16, 16);
  eye.fill(kRed, kRed);
  mirror.offer(eye.texture, eye.size);
  glFinish();
  QVERIFY(!mirror.draw(shown.framebuffer, shown.size, true));
  mirror.want();
  mirror.offer(eye.texture, eye.size);
  eye.fill(kGrey, kGrey);
  mirror.offer(eye.texture, eye.size);  // nobody has asked for another one yet
  glFinish();
  QVERIFY(mirror.draw(shown.framebuffer, shown.size, true));
  QCOMPARE(shown.at(8, 8), kRed);
  mirror.close();
}

/// Of a window that asks and never draws, and of one that draws what it was never given, as often as they like.
void VrMirrorTest::nothingIsWaitedFor() {
  HeadlessContext context;
  vr::Mirror mirror;
  const Plate eye(GL_SRGB8_ALPHA8, 16, 16), shown(GL_RGBA8, 16, 16);
  for (int i = 0; i < 50; ++i) {
    eye.fill(kGrey, kGrey);
    mirror.want();
    mirror.offer(eye.texture, eye.size);
  }
  eye.fill(kBlue, kBlue);
  mirror.want();
  mirror.offer(eye.texture, eye.size);
  glFinish();
  for (int i = 0; i < 50; ++i) QCOMPARE(mirror.draw(shown.framebuffer, shown.size, false), i == 0);
  QCOMPARE(shown.at(8, 8), kBlue);  // the newest
  mirror.close();
}

/// It is the eye's picture, cut to the view; switched off the view is back, and which it was is remembered.
void VrMirrorTest::theWindowShowsTheLeftEye() {
  open();
  backToTheStart();
  QAction* mirrors = m_window->action(QStringLiteral("simulation.mirror"));
  QVERIFY(mirrors && mirrors->isCheckable() && !mirrors->isChecked());
  const ScriptedRun run(vrScript(QStringLiteral(R"(, "pictures": [60])"), kHandsAway));
  enter();
  QVERIFY(!vr().mirror() && view()->updatesEnabled());
  mirrors->trigger();
  QVERIFY(vr().mirror() && preferences::showsEye() && !view()->updatesEnabled());
  VrMirror& mirror = *vr().mirror();
  QVERIFY(mirror.isVisible() && mirror.geometry() == view()->geometry());
  QTRY_VERIFY_WITH_TIMEOUT(mirror.pictures() > 3, kLong);
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 62, kLong);
  const QImage shown = mirror.grabFramebuffer().convertToFormat(QImage::Format_RGB888);
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  if (!folder.isEmpty()) m_window->grab().save(folder + "/vr-mirror.png");
  if (!folder.isEmpty()) shown.save(folder + "/vr-mirror-eye.png");
  // It goes with the view, and the newest picture fills it then too.
  m_window->resize(m_window->width() - 100, m_window->height() - 40);
  QTRY_COMPARE(mirror.geometry(), view()->geometry());
  const uint64_t before = mirror.pictures();
  QTRY_VERIFY_WITH_TIMEOUT(mirror.pictures() > before, kLong);
  m_window->resize(1280, 800);
  leave();
  QVERIFY(!vr().mirror() && view()->updatesEnabled());
  QVERIFY(run.lines("violation").empty());
  const QImage eye = run.picture(60, 0).convertToFormat(QImage::Format_RGB888);
  const double scale = std::max(double(shown.width()) / eye.width(), double(shown.height()) / eye.height());
  double difference = 0, contrast = 0;
  int count = 0;
  for (int y = 4; y < shown.height() - 60; y += 7)  // above the caption
    for (int x = 4; x < shown.width() - 4; x += 7, ++count) {
      const auto of = [&](double at, int side, int whole) {
        return std::clamp(int((at + 0.5 - whole / 2.0) / scale + side / 2.0), 0, side - 1);
      };
      const QColor a = shown.pixelColor(x, y);
      const QColor b = eye.pixelColor(of(x, eye.width(), shown.width()), of(y, eye.height(), shown.height()));
      difference += std::abs(a.red() - b.red()) + std::abs(a.blue() - b.blue());
      contrast += std::abs(b.red() - eye.pixelColor(0, 0).red()) + std::abs(b.blue() - eye.pixelColor(0, 0).blue());
    }
  // Smoothed as it is magnified, it differs along edges alone.
  QVERIFY2(difference < 0.1 * contrast, qPrintable(QString::number(difference / contrast)));
  // It is there again at once the next time, also after a stay that fails.
  {
    const ScriptedRun dies(
        vrScript(QStringLiteral(R"(, "events": [{"frame": 12, "dies": "XR_ERROR_INSTANCE_LOST"}])")));
    action()->trigger();
    QVERIFY(vr().mirror());
    QTRY_VERIFY_WITH_TIMEOUT(!vr().active(), kLong);
    QVERIFY(!vr().mirror() && view()->updatesEnabled());
  }
  const ScriptedRun again(vrScript());
  enter();
  QVERIFY(vr().mirror());
  mirrors->trigger();
  QVERIFY(!vr().mirror() && !preferences::showsEye() && view()->updatesEnabled());
  leave();
}

/// As long as they are there, where they are, true to the scene's scale: wands, and the brush about their tips. After
/// the stay the view is what it was.
void VrMirrorTest::theViewShowsTheHands() {
  constexpr int kClearly = 30, kHaze = 6;  // of three channels of 255
  if (!m_window) open();
  backToTheStart();
  QAction* mirrors = m_window->action(QStringLiteral("simulation.mirror"));
  QVERIFY(mirrors && !mirrors->isChecked());
  m_window->tools().takeBrush("sphere");
  const vr::Stand stands = stand();
  const std::array<Vector3, 2> tips{Vector3(-0.12, 0.5, 0.2), Vector3(0.12, 0.45, 0.2)};
  const QString there = QStringLiteral(R"(, "active": true)");
  const QString hands = tipKey(0, "left", stands, tips[0], there) + tipKey(0, "right", stands, tips[1], there);
  ScriptedRun run(vrScript({}, kHandsAway));
  const auto picture = [&] { return view()->grabFramebuffer().convertToFormat(QImage::Format_RGB888); };
  const QImage before = picture();
  const auto apart = [&](const QImage& now, const Vector3& place) {
    const auto at = project(view()->navigator().camera(), now.width(), now.height(), place);
    if (!at || now.size() != before.size()) return -1;
    const QColor a = before.pixelColor(int(at->x()), int(at->y())), b = now.pixelColor(int(at->x()), int(at->y()));
    return std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue());
  };
  const auto wandOf = [&](const Vector3& tip) { return stands.toScene(stands.toRoom(tip) + Vector3(0, 0, 0.1)); };
  enter();
  run.goOn(vrScript({}, hands));
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  for (const Vector3& tip : tips)
    QTRY_VERIFY2_WITH_TIMEOUT(apart(picture(), wandOf(tip)) > kClearly,
                              qPrintable(QString::number(apart(picture(), wandOf(tip)))), kLong);
  const QImage with = picture();
  if (!folder.isEmpty()) with.save(folder + "/vr-view-hands.png");
  for (const Vector3& tip : tips) QVERIFY(std::abs(apart(with, tip + Vector3(0, 0.2, 0))) <= kHaze);  // nothing
  leave();
  for (const Vector3& tip : tips) QVERIFY(std::abs(apart(picture(), wandOf(tip))) <= kHaze);
  QVERIFY(run.lines("violation").empty());
}

QTEST_MAIN(VrMirrorTest)
#include "tst_vrmirror.moc"
