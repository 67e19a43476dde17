// SPDX-License-Identifier: Apache-2.0
// A picture is drawn by a thread and a context of its own: reading one back from the view would hold up the interface.
// At close the one that has begun is waited for.
#pragma once
#include "ui/film/sceneshot.h"
#include "ui/session/worker.h"

#include <QtCore/QObject>
#include <QtCore/QSize>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <functional>
#include <memory>
#include <optional>

namespace ps {

class Session;

/// Where the picture of a project's file is kept, in the user's cache.
QString thumbnailPath(const QString& project);

/// Keeps pictures of the projects that a window has open: when one is saved, some seconds after it was opened where
/// there is none yet, and when it is asked to. Not of samples, which have theirs.
class Thumbnails : public QObject {
  Q_OBJECT
 public:
  static constexpr QSize kSize{320, 256};
  static constexpr int kSettle = 4000;  ///< ms after a project has shown, for matter to move a little
  /// `shot`: what the view shows now; nothing: no matter, or no view.
  Thumbnails(Session& session, std::function<std::optional<SceneShot>()> shot, QObject* parent = nullptr);
  void take();  ///< of the document as it is shown now
  /// The same, as the project's own picture, in one step of undo; ownTaken() follows, unless it is asked for once more
  /// or another project is opened before.
  void takeOwn();
  void end() { m_worker.wait(); }  ///< what is being drawn is drawn: before the session goes

 Q_SIGNALS:
  void taken(const QString& project);
  void ownTaken(const QString& problem);  ///< "": the project has it

 private:
  Session& m_session;
  std::function<std::optional<SceneShot>()> m_shot;
  QTimer m_settle;
  int m_asked = 0;  ///< how often an own picture was, or its project went
  Worker m_worker;  // ends first
};

}  // namespace ps
