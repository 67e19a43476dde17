// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/scene/project.h"
#include "ui/document/matterref.h"

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ps {

struct Parting;
struct StrokeRecord;

/// Another project altogether.
struct ProjectOpened {
  bool play = true;  ///< whether it should run at once
};
/// One parameter has another value; nothing: it is set no more, and what it falls back to holds.
struct ParameterChanged {
  Address address;
  std::optional<Value> value;
  Value before{};  ///< what held until now
};
/// A body was renamed, hidden, locked, given another structure; or it came or went together with its matter, which
/// `matter` names (nullptr: no particle is touched). `move`: it is at another pose, and nothing else of it has changed;
/// its matter goes along. `composition`: what has changed of its structure and its material, which is set as
/// parameters are. `remade`: its matter is made otherwise at the next reset. `led`: it moves there by a hand, and meets
/// what is in its way.
struct BodyChanged {
  std::string id;
  MatterRef matter{};
  std::optional<RigidMove> move{};
  std::vector<ParameterChanged> composition{};
  bool remade = false;  ///< others of its particles are pinned, or its sketch has other cells
  bool led = false;
  struct Resized {
    double factor = 1;
    Vector3 about{0, 0, 0};  ///< m
  };
  /// A sketch is made larger or smaller at the next reset, before it moves.
  std::optional<Resized> resized{};
};
/// An emitter or a sink came, went, was renamed, hidden or locked; `moved`: nothing but its place has changed. An
/// emitter goes and comes back together with what it has poured, which `matter` names.
struct PortChanged {
  bool moved = false;
  std::string id{};
  MatterRef matter{};
};
/// Walls came, went, were renamed, hidden or locked; `moved`: nothing but their places has changed.
struct WallsChanged {
  bool moved = false;
};
/// The scene has one material more, or less, or one holds on to others than before. `other`: one is of another
/// installed one, as which its matter is made at the next reset.
struct MaterialsChanged {
  bool other = false;
};
/// A stroke was made (`live`: its particles are in the engine already), undone or redone.
struct StrokeChanged {
  std::shared_ptr<StrokeRecord> stroke;
  bool done = true, live = false;
};
/// Matter of a body became that of its pieces, or theirs its own again; the bodies have come, or gone, before.
struct BodyParted {
  std::shared_ptr<const Parting> parting;
  bool done = true;
};
/// What colour means changed.
struct ViewChanged {};
/// Other rows are pinned.
struct PinsChanged {};
/// A parameter has other keys, or none any more; what it says by itself stays what it is.
struct TracksChanged {
  std::string parameter;  ///< Track::parameter
};
/// Probes came, went, or measure something else.
struct ProbesChanged {
  std::string id;  ///< Probe::id
};
/// Other graphs are shown, or they show something else.
struct GraphsChanged {};
/// Things stand in another order, or in other groups.
struct OrderChanged {};
/// Markers came, went, moved or are called something else.
struct MarkersChanged {};
/// The project holds another state to open at, or none; the scene that runs stays what it is.
struct StateChanged {};
/// The project has another title or description.
struct AboutChanged {};
/// The file, its name or whether it holds everything changed.
struct FileChanged {};

/// What happened to a document, as one value: receivers visit it.
using ChangeEvent =
    std::variant<ProjectOpened, ParameterChanged, BodyChanged, PortChanged, WallsChanged, MaterialsChanged,
                 StrokeChanged, BodyParted, ViewChanged, PinsChanged, TracksChanged, ProbesChanged, GraphsChanged,
                 OrderChanged, MarkersChanged, StateChanged, AboutChanged, FileChanged>;

}  // namespace ps
