// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

#include <variant>

namespace ps {

/// A constraint plugin by the form of its interface; never nullptr.
using AnyConstraint = std::variant<const api::StructuralPlugin*, const api::GroupPlugin*, const api::NeighbourPlugin*>;

/// What the forms share.
inline const api::ConstraintPlugin& commonOf(const AnyConstraint& plugin) {
  return std::visit([](const auto* p) -> const api::ConstraintPlugin& { return *p; }, plugin);
}

}  // namespace ps
