// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QPointer>
#include <QtCore/QString>
#include <QtCore/QTimer>
#include <QtWidgets/QWidget>

#include <vector>

class QLabel;
class QPushButton;

namespace ps {

/// One step of a tour: a widget, and what can be done with it.
struct TourStep {
  QPointer<QWidget> at;
  QString title, text;
};

/// Marks over the running window, one after another: a ring around what is spoken of, and a card that stays where it is
/// as long as it covers nothing of that. Nothing is held up: the mouse goes through the ring to what lies below. Goes
/// by "Done", "Skip" or Esc.
class Tour : public QWidget {
  Q_OBJECT
 public:
  explicit Tour(QWidget& window);
  void start(std::vector<TourStep> steps);
  bool running() const { return !m_steps.empty(); }
  int step() const { return m_step; }
  void next();
  void end();

 Q_SIGNALS:
  void ended();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void showStep();
  void place();
  void follow();                    ///< what it speaks of, when that or the window is laid out anew
  QRect target(size_t step) const;  ///< of a step, in the window
  QRect target() const;             ///< of the present one
  std::vector<TourStep> m_steps;
  int m_step = 0;
  QWidget* m_card;
  QLabel *m_title, *m_text, *m_count;
  QPushButton *m_next, *m_skip;
  QTimer m_laidOut;  ///< fires when all layouts have done their part
};

}  // namespace ps
