// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QPointer>

#include <functional>
#include <vector>

class QWidget;

namespace ps {

class Dock;

/// Where the keys go. What has the focus may vanish (a row that is named, a page that another takes the place of): Qt
/// gives it to whatever is next, which is some dock's tabs. Then it goes to what held that widget, else to the view.
/// It gets to tabs by hand alone: Tab, a click on them, or from part to part of the window. What is typed into a row
/// and given up by Esc leaves the keys in the view.
class FocusKeeper : public QObject {
  Q_OBJECT
 public:
  /// `view`: nullptr where there is no picture. `docks`: in the order in which step() goes through them.
  FocusKeeper(QWidget& window, QWidget* view, std::function<std::vector<Dock*>()> docks);
  ~FocusKeeper() override;
  /// To the next part of the window in sight, or the one before: the view, then each dock, where it was left there.
  void step(bool forward);

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void onFocus(QWidget* before, QWidget* now);
  void givenUp(QObject* watched);
  void giveBack();
  QWidget& m_window;
  QPointer<QWidget> m_view;
  std::function<std::vector<Dock*>()> m_docks;
  bool m_byHand = false;                     ///< what comes next may give the focus to tabs
  std::vector<QPointer<QWidget>> m_holders;  ///< of the focus, from the widget itself out
};

}  // namespace ps
