// SPDX-License-Identifier: Apache-2.0
#include "ui/window/pinactions.h"

#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/pinaddress.h"
#include "ui/session/pinexcerpt.h"
#include "ui/session/selection.h"
#include "ui/window/notices.h"

#include <algorithm>
#include <utility>

namespace ps {

bool PinActions::alone() const {
  const auto& items = m_selection.items();
  return !items.empty() &&
         std::all_of(items.begin(), items.end(), [](const SelectedItem& i) { return i.kind == OutlineKind::Pin; });
}

/// The body that is selected last, or that of the pin that is.
const Body* PinActions::target() const {
  const auto pin = m_selection.kind() == OutlineKind::Pin ? PinAddress::parse(m_selection.id()) : std::nullopt;
  return m_document.body(pin ? pin->body : m_selection.body());
}

void PinActions::add() {
  const Body* body = target();
  const double spacing = numberOf(m_document.project().solver.parameters, solverParameters(), "particle_spacing");
  put(body ? std::vector{firstPin(*body, spacing)} : std::vector<Region>{}, QStringLiteral("pin of %1"));
}

std::string PinActions::copied() const { return textOfPins(pinsOf(m_document.project(), m_selection.items())); }

bool PinActions::paste(const std::string& text) {
  const auto pins = pinsIn(text);
  if (pins) put(*pins, QStringLiteral("pasting a pin of %1"));
  return pins.has_value();
}

void PinActions::duplicate() {
  put(pinsOf(m_document.project(), m_selection.items()), QStringLiteral("copy of a pin of %1"));
}

/// On the body, and selected.
void PinActions::put(const std::vector<Region>& pins, const QString& title) {
  const Body* body = target();
  QString problem;
  if (!body)
    problem = QStringLiteral("Select the body that it is to hold first.");
  else if (body->locked)
    problem = QStringLiteral("“%1” is locked. Unlock it first.").arg(nameOf(*body));
  else if (toggleOf(body->parameters, bodyParameters(), "fixed"))
    problem = QStringLiteral("“%1” is held in place as a whole.").arg(nameOf(*body));
  m_notices.refuse(QStringLiteral("No pin was added."), problem);
  if (!problem.isEmpty()) return;
  Placement after;
  after.pins.push_back(withPins(*body, pins));
  std::vector<SelectedItem> added;
  for (size_t k = body->pins.size(); k < after.pins[0].boxes.size(); ++k)
    added.push_back({OutlineKind::Pin, PinAddress{body->id, k}.text()});
  m_document.place(std::move(after), title.arg(nameOf(*body)));
  m_selection.selectAll(std::move(added));
}

QString PinActions::name() const {
  std::vector<std::string> bodies;
  for (const SelectedItem& item : m_selection.items()) {
    if (item.kind == OutlineKind::Pin) bodies.push_back(PinAddress::parse(item.id)->body);
  }
  const Body* body = bodies.size() == 1 ? m_document.body(bodies[0]) : nullptr;
  return body ? QStringLiteral("a pin of %1").arg(nameOf(*body)) : QStringLiteral("%1 pins").arg(bodies.size());
}

void PinActions::selectTheirBodies() {
  std::vector<SelectedItem> left;
  for (SelectedItem item : m_selection.items()) {
    if (item.kind == OutlineKind::Pin) item = {OutlineKind::Body, PinAddress::parse(item.id)->body};
    if (std::find(left.begin(), left.end(), item) == left.end()) left.push_back(std::move(item));
  }
  m_selection.selectAll(std::move(left));
}

}  // namespace ps
