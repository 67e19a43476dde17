// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtGui/QColor>
#include <QtWidgets/QWidget>

#include <string>
#include <vector>

namespace ps {

class Document;

/// Materials of the scene as a grid of painted balls; a click makes one the brush's matter and shows its values.
class MaterialsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit MaterialsPanel(Document& document, QWidget* parent = nullptr);
  void rebuild();
  void setCurrent(const std::string& id);
  const std::string& current() const { return m_current; }
  QString currentLabel() const;  ///< "" when there is none
  QSize sizeHint() const override { return {204, 140}; }
  QSize minimumSizeHint() const override { return {120, 90}; }

 Q_SIGNALS:
  void picked(const std::string& id);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  struct Tile {
    std::string id;
    QString label;
    QColor colour;
    bool missing = false;
  };
  QRect tileRect(size_t index) const;
  int columns() const;
  int tileAt(const QPoint& at) const;
  void pick(size_t index);

  Document& m_document;
  std::vector<Tile> m_tiles;
  std::string m_current;
  int m_hover = -1;
};

}  // namespace ps
