// SPDX-License-Identifier: Apache-2.0
#pragma once

class QMenu;
class QPoint;

namespace ps {

class Actions;
class Document;
class Viewport;
class WindowLayout;

/// What the scene and the window look like: the menu View, and the view's own menu.
class ViewActions {
 public:
  /// `view`: nullptr where there is no picture.
  ViewActions(Document& document, Viewport* view, WindowLayout& layout, const Actions& actions)
      : m_document(document), m_view(view), m_layout(layout), m_actions(actions) {}
  void makeMenu(QMenu* menu);
  void openViewMenu(const QPoint& global) const;

 private:
  void makeThemes(QMenu* menu);
  Document& m_document;
  Viewport* m_view;
  WindowLayout& m_layout;
  const Actions& m_actions;
};

}  // namespace ps
