// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/film/swatch.h"
#include "ui/session/carriedmaterial.h"

#include <QtWidgets/QWidget>

#include <string>
#include <vector>

class QPainter;

namespace ps {

/// Digits that take the scene's first materials in Sketch: 1 to 9 and 0.
inline constexpr int kMaterialKeys = 10;

class Document;
class Selection;
class Session;
class Swatches;

/// Materials of the scene as a grid of swatches; a click makes one the brush's matter and shows its values, Shift+click
/// or Ctrl+click one more, so that they are edited together. Below
/// them those that are installed besides; a click brings one into the scene. All are dragged to where a material is
/// wanted.
class MaterialsPanel : public QWidget {
  Q_OBJECT
 public:
  MaterialsPanel(Session& session, Selection& selection, QWidget* parent = nullptr);
  void rebuild();
  QString currentLabel() const;  ///< "" when there is none
  /// Brings an installed material into the scene and makes it the current one.
  void addInstalled(const std::string& base);
  /// Of a scene's material by its id, or of one that can be added by its base; empty when there is none.
  QRect tileOf(const std::string& id) const;
  /// Arrows and Enter are its own: it got the focus by keys. After a click on it the commands of Edit are for
  /// materials, and single keys stay the view's, where one draws with what was clicked.
  bool walks() const { return m_walks; }
  QSize sizeHint() const override { return {204, 140}; }
  QSize minimumSizeHint() const override { return {120, 90}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;

 Q_SIGNALS:
  /// The keyboard has moved to it, it became the current one, or it has joined the scene.
  void revealed(const QRect& tile);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void showCurrent();
  void revealJoined(const std::vector<std::string>& before);
  void revealSoon(const std::string& id);
  std::vector<std::string> ownIds() const;
  void showLook(const std::string& material);
  struct Tile {
    std::string id;  ///< of one that can be added: its base
    QString label;
    Swatch swatch;
    bool missing = false;
    bool installed = false;  ///< can be added
  };
  QRect tileRect(size_t index) const { return tileRect(index, width()); }
  QRect tileRect(size_t index, int width) const;
  QRect headingRect(int width) const;
  int columns() const;
  int tileAt(const QPoint& at) const;
  void paintTile(QPainter& painter, size_t index) const;
  void pick(size_t index, Qt::KeyboardModifiers keys = {});
  bool isChosen(const std::string& id) const;
  void drag(const Tile& tile);
  void moveTo(int index);

  Document& m_document;
  Swatches& m_swatches;
  Selection& m_selection;
  std::vector<Tile> m_tiles;
  size_t m_own = 0;                 ///< tiles of the scene; the rest can be added
  int m_hover = -1, m_cursor = -1;  ///< m_cursor: where the keyboard is among what can be added
  int m_held = -1;                  ///< tile under the pressed button, to be picked where it goes up
  QPoint m_pressed;
  bool m_walks = true;
};

}  // namespace ps
