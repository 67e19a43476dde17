// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <cstdint>
#include <span>

namespace ps {

/// A tool that a hand can take: what it is called, and of what form.
struct ToolForm {
  enum class Kind : uint8_t { Rod, Plate, Spoon, Sieve, Comb, Hand };
  Kind kind;
  const char *id, *name;  ///< "spoon", "Spoon"
  const char* use;        ///< a sentence
};
std::span<const ToolForm> toolForms();

/// A tool about `length` m long as a body that is held in place, in the middle of the scene; of no material yet. No
/// part of it is thinner than two particles that are `spacing` m apart, so that nothing leaks through, nor an opening
/// narrower than four, so that liquid runs through a sieve: where particles are coarse it is larger than it was to be.
Body toolBody(ToolForm::Kind kind, double length, double spacing);

}  // namespace ps
