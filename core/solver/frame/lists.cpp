// SPDX-License-Identifier: Apache-2.0
// When neighbour lists are made anew, and what follows from them.
#include "core/solver/frame/solverimpl.h"

namespace ps {
namespace {

/// Frames after which particles are sorted by cell again although the lists still hold.
constexpr uint64_t kSortInterval = 60;

}  // namespace

/// Else they are those of where particles are now.
bool Solver::Impl::needsLists() const {
  return reordered || (store.period().any() && strayed()) || neighbours.stale(store) ||
         frame >= lastSort + kSortInterval;
}

void Solver::Impl::freshLists() {
  const bool newLists = needsLists();
  if (newLists) {
    if (store.period().any()) wrapIntoPeriod();
    neighbours.sortAndBuild(store);
    constraints.remap(neighbours.lastOrder());
    heat.reordered(store);
    lastSort = frame;
    reordered = false;
    structureChanged = true;
  }
  const bool led = motion.movesWithin(time, settings.dt);
  shapes.refresh(store, led);
  shapes.refreshLists(store, neighbours, newLists);
  density.refresh(store, neighbours);
  swept.refresh(store, led);
  if (structureChanged) return listsChanged(true);
  refreshLiquidContact();  // liquid may have become vapour, or vapour liquid
}

void Solver::Impl::refreshLiquidContact() {
  wet.refresh(store, neighbours, density.wetSolids());
  sheets.refresh(store, neighbours, thinSolids);
}

/// Makes everything anew that follows from lists and structure, and from nothing else: whatever is kept there may be
/// dropped at any time, and a state needs none of it.
void Solver::Impl::listsChanged(bool newStructure) {
  if (newStructure) {
    rigid.refreshBodies(store, constraints);
    constraints.findGroupMembers(store, grouped);
    constraints.findHanging(store, hanging);
    constraints.findPieces(store.size(), pieceOf);
    rebound.refresh();
    pieces.refresh(pieceOf);
    pieceSpin.refresh(store, constraints.graph(store.size()), pieces);
    constraints.findHeld(store);
    anchorsKnown = false;
    findThinSolids();
    structureChanged = false;
  } else {
    shapes.refreshLists(store, neighbours, true);
    density.refreshLists(store, neighbours);  // of a new structure it has just been refreshed
  }
  refreshLiquidContact();
  wallStage.refreshLists(store, neighbours, rigid.members());
  swept.refreshLists(store, neighbours);
  rigid.refreshContacts(store, neighbours, constraints);
  viscosity.listsChanged();
  contact.refresh(store, neighbours, constraints, pieceOf, rigid.members());
}

}  // namespace ps
