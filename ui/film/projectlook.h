// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/export/exportformat.h"
#include "ui/render/renderer.h"

#include <functional>
#include <string>

namespace ps {

class PluginRegistry;

/// What a project looks like where nobody has set anything: a field's colours, for temperature from the coldest to the
/// hottest that the scene starts from and is driven by, so that they keep their meaning from frame to frame, about the
/// melting point of its first material.
Look lookOf(const Project& project, const PluginRegistry& plugins, const std::string& colour);

/// Colours of temperatures, K, by the look's range and melting point.
std::function<ByteColour(float kelvin)> temperatureColours(const Look& look);

}  // namespace ps
