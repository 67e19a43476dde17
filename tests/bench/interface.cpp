// SPDX-License-Identifier: Apache-2.0
// How long the interface's thread is held up by one event while a large scene runs, is recorded and scrubbed: the
// longest turns of the event loop, and by whom. What OpenGL takes is left out where software draws.
//   interface [PARTICLES] [SECONDS] [tune]       in the workspace Scene, or Tune
#include "core/experiments/benchscenes.h"
#include "core/io/projectio.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/theme/theme.h"
#include "ui/viewport/viewport.h"
#include "ui/window/mainwindow.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QMetaEnum>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTimer>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

struct Turn {
  double milliseconds = 0;
  QString who;
};

/// Times what each event takes by itself, without the events within it.
class WatchedApplication : public QApplication {
 public:
  using QApplication::QApplication;
  std::vector<Turn> turns;
  bool watching = false;

  bool notify(QObject* receiver, QEvent* event) override {
    if (!watching) return QApplication::notify(receiver, event);
    QString who = QString::fromLatin1(receiver->metaObject()->className()) + QLatin1Char(' ') +
                  QString::fromLatin1(QMetaEnum::fromType<QEvent::Type>().valueToKey(event->type()));
    if (const auto* timer = qobject_cast<QTimer*>(receiver)) who += QStringLiteral(" of %1 ms").arg(timer->interval());
    // The viewport's own painting, and what puts it into the window.
    const bool drawing = (event->type() == QEvent::Paint && qobject_cast<ps::Viewport*>(receiver)) ||
                         event->type() == QEvent::UpdateRequest;
    const double before = m_within;
    m_within = 0;
    QElapsedTimer timer;
    timer.start();
    const bool done = QApplication::notify(receiver, event);
    const double whole = static_cast<double>(timer.nsecsElapsed()) / 1e6;
    if (!drawing) turns.push_back({whole - m_within, who});
    m_within = before + whole;
    return done;
  }

 private:
  double m_within = 0;  // ms, of the events within the present one
};

}  // namespace

int main(int argc, char** argv) {
  WatchedApplication application(argc, argv);
  const int particles = argc > 1 ? std::atoi(argv[1]) : 100000;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 20;
  ps::Theme::apply(application, true);
  const QTemporaryDir folder;
  const QString path = folder.filePath("tank.json");
  ps::saveProject(ps::tank(particles), path.toStdString());
  ps::MainWindow::Options options;
  options.project = options.sample = path;
  options.restore = false;
  options.session.autosave = false;
  ps::MainWindow window(options);
  window.resize(1280, 800);
  window.show();
  bool shown = false;
  QObject::connect(&window, &ps::MainWindow::projectShown, [&] { shown = true; });
  window.start();
  if (argc > 3) window.showWorkspace(ps::MainWindow::kTuneTab);
  if (!QTest::qWaitFor([&] { return shown; }, 120000)) return 1;
  int scrubbed = 0;
  ps::RecordedView& recorded = window.session().recorded();
  QObject::connect(&recorded, &ps::RecordedView::changed, [&] { ++scrubbed; });
  application.watching = true;
  window.session().play();
  QTest::qWait(static_cast<int>(500 * seconds));
  // Then back and forth through what was recorded, while it is paused and while it runs on.
  for (const bool running : {false, true}) {
    if (running)
      window.session().play();
    else
      window.session().pause();
    QElapsedTimer timer;
    timer.start();
    for (int k = 0; static_cast<double>(timer.elapsed()) < 250 * seconds; ++k) {
      const ps::RunRecord::Extent extent = recorded.extent();
      if (k % 20 == 0)
        recorded.showAt(extent.from + (extent.to - extent.from) * (k / 20 % 7) / 7.0);
      else
        recorded.step(k / 10 % 2 == 0 ? -1 : 1);
      QTest::qWait(50);
    }
  }
  application.watching = false;
  std::sort(application.turns.begin(), application.turns.end(),
            [](const Turn& a, const Turn& b) { return a.milliseconds > b.milliseconds; });
  const auto over = std::count_if(application.turns.begin(), application.turns.end(),
                                  [](const Turn& turn) { return turn.milliseconds > 16; });
  std::printf(
      "%d particles, frame %llu, %d recorded frames shown: %zu events, %td of them longer than 16 ms; the longest\n",
      particles, static_cast<unsigned long long>(window.session().newest()->stats.frame), scrubbed,
      application.turns.size(), over);
  for (size_t k = 0; k < std::min<size_t>(12, application.turns.size()); ++k)
    std::printf("  %7.2f ms  %s\n", application.turns[k].milliseconds, qPrintable(application.turns[k].who));
}
