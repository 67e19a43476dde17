// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"
#include "ui/document/port.h"

#include <QtCore/QObject>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace ps {

class Document;

/// What can be selected: rows of the outliner.
enum class OutlineKind { Scene, Body, Emitter, Sink, Wall, Probes, Probe, Environment };

/// What is selected and which material is the current one, of one editor. Tools and panels set it, all of them follow.
/// What leaves the document leaves the selection.
class Selection : public QObject {
  Q_OBJECT
 public:
  explicit Selection(Document& document, QObject* parent = nullptr);

  OutlineKind kind() const { return m_kind; }
  const std::string& id() const { return m_id; }
  bool empty() const { return !m_any; }
  std::string body() const;  ///< "" when something else is, or nothing
  std::optional<Port> port() const;
  /// Selecting a body makes its material the current one.
  void select(OutlineKind kind, const std::string& id);
  void select(const Port& port) { select(port.sink ? OutlineKind::Sink : OutlineKind::Emitter, port.id); }
  void selectBody(const std::string& id);  ///< "": nothing
  void clear();

  /// The particle that was clicked: revision of the scene and id. Another selection forgets it.
  const std::optional<std::pair<uint64_t, uint32_t>>& marked() const { return m_marked; }
  void mark(uint64_t revision, uint32_t particle);

  const std::string& material() const { return m_material; }  ///< SceneMaterial::id; "" in a scene without any
  void setMaterial(const std::string& id);
  /// Somebody chose it, and wants to see its values.
  void pickMaterial(const std::string& id);

 Q_SIGNALS:
  void changed();  ///< also where the same thing is selected once more
  void materialChanged();
  void materialPicked();

 private:
  void onChanged(const ChangeEvent& event);
  bool isThere() const;
  Document& m_document;
  OutlineKind m_kind = OutlineKind::Scene;
  std::string m_id, m_material;
  std::optional<std::pair<uint64_t, uint32_t>> m_marked;
  bool m_any = false;
};

}  // namespace ps
