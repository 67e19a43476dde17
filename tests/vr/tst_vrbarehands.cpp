// SPDX-License-Identifier: Apache-2.0
// Bare hands in the headset, by their joints: how they are seen, and what they draw and press without controllers.
#include "core/scene/project.h"
#include "tests/vr/panelhands.h"
#include "tests/vr/runtime/joints.h"
#include "ui/document/document.h"
#include "ui/tools/toolbox.h"
#include "ui/vr/barehand.h"
#include "ui/vr/posedhand.h"
#include "ui/window/vrpanels.h"

#include <QColor>
#include <QImage>

#include <cmath>

using namespace ps;

namespace {

const QString kNoControllers = QStringLiteral(R"(, "events": [{"profile": ""}])");

/// Of the runtime's hand, where it is level and looks away from its wearer.
Vector3 indexTip(const char* shape, size_t hand) {
  const XrVector3f tip = scripted::jointsOf(shape, hand)[XR_HAND_JOINT_INDEX_TIP_EXT].pose.position;
  return {double(tip.x), double(tip.y), double(tip.z)};
}

/// A key of the script: a hand in a shape whose index would touch a place of the room, were it to pinch.
QString shaped(int frame, size_t hand, const Vector3& tip, const char* shape) {
  const Vector3 at = tip - indexTip("pinch", hand);
  return QStringLiteral(R"(, {"frame": %1, "%2": {"grip": [%3, %4, %5], "aim": [%3, %4, %5], "joints": "%6"}})")
      .arg(QString::number(frame), hand == vr::kLeft ? QStringLiteral("left") : QStringLiteral("right"),
           QString::number(at.x()), QString::number(at.y()), QString::number(at.z()), QString::fromLatin1(shape));
}

/// As the headset tells it, at the origin.
vr::SeenHand seenHand(const char* shape, size_t hand) {
  vr::SeenHand seen;
  const scripted::HandJoints joints = scripted::jointsOf(shape, hand);
  for (size_t i = 0; i < joints.size(); ++i) {
    const XrVector3f& p = joints[i].pose.position;
    seen.joints[i] = {{double(p.x), double(p.y), double(p.z)}, double(joints[i].radius)};
  }
  return seen;
}

}  // namespace

class VrBareHandsTest : public PanelsTest {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() {
    backToTheStart();
    m_window->tools().takeBrush("sphere");
  }
  void cleanup() { leaveAtLast(); }
  void cleanupTestCase() { m_window.reset(); }

  void shapesAreTold_data();
  void shapesAreTold();
  void anIndexPressesWhereItIs();
  void aPinchDraws();
  void aHandLostEndsItsStroke();
  void aFistDrawsNothing();
  void handsAreSeen();
  void handsAreShownAsFarAsTheyAreKnown_data();
  void handsAreShownAsFarAsTheyAreKnown();
  void modelsAreHeldAsTheyAct();

 private:
  int steps() { return document().undoStack().index(); }
  std::array<QImage, 2> before(const QString& more, const char* shape);
};

void VrBareHandsTest::shapesAreTold_data() {
  QTest::addColumn<double>("pinch");
  QTest::addColumn<double>("fist");
  QTest::newRow("relaxed") << 0.0 << 0.0;
  QTest::newRow("pinch") << 1.0 << 0.0;
  QTest::newRow("fist") << 0.0 << 1.0;
  QTest::newRow("point") << 0.0 << 0.0;
}

void VrBareHandsTest::shapesAreTold() {
  QFETCH(double, pinch);
  QFETCH(double, fist);
  for (const size_t hand : {vr::kLeft, vr::kRight}) {
    const vr::SeenHand seen = seenHand(QTest::currentDataTag(), hand);
    vr::HandInput input;
    vr::useBareHand(input, hand, seen, false);
    QVERIFY2(std::abs(input.draw - pinch) < 1e-3, qPrintable(QString::number(input.draw)));
    QCOMPARE(input.points, std::string(QTest::currentDataTag()) == "point");
    QVERIFY2(std::abs(input.hold - fist) < 1e-3, qPrintable(QString::number(input.hold)));
    // Palms down: out of the left one and into the right one leads x, to the thumb -z.
    const Matrix3 grip = input.grip->orientation.toRotationMatrix();
    QVERIFY((grip.col(0) - Vector3(0, hand == vr::kLeft ? -1 : 1, 0)).norm() < 1e-9);
    QVERIFY((grip.col(2) - Vector3(hand == vr::kLeft ? -1 : 1, 0, 0)).norm() < 1e-9);
    // Who reads hands knows better.
    vr::HandInput told;
    told.draw = 0.25;
    told.aim = vr::HandPose{{5, 5, 5}, Quaternion(Eigen::AngleAxisd(1, Vector3::UnitX()))};
    vr::useBareHand(told, hand, seen, true);
    QVERIFY(told.draw == 0.25 && told.hold == 0 && told.joints);
    const Vector3 tip = told.aim->position + told.aim->orientation * Vector3(0, 0, -vr::kTip);
    QVERIFY((tip - seen.joints[vr::kIndexTip].position).norm() < 1e-9);
  }
}

