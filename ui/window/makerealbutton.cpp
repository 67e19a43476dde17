// SPDX-License-Identifier: Apache-2.0
#include "ui/window/makerealbutton.h"

#include <QtCore/QEvent>
#include <QtGui/QAction>

namespace ps {
namespace {
constexpr int kOverHints = 52;  // px from below, over the strip of hints
}  // namespace

MakeRealButton::MakeRealButton(QAction& action, QWidget& view) : QPushButton(&view), m_action(action) {
  setText(action.text());
  setToolTip(QStringLiteral("%1 (Enter)").arg(action.toolTip()));
  setAccessibleName(action.text());
  setProperty("primary", true);
  setFocusPolicy(Qt::TabFocus);
  setCursor(Qt::ArrowCursor);
  connect(this, &QPushButton::clicked, &action, &QAction::trigger);
  connect(&action, &QAction::enabledChanged, this, [this] { follow(); });
  view.installEventFilter(this);
  follow();
}

void MakeRealButton::follow() {
  place();
  setVisible(m_action.isEnabled());
}

void MakeRealButton::place() {
  const QSize wanted = sizeHint();
  const QWidget* view = parentWidget();
  setGeometry((view->width() - wanted.width()) / 2, view->height() - kOverHints - wanted.height(), wanted.width(),
              wanted.height());
}

bool MakeRealButton::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) place();
  return QPushButton::eventFilter(watched, event);
}

}  // namespace ps
