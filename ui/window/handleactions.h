// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/handlesettings.h"

#include <QtCore/QObject>

class QActionGroup;
class QMenu;

namespace ps {

class Actions;
class Toolbox;

/// How the handles work, as somebody chooses it for all projects: what they turn and scale about.
class HandleActions : public QObject {
  Q_OBJECT
 public:
  HandleActions(Toolbox& tools, const Actions& actions, QObject* parent);
  void addTo(QMenu* edit);
  QMenu* pivots() const { return m_pivots; }

 private:
  void choose(const HandleSettings& settings);
  void show();
  Toolbox& m_tools;
  const Actions& m_actions;
  QMenu* m_pivots = nullptr;
  QActionGroup* m_pivotGroup;
};

}  // namespace ps
