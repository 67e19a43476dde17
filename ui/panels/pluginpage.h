// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/missingplugins.h"

#include <QtWidgets/QWidget>

#include <string>
#include <vector>

class QHBoxLayout;
class QLabel;
class QLineEdit;
class QModelIndex;
class QPushButton;
class QStandardItemModel;
class QTreeView;

namespace ps {

class NothingFound;
class PluginRegistry;
struct PluginInfo;
class Session;

/// All plugins found, loaded or not: name, kind, version, API, licence, place, state, and what is wrong and what to do.
class PluginPage : public QWidget {
  Q_OBJECT
 public:
  explicit PluginPage(Session& session, QWidget* parent = nullptr);
  void refresh();
  void select(const std::string& id);
  /// Below the list, until another row is chosen: the bar over the view is out of sight here.
  void showNews(const QString& text);
  /// Shows one that the scene misses, whatever is filtered.
  void find(const std::string& id);
  /// Tries one in quarantine once more, in a process of its own; one at a time.
  void tryAgain(const std::string& id);
  QString summary() const;
  /// As shown, one line per plugin: for tests and "Copy list".
  QStringList lines() const;

 Q_SIGNALS:
  void closeRequested();
  void tried(const std::string& id, const QString& problem);  ///< ""; or why it stays in quarantine
  void folderWanted(const std::string& id);                   ///< where a missing one is to be looked for

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  QHBoxLayout* makeHead();
  QHBoxLayout* makeFoot();
  void addMissing();
  void showDetails();
  void showMissing(const MissingPlugin& missing);
  const MissingPlugin* missingAt(const QModelIndex& index) const;
  std::string idAt(int row) const;
  /// What the list has in this row; nullptr: nothing there.
  const PluginInfo* pluginAt(const QModelIndex& index) const;
  void filter(const QString& text);
  Session& m_session;
  PluginRegistry* m_registry = nullptr;  ///< while plugins are being loaded
  QStandardItemModel* m_model;
  QTreeView* m_view;
  QLabel *m_summary, *m_details;
  QLineEdit* m_filter;
  NothingFound* m_nothing;
  QPushButton *m_again, *m_folder;
  std::vector<MissingPlugin> m_missing;  ///< that the list has no other row for
  bool m_trying = false;                 ///< in a process of its own
};

}  // namespace ps
