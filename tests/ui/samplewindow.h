// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/shared/enginehands.h"
#include "ui/theme/theme.h"
#include "ui/window/mainwindow.h"

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
inline constexpr int kLong = 30000;  // ms; software rendering on a busy machine

/// A window that has shown the sample, which plays, and has the focus; nullptr when it did not come.
inline std::unique_ptr<MainWindow> sampleWindow(const QSize& size, const std::vector<std::string>& pluginPaths = {}) {
  Theme::apply(*qApp, true);
  MainWindow::Options options;
  options.project = options.sample = kSample;
  options.restore = false;
  options.session.autosave = false;
  options.session.pluginPaths = pluginPaths;
  auto window = std::make_unique<MainWindow>(options);
  window->resize(size);
  window->show();
  QSignalSpy shown(window.get(), &MainWindow::projectShown);
  if (!QTest::qWaitForWindowExposed(window.get())) return nullptr;
  window->start();
  if (!shown.wait(kLong)) return nullptr;
  QApplication::setActiveWindow(window.get());
  return window;
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

}  // namespace ps
