// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/viewport/viewport.h"

#include <QtWidgets/QWidget>

class QButtonGroup;
class QComboBox;
class QLabel;
class QToolButton;

namespace ps {

class NoticeBar;

/// The middle of the window: tool bar, notices, the viewport. Where no OpenGL can be had at all, a sentence stands in
/// the viewport's place and everything else works.
class ViewportPane : public QWidget {
  Q_OBJECT
 public:
  explicit ViewportPane(QWidget* parent = nullptr);
  Viewport* viewport() const { return m_viewport; }  ///< nullptr without OpenGL
  NoticeBar* notice() const { return m_notice; }
  void setColour(ColourBy colour);
  void setTool(ViewTool tool);
  void setBrush(const BrushSettings& brush);

 Q_SIGNALS:
  void colourPicked(ps::ColourBy colour);
  void toolPicked(ps::ViewTool tool);
  void shapePicked(const std::string& shape);
  void radiusStepped(int direction);
  void frameRequested();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QWidget* makeBar();
  Viewport* m_viewport = nullptr;
  NoticeBar* m_notice;
  QButtonGroup *m_tools, *m_shapes;
  QWidget* m_brushBar;
  QLabel* m_radius;
  QComboBox* m_colour;
};

}  // namespace ps
