// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

class QStandardItemModel;
class QTreeView;
class QLabel;

namespace ps {

class MessageLog;

/// The list of messages, newest on top.
class MessagesPage : public QWidget {
  Q_OBJECT
 public:
  explicit MessagesPage(MessageLog& log, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void refresh();
  MessageLog& m_log;
  QStandardItemModel* m_model;
  QTreeView* m_view;
  QLabel* m_empty;
};

}  // namespace ps
