// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/window/mainwindow.h"
#include "ui/window/noticebar.h"

#include <QtTest/QSignalSpy>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>
#include <QtWidgets/QPushButton>

#include <memory>

// What all tests of the window share.
namespace ps {

inline constexpr int kLong = 30000;  // ms; software rendering on a busy machine

/// The button of this text on the notice that is shown; nullptr where there is none.
inline QPushButton* noticeButton(const MainWindow& window, const QString& text) {
  for (QPushButton* button : window.notice()->findChildren<QPushButton*>()) {
    if (button->text() == text) return button;
  }
  return nullptr;
}

/// On its first project; nullptr where it did not come.
inline std::unique_ptr<MainWindow> shownWindow(const MainWindow::Options& options, const QSize& size) {
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

}  // namespace ps
