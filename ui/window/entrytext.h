// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/theme/plaintext.h"

#include <QtGui/QAction>

namespace ps {

/// Property of an action: its whole name, where its menu says less.
inline constexpr const char* kWholeName = "wholeName";

/// The menu Add need not say "Add body: torus" in each of its entries; Ctrl+K and lists of keys do.
inline void sayInMenu(QAction& action, const QString& text) {
  action.setProperty(kWholeName, fromButtonText(action.text()));
  const QString tip = action.toolTip();
  action.setText(asButtonText(text.left(1).toUpper() + text.mid(1)));
  action.setToolTip(tip);
}

}  // namespace ps
