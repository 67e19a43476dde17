// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <QtCore/QList>
#include <QtCore/QObject>
#include <QtCore/QString>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

class QAction;
class QKeySequence;
class QMenu;

namespace ps {

class Actions;
class Session;
class Toolbox;
struct TiedScene;

QString materialAction(int number);  ///< name of the action that draws with that one, from 0 on

/// The menu Sketch: a row for each tool of the table, for the scene's first materials, and for each brush that is
/// installed.
class SketchActions : public QObject {
  Q_OBJECT
 public:
  SketchActions(Session& session, Toolbox& tools, const Actions& actions)
      : m_session(session), m_tools(tools), m_actions(actions) {}
  void makeMenu(QMenu* menu);
  void addBrushes();  ///< once plugins are there
  void addGravity(QMenu* menu);

  bool hasOtherCells(const std::string& body) const;  ///< than its matter was made of

  QAction* makeReal() const { return m_makeReal; }  ///< enabled while something is held

 Q_SIGNALS:
  void shapeTaken();                  ///< a brush was chosen by its name
  void planeWanted(bool acrossView);  ///< to draw on: else from the surface under the pointer

 private:
  void addHolding(QMenu* menu);
  void addMaterials(QMenu* menu);
  void showMaterials();  ///< what those entries are called
  void takeMaterial(size_t number);
  std::vector<std::string> heldBodies() const;  ///< until somebody lets go; keys do so themselves
  void letGo();
  void showHeld();
  void separate();
  struct Pieces {
    Body body;  ///< as it was asked for
    std::vector<std::vector<std::array<int, 3>>> cells;
  };
  struct Separation {
    std::vector<Pieces> bodies;
    QString resized;   ///< the name of one whose matter is of other cells
    bool all = false;  ///< nobody has chosen: of those that are solid
  };
  void findPieces(const std::shared_ptr<const TiedScene>& moment, Separation wanted);
  void part(const std::vector<Pieces>& bodies, const QString& resized);
  void noteSize(const std::string& body, double factor);
  void turnGravity();
  QList<QKeySequence> keysOf(const std::string& brush) const;

  Session& m_session;
  Toolbox& m_tools;
  const Actions& m_actions;
  QMenu* m_shapes = nullptr;
  QAction *m_hold = nullptr, *m_makeReal = nullptr, *m_gravity = nullptr;
  struct Resized {
    uint64_t revision = 0;  ///< of the scene as it was made
    double factor = 1;      ///< by which a sketch has become larger since
  };
  std::map<std::string, Resized> m_resized;  ///< by Body::id
  double m_before = 0;  ///< m/s^2, the gravity before there was none; 0: it was not taken away here
};

}  // namespace ps
