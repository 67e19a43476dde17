// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/scene/project.h"

#include <phasesketch/brush.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

// Whatever changes an engine is one of these values, applied between frames. Why values and not functions: a list of
// them with their frames, and the state at the start, say all that happened, and can be written down and repeated.
namespace ps {

class NamedMatter;

/// Names matter that came or went by one edit, so that another one can take it away or bring it back. 0: nobody asks.
using MatterKey = uint64_t;
using CellIndices = std::vector<std::array<int, 3>>;
/// Particles by the key that names them.
using MatterIds = std::map<MatterKey, std::vector<uint32_t>>;

/// A parameter has this value from now on.
struct SetParameter {
  Address address;
  Value value;
};
/// The document changed as a whole: see Engine::update().
struct UpdateProject {
  std::shared_ptr<const Project> project;
};
/// Parameters go by these tracks from now on: see Engine::setTracks().
struct SetTracks {
  std::vector<Track> tracks;
};
/// These are measured from now on. Matter stays as it is.
struct SetProbes {
  std::vector<Probe> probes;
};
/// Cells of a sketched body become matter: see Engine::addCells().
struct AddCells {
  std::shared_ptr<const Body> body;
  CellIndices cells;
  int palette = 0;
  MatterKey key = 0;  ///< adds what is born to what the key names
  RigidMove way{};    ///< from where the body is drawn to where it stands by now, and its cells come
};
/// Takes what stands in cells of a lattice, except matter of some bodies.
struct TakeCells {
  VoxelShape lattice;  ///< see latticeOf()
  CellIndices cells;
  std::vector<std::string> spared{};  ///< Body::id
  MatterKey key = 0;
};
/// Takes all matter of a body, an emitter's too; what the key named before is forgotten.
struct TakeBody {
  std::string body;  ///< Body::id or Emitter::id
  MatterKey key = 0;
};
/// Takes what a key names, wherever it is by now. Where the key names nothing, because of a reset since, it takes what
/// stands in the cells instead.
struct TakeMatter {
  MatterKey key = 0;
  VoxelShape lattice{};  ///< see latticeOf()
  CellIndices cells{};
};
/// Puts what was taken under a key back where it was, the last taken first. Where the key names nothing, because of a
/// reset since, `cells` are added in its place under the key.
struct PutBack {
  MatterKey key = 0;
  std::vector<AddCells> cells{};
};
/// What stands in cells of a lattice becomes of a material, or gets a colour, except matter of some bodies: see
/// Engine::paint(). Refused where the scene has no such material.
struct PaintCells {
  VoxelShape lattice;  ///< see latticeOf()
  CellIndices cells;
  std::string material;               ///< SceneMaterial::id, or a colour: see core/scene/coat.h
  std::vector<std::string> spared{};  ///< Body::id
  MatterKey key = 0;                  ///< notes what each particle was
};
/// A body is at another pose from now on, and its matter is carried by as much: see Engine::moveBody().
struct MoveBody {
  std::shared_ptr<const Body> body;  ///< as it is there
  RigidMove move;                    ///< from where the engine's document has it
  bool led = false;  ///< what is fixed goes there as time passes, through what is in its way: Solver::lead()
};
/// Matter of a body becomes another one's, which has come from it or goes back to it: all of it, or what was made of
/// some cells of its lattice (RestPlaces). It stays where it is, and tied as it was.
struct PassMatter {
  std::string from, to;  ///< Body::id
  VoxelShape lattice{};  ///< see latticeOf()
  CellIndices cells{};
  bool all = false;  ///< instead of the cells
};
/// Names the matter of a body that stands in cells of a lattice; right after a reset, when nothing has moved.
struct NameMatter {
  MatterKey key = 0;
  std::string body;    ///< Body::id
  VoxelShape lattice;  ///< see latticeOf()
  CellIndices cells;
  /// "": the key made it; else the key painted it, and UndoTouch gives it this material, or this colour, again. Matter
  /// of several materials is named one after the other.
  std::string paintedFrom{};
};
/// Puts the matter that was taken with a body back; where the key names nothing, the body comes as it is at the start,
/// and `named` are named in it.
struct ReturnBody {
  std::shared_ptr<const Body> body;  ///< nullptr: it comes back from what was taken only
  MatterKey key = 0;
  std::vector<NameMatter> named{};
};
/// These keys are asked for no more.
struct ForgetMatter {
  std::vector<MatterKey> keys;
};
/// Back to the start, with all edits kept. Keys name nothing then, except `named`.
struct Reset {
  std::vector<NameMatter> named{};
};
/// To a state that a project of these bodies holds, with all other edits kept. Keys name nothing then, except `named`:
/// what Engine::names() said when the state was kept. What was out of the scene then, and hands, are in no state.
struct ReturnToState {
  std::shared_ptr<const ProjectState> state;
  std::shared_ptr<const NamedMatter> named{};
};

/// A hand is in matter, for as long as it stays: it acts at the start of each frame, until another one of its key says
/// where it is by now. What a path of `samples` places asks for shares the next frame evenly, also where several come
/// before it; `still` acts in each frame after that, and none lets go. Heat is W of the thermal clock that was asked
/// for, booked as heaters; what is fixed takes it like all other matter. What is fixed is neither pushed nor held; the
/// work of a hand is work from outside, between two frames. Only `still` holds: what is within when it comes first.
/// What a path cuts and welds it does at once, before all else. Refused with numbers that cannot be, and heat without a
/// thermal model.
struct TouchMatter {
  std::vector<api::Touch> path{};
  uint32_t samples = 1;  ///< 1 at least
  std::vector<api::Touch> still{};
  std::vector<std::string> spared{};  ///< Body::id
  MatterKey key = 0;                  ///< notes what each particle got
};
/// Lets go, and takes from each particle the heat that it got by a key, wherever it is by now, but leaves it at 1 K at
/// least; what has gone gives nothing back. What a key cut is tied again, what it welded no more: see Solver::undo().
/// What it painted is of its own material again: see Solver::unpaint().
struct UndoTouch {
  MatterKey key = 0;
};
/// Gives again what was taken so, and paints again.
struct RedoTouch {
  MatterKey key = 0;
};

/// Snapshots carry these fields from now on: see Engine::show(). Matter stays as it is.
struct ShowFields {
  std::vector<std::string> names;
};

using Command = std::variant<SetParameter, UpdateProject, SetTracks, AddCells, TakeCells, TakeBody, TakeMatter, PutBack,
                             PaintCells, MoveBody, PassMatter, NameMatter, ReturnBody, ForgetMatter, TouchMatter,
                             UndoTouch, RedoTouch, Reset, ReturnToState, ShowFields, SetProbes>;

}  // namespace ps
