// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>

class QMenu;

namespace ps {

class Actions;
class Notices;
class Session;

/// Exports of the recorded run: what asks for them, and what is said about them.
class ExportActions : public QObject {
  Q_OBJECT
 public:
  ExportActions(Session& session, const Actions& actions, Notices& notices, QObject* parent = nullptr);
  void addTo(QMenu* menu);
  void setEnabled(bool on);  ///< what needs plugins

 private:
  template <class Dialog>
  void open();
  void onWorking(const QString& stage, double done, double left);
  void onWritten(const QString& what, const QString& where, qulonglong frames);

  Session& m_session;
  const Actions& m_actions;
  Notices& m_notices;
  bool m_tells = false;  ///< how far it is
};

}  // namespace ps
