// SPDX-License-Identifier: Apache-2.0
#include "ui/window/keyroute.h"

#include "ui/panels/materialspanel.h"
#include "ui/panels/outliner.h"
#include "ui/viewport/viewport.h"
#include "ui/welcome/buttons.h"

#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QApplication>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QTabBar>

namespace ps {

namespace {

/// Of materials that were clicked: single keys go on to the view.
bool leavesKeys(const QObject* widget) {
  const auto* materials = qobject_cast<const MaterialsPanel*>(widget);
  return materials && !materials->walks();
}

}  // namespace

bool leadsTab(const QObject* widget) { return qobject_cast<const Viewport*>(widget) || leavesKeys(widget); }

bool takesKey(const QObject* widget, int key) {
  switch (key) {
    case Qt::Key_Delete:
      // Deletes where what is selected, or chosen, can be seen to be: in the outliner, the view and among materials.
      return widget == QApplication::focusWidget() && !qobject_cast<const Viewport*>(widget) &&
             !qobject_cast<const MaterialsPanel*>(widget) && !qobject_cast<const Outliner*>(widget->parent());
    case Qt::Key_Return:
    case Qt::Key_Enter:
      // "Make it real" is for the view; everywhere else Enter takes what is typed or chosen. An open list takes it from
      // this very event.
      return !QApplication::activePopupWidget() && widget == QApplication::focusWidget() &&
             !qobject_cast<const Viewport*>(widget) && !leavesKeys(widget);
    case Qt::Key_Space:
      return qobject_cast<const QAbstractButton*>(widget) || qobject_cast<const QComboBox*>(widget);
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
      if (leavesKeys(widget)) return false;
      if (qobject_cast<const QTabBar*>(widget) || qobject_cast<const QMenuBar*>(widget) ||
          qobject_cast<const MaterialsPanel*>(widget) || qobject_cast<const Card*>(widget))
        return true;
      return qobject_cast<const QAbstractItemView*>(widget) || qobject_cast<const QComboBox*>(widget);
    case Qt::Key_Home:
    case Qt::Key_End:
      // The outliner is beside the run all the time: its rows' ends have Ctrl+Home and Ctrl+End.
      if (qobject_cast<const Outliner*>(widget->parent())) return false;
      return qobject_cast<const QAbstractItemView*>(widget) || qobject_cast<const QComboBox*>(widget);
    default:
      return false;
  }
}

}  // namespace ps