/// Its tip goes through the board, without a pinch.
void VrBareHandsTest::anIndexPressesWhereItIs() {
  vr::HeadsetView view;
  view.panels[vr::kBoard].image = std::make_shared<PanelImage>();
  view.panels[vr::kBoard].width = 0.5;
  view.panels[vr::kBoard].height = 0.4;
  vr::Panels geometry;
  geometry.follow(frameOf({}, {}), view);
  const vr::Panels::Place board = *geometry.place(vr::kBoard);
  std::vector<bool> pressed;
  for (const double before : {0.06, 0.02, -0.004, 0.02}) {
    vr::SeenHand seen = seenHand("point", vr::kRight);
    const Vector3 move =
        board.at(0.3, 0.6) + before * (board.pose.orientation * Vector3::UnitZ()) - seen.joints[vr::kIndexTip].position;
    for (vr::HandJoint& joint : seen.joints) joint.position += move;
    vr::HeadsetFrame frame = frameOf({}, {});
    vr::useBareHand(frame.hands[vr::kRight], vr::kRight, seen, false);
    geometry.follow(frame, view);
    const auto point = geometry.pointed(vr::kRight);
    pressed.push_back(point && point->pressed);
    if (before > 0.03) continue;
    QVERIFY(point && point->tip && point->panel == vr::kBoard);
    QVERIFY(std::abs(point->x - 0.3) < 1e-9 && std::abs(point->y - 0.6) < 1e-9 &&
            std::abs(point->depth - before) < 1e-9);
  }
  QVERIFY(pressed == (std::vector<bool>{false, false, true, false}));
}

void VrBareHandsTest::aPinchDraws() {
  const vr::Stand s = stand();
  const Vector3 from(-0.15, 0.5, 0.1), to(0.15, 0.5, 0.1);
  const ScriptedRun run(vrScript(kNoControllers, shaped(5, vr::kRight, s.toRoom(from), "relaxed") +
                                                     shaped(20, vr::kRight, s.toRoom(from), "pinch") +
                                                     shaped(50, vr::kRight, s.toRoom(to), "pinch") +
                                                     shaped(60, vr::kRight, s.toRoom(to), "relaxed")));
  action()->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 1, kLong);
  QCOMPARE(document().undoStack().undoText(), QStringLiteral("brush stroke"));
  leave();
  QVERIFY(run.lines("violation").empty());
  const auto& drawn = std::get<VoxelShape>(document().project().bodies.back().shape);
  Vector3 low = Vector3::Constant(1e9), high = -low;
  for (const VoxelShape::Run& cells : drawn.runs)
    for (const int x : {cells.x, cells.x + cells.length - 1}) {
      const Vector3 p =
          Vector3(drawn.origin[0], drawn.origin[1], drawn.origin[2]) + drawn.spacing * Vector3(x, cells.y, cells.z);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const double radius = m_window->tools().brush().radius, cell = drawn.spacing;
  QVERIFY(std::abs(low.x() - (from.x() - radius)) < 2 * cell && std::abs(high.x() - (to.x() + radius)) < 2 * cell);
  QVERIFY(std::abs((low.y() + high.y()) / 2 - 0.5) < cell && std::abs((low.z() + high.z()) / 2 - 0.1) < cell);
}

