// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

class QMenu;
class QPoint;

namespace ps {

class Actions;
class Session;
class Viewport;
class WindowLayout;

/// What the scene and the window look like: the menu View, and the view's own menu.
class ViewActions {
 public:
  /// `view`: nullptr where there is no picture.
  ViewActions(Session& session, Viewport* view, WindowLayout& layout, const Actions& actions)
      : m_session(session), m_view(view), m_layout(layout), m_actions(actions) {}
  void makeMenu(QMenu* menu);
  void openViewMenu(const QPoint& global) const;
  /// What stands over the picture and whose light falls on the scene, for a button beside the view.
  QMenu* look() const { return m_look; }

 private:
  void makeSection(QMenu* menu);
  void makeShow(QMenu* menu);
  void makeLight(QMenu* menu);
  void makeLook(const QMenu& shown, const QMenu& light);
  void followLook() const;  ///< marks what is so at present
  void makeThemes(QMenu* menu);
  /// Matter and the fields that have no entry yet.
  void addColours(QMenu* menu);
  void addColour(QMenu* menu, const std::string& name, const std::string& label);
  Session& m_session;
  Viewport* m_view;
  WindowLayout& m_layout;
  const Actions& m_actions;
  QMenu* m_look = nullptr;
};

}  // namespace ps
