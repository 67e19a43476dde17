// SPDX-License-Identifier: Apache-2.0
// What is hidden and locked of a document's things.
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"

#include <algorithm>
#include <utility>

namespace ps {
namespace {

/// use(thing) for the one of that address. False: there is none.
template <class Scene, class Use>
bool withThing(Scene& project, const Address& thing, const Use& use) {
  const auto among = [&](auto& items) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.id == thing.id; });
    if (found == items.end()) return false;
    use(*found);
    return true;
  };
  switch (thing.owner) {
    case Owner::Body:
      return among(project.bodies);
    case Owner::Emitter:
      return among(project.emitters);
    case Owner::Sink:
      return among(project.sinks);
    case Owner::Wall:
      return among(project.environment.walls);
    case Owner::Probe:
      return among(project.probes);
    default:
      return false;
  }
}

std::vector<Address> bodiesOf(const std::vector<std::string>& ids) {
  std::vector<Address> things;
  for (const std::string& id : ids) things.push_back({Owner::Body, id, ""});
  return things;
}

/// "Ice block", "3 bodies", "2 things".
QString whatOf(const Project& project, const std::vector<ThingMarks>& marks) {
  if (marks.size() == 1) return ownerLabel(project, marks[0].thing);
  const bool bodies =
      std::all_of(marks.begin(), marks.end(), [](const ThingMarks& one) { return one.thing.owner == Owner::Body; });
  return QStringLiteral("%1 %2").arg(marks.size()).arg(bodies ? QStringLiteral("bodies") : QStringLiteral("things"));
}

}  // namespace

std::optional<ThingMarks> Document::marks(const Address& thing) const {
  ThingMarks marks{{thing.owner, thing.id, ""}};
  const bool there = withThing(m_project, thing, [&](const auto& item) {
    marks.visible = item.visible;
    marks.locked = item.locked;
  });
  return there ? std::optional(marks) : std::nullopt;
}

void Document::setMarks(const std::vector<Address>& things, const QString& title,
                        const std::function<void(ThingMarks&)>& change) {
  std::vector<ThingMarks> before, after;
  for (const Address& thing : things) {
    const std::optional<ThingMarks> now = marks(thing);
    if (!now) continue;
    ThingMarks wanted = *now;
    change(wanted);
    if (wanted == *now) continue;
    before.push_back(*now);
    after.push_back(std::move(wanted));
  }
  if (after.empty()) return;
  const QString text = title.arg(whatOf(m_project, after));
  m_undo.push(new MarksCommand(*this, std::move(before), std::move(after), text));
}

void Document::setVisible(const std::vector<Address>& things, bool visible) {
  setMarks(things, visible ? QStringLiteral("showing %1") : QStringLiteral("hiding %1"),
           [visible](ThingMarks& marks) { marks.visible = visible; });
}

void Document::setLocked(const std::vector<Address>& things, bool locked) {
  setMarks(things, locked ? QStringLiteral("locking %1") : QStringLiteral("unlocking %1"),
           [locked](ThingMarks& marks) { marks.locked = locked; });
}

void Document::setBodiesVisible(const std::vector<std::string>& ids, bool visible) {
  setVisible(bodiesOf(ids), visible);
}

void Document::applyMarks(const std::vector<ThingMarks>& marks) {
  bool walls = false;
  for (const ThingMarks& one : marks) {
    withThing(m_project, one.thing, [&](auto& item) {
      item.visible = one.visible;
      item.locked = one.locked;
    });
  }
  ++m_changes;
  for (const ThingMarks& one : marks) {
    walls = walls || one.thing.owner == Owner::Wall;
    if (one.thing.owner == Owner::Body) notify(BodyChanged{one.thing.id});
    if (one.thing.owner == Owner::Probe) notify(ProbesChanged{one.thing.id});
    if (one.thing.owner == Owner::Emitter || one.thing.owner == Owner::Sink)
      notify(PortChanged{false, one.thing.id, {}});
  }
  if (walls) notify(WallsChanged{});
}

}  // namespace ps
