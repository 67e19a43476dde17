// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/port.h"
#include "ui/tools/tool.h"

#include <optional>
#include <utility>
#include <vector>

namespace ps {

/// The shape of emitters and sinks as lines in space, what of them can be taken hold of, and what a drag makes of them.
/// Pure: no widget, no picture, no document.

/// A part of an emitter or a sink that can be dragged.
struct PortHandle {
  enum class Part { Whole, Tip, Corner };
  Port port;
  Part part = Part::Whole;
  int corner = 0;          ///< bit a set: at the maximum of axis a
  Vector3 place{0, 0, 0};  ///< m, where it is
  bool operator==(const PortHandle&) const = default;
};

/// Emitters and sinks, and which of them is selected: that one shows its knobs. Others do not show where a section cuts
/// them away.
struct PortSet {
  const std::vector<Emitter>* emitters = nullptr;
  const std::vector<Sink>* sinks = nullptr;
  std::optional<Port> selected;
  std::optional<Section> section{};
};

/// A mouth is a circle with the jet as a line, a sink a box of wire.
struct PortShape {
  std::vector<std::pair<Vector3, Vector3>> lines;
  std::vector<Vector3> face;                       ///< of a mouth; a click within it hits
  std::optional<std::pair<Vector3, Vector3>> jet;  ///< the last of the lines, from the mouth to the tip
};
/// `least`: m, the shortest jet that can be seen from where somebody looks.
PortShape shapeOf(const Emitter& emitter, double least);
PortShape shapeOf(const Sink& sink, double least);

/// Units of a pointer's fineness (pixels) that the jet is drawn long, at least.
inline constexpr double kLeastJet = 44;
/// Where the arrow of a jet ends, m: two widths of the mouth away, and at least `least`.
Vector3 arrowTip(const Emitter& emitter, double least);
Vector3 cornerOf(const Sink& sink, int corner);
std::vector<PortHandle> knobsOf(const Port& port, const Emitter& emitter, double least);
std::vector<PortHandle> knobsOf(const Port& port, const Sink& sink, double least);
Vector3 anchorOf(const Emitter& emitter);
Vector3 anchorOf(const Sink& sink);

/// visit(port, item) for each port that shows (no hidden one), the selected one first or last.
template <class Visit>
void forPorts(const PortSet& ports, bool selectedFirst, Visit&& visit) {
  const auto pass = [&](bool marked) {
    const auto all = [&](const auto& items, bool isSink) {
      for (const auto& item : items) {
        const Port port{isSink, item.id};
        const bool selected = ports.selected == port;
        const bool shows = item.visible && (selected || !ports.section || ports.section->shows(anchorOf(item)));
        if (shows && selected == marked) visit(port, item);
      }
    };
    if (ports.emitters) all(*ports.emitters, false);
    if (ports.sinks) all(*ports.sinks, true);
  };
  pass(selectedFirst);
  pass(!selectedFirst);
}

/// What the pointer can take hold of, nothing of locked ones; tips and corners of the selected one only.
std::optional<PortHandle> handleAt(const PortSet& ports, const Pointer& pointer);

// What a drag of a handle to a place in m gives.
Emitter dragged(Emitter emitter, const PortHandle& handle, const Vector3& to);
/// `least`: shortest edge, m.
Sink dragged(Sink sink, const PortHandle& handle, const Vector3& to, double least);

}  // namespace ps
