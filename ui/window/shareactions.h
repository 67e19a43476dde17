// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>

#include <memory>

class QMenu;

namespace ps {

class Actions;
class Notices;
class Session;
class Viewport;
struct Project;

/// Copies for others: one file with what its run comes to; and whether one of somebody's comes to that here.
class ShareActions : public QObject {
  Q_OBJECT
 public:
  ShareActions(Session& session, const Actions& actions, Notices& notices, QObject* parent = nullptr);
  void addTo(QMenu* menu, Viewport* view);
  void setEnabled(bool on);  ///< what needs plugins
  /// In the background: the run to its end takes as long as it takes.
  void writeCopy(const QString& path);

 private:
  void chooseCopy();
  void check();
  void onOpened();

  Session& m_session;
  const Actions& m_actions;
  Notices& m_notices;
  Viewport* m_view = nullptr;
  std::shared_ptr<const Project> m_opened;  ///< as it was opened, with an end; nullptr: it says of none
};

}  // namespace ps
