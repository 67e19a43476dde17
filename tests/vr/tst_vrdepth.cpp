// SPDX-License-Identifier: Apache-2.0
// How far what the eyes see is, as the headset is told: of matter, of what stands around it, of the board.
#include "core/math/vector.h"
#include "tests/vr/panelhands.h"

#include <QImage>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

constexpr double kNear = 0.03, kFar = 100;  // m, of the headset's setup
constexpr int kDepths = kSide / 2;          // along a side

/// m along the line of sight; the inverse of what a perspective does to depth.
double distanceOf(const QImage& depths, double x, double y) {
  const int column = std::clamp(int(x), 0, kDepths - 1), row = std::clamp(int(y), 0, kDepths - 1);
  const double d = reinterpret_cast<const uint16_t*>(depths.constScanLine(row))[column] / 65535.0;
  return kNear * kFar / (kFar - d * (kFar - kNear));
}

}  // namespace

class VrDepthTest : public PanelsTest {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { backToTheStart(); }
  void cleanup() { leaveAtLast(); }
  void cleanupTestCase() { m_window.reset(); }

  void depthsAreThoseOfWhatIsSeen();
  void nothingIsToldWhereNobodyAsks_data();
  void nothingIsToldWhereNobodyAsks();
};

void VrDepthTest::depthsAreThoseOfWhatIsSeen() {
  const ScriptedRun run(vrScript(QStringLiteral(R"(, "pictures": [40, 120])"), kHandsAway));
  enter();
  const vr::Stand s = stand();
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 44, kLong);
  panels().showPage(QStringLiteral("Brush"));
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 124, kLong);
  vr::HeadsetView shown;
  panels().describe(shown);
  leave();
  QVERIFY(run.lines("violation").empty());
  const auto layer = run.lines("layers").at(40)["layers"][0]["views"];
  for (const size_t eye : {size_t{0}, size_t{1}}) {
    const auto& depth = layer[eye]["depth"];
    QCOMPARE(depth["rect"][2].get<int>(), kDepths);
    QVERIFY(std::abs(depth["near"].get<double>() - kNear) < 1e-6 && std::abs(depth["far"].get<double>() - kFar) < 1e-3);
  }
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  const Snapshot& scene = *view()->snapshot();
  Vector3 low = Vector3::Constant(1e9), high = -low;
  for (const api::Float4& p : scene.position) low = low.cwiseMin(vectorOf(p)), high = high.cwiseMax(vectorOf(p));
  const double inside = 1.5 * scene.spacing;  // m from the edges, past which one sees
  for (const bool right : {false, true}) {
    const QString side = right ? QStringLiteral("right") : QStringLiteral("left");
    const QImage depths(run.file(QStringLiteral("frame40-%1-depth.png").arg(side)));
    QCOMPARE(depths.size(), QSize(kDepths, kDepths));
    QCOMPARE(depths.format(), QImage::Format_Grayscale16);
    if (!folder.isEmpty()) depths.save(folder + "/vr-depth-" + side + ".png");
    // Nothing is seen at the picture's upper corners. The block's upper side is that of its balls, within their size.
    QVERIFY(distanceOf(depths, 1, 1) > 0.99 * kFar);
    double worst = 0;
    int count = 0;
    for (const api::Float4& p : scene.position) {
      const bool edge = p.x < low.x() + inside || p.x > high.x() - inside || p.z < low.z() + inside;
      if (edge || double{p.y} < high.y() - double{p.w}) continue;
      const auto at = project(scriptEye(right), kDepths, kDepths, s.toRoom(Vector3(p.x, p.y + p.w, p.z)));
      QVERIFY(at);
      worst = std::max(worst, std::abs(distanceOf(depths, at->x(), at->y()) - at->z()));
      ++count;
    }
    QVERIFY(count > 50);
    QVERIFY2(worst < 2.5 * scene.spacing * s.scale, qPrintable(QString::number(worst)));
    // The plate that it stands on, before it.
    const Box box = boxOf(scene, view()->scene().environment);
    const Vector3 floor((box.first.x() + box.second.x()) / 2, box.first.y(), box.second.z() - 0.05);
    const auto at = project(scriptEye(right), kDepths, kDepths, s.toRoom(floor));
    QVERIFY(at);
    QVERIFY2(std::abs(distanceOf(depths, at->x(), at->y()) - at->z()) < 0.05,
             qPrintable(QString::number(distanceOf(depths, at->x(), at->y()) - at->z())));
    // The board stands before all of it.
    const QImage withBoard(run.file(QStringLiteral("frame120-%1-depth.png").arg(side)));
    vr::Panels geometry;
    geometry.follow(frameOf({}, {}), shown);
    const auto board = geometry.place(vr::kBoard);
    QVERIFY(board);
    const auto middle = project(scriptEye(right), kDepths, kDepths, board->at(0.5, 0.2));
    QVERIFY(middle && std::abs(distanceOf(withBoard, middle->x(), middle->y()) - middle->z()) < 0.02);
  }
}

void VrDepthTest::nothingIsToldWhereNobodyAsks_data() {
  QTest::addColumn<QString>("more");
  QTest::newRow("without the extension") << R"(, "extensions": ["XR_KHR_opengl_enable"])";
  QTest::newRow("without a format for it") << R"(, "formats": ["SRGB8_ALPHA8"])";
  QTest::newRow("where its pictures are refused")
      << R"(, "events": [{"fail": "xrCreateSwapchain", "result": "XR_ERROR_RUNTIME_FAILURE", "after": 2}])";
}

void VrDepthTest::nothingIsToldWhereNobodyAsks() {
  QFETCH(QString, more);
  const ScriptedRun run(vrScript(more));
  enter();
  leave();
  QVERIFY(run.lines("violation").empty());
  for (const nlohmann::json& line : run.lines("layers"))
    for (const auto& layer : line["layers"])
      for (const auto& one : layer["views"]) QVERIFY(!one.contains("depth"));
}

QTEST_MAIN(VrDepthTest)
#include "tst_vrdepth.moc"
