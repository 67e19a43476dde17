// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/shared/enginehands.h"
#include "tests/ui/windowtesting.h"
#include "ui/document/document.h"
#include "ui/theme/theme.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/viewport.h"

#include <QtTest/QSignalSpy>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>

#include <functional>
#include <future>
#include <memory>
#include <set>

// The real window on the first sample, for tests of what hands do in it.
namespace ps {

inline const QString kSample = QStringLiteral(PS_SOURCE_DIR "/projects/ice-on-hot-plate.json");

/// A window that has shown the sample, which plays, and has the focus; nullptr when it did not come.
inline std::unique_ptr<MainWindow> sampleWindow(const QSize& size, const std::vector<std::string>& pluginPaths = {}) {
  Theme::apply(*qApp, true);
  MainWindow::Options options;
  options.project = options.sample = kSample;
  options.restore = false;
  options.session.autosave = false;
  options.session.pluginPaths = pluginPaths;
  return shownWindow(options, size);
}

/// Asks between two frames, and waits for the answer.
template <class Result>
Result onEngine(Session& session, std::function<Result(Engine&)> question) {
  return tests::onEngine<Result>(*session.engine(), std::move(question));
}

inline std::set<uint32_t> idsNow(Session& session) {
  return onEngine<std::set<uint32_t>>(session, [](Engine& engine) {
    const ParticleStore& store = engine.solver().particles();
    return std::set<uint32_t>(store.id(), store.id() + store.size());
  });
}

/// What tests of hands in one window share.
class SampleWindowTest : public QObject {
 protected:
  void open() {
    m_window = sampleWindow({1280, 800});
    QVERIFY(m_window);
  }
  /// The scene as it was opened, paused.
  void backToTheStart() {
    session().pause();
    while (document().undoStack().canUndo()) document().undoStack().undo();
    toTheStart();
    m_window->tools().activate("select");
    view()->show(StandardView::Scene);
  }
  /// The same, with the keys going to the view.
  void beginInTheView() {
    backToTheStart();
    QApplication::setActiveWindow(m_window.get());
    view()->setFocus();
  }
  /// The view shows the scene after a reset: the brush stands on what it shows.
  void toTheStart() {
    const uint64_t revision = session().snapshot()->revision;
    session().reset();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->revision != revision && view()->snapshot() == session().snapshot(),
                             kLong);
  }
  void stroke(const QPoint& from, const QPoint& way, bool release) {
    QTest::mousePress(view(), Qt::LeftButton, {}, from);
    for (int k = 1; k <= 6; ++k) QTest::mouseMove(view(), from + way * k / 6);
    if (release) QTest::mouseRelease(view(), Qt::LeftButton, {}, from + way);
  }
  /// Of the window, where PS_TEST_PICTURES names a folder.
  void picture(const QString& name) {
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) m_window->grab().save(folder + QLatin1Char('/') + name);
  }
  Session& session() { return m_window->session(); }
  Document& document() { return session().document(); }
  Viewport* view() { return m_window->viewport(); }

  std::unique_ptr<MainWindow> m_window;
};

}  // namespace ps
