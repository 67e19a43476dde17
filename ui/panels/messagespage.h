// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

class QStandardItemModel;
class QTreeView;
class QLabel;

namespace ps {

class MessageLog;
struct Message;

/// The list of messages, newest on top.
class MessagesPage : public QWidget {
  Q_OBJECT
 public:
  explicit MessagesPage(MessageLog& log, QWidget* parent = nullptr);

 Q_SIGNALS:
  void linkActivated(const QString& target);  ///< MessageLink::target

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void refresh();
  void setWidths();
  void addLinks(int row, const Message& message);
  MessageLog& m_log;
  QStandardItemModel* m_model;
  QTreeView* m_view;
  QLabel* m_empty;
  int m_linksWidth = 0;  ///< of the widest
};

}  // namespace ps
