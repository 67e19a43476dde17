// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ps {

/// Whose parameters there are.
enum class Owner : uint8_t {
  Material,
  Wall,
  Environment,
  Solver,
  Thermal,
  Body,
  Emitter,
  Sink,
  Constraint,
  Scene,
  HeatSource,
  Probe,
  Shape
};
inline constexpr Owner kOwners[] = {Owner::Material,   Owner::Wall,  Owner::Environment, Owner::Solver,
                                    Owner::Thermal,    Owner::Body,  Owner::Emitter,     Owner::Sink,
                                    Owner::Constraint, Owner::Scene, Owner::HeatSource,  Owner::Probe,
                                    Owner::Shape};
/// As addresses begin: "material", "wall", ...
std::string_view ownerName(Owner owner);

/// Names one parameter of a project: "material/water/conductivity_solid", "wall/floor/temperature",
/// "environment/ambient_pressure", "solver/substeps", "thermal/KEY", "body/ice/temperature", "emitter/tap/speed",
/// "sink/drain/open", "constraint/ice/bonds/KEY", "heat_source/lamp/KEY", "scene/gravity",
/// "probe/core/quantity", "shape/ball/size_x".
struct Address {
  Owner owner = Owner::Scene;
  std::string id;  ///< of the owner, of a constraint's or a shape's body; "" where there is one owner
  std::string key;
  std::string plugin{};  ///< of a constraint: "bonds"; "" elsewhere
  std::string text() const;
  /// Its text without the key: "constraint/ice/bonds/".
  std::string prefix() const;
  static std::optional<Address> parse(std::string_view text);
  bool operator==(const Address&) const = default;
};

}  // namespace ps
