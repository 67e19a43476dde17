// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "ui/document/changeevent.h"

#include <QtWidgets/QWidget>

#include <optional>
#include <vector>

class QMenu;

namespace ps {

class KeyRows;
class Session;

/// The document's markers over the scene's time, on the scale of the keys below them: each is shown by a click, dragged
/// to another frame (Shift: to any time), named by F2 or a double-click, taken away by Delete; a double-click beside
/// them sets one. Each gesture is one undo step.
class MarkerRow : public QWidget {
  Q_OBJECT
 public:
  static constexpr int kHeight = 24;  ///< logical pixels

  MarkerRow(Session& session, const KeyRows& scale, QWidget* parent = nullptr);
  std::optional<size_t> chosen() const { return m_chosen; }  ///< its place in the project's list
  QPoint placeOf(size_t marker) const;                       ///< of its flag
  void fillMenu(QMenu& menu, size_t marker);
  void editName(size_t marker);

 Q_SIGNALS:
  void wanted(bool any);  ///< whether there is one

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  void onChanged(const ChangeEvent& event);
  void followChosen();
  std::optional<size_t> markerAt(const QPoint& at) const;
  QRectF flagOf(size_t marker) const;
  double snapped(double seconds, bool free) const;
  void endDrag(bool keep);
  void removeChosen();

  Session& m_session;
  const KeyRows& m_scale;
  std::optional<size_t> m_chosen;
  std::vector<Marker> m_known;  ///< those of which m_chosen is true
  struct Drag {
    double grip = 0, from = 0;  ///< s: from the marker to where it was taken, and where it was
    bool moved = false;
  };
  std::optional<Drag> m_drag;
};

}  // namespace ps
