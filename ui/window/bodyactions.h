// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/geometry/toolbodies.h"
#include "core/scene/solidform.h"
#include "ui/window/meshqueue.h"

#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <string>
#include <vector>

class QAction;
class QMenu;

namespace ps {

class Actions;
class Notices;
class Selection;
class Session;
struct SolidRow;

/// What brings whole bodies into the scene: solids of every kind, sheets, ropes, and meshes from files. They come to
/// stand above what is in the middle of the scene, and join it at once.
class BodyActions : public QObject {
  Q_OBJECT
 public:
  BodyActions(Session& session, Selection& selection, const Actions& actions, Notices& notices,
              QObject* parent = nullptr);
  void makeMenu(QMenu* menu, QMenu* walls);  ///< `walls`: stands beside the bodies
  /// The entry that brings walls.
  void addToWallMenu(QMenu* menu);
  /// Reads meshes in the background and adds them one by one; what goes wrong is told over the view.
  void importMeshes(const QStringList& paths, MeshUse use = MeshUse::Matter) { m_meshes.add(paths, use); }
  /// Gives up those that are being read. False where none is.
  bool cancelReading() { return m_meshes.cancel(); }
  /// By its ending, one of those that meshes have.
  static bool isMesh(const QString& path);

 Q_SIGNALS:
  void rowWanted(const ps::Address& address);  ///< of what has come
  /// A mesh, for a while already; often. -1 per cent: no more.
  void reading(const QString& stage, int percent);

 private:
  void chooseMesh(MeshUse use);
  void showCounts();
  void addSolid(const SolidRow& row);
  void makeToolMenu(QMenu* menu);
  void addTool(const ToolForm& form);
  Body newSolid(const SolidRow& row) const;
  std::string add(Body body, const std::string& without = {});
  void onRead(const MeshQueue::File& file, const ImportedMesh& imported);
  void onUnread(const MeshQueue::File& file, const QString& problem);
  void onAllRead();
  double heightFree(const Vector3& middle, const Vector3& size, const std::string& without) const;
  double scaledToFit(Body& body, const ImportedMesh& imported) const;
  void showImported(const std::string& id);
  void askUnit(const std::string& id, double metresPerUnit);
  void setUnit(std::string id, double from, double to);  ///< a copy: the notice that asks goes meanwhile

  Session& m_session;
  Selection& m_selection;
  const Actions& m_actions;
  Notices& m_notices;
  std::vector<QAction*> m_adding;  ///< need plugins; solids first
  std::string m_asked;             ///< body whose unit was asked for last; "": none
  MeshQueue m_meshes;
};

}  // namespace ps
