// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <string>

namespace ps {

/// "" or why no scene could be made of a project in which one parameter has another value that is in its range: too
/// many particles, a periodic box too small for their reach, a temperature gradient that leads below 1 K. Found without
/// building, and only what that parameter can bring about: it may be asked of every value of a drag.
std::string problemOfSceneWith(const Project& project, const Address& address, const Value& value);
/// Throws InputError for more particles than a scene may have.
void requireRoom(double particles);

}  // namespace ps
