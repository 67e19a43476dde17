// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/messagelog.h"

#include <QtCore/QTimer>
#include <QtWidgets/QWidget>

#include <functional>
#include <utility>
#include <vector>

class QLabel;
class QHBoxLayout;

namespace ps {

/// A bar over a dock: what happened, where, what to do, with buttons. Never a dialog. The newest notice shows; those
/// with buttons wait below it until somebody decides, those without (the message log has them too) give way. What went
/// well, with nothing to decide, leaves by itself.
class NoticeBar : public QWidget {
  Q_OBJECT
 public:
  explicit NoticeBar(QWidget* parent = nullptr);
  struct Button {
    QString text;
    std::function<void()> act;
    QString tip = QString();
  };
  /// Of long work; Esc does the same.
  static Button cancelButton(std::function<void()> act);
  /// `topic`: a later notice of the same topic replaces this one, and close(topic) takes it away; what waits below
  /// shows.
  void show(const QString& topic, MessageLevel level, const QString& title, const QString& text,
            std::vector<Button> buttons = {});
  /// Another text in the notice of a topic, in place: its buttons stay under the pointer.
  void setText(const QString& topic, const QString& text);
  void close(const QString& topic);
  QString topic() const;  ///< of the notice that shows; "" when none does
  QString text() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Notice {
    QString topic;
    MessageLevel level;
    QString title, text;
    std::vector<Button> buttons;
  };
  void remove(const QString& topic);
  void refresh();      ///< shows the last of the notices
  void showWaiting();  ///< how many are below it
  std::vector<Notice> m_notices;
  QLabel *m_title, *m_text, *m_more;
  QHBoxLayout* m_buttons;
  QTimer m_leaves{this};
};

}  // namespace ps
