// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>

class QMenu;

namespace ps {

class Actions;
class Notices;
class RestoreOffer;
class Session;
enum class OutsideChange;
enum class SaveRefusal;

/// What is said where a file is not this window's alone (another window has it open, another program has written it),
/// with the ways out; and the menu of what it was saved as before.
class FileGuard : public QObject {
  Q_OBJECT
 public:
  FileGuard(Session& session, const Actions& actions, Notices& notices, RestoreOffer& restore,
            QObject* parent = nullptr);
  void addVersionsMenu(QMenu* menu);
  void fillVersions();

 private:
  void onRefused(const QString& path, SaveRefusal refusal, const QString& problem, bool present);
  void onOutside(const QString& path, OutsideChange change);
  void onElsewhere(const QString& path, const QString& who);
  void takeOver(const QString& path, bool save);
  void onTookOver(const QString& path, bool done);

  Session& m_session;
  const Actions& m_actions;
  Notices& m_notices;
  RestoreOffer& m_restore;
  QMenu* m_versions = nullptr;
  QString m_saveTo;  ///< file to save to when it is taken over; "": none
};

}  // namespace ps
