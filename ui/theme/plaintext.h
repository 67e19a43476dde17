// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QRect>
#include <QtCore/QString>

class QPoint;
class QWidget;

// Why for all widgets at once: Qt takes a text for HTML where it looks like it, and loads what it names. A project with
// a row called "<img src='file:///dev/zero'>" fills the memory. Texts of files, of plugins and paths come to labels and
// tooltips at a hundred places, and in Qt's own dialogs, of which one would be forgotten.
namespace ps {

/// A label that nobody told to be rich shows its text as it stands. The style says so of every widget before it is
/// measured.
void showPlainly(QWidget& widget);

/// Shows the tooltips of widgets, items of views, entries of menus and tabs as they stand. An event filter of the
/// application.
class PlainTips : public QObject {
 public:
  using QObject::QObject;
  bool eventFilter(QObject* object, QEvent* event) override;
};

/// A tooltip that is plain text; "" takes it away. In `area` of the widget, or all of it.
void showTip(const QPoint& global, const QString& text, QWidget* of, const QRect& area = {});
/// A tooltip of our own making, in which every text of others is escaped.
void showRichTip(const QPoint& global, const QString& html, QWidget* of);

/// As the text of a button, an action or a tab, where a single "&" underlines what follows it.
QString asButtonText(QString text);
/// The text that asButtonText() was given.
QString fromButtonText(QString text);

}  // namespace ps
