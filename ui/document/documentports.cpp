// SPDX-License-Identifier: Apache-2.0
// Emitters and sinks of a document: they come, go, move and are renamed.
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/leaving.h"
#include "ui/document/portbounds.h"

#include <algorithm>
#include <type_traits>

namespace ps {
namespace {

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

template <class Items>
auto at(Items& items, const std::string& id) {
  return std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.id == id; });
}

template <class Item>
const Item* itemOf(const std::vector<Item>& items, const std::string& id) {
  const auto found = at(items, id);
  return found == items.end() ? nullptr : &*found;
}

std::vector<Emitter>& itemsOf(Project& project, const Emitter&) { return project.emitters; }
std::vector<Sink>& itemsOf(Project& project, const Sink&) { return project.sinks; }

/// "Tap 2" of "tap-2".
std::string nameFromId(const std::string& id) {
  QString name = text(id).replace(QLatin1Char('-'), QLatin1Char(' '));
  name[0] = name[0].toUpper();
  return name.toStdString();
}

/// The nearest place within the bounds.
Vector3 within(const Environment& environment, const Vector3& p) {
  return p.cwiseMax(environment.boundsMinimum).cwiseMin(environment.boundsMaximum);
}

}  // namespace

void keepWithin(const Environment& environment, Emitter& emitter) {
  emitter.point = within(environment, emitter.point);
}
void keepWithin(const Environment& environment, Sink& sink) {
  const Vector3 centre = 0.5 * (sink.minimum + sink.maximum), way = within(environment, centre) - centre;
  sink.minimum += way, sink.maximum += way;
}

const Emitter* Document::emitter(const std::string& id) const { return itemOf(m_project.emitters, id); }
const Sink* Document::sink(const std::string& id) const { return itemOf(m_project.sinks, id); }

QString Document::portName(const Port& port) const {
  if (port.sink) return sink(port.id) ? nameOf(*sink(port.id)) : QString();
  return emitter(port.id) ? nameOf(*emitter(port.id)) : QString();
}

template <class Item>
void Document::pushPort(std::optional<Item> before, std::optional<Item> after, size_t index, const QString& title) {
  if (m_gestureDepth == 0) ++m_gesture;
  MatterRef matter = (!before || !after) && std::is_same_v<Item, Emitter> ? newMatter() : nullptr;
  m_undo.push(new PortCommand(*this, PortEdit<Item>{std::move(before), std::move(after), index, std::move(matter)},
                              m_gesture, title));
}

Port Document::addEmitter(Emitter emitter) {
  emitter.id = freeBodyId(emitter.id.empty() ? "tap" : emitter.id);
  if (emitter.name.empty()) emitter.name = nameFromId(emitter.id);
  keepWithin(m_project.environment, emitter);
  const Port port{false, emitter.id};
  const QString title = QStringLiteral("placing %1").arg(nameOf(emitter));
  pushPort<Emitter>({}, std::move(emitter), m_project.emitters.size(), title);
  return port;
}

Port Document::addSink(Sink sink) {
  const std::string stem = sink.id.empty() ? "drain" : sink.id;
  sink.id = stem;
  for (int n = 2; this->sink(sink.id); ++n) sink.id = stem + "-" + std::to_string(n);
  if (sink.name.empty()) sink.name = nameFromId(sink.id);
  keepWithin(m_project.environment, sink);
  const Port port{true, sink.id};
  const QString title = QStringLiteral("placing %1").arg(nameOf(sink));
  pushPort<Sink>({}, std::move(sink), m_project.sinks.size(), title);
  return port;
}

void Document::editEmitter(Emitter after, const QString& title) {
  const Emitter* before = emitter(after.id);
  if (!before) return;
  keepWithin(m_project.environment, after);
  pushPort<Emitter>(*before, std::move(after), 0, title);
}

void Document::editSink(Sink after, const QString& title) {
  const Sink* before = sink(after.id);
  if (!before) return;
  keepWithin(m_project.environment, after);
  pushPort<Sink>(*before, std::move(after), 0, title);
}

void Document::renamePort(const Port& port, const QString& name) {
  const QString old = portName(port), wanted = name.trimmed();
  if (old.isEmpty() || wanted.isEmpty() || wanted == old) return;
  const QString title = QStringLiteral("rename of %1").arg(old);
  if (port.sink) {
    Sink after = *sink(port.id);
    after.name = wanted.toStdString();
    editSink(std::move(after), title);
  } else {
    Emitter after = *emitter(port.id);
    after.name = wanted.toStdString();
    editEmitter(std::move(after), title);
  }
}

void Document::removePort(const Port& port) {
  const QString title = QStringLiteral("deletion of %1").arg(portName(port));
  const auto remove = [&](const auto& items, Owner owner) {
    const auto old = at(items, port.id);
    if (old == items.end()) return;
    takeOut(*this, {owner, port.id, ""}, title, [&] {
      pushPort(std::optional(*old), decltype(std::optional(*old)){}, static_cast<size_t>(old - items.begin()), title);
    });
  };
  if (port.sink)
    remove(m_project.sinks, Owner::Sink);
  else
    remove(m_project.emitters, Owner::Emitter);
}

void Document::applyPort(const AnyPortEdit& edit, bool forward) {
  PortChanged change;
  std::visit(
      [&](const auto& known) {
        const auto& [before, after, index, matter] = known;
        const auto& from = forward ? before : after;
        const auto& to = forward ? after : before;
        change.id = (from ? from : to)->id;
        if (!from || !to) change.matter = matter;
        auto& items = itemsOf(m_project, *(from ? from : to));
        if (from && to) {
          change.moved = from->name == to->name;
          *at(items, from->id) = *to;
        } else if (to) {
          items.insert(items.begin() + static_cast<std::ptrdiff_t>(index), *to);
        } else {
          items.erase(at(items, from->id));
        }
      },
      edit);
  ++m_changes;
  notify(change);
}

}  // namespace ps
