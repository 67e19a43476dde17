// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/simulation/snapshot.h"

#include <optional>
#include <span>

namespace ps {

/// A place of matter, m: where it was made, and where it is by now.
struct RestPair {
  Vector3 rest, place;
};

/// The move that takes places of rest nearest to where they are by now, by least squares (B. Horn, "Closed-form
/// solution of absolute orientation using unit quaternions", 1987, section 4). What the places do not say of the turn
/// (one place, or a line of them) is as in `turn`, of unit length. At least one pair.
RigidMove bestMove(std::span<const RestPair> pairs, const Quaternion& turn);

/// How a sketched body stands by now near a place: the move from where it was drawn to where its matter is, by what of
/// it is solid, belongs to it and was made of its cells. Found from the solid particles within `within` m of the place,
/// the nearest dozen at least, and from there on as far as the body has not bent: where it is bent, it is the frame of
/// that part of it. What has melted and set again elsewhere counts for nothing. `body`: the index that particles carry;
/// `pose`: where the document has it. Nothing where no solid matter is near that lies together as it was drawn: none is
/// there, or the most of it has moved by more than a third of a spacing against the rest.
std::optional<RigidMove> standingNear(const Snapshot& scene, uint32_t body, const RigidMove& pose, const Vector3& place,
                                      double within);

}  // namespace ps
