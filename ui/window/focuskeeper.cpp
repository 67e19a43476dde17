// SPDX-License-Identifier: Apache-2.0
#include "ui/window/focuskeeper.h"

#include "ui/window/dock.h"

#include <QtCore/QEvent>
#include <QtCore/QTimer>
#include <QtGui/QKeyEvent>
#include <QtWidgets/QApplication>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QTabBar>

#include <algorithm>

namespace ps {
namespace {

/// Tabs of a dock, or of the workspaces.
bool isHeader(const QWidget* widget) { return qobject_cast<const QTabBar*>(widget) != nullptr; }

bool takesFocus(const QWidget* widget) {
  return widget && widget->isVisible() && widget->isEnabled() && (widget->focusPolicy() & Qt::TabFocus) &&
         !isHeader(widget);
}

}  // namespace

FocusKeeper::FocusKeeper(QWidget& window, QWidget* view, std::function<std::vector<Dock*>()> docks)
    : QObject(&window), m_window(window), m_view(view), m_docks(std::move(docks)) {
  qApp->installEventFilter(this);
  connect(qApp, &QApplication::focusChanged, this, &FocusKeeper::onFocus);
}

FocusKeeper::~FocusKeeper() { qApp->removeEventFilter(this); }

bool FocusKeeper::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    m_byHand = key == Qt::Key_Tab || key == Qt::Key_Backtab;
    if (key == Qt::Key_Escape) givenUp(watched);
  } else if (event->type() == QEvent::MouseButtonPress && watched->isWidgetType()) {
    m_byHand = isHeader(static_cast<QWidget*>(watched));
  }
  return QObject::eventFilter(watched, event);
}

void FocusKeeper::onFocus(QWidget*, QWidget* now) {
  if (!now || now->window() != &m_window) return;
  if (!m_byHand && isHeader(now)) {
    // When whatever goes is gone.
    QTimer::singleShot(0, this, &FocusKeeper::giveBack);
    return;
  }
  m_holders.clear();
  for (QWidget* holder = now; holder && holder != &m_window; holder = holder->parentWidget())
    m_holders.emplace_back(holder);
}

/// When the field has gone: it knows its row, and what lies around that the row does not know.
void FocusKeeper::givenUp(QObject* watched) {
  auto* field = qobject_cast<QLineEdit*>(watched);
  if (!field || field->objectName() != QStringLiteral("psRowEdit") || field->window() != &m_window) return;
  QTimer::singleShot(0, this, [this, field = QPointer(field)] {
    const bool gone = !field || !field->isVisible();
    if (gone && m_view && m_view->isVisible()) m_view->setFocus(Qt::OtherFocusReason);
  });
}

void FocusKeeper::giveBack() {
  if (!isHeader(QApplication::focusWidget())) return;  // somebody else was faster
  const auto held = std::find_if(m_holders.begin(), m_holders.end(), takesFocus);
  if (held != m_holders.end())
    (*held)->setFocus(Qt::OtherFocusReason);
  else if (m_view && m_view->isVisible())
    m_view->setFocus(Qt::OtherFocusReason);
}

void FocusKeeper::step(bool forward) {
  std::vector<QWidget*> parts;
  if (m_view && m_view->isVisible()) parts.push_back(m_view);
  for (Dock* dock : m_docks()) {
    if (dock->isVisible() && dock->firstStop()) parts.push_back(dock);
  }
  if (parts.empty()) return;
  const QWidget* focus = QApplication::focusWidget();
  const auto at = std::find_if(parts.begin(), parts.end(), [focus](const QWidget* part) {
    return focus && (part == focus || part->isAncestorOf(focus));
  });
  const auto count = static_cast<std::ptrdiff_t>(parts.size());
  // From elsewhere forward to the first one, and back to the last.
  const std::ptrdiff_t index = at == parts.end() ? (forward ? -1 : count) : at - parts.begin();
  QWidget* to = parts[static_cast<size_t>((index + (forward ? 1 : -1) + count) % count)];
  m_byHand = true;
  auto* dock = qobject_cast<Dock*>(to);
  (dock ? dock->firstStop() : to)->setFocus(Qt::ShortcutFocusReason);
}

}  // namespace ps
