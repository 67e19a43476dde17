// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>

class QMenu;

namespace ps {

class Actions;
class Notices;
class Session;

/// Saving and opening what was recorded of the run, and what is said about it.
class RecordingActions : public QObject {
  Q_OBJECT
 public:
  RecordingActions(Session& session, const Actions& actions, Notices& notices, QObject* parent = nullptr);
  void addTo(QMenu* menu);
  void setEnabled(bool on);  ///< what needs plugins

 private:
  void chooseSave();
  void chooseOpen();
  void onWorking(const QString& stage, double done, double left);
  void onOpened(const QString& path, double from, double to, const QString& remark);

  Session& m_session;
  const Actions& m_actions;
  Notices& m_notices;
  bool m_tells = false;  ///< how far it is
};

}  // namespace ps
