// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QPushButton>

class QAction;

namespace ps {

/// Stands at the bottom of the view while something is held, and lets go of it.
class MakeRealButton : public QPushButton {
 public:
  /// Goes with the view; shown as long as the action can be had.
  MakeRealButton(QAction& action, QWidget& view);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void follow();
  void place();
  QAction& m_action;
};

}  // namespace ps
