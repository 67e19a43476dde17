// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

namespace ps {

/// Emitters, and the middles of sinks, stay within the scene's bounds: to the nearest place there.
void keepWithin(const Environment& environment, Emitter& emitter);
void keepWithin(const Environment& environment, Sink& sink);

}  // namespace ps
