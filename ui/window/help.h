// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/help/helppages.h"

#include <QtCore/QObject>

#include <optional>
#include <string>

class QMenu;

namespace ps {

class Actions;
class HelpWindow;
class MainWindow;
class ParameterRow;

/// The menu Help's pages and F1: a row explains its value, a panel and a tool have a page each, a brush its place on
/// one.
class Help : public QObject {
  Q_OBJECT
 public:
  Help(MainWindow& window, const Actions& actions);
  void makeMenu(QMenu* menu);
  void open(const QString& id);
  /// Of the row under the pointer or with the focus, or else of the brush, the panel or the tool there.
  void openHere();
  HelpWindow* dialog() const;  ///< nullptr before it was opened

 private:
  std::optional<HelpPage> page(const QString& id) const;
  HelpPage toolPage(const QString& id) const;
  HelpPage valuesPage() const;
  QString idHere() const;
  QString ofTool() const;
  std::string brushInHand() const;  ///< id of its plugin, or "erase"
  MainWindow& m_window;
  const Actions& m_actions;
};

}  // namespace ps
