// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>

#include <functional>

class QDialog;
class QMenu;

namespace ps {

class Actions;
class Notices;
class Session;
class Viewport;

/// Exports of the recorded run: what asks for them, and what is said about them.
class ExportActions : public QObject {
  Q_OBJECT
 public:
  ExportActions(Session& session, const Actions& actions, Notices& notices, QObject* parent = nullptr);
  /// `view`: whose look films have; nullptr where there is none.
  void addTo(QMenu* menu, const Viewport* view);
  void setEnabled(bool on);  ///< what needs plugins

 private:
  void open(const QString& name, const std::function<QDialog*()>& make);
  void onWorking(const QString& stage, double done, double left);

  Session& m_session;
  const Actions& m_actions;
  Notices& m_notices;
  bool m_tells = false;  ///< how far it is
};

}  // namespace ps
