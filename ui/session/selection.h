// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"
#include "ui/document/port.h"

#include <QtCore/QObject>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class Document;

/// What can be selected: rows of the outliner. A pin's id is a PinAddress.
enum class OutlineKind { Scene, Group, Body, Emitter, Sink, Wall, Probes, Probe, Environment, Pin };

/// One thing that is selected.
struct SelectedItem {
  OutlineKind kind = OutlineKind::Scene;
  std::string id;
  bool operator==(const SelectedItem&) const = default;
};

/// The body, emitter, sink, wall or probe that it is, of a pin its body, as an address without a key; nothing for
/// others.
std::optional<Address> thingOf(const SelectedItem& item);

/// What is selected and which material is the current one, of one editor. Tools and panels set it, all of them follow.
/// What leaves the document leaves the selection, and comes back with it as long as nothing else has been selected.
class Selection : public QObject {
  Q_OBJECT
 public:
  explicit Selection(Document& document, QObject* parent = nullptr);

  /// All that is, in the order in which it was selected.
  const std::vector<SelectedItem>& items() const { return m_items; }
  bool empty() const { return m_items.empty(); }
  bool has(OutlineKind kind, const std::string& id) const;
  std::vector<std::string> bodies() const;  ///< Body::id of those among them

  // The one selected last, which panels show.
  OutlineKind kind() const { return empty() ? OutlineKind::Scene : m_items.back().kind; }
  std::string id() const { return empty() ? std::string() : m_items.back().id; }
  std::string body() const;  ///< "" when something else is, or nothing
  std::optional<Port> port() const;

  /// That alone. Selecting a body makes its material the current one.
  void select(OutlineKind kind, const std::string& id);
  /// Adds something to what is selected, as the last, or takes it out.
  void toggle(OutlineKind kind, const std::string& id);
  void selectAll(std::vector<SelectedItem> items);
  /// What was selected when the project was open last, as far as it is still there; "": the material stays.
  void restore(const std::vector<SelectedItem>& items, const std::string& material);
  void select(const Port& port) { select(port.sink ? OutlineKind::Sink : OutlineKind::Emitter, port.id); }
  void selectBody(const std::string& id);  ///< "": nothing
  void clear();

  /// The particle that was clicked: revision of the scene and id. Another selection forgets it.
  const std::optional<std::pair<uint64_t, uint32_t>>& marked() const { return m_marked; }
  void mark(uint64_t revision, uint32_t particle);

  /// SceneMaterial::id of the current one; "" in a scene without any.
  std::string material() const { return m_materials.empty() ? std::string() : m_materials.back(); }
  void setMaterial(const std::string& id);  ///< that alone
  /// Those whose values are edited together, the current one last.
  const std::vector<std::string>& materials() const { return m_materials; }
  /// One more of them, as the current one; or one less, but for the last.
  void toggleMaterial(const std::string& id);
  /// Somebody chose it, and wants to see its values.
  void pickMaterial(const std::string& id);

 Q_SIGNALS:
  void changed();  ///< also where the same thing is selected once more
  void materialChanged();
  void materialPicked();

 private:
  void onChanged(const ChangeEvent& event);
  bool isThere(const SelectedItem& item) const;
  bool hasMaterial(const std::string& id) const;
  std::string latestMaterial() const;
  Document& m_document;
  std::vector<SelectedItem> m_items, m_gone;  ///< selected, and what was until it left the document
  std::vector<std::string> m_materials;
  std::vector<std::string> m_formerMaterials;  ///< chosen before, the latest last
  std::optional<std::pair<uint64_t, uint32_t>> m_marked;
};

}  // namespace ps
