// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/window/mainwindow.h"
#include "ui/window/noticebar.h"

#include <QtWidgets/QPushButton>

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

}  // namespace ps
