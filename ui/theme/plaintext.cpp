// SPDX-License-Identifier: Apache-2.0
#include "ui/theme/plaintext.h"

#include <QtGui/QHelpEvent>
#include <QtGui/QTextDocument>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolTip>

namespace ps {
namespace {

/// Of what a widget shows at this place, or of the widget itself.
QString tipAt(const QWidget& widget, const QPoint& at) {
  QString text;
  if (const auto* view = qobject_cast<const QAbstractItemView*>(widget.parentWidget());
      view && view->viewport() == &widget) {
    const auto* header = qobject_cast<const QHeaderView*>(view);
    if (!header)
      text = view->indexAt(at).data(Qt::ToolTipRole).toString();
    else if (const int section = header->logicalIndexAt(at); section >= 0)
      text = header->model()->headerData(section, header->orientation(), Qt::ToolTipRole).toString();
  } else if (const auto* menu = qobject_cast<const QMenu*>(&widget)) {
    const QAction* action = menu->toolTipsVisible() ? menu->actionAt(at) : nullptr;
    if (action) text = action->toolTip();
  } else if (const auto* tabs = qobject_cast<const QTabBar*>(&widget)) {
    text = tabs->tabToolTip(tabs->tabAt(at));
  }
  return text.isEmpty() ? widget.toolTip() : text;
}

}  // namespace

void showPlainly(QWidget& widget) {
  auto* label = qobject_cast<QLabel*>(&widget);
  if (!label || label->textFormat() != Qt::AutoText) return;
  if (label->inherits("QTipLabel")) return;  // PlainTips sees to it, and rows have rich tips
  label->setTextFormat(Qt::PlainText);
}

bool PlainTips::eventFilter(QObject* object, QEvent* event) {
  if (event->type() != QEvent::ToolTip || !object->isWidgetType()) return false;
  auto* widget = static_cast<QWidget*>(object);
  const auto* help = static_cast<const QHelpEvent*>(event);
  const QString text = tipAt(*widget, help->pos());
  if (!Qt::mightBeRichText(text)) return false;
  showTip(help->globalPos(), text, widget);
  return true;
}

void showTip(const QPoint& global, const QString& text, QWidget* of, const QRect& area) {
  const QString shown = Qt::mightBeRichText(text) ? Qt::convertFromPlainText(text, Qt::WhiteSpaceNormal) : text;
  QToolTip::showText(global, shown, of, area);
}

void showRichTip(const QPoint& global, const QString& html, QWidget* of) { QToolTip::showText(global, html, of); }

QString asButtonText(QString text) { return text.replace(QLatin1Char('&'), QStringLiteral("&&")); }
QString fromButtonText(QString text) { return text.replace(QStringLiteral("&&"), QStringLiteral("&")); }

}  // namespace ps
