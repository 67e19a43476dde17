// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/scene/project.h"

#include <span>

namespace ps {

/// Whether contact may follow a body's shape: a packed solid that is fixed and stands. On a lattice its particles lie
/// as far out as the surface itself, where liquid and what is fast would meet them first.
bool hasTrueSurface(const Body& body);
/// Writes field::kTrueSurface of a body's particles that lie within a spacing of its surface.
void noteTrueSurface(ParticleStore& store, std::span<const uint32_t> ids, const Body& body, double spacing);

}  // namespace ps
