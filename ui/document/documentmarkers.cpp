// SPDX-License-Identifier: Apache-2.0
// Markers of a document: they come, move, are named and go; each edit is a command.
#include "ui/document/commands.h"
#include "ui/document/document.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// A clock that adds up frames is never quite on a round number.
double rounded(double time) { return std::max(0.0, std::round(time * 1e6) / 1e6); }

}  // namespace

size_t Document::addMarker(double time) {
  std::vector<Marker> markers = m_project.markers;
  const auto taken = [&](const std::string& name) {
    return std::any_of(markers.begin(), markers.end(), [&](const Marker& marker) { return marker.name == name; });
  };
  size_t number = markers.size() + 1;
  while (taken("Marker " + std::to_string(number))) ++number;
  markers.push_back({rounded(time), "Marker " + std::to_string(number)});
  setMarkers(std::move(markers), QStringLiteral("marker"));
  return m_project.markers.size() - 1;
}

void Document::editMarker(size_t place, double time, const QString& name) {
  if (place >= m_project.markers.size()) return;
  std::vector<Marker> markers = m_project.markers;
  markers[place].time = rounded(time);
  if (!name.trimmed().isEmpty()) markers[place].name = name.trimmed().toStdString();
  const QString title = QStringLiteral("change of %1").arg(QString::fromStdString(markers[place].name));
  setMarkers(std::move(markers), title);
}

void Document::removeMarker(size_t place) {
  if (place >= m_project.markers.size()) return;
  std::vector<Marker> markers = m_project.markers;
  const QString name = QString::fromStdString(markers[place].name);
  markers.erase(markers.begin() + static_cast<std::ptrdiff_t>(place));
  setMarkers(std::move(markers), QStringLiteral("removal of %1").arg(name));
}

void Document::setMarkers(std::vector<Marker> markers, const QString& title) {
  if (markers == m_project.markers && m_gestureDepth == 0) return;
  if (m_gestureDepth == 0) ++m_gesture;
  m_undo.push(new MarkersCommand(*this, m_project.markers, std::move(markers), m_gesture, title));
}

void Document::applyMarkers(const std::vector<Marker>& markers) {
  m_project.markers = markers;
  ++m_changes;
  notify(MarkersChanged{});
}

}  // namespace ps
