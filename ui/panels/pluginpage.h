// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

#include <string>
#include <vector>

class QLabel;
class QLineEdit;
class QStandardItemModel;
class QTreeView;

namespace ps {

class PluginRegistry;
class Session;

/// All plugins found, loaded or not: name, kind, version, API, licence, place, state, and what is wrong and what to do.
class PluginPage : public QWidget {
  Q_OBJECT
 public:
  explicit PluginPage(Session& session, QWidget* parent = nullptr);
  void refresh();
  void select(const std::string& id);
  QString summary() const;
  /// As shown, one line per plugin: for tests and "Copy list".
  QStringList lines() const;

 Q_SIGNALS:
  void closeRequested();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void showDetails();
  void filter(const QString& text);
  PluginRegistry* m_registry = nullptr;  ///< while plugins are being loaded
  QStandardItemModel* m_model;
  QTreeView* m_view;
  QLabel *m_summary, *m_details;
  QLineEdit* m_filter;
};

}  // namespace ps
