// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>

#include <string>
#include <vector>

class QMenu;
class QStackedWidget;

namespace ps {

class Actions;
class Inspector;
class MessagesPage;
class Notices;
class PluginPage;
class Session;

/// Follows the links by which notes, notices and messages lead out of a trouble: a plugin that is missing is looked
/// for, or another material is taken in the place of the one that it would give.
class WaysOut : public QObject {
  Q_OBJECT
 public:
  struct Parts {
    Session& session;
    Notices& notices;
    const Actions& actions;
    Inspector& inspector;
    QStackedWidget& centre;
    PluginPage& plugins;
    MessagesPage* messages = nullptr;
  };
  explicit WaysOut(const Parts& parts, QObject* parent = nullptr);
  void follow(const QString& link);
  /// Of an opened scene: over the view, and in the messages one for each.
  void tellMissing();
  /// Over the view alone, as the scene is by now; nothing while it misses none.
  void showMissing();
  void findPlugin(const std::string& id);
  /// A menu of those that are installed; nullptr where the scene has no such material.
  QMenu* materialsFor(const std::string& material);
  void useOther(const std::string& material, const std::string& base);
  /// Installs a plugin from a folder, which is read by another thread.
  void installFrom(const QString& folder, const std::string& id);

 private:
  void showInstalled(const std::string& id, const QString& problem, const QString& place);
  /// Of one in quarantine that was tried again.
  void showTried(const std::string& id, const QString& problem);
  Parts m_parts;
};

}  // namespace ps
