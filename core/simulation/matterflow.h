// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/snapshot.h"
#include "core/solver/solver.h"

#include <deque>
#include <functional>
#include <map>
#include <span>

namespace ps {

class StateReader;
class StateWriter;

/// Emitters and sinks of one run. Matter comes and goes between two frames; its energy is booked as a source in the
/// heat ledger, its amount in total().
///
/// A mouth is the end of a short pipe: the layers that come next, as many as a particle's reach is long, are there
/// already, held at the speed of the jet, so that what has just left leans on them instead of on nothing. A layer is
/// poured when it crosses the mouth. A tap that is shut holds nothing, nor does one that waits until there are fewer
/// particles.
class MatterFlow {
 public:
  /// Gives birth to an emitter's particles; returns their ids, or none where there can be none.
  using Birth = std::function<std::vector<uint32_t>(Spawn, const Emitter&)>;

  /// Takes away what the sinks hold.
  void drain(Solver& solver, const Project& project);
  /// Before a frame of `dt` s, or after an edit: what is held takes the speed of its emitter, and goes back where the
  /// emitter has been shut, moved or taken away.
  void steer(Solver& solver, const Project& project, double dt);
  /// Pours what is due between the solver's time less `dt` and its time, in layers as far apart as the mouth says, each
  /// as far down the jet as it has come since it left the mouth, so that the mean flow is speed times area whatever the
  /// frame; then fills the pipes up. `bodyOf` says which body an emitter's particles are of. A place that is taken
  /// stays empty. A frame that is so long, or a jet so fast, that more layers are due than anybody could follow pours
  /// kMostLayers; the rest is not made up for, and limits() says so.
  void pour(Solver& solver, const Project& project, std::span<const BakedMaterial> materials, double spacing, double dt,
            const std::function<uint32_t(const Emitter&)>& bodyOf, const Birth& birth);
  bool holds(uint32_t id) const;
  const FlowTotal& total() const { return m_total; }
  /// Of the last pour().
  const std::vector<Limit>& limits() const { return m_limits; }

  void save(StateWriter& writer) const;
  /// After the particles.
  void restore(const StateReader& reader, const ParticleStore& store);
  /// Throws InputError where what is held does not fit the mouths that the project has.
  void requireLayers(const Project& project, std::span<const BakedMaterial> materials, double spacing) const;

 private:
  static constexpr uint32_t kNone = ~0u;
  static constexpr double kMostLayers = 256;  ///< that one mouth pours in a frame
  using Layer = std::vector<uint32_t>;        ///< ids by place in compileLayer(); kNone: nothing is held there
  struct Pipe {
    double travelled = 0;      ///< m, of the jet since its last layer crossed the mouth
    std::deque<Layer> layers;  ///< held, one behind the other; the first is the next to cross
    Layer last;                ///< that has crossed
    Vector3 point{}, direction{};
    double diameter = 0;  ///< m
  };
  struct Job;

  void cross(const Job& job, Pipe& pipe, double offset, double& living);
  void fill(const Job& job, Pipe& pipe);
  Spawn crossed(const Job& job, const Pipe& pipe, double offset) const;
  void born(const Job& job, const Spawn& layer, const std::vector<size_t>& places, Layer& ids);
  void takeBack(Solver& solver, Layer ids);
  void empty(Solver& solver, Pipe& pipe);
  void settle(const Solver& solver);

  std::map<std::string, Pipe> m_pipes;  ///< by Emitter::id
  FlowAmount m_born;                    ///< what was born less what went back
  FlowTotal m_total;
  std::vector<Limit> m_limits;
};

}  // namespace ps
