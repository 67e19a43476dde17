// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/handlesettings.h"

#include <QtCore/QObject>

#include <vector>

class QAction;
class QActionGroup;
class QLineEdit;
class QMenu;

namespace ps {

class Actions;
class Notices;
class Toolbox;

/// How the handles work, as somebody chooses it for all projects: what they turn and scale about, and by which steps
/// they go.
class HandleActions : public QObject {
  Q_OBJECT
 public:
  HandleActions(Toolbox& tools, const Actions& actions, Notices& notices, QObject* parent);
  void addTo(QMenu* edit);
  QMenu* pivots() const { return m_pivots; }
  QMenu* snapping() const { return m_snapping; }
  QAction* snap() const { return m_snap; }

 private:
  void addPivots(QMenu* edit);
  void addSnapping(QMenu* edit);
  void addSteps();
  void take(size_t step);  ///< what is typed in its field
  void choose(const HandleSettings& settings);
  void show();
  Toolbox& m_tools;
  const Actions& m_actions;
  Notices& m_notices;
  QMenu *m_pivots = nullptr, *m_snapping = nullptr;
  QActionGroup* m_pivotGroup;
  QAction *m_snap = nullptr, *m_surfaces = nullptr;
  std::vector<QLineEdit*> m_steps;
};

}  // namespace ps
