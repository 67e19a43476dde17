// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/viewport/viewport.h"

#include <QtWidgets/QWidget>

class QButtonGroup;
class QComboBox;
class QLabel;
class QMenu;
class QToolButton;

namespace ps {

class HandleActions;
class NoticeBar;

/// The middle of the window: tool bar, notices, the viewport. Where no OpenGL can be had at all, a sentence
/// stands in the viewport's place and everything else works. Buttons come from the table of tools.
class ViewportPane : public QWidget {
  Q_OBJECT
 public:
  ViewportPane(Session& session, Selection& selection, Toolbox& tools, QWidget* parent = nullptr);
  Viewport* viewport() const { return m_viewport; }  ///< nullptr without OpenGL
  NoticeBar* notice() const { return m_notice; }
  QWidget* toolBar() const { return m_bar; }
  /// Beside the tools, while one with handles is in hand.
  void showHandles(const HandleActions& handles);
  void showFavourites(QMenu* favourites);  ///< beside the brush
  void showLook(QMenu* look);              ///< beside the colours

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* makeBar();
  void makeBrushBar();
  void addColours();
  void showColour();
  void showTool();
  void showBrush();
  void share();
  void placeNotice();

  Session& m_session;
  Toolbox& m_tools;
  Viewport* m_viewport = nullptr;
  QWidget* m_bar = nullptr;
  NoticeBar* m_notice;
  QButtonGroup* m_buttons;
  QWidget *m_brushBar, *m_handleBar;
  QWidget* m_rareTools;  ///< those that there is not always room for
  QWidget* m_lookBar;    ///< likewise
  QLabel* m_radius;
  QLabel* m_sizeLabel;  ///< what it says: the radius, or a scale
  QLabel* m_colourLabel;
  QComboBox* m_colour;
};

}  // namespace ps
