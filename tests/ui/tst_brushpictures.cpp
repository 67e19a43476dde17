// SPDX-License-Identifier: Apache-2.0
// Each installed brush at work in the window, taken from the bar by its declaration: PS_TEST_PICTURES names the folder
// for the pictures.
#include "core/plugin_host/registry.h"
#include "tests/ui/gizmohands.h"
#include "tests/ui/samplewindow.h"
#include "ui/session/selection.h"
#include "ui/tools/tooltable.h"
#include "ui/window/noticebar.h"

#include <QtGui/QAction>
#include <QtWidgets/QAbstractButton>

#include <algorithm>

using namespace ps;

namespace {

const Vector3 kFrom{-0.25, 0, 0.25}, kTo{0.2, 0, 0.25};              // on the floor, before the others
const Vector3 kIceFrom{-0.28, 0.2, 0.05}, kIceTo{-0.08, 0.2, 0.05};  // on the block's top

}  // namespace

class TestBrushPictures : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void cleanupTestCase() { m_window.reset(); }

  /// A block of ice and an iron bowl, in the colours of their matter.
  void init() {
    beginInTheView();
    document().addMaterial("iron");
    QCOMPARE(document().removeBody("ice"), QString());
    Body block;
    block.id = "block", block.name = "Block", block.material = "water";
    block.parameters.values["temperature"] = 250.0;
    block.constraints.push_back({"bonds", {}, {}});
    block.shape = BoxShape{{-0.18, 0.1, 0}, {0.2, 0.2, 0.2}, {}};
    document().addBody(block);
    Body bowl;
    bowl.id = "bowl", bowl.name = "Bowl", bowl.material = "iron";
    bowl.parameters.values = {{"temperature", 293.15}, {"fixed", true}};
    SolidShape form;
    form.parameters.values = {{"kind", std::string("bowl")}, {"size_x", 0.26},     {"size_y", 0.14}, {"size_z", 0.26},
                              {"position_x", 0.17},          {"position_y", 0.07}, {"wall", 0.045}};
    bowl.shape = form;
    const std::string stamped = document().addBody(bowl);  // ids of undone bodies are not given again
    m_scene = document().undoStack().count();
    QTest::keyClick(view(), Qt::Key_1, Qt::ControlModifier);
    toTheStart();
    m_window->selection().selectBody(stamped);
    m_window->selection().setMaterial("water");
  }

  void everyBrushAtWork_data() {
    QTest::addColumn<QString>("brush");
    for (const std::string& id : session().plugins()->ids(PluginKind::Brush))
      QTest::newRow(id.c_str()) << QString::fromStdString(id);
  }
  void everyBrushAtWork() {
    QFETCH(QString, brush);
    QAction* action = m_window->action(QStringLiteral("sketch.shape.") + brush);
    QVERIFY2(action, "it is on no bar");
    const auto buttons = m_window->findChildren<QAbstractButton*>();
    QVERIFY2(std::any_of(buttons.begin(), buttons.end(),
                         [&](const QAbstractButton* button) {
                           return button->property("shape").toString() == brush && !button->icon().isNull() &&
                                  button->text().isEmpty();
                         }),
             "it has no picture on the bar");
    action->trigger();
    Toolbox& tools = m_window->tools();
    QCOMPARE(tools.brush().shape, brush.toStdString());
    BrushSettings settings = tools.brush();
    settings.radius = 0.05;
    settings.material = tools.paints() ? "iron" : "water";
    settings.temperature = 262;
    if (brush == QLatin1String("stamp")) settings.parameters["stamp"].values["scale"] = 0.6;
    tools.setBrush(settings);
    const size_t before = idsNow(session()).size();
    if (tools.touchesMatter()) {
      touch();
      picture(QStringLiteral("brush-%1.png").arg(brush));
      QTest::mouseRelease(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), kIceTo));
      session().pause();
      return;
    }
    if (tools.smooths()) {
      action = m_window->action(QStringLiteral("sketch.shape.cube"));
      action->trigger();
      draw(kFrom, kTo);
      tools.takeBrush("smooth");
      picture(QStringLiteral("brush-smooth-before.png"));
      draw(kFrom + Vector3(0, 0.08, 0), kTo + Vector3(0, 0.08, 0));
    } else if (tools.reworks()) {
      draw(kIceFrom, kIceTo);
    } else if (brush == QLatin1String("fill")) {
      const Vector3 wall(0.13, 0.08, -0.05);  // the far side of the bowl, from within
      draw(wall, wall);
    } else {
      draw(kFrom, kTo);
    }
    picture(QStringLiteral("brush-%1.png").arg(brush));
    QVERIFY2(document().undoStack().count() > m_scene, qPrintable(m_window->notice()->text()));
    if (!tools.reworks()) QVERIFY(idsNow(session()).size() > before);
  }

 private:
  void shown() {
    const size_t there = idsNow(session()).size();
    QTRY_VERIFY_WITH_TIMEOUT(
        session().snapshot()->position.size() == there && view()->snapshot() == session().snapshot(), kLong);
  }
  void pointTo(const Vector3& place) {
    const QPointF at = hands::pixelOf(*view(), place);
    QMouseEvent event(QEvent::MouseMove, at, view()->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(view(), &event);
  }
  void draw(const Vector3& from, const Vector3& to) {
    shown();
    QTest::mousePress(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), from));
    constexpr int kSteps = 8;
    for (int k = 1; k <= kSteps; ++k) pointTo(from + k * (to - from) / kSteps);
    QTest::mouseRelease(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), to));
    onEngine<size_t>(session(), [](Engine& engine) { return engine.particles().size(); });
    shown();
  }
  /// Pressed, and led across the block while it runs.
  void touch() {
    shown();
    session().play();
    QTest::mousePress(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), kIceFrom));
    constexpr int kSteps = 20;
    for (int k = 1; k <= kSteps; ++k) {
      pointTo(kIceFrom + k * (kIceTo - kIceFrom) / kSteps);
      const uint64_t frame = session().snapshot()->stats.frame;
      QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame > frame + 1, kLong);
    }
  }

  int m_scene = 0;  ///< steps of undo that made it
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestBrushPictures test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_brushpictures.moc"
