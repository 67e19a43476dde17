// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/viewnavigator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// An orthographic picture is taken with a very long lens from very far: rays deviate by under two degrees, and every
// function of the camera works unchanged.
namespace ps {
namespace {

constexpr double kPerspectiveField = 35, kLongField = 3.5;  // degrees
constexpr double kDegreesPerPixel = 0.4;
constexpr double kNotch = 1.12;

double halfTangent(double degrees) { return std::tan(degrees * std::numbers::pi / 360); }
/// Distance ratio that keeps the size of things at the target.
const double kLongDistance = halfTangent(kPerspectiveField) / halfTangent(kLongField);

}  // namespace

QString ViewNavigator::viewName() const {
  const QString lens = m_orthographic ? QStringLiteral("Orthographic") : QStringLiteral("Perspective");
  return m_name.isEmpty() ? lens : m_name + QStringLiteral(" · ") + lens.toLower();
}

void ViewNavigator::setScene(const Camera& camera) {
  m_orthographic = false;
  m_name.clear();
  m_camera = camera;
  m_camera.fieldOfView = kPerspectiveField;
  m_sceneCamera = m_lastCamera = m_camera;
}

void ViewNavigator::restore(const Camera& camera) {
  m_camera = camera;
  m_orthographic = camera.fieldOfView < 0.5 * kPerspectiveField;
}

ViewState ViewNavigator::view() const {
  ViewState view;
  view.camera = ViewCamera{m_camera.target, m_orthographic ? m_camera.distance / kLongDistance : m_camera.distance,
                           m_camera.azimuth, m_camera.elevation};
  return view;
}

void ViewNavigator::orbitBy(const QPointF& pixels) {
  m_name.clear();
  orbit(m_camera, -pixels.x() * kDegreesPerPixel, pixels.y() * kDegreesPerPixel);
}

void ViewNavigator::panBy(const QPointF& pixels) { pan(m_camera, height(), pixels.x(), pixels.y()); }

void ViewNavigator::zoomAt(const QPointF& position, double notches) {
  dollyTo(m_camera, width(), height(), position.x(), position.y(), std::pow(kNotch, -notches));
}

void ViewNavigator::dollyBy(double pixels) {
  dollyTo(m_camera, width(), height(), width() / 2.0, height() / 2.0, std::pow(1.006, -pixels));
}

void ViewNavigator::frame(const std::pair<Vector3, Vector3>& box) {
  remember();
  frameAll(m_camera, width(), height(), box.first, box.second);
}

void ViewNavigator::look(double azimuth, double elevation) {
  remember();
  m_name.clear();
  m_camera.azimuth = azimuth;
  m_camera.elevation = elevation;
}

void ViewNavigator::remember() { m_lastCamera = m_camera; }

void ViewNavigator::setOrthographic(bool on) {
  if (on == m_orthographic) return;
  m_orthographic = on;
  m_camera.fieldOfView = on ? kLongField : kPerspectiveField;
  m_camera.distance *= on ? kLongDistance : 1 / kLongDistance;
}

void ViewNavigator::show(StandardView view) {
  struct Angles {
    const char* name;
    double azimuth, elevation;
  };
  static constexpr Angles kAngles[] = {{"Front", 0, 0},  {"Right", 90, 0}, {"Top", 0, 90},
                                       {"Back", 180, 0}, {"Left", -90, 0}, {"Bottom", 0, -90}};
  const int index = static_cast<int>(view) - 1;
  if (index < 6) {
    look(kAngles[index].azimuth, kAngles[index].elevation);
    m_name = QString::fromLatin1(kAngles[index].name);
  } else if (view == StandardView::Orthographic) {
    setOrthographic(!m_orthographic);
  } else if (view == StandardView::Scene) {
    setOrthographic(false);
    remember();
    m_camera = m_sceneCamera;
    m_name.clear();
  } else {
    const Camera before = m_camera;
    restore(m_lastCamera);
    m_lastCamera = before;
    m_name.clear();
  }
}

}  // namespace ps
