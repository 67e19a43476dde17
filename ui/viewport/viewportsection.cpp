// SPDX-License-Identifier: Apache-2.0
// The section through the scene: where it begins, how it moves, what its strip says.
#include "ui/document/document.h"
#include "ui/render/framing.h"
#include "ui/tools/brushsettings.h"
#include "ui/viewport/viewport.h"

#include <algorithm>
#include <limits>

namespace ps {

std::optional<Section> Viewport::section() const {
  if (!m_section) return std::nullopt;
  return sectionFor(*m_section, frameOf(m_navigator.camera()).forward);
}

void Viewport::setSection(const std::optional<ViewSection>& section) {
  if (m_section == section) return;
  m_section = section;
  storeView();
  requestPaint();
  announce();
  Q_EMIT sectionChanged();
}

/// m: of what is selected, or else of the matter that is in the picture; what one looks at where there is none.
Vector3 Viewport::middleInView() const {
  const Camera& camera = m_navigator.camera();
  if (const auto box = boxOfSelection()) return (box->first + box->second) / 2;
  const Eye eye = eyeOf(camera, width(), height());
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (size_t i = 0; m_now && i < m_now->position.size(); ++i) {
    const Vector3 place = vectorOf(m_now->position[i]);
    const auto at = project(eye, width(), height(), place);
    if (!at || at->x() < 0 || at->y() < 0 || at->x() > width() || at->y() > height()) continue;
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return (low.array() <= high.array()).all() ? Vector3((low + high) / 2) : camera.target;
}

const Box& Viewport::boxOfAll() const {
  static const Snapshot kEmpty;
  if (!m_box) m_box = boxOf(m_now ? *m_now : kEmpty, m_scene.environment);
  return *m_box;
}

/// m along `side`, of all there is to see: from where everything is cut away to where nothing is.
std::pair<double, double> Viewport::reachOfSection(const Vector3& side) const {
  const Box& box = boxOfAll();
  const Vector3 half = (box.second - box.first) / 2;
  const double middle = side.dot(box.first + half), reach = side.cwiseAbs().dot(half);
  return {middle - reach, middle + reach};
}

void Viewport::cutAcross(const std::string& across) {
  m_navigator.setSize(size());
  ViewSection section{across, m_section ? m_section->through : middleInView(), false};
  const Vector3 forward = frameOf(m_navigator.camera()).forward;
  section.flipped = openSide(section, forward).dot(forward) > 0;
  setSection(section);
}

void Viewport::flipSection() {
  auto section = m_section;
  if (!section) return;
  section->flipped = !section->flipped;
  setSection(section);
}

/// m, along the side that is cut away.
void Viewport::cutAt(double height) {
  auto section = m_section;
  if (!section) return;
  const Vector3 side = openSide(*section, frameOf(m_navigator.camera()).forward);
  const auto [low, high] = reachOfSection(side);
  section->through += (std::clamp(height, low, high) - side.dot(section->through)) * side;
  setSection(section);
}

void Viewport::moveSection(int steps) {
  const auto cut = section();
  if (!cut) return;
  const auto [low, high] = reachOfSection(-cut->plane.normal);
  const double step = m_now && m_now->spacing > 0 ? m_now->spacing : (high - low) / 100;
  cutAt(-cut->plane.offset - steps * step);
}

bool Viewport::endSection() {
  const bool shown = m_section.has_value();
  setSection(std::nullopt);
  return shown;
}

std::optional<SectionNote> Viewport::sectionNote() const {
  if (!m_section) return std::nullopt;
  const Vector3 side = openSide(*m_section, frameOf(m_navigator.camera()).forward);
  const auto [low, high] = reachOfSection(side);
  const double deep = high - side.dot(m_section->through);
  SectionNote note{
      m_section->across, m_section->flipped, high > low ? std::clamp(deep / (high - low), 0.0, 1.0) : 0, {}};
  const size_t axis = std::string("xyz").find(m_section->across);
  note.place = axis == std::string::npos ? QStringLiteral("%1 deep").arg(lengthText(deep))
                                         : lengthText(m_section->through[static_cast<Eigen::Index>(axis)]);
  return note;
}

bool Viewport::clickSection(const QPointF& position) {
  const SectionHits& hits = m_hits.section;
  if (!hits.strip.contains(position)) return false;
  if (hits.slider.contains(position)) {
    m_sectionBefore = m_section;
    m_drag = Drag::Section;
    dragSection(position);
  } else if (hits.flip.contains(position)) {
    flipSection();
  } else if (hits.end.contains(position)) {
    endSection();
  }
  const auto way =
      std::find_if(hits.ways.begin(), hits.ways.end(), [&](const auto& one) { return one.second.contains(position); });
  if (way != hits.ways.end()) cutAcross(way->first);
  return true;
}

void Viewport::dragSection(const QPointF& position) {
  const auto cut = section();
  const QRectF& slider = m_hits.section.slider;
  if (!cut || slider.isEmpty()) return;
  const auto [low, high] = reachOfSection(-cut->plane.normal);
  cutAt(high - (position.x() - slider.left()) / slider.width() * (high - low));
}

}  // namespace ps
