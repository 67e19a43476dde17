// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/solidform.h"

#include <span>
#include <string>

namespace ps {

class PluginRegistry;

/// A solid that comes into the scene in one step: what it is called, and of what form.
struct SolidRow {
  SolidForm::Kind kind;
  const char* name;          ///< as the body's row Shape says it, where it is no more than a shape
  const char* words = "";    ///< by which it is found too
  const char* id = nullptr;  ///< nullptr: by its kind
  double held = 0;           ///< K that it keeps, held in place; 0: it is as warm as the scene makes it
};
std::span<const SolidRow> solidRows();
/// "ellipsoid", as the parameter of solids calls the kind, or what the row says.
std::string idOf(const SolidRow& row);

/// As a body in the middle of the scene, of no material yet. About `size` m wide; a torus and a bowl, half a ball, are
/// twice as wide, sheets, ropes and what holds a temperature lie, and are longer.
Body solidBody(const SolidRow& row, double size, double spacing);

/// Id of the installed material that melts last: walls and tools of it stay what they are at any temperature that
/// scenes have. "" where none is installed.
std::string lastToMelt(const PluginRegistry& plugins);
/// Of those that are solid at a temperature in K the one that conducts heat best there.
std::string bestConductor(const PluginRegistry& plugins, double kelvin);

}  // namespace ps
