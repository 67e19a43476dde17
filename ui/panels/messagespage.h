// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QDateTime>
#include <QtWidgets/QWidget>

class QStandardItemModel;
class QTreeView;
class QLabel;

namespace ps {

class MessageLog;
class Session;
struct Message;

/// The list of messages, newest on top; those of a project that was open before say so.
class MessagesPage : public QWidget {
  Q_OBJECT
 public:
  explicit MessagesPage(Session& session, QWidget* parent = nullptr);

 Q_SIGNALS:
  void linkActivated(const QString& target);  ///< MessageLink::target

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void refresh();
  void setWidths();
  bool isOfFormer(const Message& message) const;
  void addLinks(int row, const Message& message);
  MessageLog& m_log;
  QString m_path;      ///< of the present project; "": never saved
  QDateTime m_opened;  ///< when the present project came in the place of another
  QStandardItemModel* m_model;
  QTreeView* m_view;
  QLabel* m_empty;
  int m_linksWidth = 0;  ///< of the widest
};

}  // namespace ps
