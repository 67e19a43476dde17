// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

// What stories share that are told by mouse and keys or in the headset: a scene of their own, and what is there.
namespace ps {

inline constexpr int kRun = 120000;         // ms that a part of a story may take
inline constexpr double kHeatFaster = 100;  // times as fast as it is

/// `Window`: SampleWindowTest, or a test of a window that is one too.
template <class Window>
class SceneStory : public Window {
 protected:
  using Window::document;
  using Window::m_window;
  using Window::session;
  using Window::view;

  /// A new scene at 0 s in which heat is a hundred times as fast.
  void emptyScene() {
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    Window::open();
    session().pause();
    QTest::keyClick(m_window.get(), Qt::Key_N, Qt::ControlModifier);
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot() && session().snapshot()->position.empty(), kLong);
    session().pause();
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
    view()->show(StandardView::Scene);
    QCOMPARE(document().setParameter({Owner::Solver, "", "thermal_time_scale"}, kHeatFaster), QString());
  }
  void key(Qt::Key which, Qt::KeyboardModifiers modifiers = {}) {
    QApplication::setActiveWindow(m_window.get());
    view()->setFocus();
    QTest::keyClick(view(), which, modifiers);
  }
  void choose(const char* material) {
    auto* panel = m_window->template findChild<MaterialsPanel*>();
    const QRect tile = panel->tileOf(material);
    QVERIFY2(!tile.isEmpty(), material);
    QTest::mouseClick(panel, Qt::LeftButton, {}, tile.center());
    QCOMPARE(m_window->selection().material(), std::string(material));
  }
  void shape(const char* brush) {
    QAction* action = m_window->action(QStringLiteral("sketch.shape.") + QString::fromLatin1(brush));
    QVERIFY2(action, brush);
    action->trigger();
    QCOMPARE(m_window->tools().brush().shape, std::string(brush));
  }
  ParameterRow* row(Owner owner, const std::string& id, const char* parameter) {
    const Address address{owner, id, parameter};
    QApplication::processEvents();
    if (!m_window->revealParameter(address, false)) return nullptr;
    QApplication::processEvents();
    return m_window->inspector().panelFor(address)->row(QString::fromStdString(address.text()));
  }
  void playOn(double seconds) {
    const double until = timeNow() + seconds;
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(timeNow() >= until, kRun);
    session().pause();
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
  }
  double timeNow() {
    return onEngine<double>(session(), [](Engine& engine) { return engine.solver().time(); });
  }
  uint64_t frameNow() {
    return onEngine<uint64_t>(session(), [](Engine& engine) { return engine.solver().frame(); });
  }
  double heaters() {
    return onEngine<double>(session(), [](Engine& engine) { return engine.solver().heatLedger().heaters; });
  }
  /// m, of a body's particles, or of those that move so.
  std::vector<Vector3> placesOf(const std::string& id, std::optional<api::Motion> motion = {}) {
    return onEngine<std::vector<Vector3>>(session(), [id, motion](Engine& engine) {
      std::vector<Vector3> places;
      const ParticleStore& store = engine.particles();
      for (size_t i = 0; i < store.size(); ++i) {
        const bool isMeant = engine.bodyIds()[store.body()[i]] == id && (!motion || store.motion()[i] == *motion);
        if (isMeant) places.push_back(vectorOf(store.position()[i]));
      }
      return places;
    });
  }
  size_t liquidOf(const std::string& id) { return placesOf(id, api::Motion::Liquid).size(); }
  Vector3 meanOf(const std::string& id) {
    Vector3 sum(0, 0, 0);
    const std::vector<Vector3> places = placesOf(id);
    for (const Vector3& place : places) sum += place;
    return sum / static_cast<double>(std::max<size_t>(places.size(), 1));
  }
  /// As what is saved with its state says, which has so many bodies, and goes on as it would have.
  void savedIsWhatIsThere(size_t bodies) {
    const QString file = m_folder.filePath(QStringLiteral("story.json"));
    QAction* save = m_window->action(QStringLiteral("file.saveState"));
    hands::answerDialog(file);
    save->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(file) && !document().isDirty(), kLong);
    PluginRegistry plugins;
    const Project saved = loadProject(file.toStdString(), plugins).project;
    QVERIFY(saved.state);
    Engine reopened(saved, plugins);
    QVERIFY2(reopened.remarks().empty(), reopened.remarks().empty() ? "" : reopened.remarks().front().c_str());
    QCOMPARE(reopened.particles().size(), idsNow(session()).size());
    QCOMPARE(reopened.stateHash(), onEngine<uint64_t>(session(), [](Engine& engine) { return engine.stateHash(); }));
    QCOMPARE(saved.bodies.size(), bodies);
    for (int frame = 0; frame < 10; ++frame) {
      reopened.step();
      key(Qt::Key_Right);
    }
    QTRY_VERIFY_WITH_TIMEOUT(frameNow() == reopened.solver().frame(), kLong);
    QCOMPARE(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.stateHash(); }), reopened.stateHash());
  }

  QTemporaryDir m_folder;
};

}  // namespace ps
