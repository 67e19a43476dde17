// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/ui/windowtesting.h"
#include "ui/panels/outliner.h"
#include "ui/session/selection.h"

#include <QtCore/QAbstractItemModel>
#include <QtCore/QMimeData>
#include <QtCore/QStringList>
#include <QtCore/QTimer>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QDropEvent>
#include <QtGui/QMouseEvent>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

// What a hand does to any widget of the window: drags, drops, menus and dialogs.
namespace ps::hands {

inline void move(QWidget& on, const QPointF& to, Qt::KeyboardModifiers modifiers = {}) {
  QMouseEvent event(QEvent::MouseMove, to, on.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, modifiers);
  QApplication::sendEvent(&on, &event);
}

/// Without letting go.
inline void press(QWidget& on, const QPoint& from, const QPoint& way, Qt::KeyboardModifiers first,
                  Qt::KeyboardModifiers then) {
  constexpr int kSteps = 6;
  QTest::mousePress(&on, Qt::LeftButton, first, from);
  for (int k = 1; k <= kSteps; ++k) move(on, from + QPointF(way) * k / kSteps, then);
}

inline void pull(QWidget& on, const QPoint& from, const QPoint& way, Qt::KeyboardModifiers modifiers = {}) {
  press(on, from, way, {}, modifiers);
  QTest::mouseRelease(&on, Qt::LeftButton, modifiers, from + way);
}

/// Whether it was taken.
inline bool drop(QWidget& on, const QMimeData& data) {
  const QPointF at = QRectF(on.rect()).center();
  QDragEnterEvent enter(at.toPoint(), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&on, &enter);
  if (!enter.isAccepted()) return false;
  QDropEvent event(at, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&on, &event);
  return event.isAccepted();
}

/// What a list or a tree hands out for a row.
inline std::unique_ptr<QMimeData> dragged(const QModelIndex& row) {
  return std::unique_ptr<QMimeData>(row.model()->mimeData({row}));
}

/// A row of the outliner.
inline QModelIndex outlined(const MainWindow& window, OutlineKind kind, const std::string& id) {
  const QAbstractItemModel& model = *window.findChild<Outliner*>()->findChild<QTreeView*>()->model();
  for (const QModelIndex& index : model.match(model.index(0, 0), outline::kId, QString::fromStdString(id), -1,
                                              Qt::MatchExactly | Qt::MatchRecursive)) {
    if (index.data(outline::kKind).toInt() == static_cast<int>(kind)) return index;
  }
  return {};
}

/// The entry at the end of a path of titles; nullptr where there is none.
inline QAction* entryOf(QMenu& menu, const QStringList& path) {
  QMenu* in = &menu;
  for (const QString& text : path) {
    Q_EMIT in->aboutToShow();
    const QList<QAction*> actions = in->actions();
    const auto found = std::find_if(actions.begin(), actions.end(), [&](QAction* a) { return a->text() == text; });
    if (found == actions.end()) return nullptr;
    if (!(*found)->menu()) return *found;
    in = (*found)->menu();
  }
  return nullptr;
}

/// A right-click on a widget, and a click on an entry of the menu that comes, or what lies deeper in it. `first` is
/// done just before that.
inline void chooseAt(QWidget& on, const QPoint& at, const QStringList& path, const std::function<void()>& first = {}) {
  bool chosen = false;
  QTimer::singleShot(0, &on, [&] {  // the menu may keep its own loop
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    QAction* action = entryOf(*menu, path);
    if (!action) menu->close();
    QVERIFY2(action, qPrintable(path.join(QStringLiteral(" > "))));
    if (first) first();
    chosen = true;
    if (path.size() == 1) {
      QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
    } else {
      menu->close();
      action->trigger();
    }
  });
  QContextMenuEvent ask(QContextMenuEvent::Mouse, at, on.mapToGlobal(at));
  QApplication::sendEvent(&on, &ask);
  QTRY_VERIFY(chosen);
}

/// Names the file in the dialog that comes.
inline void answerDialog(const QString& path) {
  QTimer::singleShot(0, qApp, [path] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    QVERIFY(dialog);
    dialog->selectFile(path);
    static_cast<QDialog*>(dialog)->accept();
  });
}

}  // namespace ps::hands
