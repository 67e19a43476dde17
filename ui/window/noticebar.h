// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/window/messagelog.h"

#include <QtWidgets/QWidget>

#include <functional>
#include <utility>
#include <vector>

class QLabel;
class QHBoxLayout;

namespace ps {

/// A bar over a dock: what happened, where, what to do, with buttons. Never a dialog.
class NoticeBar : public QWidget {
  Q_OBJECT
 public:
  explicit NoticeBar(QWidget* parent = nullptr);
  struct Button {
    QString text;
    std::function<void()> act;
  };
  /// `topic`: a later notice of the same topic replaces this one, and close(topic) takes it away.
  void show(const QString& topic, MessageLevel level, const QString& title, const QString& text,
            std::vector<Button> buttons = {});
  void close(const QString& topic);
  const QString& topic() const { return m_topic; }
  QString text() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString m_topic;
  MessageLevel m_level = MessageLevel::Info;
  QLabel *m_title, *m_text;
  QHBoxLayout* m_buttons;
};

}  // namespace ps
