// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/cellgrid.h"
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class Solver;

/// Measures what the tools feel that hands lead through matter, or have led last, one for each hand, in each frame, for
/// who holds them. It moves nothing, and is no state: after a return to one, a tool is known again when it is led
/// again.
///
/// It cannot do: tell the heat that a tool takes from what it gives to the air or gets from a heater; see matter that
/// touches it across a face of a periodic box.
class ToolMeter {
 public:
  /// A hand leads this body, by the index that particles carry.
  void add(uint32_t body);
  /// Those, the one that was led last first.
  std::vector<uint32_t> bodies() const;
  /// After a frame; `spacing` of the particles in m.
  void measure(const Solver& solver, double spacing);
  /// By what the bodies are called.
  std::vector<ToolContact> contacts(const std::vector<std::string>& bodyIds) const;

 private:
  /// J by the particles' ids, ascending.
  using LatentById = std::vector<std::pair<uint32_t, double>>;
  struct Tool {
    uint32_t body = 0;
    ToolContact contact;
    std::optional<double> joules;  ///< in it, when the last frame ended
    LatentById latent;             ///< of what touched it then
  };
  void measure(const Solver& solver, double spacing, double seconds, Tool& tool);
  void findTouching(const Solver& solver, double reach, uint32_t body);

  static constexpr size_t kHands = 2;
  std::vector<Tool> m_tools;  ///< the one that was led last first
  double m_thermalTime = 0;   ///< s, when the last frame ended
  struct Touching {
    uint32_t particle = 0, of = 0;  ///< by index: of another body, and the nearest of the tool
    double distance = 0;            ///< m
  };
  std::vector<Touching> m_touching;
  std::vector<uint32_t> m_surface;  ///< particles of a tool
  CellGrid m_grid;
};

}  // namespace ps
