// SPDX-License-Identifier: Apache-2.0
// What probes read off the particles: sums in the order of the store, the same for any number of threads.
#include "core/math/vector.h"
#include "core/simulation/measure.h"
#include "core/simulation/particlefield.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

namespace ps {
namespace {

/// Particles that may run ahead of a front without being it: spray.
constexpr size_t kSpray = 2;

/// Particles that make a piece: fewer do not fill a volume.
constexpr size_t kLeastPiece = 4;

/// x, y or z of a vector.
double part(const api::Float4& v, size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// A quantity's key, taken apart: "velocity_x_max" is velocity, axis 0, max.
struct Key {
  std::string base, statistic;
  size_t axis = 0;

  explicit Key(const std::string& quantity) : base(quantity) {
    for (const char* end : {"_min", "_max"}) {
      if (base.ends_with(end)) statistic = dropEnd(4).substr(1);
    }
    if (base.size() > 2 && base[base.size() - 2] == '_' && base.back() >= 'x') {
      axis = static_cast<size_t>(dropEnd(2).back() - 'x');
    }
  }

 private:
  std::string dropEnd(size_t letters) {
    std::string end = base.substr(base.size() - letters);
    base.resize(base.size() - letters);
    return end;
  }
};

constexpr size_t kPhases = static_cast<size_t>(api::Phase::Gas) + 1;

double nothing() { return std::numeric_limits<double>::quiet_NaN(); }

class Measurement {
 public:
  Measurement(const ProbeView& view, const Probe& probe)
      : m_view(view),
        m_store(view.solver.particles()),
        m_probe(probe),
        m_key(probe.quantity),
        m_ofEach(ofEach(m_key.base)) {
    const Quantity* quantity = view.fields.quantity(probe.quantity);
    m_isKnown = quantity;
    if (quantity && quantity->field) {
      m_key.base.clear();
      m_key.statistic = quantity->of == Quantity::Of::Least ? "min" : quantity->of == Quantity::Of::Most ? "max" : "";
      m_isKnown = static_cast<bool>(m_field.emplace(*quantity->field, m_store));
    }
    if (!isForce(probe.quantity)) choose();
  }

  double value() const {
    const std::string& base = m_key.base;
    if (isForce(m_probe.quantity)) return force();
    if (base == "pieces") return static_cast<double>(pieces());
    if (base == "count") return static_cast<double>(m_chosen.size());
    if (base == "mass" || base.ends_with("_mass")) return sum([](size_t) { return 1.0; });
    if (base == "kinetic_energy") return sum([&](size_t i) { return 0.5 * squaredSpeed(m_store.velocity()[i]); });
    if (base == "thermal_energy") return thermalEnergy();
    if (base == "momentum") return sum([&](size_t i) { return part(m_store.velocity()[i], m_key.axis); });
    if (base == "angular_momentum") return angularMomentum(Vector3::Zero());
    if (base == "outside") return static_cast<double>(beyondWalls());
    if (m_chosen.empty() || !m_isKnown) return nothing();
    if (base == "spin") return spin();
    if (base == "front") return front();
    if (base == "gap") return gap();
    if (base == "extent") return largest() - smallest();
    if (m_probe.wave) return amplitude(*m_probe.wave);
    if (m_key.statistic == "min") return smallest();
    if (m_key.statistic == "max") return largest();
    return sum([&](size_t i) { return ofParticle(i); }) / sum([](size_t) { return 1.0; });
  }

 private:
  /// What a particle has of a quantity that is no field's.
  enum class OfEach : uint8_t { Place, Height, Compression, Velocity };
  static OfEach ofEach(const std::string& base) {
    if (base == "height") return OfEach::Height;
    if (base == "compression") return OfEach::Compression;
    return base == "velocity" ? OfEach::Velocity : OfEach::Place;
  }

  void choose() {
    const auto& ids = m_view.bodyIds;
    const auto body = static_cast<size_t>(std::find(ids.begin(), ids.end(), m_probe.body) - ids.begin());
    const bool byMass = m_key.base.ends_with("_mass");
    const bool still = m_probe.fixed || (!m_probe.body.empty() && !moves(body));
    const std::string phase = byMass ? m_key.base.substr(0, m_key.base.size() - 5) : m_probe.phase;
    const bool ofBody = !m_probe.body.empty(), everyPhase = phase.empty(), everyMaterial = m_probe.material.empty();
    const auto& materials = m_view.materialIds;
    const auto material =
        static_cast<size_t>(std::find(materials.begin(), materials.end(), m_probe.material) - materials.begin());
    std::array<bool, kPhases> wanted{};  // names are compared once, not for each particle
    for (size_t k = 0; k < kPhases; ++k) wanted[k] = phase == kPhaseNames[k];
    for (size_t i = 0; i < m_store.size(); ++i) {
      if (m_store.velocity()[i].w == 0 && !still) continue;
      if (ofBody && m_store.body()[i] != body) continue;
      if (!everyMaterial && m_store.material()[i] != material) continue;
      if (!everyPhase && !wanted[static_cast<size_t>(m_store.phase()[i])]) continue;
      if (m_probe.region && !isInRegion(i)) continue;
      m_chosen.push_back(i);
    }
  }

  bool isInRegion(size_t i) const {
    if (m_probe.regionWhen == Probe::kNow) return m_probe.region->contains(vectorOf(m_store.wrappedPosition(i)));
    const size_t id = m_store.id()[i];
    return id < m_view.start.size() && m_probe.region->contains(m_view.start[id]);
  }

  bool moves(size_t body) const {
    for (size_t i = 0; i < m_store.size(); ++i) {
      if (m_store.body()[i] == body && m_store.velocity()[i].w != 0) return true;
    }
    return false;
  }

  double ofParticle(size_t i) const {
    if (m_field) return (*m_field)[i];
    switch (m_ofEach) {
      case OfEach::Height:
        return m_store.position()[i].y;
      case OfEach::Compression:
        return std::max(0.0, double{m_store.densityError()[i]});
      case OfEach::Velocity:
        return part(m_store.velocity()[i], m_key.axis);
      case OfEach::Place:
        break;
    }
    return part(m_store.position()[i], m_key.axis);
  }

  /// Sum of m f.
  template <class F>
  double sum(F&& of) const {
    double total = 0;
    for (const size_t i : m_chosen) total += double{m_store.mass()[i]} * of(i);
    return total;
  }

  double smallest() const {
    double least = std::numeric_limits<double>::infinity();
    for (const size_t i : m_chosen) least = std::min(least, ofParticle(i));
    return least;
  }
  double largest() const {
    double most = -std::numeric_limits<double>::infinity();
    for (const size_t i : m_chosen) most = std::max(most, ofParticle(i));
    return most;
  }

  double thermalEnergy() const {
    const std::span<const double> energies = m_view.solver.thermalEnergies();
    double total = 0;
    for (const size_t i : m_chosen) total += energies.empty() ? 0 : energies[i];
    return total;
  }

  /// Component along the axis of sum m (x - about) x v, kg m2/s.
  double angularMomentum(const Vector3& about) const {
    const auto axis = static_cast<Eigen::Index>(m_key.axis);
    return sum([&](size_t i) {
      return (vectorOf(m_store.position()[i]) - about).cross(vectorOf(m_store.velocity()[i]))[axis];
    });
  }

  /// Of the last frame, on a wall or a body.
  double force() const {
    const auto indexOf = [](const auto& all, auto&& is) {
      return static_cast<size_t>(std::find_if(all.begin(), all.end(), is) - all.begin());
    };
    std::optional<Wrench> wrench;
    if (!m_probe.wall.empty())
      wrench = m_view.solver.forceOnWall(indexOf(m_view.walls, [&](const Wall& w) { return w.id == m_probe.wall; }));
    else if (!m_probe.body.empty())
      wrench = m_view.solver.forceOnBody(
          static_cast<uint32_t>(indexOf(m_view.bodyIds, [&](const std::string& id) { return id == m_probe.body; })));
    if (!wrench) return nothing();
    return (m_key.base == "force" ? wrench->force : wrench->torque)[static_cast<Eigen::Index>(m_key.axis)];
  }

  /// L/I about an axis through the centre of mass.
  double spin() const {
    const auto axis = static_cast<Eigen::Index>(m_key.axis);
    const double mass = sum([](size_t) { return 1.0; });
    Vector3 centre;
    for (Eigen::Index a = 0; a < 3; ++a)
      centre[a] = sum([&](size_t i) { return vectorOf(m_store.position()[i])[a]; }) / mass;
    const double inertia = sum([&](size_t i) {
      const Vector3 arm = vectorOf(m_store.position()[i]) - centre;
      return arm.squaredNorm() - arm[axis] * arm[axis];
    });
    return inertia > 0 ? angularMomentum(centre) / inertia : nothing();
  }

  /// From the centre of one of the chosen to the nearest centre of another body: others are sorted along x, and looked
  /// at outwards from there until x alone is farther than the nearest.
  double gap() const {
    const api::Float4* place = m_store.position();
    std::vector<uint32_t> others;
    for (uint32_t i = 0; i < m_store.size(); ++i) others.push_back(i);
    std::sort(others.begin(), others.end(), [&](uint32_t a, uint32_t b) { return place[a].x < place[b].x; });
    double nearest = std::numeric_limits<double>::infinity();  // squared
    for (const size_t i : m_chosen) {
      const auto look = [&](uint32_t j) {
        const double x = double{place[i].x} - place[j].x, y = double{place[i].y} - place[j].y,
                     z = double{place[i].z} - place[j].z;
        if (m_store.body()[j] != m_store.body()[i]) nearest = std::min(nearest, x * x + y * y + z * z);
        return x * x <= nearest;
      };
      const auto here = std::lower_bound(others.begin(), others.end(), place[i].x,
                                         [&](uint32_t j, float x) { return place[j].x < x; });
      for (auto j = here; j != others.end() && look(*j);) ++j;
      for (auto j = here; j != others.begin() && look(*(j - 1));) --j;
    }
    return std::isfinite(nearest) ? std::sqrt(nearest) : nothing();
  }

  double front() const {
    std::vector<double> places;
    for (const size_t i : m_chosen) places.push_back(ofParticle(i));
    const size_t rank = std::min(kSpray, places.size() - 1);
    std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(rank), places.end(),
                     std::greater<>());
    return places[rank] + 0.5 * m_view.spacing;
  }

  /// Of a sine, by its projection: exact for matter that is spread evenly over whole waves.
  double amplitude(const Wave& wave) const {
    const auto axis = static_cast<size_t>(wave.axis);
    double total = 0;
    for (const size_t i : m_chosen) {
      const double at = 2 * std::numbers::pi * part(m_store.position()[i], axis) / wave.wavelength + wave.phase;
      total += ofParticle(i) * std::sin(at);
    }
    return 2 * total / static_cast<double>(m_chosen.size());
  }

  /// Solid bodies that some of the chosen belong to: what hangs together and is large enough to be called one.
  size_t pieces() const {
    const std::vector<uint32_t> piece = m_view.solver.pieces();
    std::vector<size_t> size(piece.size(), 0);
    for (const uint32_t p : piece) {
      if (p != Solver::kNoPiece) ++size[p];
    }
    size_t count = 0;
    for (const size_t i : m_chosen) {
      if (piece[i] == Solver::kNoPiece || size[piece[i]] < kLeastPiece) continue;
      ++count;
      size[piece[i]] = 0;  // counted
    }
    return count;
  }

  size_t beyondWalls() const {
    size_t count = 0;
    for (const size_t i : m_chosen) {
      const api::Float4& p = m_store.position()[i];
      count +=
          std::any_of(m_view.walls.begin(), m_view.walls.end(), [&](const Wall& w) { return heightOver(w, p) < 0; });
    }
    return count;
  }

  const ProbeView& m_view;
  const ParticleStore& m_store;
  const Probe& m_probe;
  Key m_key;
  OfEach m_ofEach;
  std::optional<StoredField> m_field;  ///< what is measured, where it is a field's
  bool m_isKnown = false;              ///< a quantity that matter of this scene has
  std::vector<size_t> m_chosen;
};

}  // namespace

double measureProbe(const ProbeView& view, const Probe& probe) { return Measurement(view, probe).value(); }

std::string probeTitle(const Probe& probe, const ParticleFields& fields) {
  return probe.name + "." + probe.quantity + "[" + fields.unitOf(probe.quantity) + "]";
}

}  // namespace ps
