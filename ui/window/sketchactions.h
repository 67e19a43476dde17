// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QList>

#include <string>

class QKeySequence;
class QMenu;

namespace ps {

class Actions;
class Session;
class Toolbox;

/// The menu Sketch: a row for each tool of the table, and for each brush that is installed.
class SketchActions {
 public:
  SketchActions(Session& session, Toolbox& tools, const Actions& actions)
      : m_session(session), m_tools(tools), m_actions(actions) {}
  void makeMenu(QMenu* menu);
  void addBrushes();  ///< once plugins are there

 private:
  QList<QKeySequence> keysOf(const std::string& brush) const;

  Session& m_session;
  Toolbox& m_tools;
  const Actions& m_actions;
  QMenu* m_shapes = nullptr;
};

}  // namespace ps
