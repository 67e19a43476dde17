// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/progress.h"
#include "core/geometry/toolbodies.h"
#include "core/io/meshimport.h"
#include "core/scene/solidform.h"
#include "ui/session/worker.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <memory>
#include <vector>

class QAction;
class QMenu;

namespace ps {

class Actions;
class Notices;
class Selection;
class Session;

/// What brings whole bodies into the scene: solids of every kind, sheets, ropes, and meshes from files. They come to
/// stand above what is in the middle of the scene, and join it at once.
class BodyActions : public QObject {
  Q_OBJECT
 public:
  BodyActions(Session& session, Selection& selection, const Actions& actions, Notices& notices,
              QObject* parent = nullptr);
  ~BodyActions() override;
  void makeMenu(QMenu* menu, QMenu* walls);  ///< `walls`: stands beside the bodies
  /// What a mesh comes in as: matter that fills it, or a wall of its shape, which is a fixed body of its surface alone
  /// that lets no heat through.
  enum class MeshUse : uint8_t { Matter, Wall };
  /// The entry that brings walls.
  void addToWallMenu(QMenu* menu);
  /// Reads a mesh in the background and adds it; what goes wrong is told over the view.
  void importMesh(const QString& path, MeshUse use = MeshUse::Matter);
  /// Gives up the mesh that is being read. False where none is.
  bool cancelReading();
  /// By its ending, one of those that meshes have.
  static bool isMesh(const QString& path);

 Q_SIGNALS:
  void rowWanted(const ps::Address& address);  ///< of what has come
  /// A mesh, for a while already; often. -1 per cent: no more.
  void reading(const QString& stage, int percent);

 private:
  void chooseMesh(MeshUse use);
  void showCounts();
  void addSolid(SolidForm::Kind kind, const QString& name);
  void makeToolMenu(QMenu* menu);
  void addTool(const ToolForm& form);
  Body newSolid(SolidForm::Kind kind, const QString& name) const;
  std::string add(Body body, const std::string& without = {});
  void onImported(const QString& path, MeshUse use, const std::shared_ptr<ImportedMesh>& imported,
                  const QString& problem);
  double scaledToFit(Body& body, const ImportedMesh& imported) const;
  void showImported(const std::string& id);
  void askUnit(const std::string& id, double metresPerUnit);
  void setUnit(std::string id, double from, double to);  ///< a copy: the notice that asks goes meanwhile
  void showReading();
  void stopReading();

  Session& m_session;
  Selection& m_selection;
  const Actions& m_actions;
  Notices& m_notices;
  std::vector<QAction*> m_adding;       ///< need plugins; solids first
  std::string m_asked;                  ///< body whose unit was asked for last; "": none
  std::shared_ptr<Progress> m_reading;  ///< of the mesh that is being read; nullptr: none is
  QString m_name;                       ///< of its file
  QElapsedTimer m_since;                ///< it is being read
  QTimer m_clock;                       ///< tells how far it is
  bool m_tells = false;                 ///< that has begun
  Worker m_worker;                      ///< reads meshes; ends first
};

}  // namespace ps