/// Which no controller does: it is the hand itself that nobody sees any more.
void VrBareHandsTest::aHandLostEndsItsStroke() {
  const vr::Stand s = stand();
  const Vector3 from = s.toRoom({-0.1, 0.5, 0.1}), to = s.toRoom({0.1, 0.5, 0.1});
  const ScriptedRun run(vrScript(
      kNoControllers,
      shaped(5, vr::kRight, from, "relaxed") + shaped(20, vr::kRight, from, "pinch") + shaped(40, vr::kRight, to, "")));
  action()->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 1, kLong);
  const uint64_t ended = vr().frames();
  QVERIFY(ended >= 38);
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > ended + 20, kLong);
  QCOMPARE(steps(), 1);
  leave();
}

void VrBareHandsTest::aFistDrawsNothing() {
  const Vector3 at = stand().toRoom({0, 0.6, 0.1});
  const ScriptedRun run(vrScript(kNoControllers, shaped(5, vr::kRight, at, "relaxed") +
                                                     shaped(15, vr::kRight, at, "fist") +
                                                     shaped(30, vr::kRight, at, "relaxed")));
  enter();
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 45, kLong);
  leave();
  QCOMPARE(steps(), 0);
}

/// The right eye's pictures without hands and with both of them.
std::array<QImage, 2> VrBareHandsTest::before(const QString& more, const char* shape) {
  const vr::Stand s = stand();
  const QString back = QStringLiteral(R"(, {"frame": 20, "left": {"active": true}, "right": {"active": true}})");
  const char* left = shape == std::string("fist") ? "relaxed" : shape;  // two would carry the scene, which dims it
  std::string text = vrScript(QStringLiteral(R"(, "pictures": [15, 50])") + more,
                              kHandsAway + back + shaped(20, vr::kLeft, s.toRoom({-0.16, 0.45, 0.25}), left) +
                                  shaped(20, vr::kRight, s.toRoom({0.16, 0.4, 0.25}), shape));
  text = QString::fromStdString(text).replace(QString::number(kSide), QStringLiteral("512")).toStdString();
  const ScriptedRun run(text);
  [&] {
    enter();
    vr().panels()->showLabels(false);
    QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 54, kLong);
    leave();
    QVERIFY(run.lines("violation").empty());
  }();
  return {run.picture(15, 1), run.picture(50, 1)};
}

/// All its fingers, knuckles and the wrist are where its joints are.
void VrBareHandsTest::handsAreSeen() {
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  const vr::Stand s = stand();
  for (const char* shape : {"relaxed", "pinch", "fist", "point"}) {
    backToTheStart();  // a pinch draws
    const auto [without, with] = before(kNoControllers, shape);
    QVERIFY(!without.isNull() && without.size() == with.size());
    if (!folder.isEmpty()) without.save(folder + "/bare-without.png");
    if (!folder.isEmpty()) with.save(folder + QStringLiteral("/bare-%1.png").arg(QLatin1String(shape)));
    const auto differs = [&, &bare = without, &hands = with](const Vector3& room) {
      const auto at = project(scriptEye(true), bare.width(), bare.height(), room);
      if (!at) return false;
      const QColor a = bare.pixelColor(int(at->x()), int(at->y())), b = hands.pixelColor(int(at->x()), int(at->y()));
      return std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue()) > 20;
    };
    const Vector3 palm = s.toRoom({0.16, 0.4, 0.25}) - indexTip("pinch", vr::kRight);
    int seen = 0;
    for (const scripted::HandJoint& joint : scripted::jointsOf(shape, vr::kRight)) {
      const XrVector3f& p = joint.pose.position;
      seen += differs(palm + Vector3(double(p.x), double(p.y), double(p.z)));
    }
    QVERIFY2(seen >= 23, qPrintable(QStringLiteral("%1: %2 of 26").arg(QLatin1String(shape)).arg(seen)));
    QVERIFY(!differs(palm + Vector3(0, 0.15, 0)));
  }
}

void VrBareHandsTest::handsAreShownAsFarAsTheyAreKnown_data() {
  QTest::addColumn<QString>("more");
  QTest::addColumn<QString>("shown");
  const QString hands =
      QStringLiteral(R"(, "events": [{"profile": "/interaction_profiles/ext/hand_interaction_ext"}%1])");
  const QString known = QStringLiteral(R"(, "extensions": ["XR_KHR_opengl_enable", "XR_EXT_hand_interaction"%1])");
  const QString model = QStringLiteral("a model");
  QTest::newRow("without the extension") << hands.arg(QString()) + known.arg(QString()) << model;
  QTest::newRow("a headset that cannot") << hands.arg(QString()) + QStringLiteral(R"(, "sees_hands": false)") << model;
  QTest::newRow("refused") << hands.arg(QStringLiteral(
                                  R"(, {"fail": "xrCreateHandTrackerEXT", "result": "XR_ERROR_FEATURE_UNSUPPORTED"})"))
                           << model;
  QTest::newRow("controllers in hand") << QString() << QStringLiteral("a wand");
  QTest::newRow("hands that the headset reads") << hands.arg(QString()) << QStringLiteral("joints");
}

