// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"

#include <QtCore/QPointF>
#include <QtCore/QSizeF>
#include <QtCore/QString>

#include <utility>

namespace ps {

enum class StandardView { Front = 1, Right, Top, Back, Left, Bottom, Orthographic, Scene, Last };

/// The camera of a viewport and what mouse and keys do to it. Pure: no widget, no context. Lengths in logical pixels of
/// a picture of `size`.
class ViewNavigator {
 public:
  const Camera& camera() const { return m_camera; }
  bool orthographic() const { return m_orthographic; }
  QString viewName() const;  ///< "Perspective", "Top", "Orthographic"

  void setSize(const QSizeF& size) { m_size = size; }
  void setScene(const Camera& camera);  ///< becomes the scene's view, and is taken
  void restore(const Camera& camera);   ///< takes back a drag
  ViewState view() const;               ///< as the project keeps it

  void orbitBy(const QPointF& pixels);
  void panBy(const QPointF& pixels);
  void zoomAt(const QPointF& position, double notches);  ///< wheel: one notch is 12 %
  void dollyBy(double pixels);                           ///< right-drag: down is nearer
  void frame(const std::pair<Vector3, Vector3>& box);
  void show(StandardView view);
  void look(double azimuth, double elevation);

 private:
  void remember();
  void setOrthographic(bool on);
  int width() const { return std::max(1, static_cast<int>(m_size.width())); }
  int height() const { return std::max(1, static_cast<int>(m_size.height())); }

  Camera m_camera, m_sceneCamera, m_lastCamera;
  QSizeF m_size{1, 1};
  bool m_orthographic = false;
  QString m_name;
};

}  // namespace ps
