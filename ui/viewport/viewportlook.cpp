// SPDX-License-Identifier: Apache-2.0
// What the renderer is told of the picture: colours, the line around the selected body, the ghost of another run.
#include "ui/document/document.h"
#include "ui/film/hiddenbodies.h"
#include "ui/session/carriedmaterial.h"
#include "ui/session/recordedview.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/transitions.h"
#include "ui/theme/theme.h"
#include "ui/tools/guides.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/viewport.h"

#include <algorithm>

namespace ps {
namespace {

constexpr double kIceMelts = 273.15;  // K: the pivot of the map where nothing in the scene melts

std::array<float, 3> channels(const QColor& colour) { return {colour.redF(), colour.greenF(), colour.blueF()}; }

}  // namespace

double Viewport::meltingPoint() const { return m_session.transitions().meltsOr(kIceMelts); }

void Viewport::ghostChanged() {
  m_ghost = withoutBodies(m_session.recorded().ghost(), m_hidden);
  requestPaint();
}

Look Viewport::look() {
  Look look;
  look.colour = m_colour;
  if (const FieldPtr field = m_session.fields().find(m_colour); field && m_now) {
    const auto measured = colourRange(*m_now, m_colour);
    m_range = measured.first < measured.second ? m_legendRange.update(*field, measured) : measured;
  }
  look.rangeMinimum = m_range.first;
  look.rangeMaximum = m_range.second;
  look.dark = m_studio == Studio::AsTheme ? Theme::current().dark() : m_studio == Studio::Dark;
  look.meltingPoint = meltingPoint();
  look.outline = outline();
  look.section = section();
  if (m_ghost)
    look.ghost = Ghost{m_ghost, channels(Theme::current()[Token::Curve]), channels(Theme::current()[Token::Field]),
                       1.5f * static_cast<float>(devicePixelRatioF())};
  if (m_overlays.guides && m_tools.tool().usesBrush())
    look.guides = guideLines(m_tools.brush(), m_document.project().environment);
  return look;
}

std::optional<std::pair<double, double>> Viewport::ownLegendRange() const {
  return m_legendRange.isSet() ? std::optional(m_legendRange.range()) : std::nullopt;
}

void Viewport::setLegendRange(const std::pair<double, double>& range) {
  const FieldPtr field = m_session.fields().find(m_colour);
  if (!field) return;
  m_legendRange.set(*field, range);
  update();
}

void Viewport::setOverlays(const OverlayChoice& overlays) {
  m_overlays = overlays;
  update();
}

void Viewport::setCovered(int top) {
  if (top == m_covered) return;
  m_covered = top;
  update();
}

void Viewport::setStudio(Studio studio) {
  m_studio = studio;
  update();
}

Look Viewport::shownLook() const {
  Look look = m_shown ? m_shown->look : Look{};
  look.outline.reset();
  look.ghost.reset();
  look.guides.clear();
  return look;
}

/// Around the selected bodies, or those that take a material that is about to be dropped; two logical pixels wide.
std::optional<BodyOutline> Viewport::outline() const {
  if (!m_now || !m_now->bodyIds || (!m_overlays.outlines && m_dropTarget.empty())) return std::nullopt;
  BodyOutline outline;
  const std::vector<std::string> takers = takersOf(m_document, m_selection, m_dropTarget);
  const auto takes = [&](const std::string& id) { return std::find(takers.begin(), takers.end(), id) != takers.end(); };
  for (uint32_t k = 0; k < m_now->bodyIds->size(); ++k) {
    const std::string& id = (*m_now->bodyIds)[k];
    if (m_dropTarget.empty() ? m_selection.has(OutlineKind::Body, id) : takes(id)) outline.bodies.push_back(k);
  }
  if (outline.bodies.empty()) return std::nullopt;
  outline.colour = channels(Theme::current()[Token::Accent]);
  outline.halo = channels(Theme::current()[Token::Shadow]);
  outline.lineWidth *= static_cast<float>(devicePixelRatioF());
  outline.haloWidth *= static_cast<float>(devicePixelRatioF());
  return outline;
}

}  // namespace ps