void VrBareHandsTest::handsAreShownAsFarAsTheyAreKnown() {
  QFETCH(QString, more);
  QFETCH(QString, shown);
  const auto [without, with] = before(more, "relaxed");
  QVERIFY(!without.isNull());
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  if (!folder.isEmpty()) with.save(folder + QStringLiteral("/bare-%1.png").arg(QLatin1String(QTest::currentDataTag())));
  // Its thumb reaches out beside a wand's brush, and a wand is longer than its palm. Of a grip that is level the
  // fingers of a model hang down.
  const Vector3 palm = stand().toRoom({0.16, 0.4, 0.25}) - indexTip("pinch", vr::kRight);
  const auto differs = [&, &bare = without, &hands = with](const Vector3& room) {
    const auto at = project(scriptEye(true), bare.width(), bare.height(), room);
    if (!at) return false;
    const QColor a = bare.pixelColor(int(at->x()), int(at->y())), b = hands.pixelColor(int(at->x()), int(at->y()));
    return std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue()) > 20;
  };
  QCOMPARE(differs(palm + Vector3(0, 0, 0.1)), shown == QStringLiteral("a wand"));
  QCOMPARE(differs(palm + Vector3(-0.059, -0.022, -0.055)), shown == QStringLiteral("joints"));
  if (shown != QStringLiteral("a model")) return;
  int seen = 0;
  for (const vr::HandJoint& joint : vr::posedJoints(vr::kRight, {palm, Quaternion::Identity()}, vr::HandShape::Relaxed))
    seen += differs(joint.position);
  QVERIFY2(seen >= 23, qPrintable(QString::number(seen)));
}

/// Each is told apart by what tells real hands apart.
void VrBareHandsTest::modelsAreHeldAsTheyAct() {
  using enum vr::HandShape;
  vr::HandInput input;
  QVERIFY(vr::shapeOf(input, false) == Relaxed && vr::shapeOf(input, true) == Pointing);
  input.draw = 1;
  QVERIFY(vr::shapeOf(input, true) == Pinching);
  input.hold = 1;
  QVERIFY(vr::shapeOf(input, false) == Fist);
  const vr::HandPose grip{{0.1, 1.2, -0.3}, Quaternion(Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()))};
  for (const size_t hand : {vr::kLeft, vr::kRight})
    for (const vr::HandShape shape : {Relaxed, Pointing, Pinching, Fist}) {
      const vr::SeenHand seen{vr::posedJoints(hand, grip, shape), vr::palmOf(hand, grip)};
      QCOMPARE(vr::pinchOf(seen) > 0.9, shape == Pinching);
      QCOMPARE(vr::fistOf(seen) > 0.9, shape == Fist);
      QCOMPARE(vr::pointsWith(seen), shape == Pointing);
      vr::HandInput back;
      vr::useBareHand(back, hand, seen, false);
      QVERIFY(back.grip->orientation.angularDistance(grip.orientation) < 1e-9);
    }
  // Within 0.3 m of a panel, also beside it.
  vr::HeadsetView view;
  view.panels[vr::kBoard] = {std::make_shared<PanelImage>(), 0.5, 0.4, 0, 0, 0};
  vr::Panels geometry;
  geometry.follow(frameOf({}, {}), view);
  const vr::Panels::Place board = *geometry.place(vr::kBoard);
  const Vector3 front = board.pose.orientation * Vector3::UnitZ();
  QVERIFY(geometry.isNear(board.at(0.1, 0.9) + 0.29 * front, 0.3));
  QVERIFY(!geometry.isNear(board.at(0.1, 0.9) + 0.31 * front, 0.3));
  QVERIFY(!geometry.isNear(board.at(1.7, 0.5), 0.3));
}

QTEST_MAIN(VrBareHandsTest)
#include "tst_vrbarehands.moc"
