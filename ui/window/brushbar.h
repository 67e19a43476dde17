// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

#include <array>
#include <string>

class QAbstractButton;
class QButtonGroup;
class QGridLayout;

namespace ps {

class Selection;
class Session;
class Toolbox;
class Viewport;

/// Of the workspace Sketch: a button for each brush that is installed, in two columns, those that draw first, then what
/// changes what is there, then what touches it, then the scene's materials. Brushes scroll where the window is not high
/// enough; materials stay in sight.
class BrushBar : public QWidget {
  Q_OBJECT
 public:
  /// `view` takes the keys after a click; nullptr without OpenGL.
  BrushBar(Session& session, Selection& selection, Toolbox& tools, Viewport* view, QWidget* parent = nullptr);

  static constexpr int kWidth = 98, kButton = 40;  ///< px

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Group {
    QWidget* box = nullptr;
    QGridLayout* grid = nullptr;
  };
  Group addGroup(const QString& title, QWidget* into);
  void place(const Group& group, QAbstractButton* button);
  void addCommon();   ///< eraser and mirror
  void addBrushes();  ///< once plugins are there
  void addMaterials();
  void showBrush();
  void showMaterial();
  void clicked(const QAbstractButton* button);

  Session& m_session;
  Selection& m_selection;
  Toolbox& m_tools;
  Viewport* m_view;
  QWidget* m_list;
  Group m_draw, m_change, m_touch, m_materials;
  QButtonGroup *m_shapes, *m_matter;
  QAbstractButton *m_erase = nullptr, *m_mirror = nullptr, *m_more = nullptr;
};

}  // namespace ps
