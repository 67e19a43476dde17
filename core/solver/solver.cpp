// SPDX-License-Identifier: Apache-2.0
#include "core/solver/solver.h"

#include "core/base/error.h"
#include "core/solver/frame/solverimpl.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ps {
namespace {

/// Mean excess of density that a liquid has only where it has no room.
constexpr double kSqueezed = 0.1;
constexpr double kSqueezedShare = 0.05;  ///< of the solids

/// s, for which liquid must be so dense before it is told: what splashes soon is not.
constexpr double kDenseTime = 0.5;

/// Liquid whose weight is more than the iterations carry. What is left of it goes down with the square of the substep.
Limit denseLimit(int substeps, double excess) {
  const int asked = std::max(substeps + 1, static_cast<int>(std::ceil(substeps * std::sqrt(2 * excess / kDense))));
  Limit limit{"solver.substeps", static_cast<double>(asked), static_cast<double>(substeps), ""};
  char why[64];
  std::snprintf(why, sizeof why, "its weight leaves liquid %.0f %% too dense", 100 * excess);
  limit.why = why;
  limit.use = useOf("solver/substeps", asked);
  return limit;
}

api::Motion motionOf(api::Phase phase) {
  switch (phase) {
    case api::Phase::Solid:
      return api::Motion::Solid;
    case api::Phase::Gas:
      return api::Motion::Gas;
    default:
      return api::Motion::Liquid;
  }
}

void requirePositive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(std::string("solver: ") + name + " must be a positive number");
}

void requireRoomForImages(const SolverSettings& settings, const Bounds& bounds) {
  const double least = leastPeriod(settings);
  const double edges[3] = {bounds.maximum.x - bounds.minimum.x, bounds.maximum.y - bounds.minimum.y,
                           bounds.maximum.z - bounds.minimum.z};
  for (size_t a = 0; a < 3; ++a) {
    if (!bounds.periodic[a] || edges[a] >= least) continue;
    char lengths[64];
    std::snprintf(lengths, sizeof lengths, "%.4g m long; it must be %.4g m", edges[a], least);
    throw InputError(std::string("the scene is periodic along ") + "xyz"[a] + ", where it is " + lengths +
                     " or longer, three times the reach of its particles");
  }
}

/// Throws unless lists that are given say one thing of each particle.
void requireOneEach(const Spawn& spawn) {
  const size_t count = spawn.position.size();
  const auto require = [&](size_t given, const char* what) {
    if (given > 0 && given != count) throw Error(std::string("as many ") + what + " as positions are needed");
  };
  require(spawn.velocity.size(), "velocities");
  require(spawn.temperatures.size(), "temperatures");
  require(spawn.phases.size(), "phases");
}

}  // namespace

Solver::Solver() : m(std::make_unique<Impl>()) {}
Solver::~Solver() = default;

void Solver::setSettings(const SolverSettings& settings) {
  requirePositive(settings.spacing, "particle_spacing");
  requirePositive(settings.dt, "dt");
  if (settings.substeps < 1) throw InputError("solver: substeps must be 1 or more");
  if (settings.iterations < 1) throw InputError("solver: iterations must be 1 or more");
  if (!(settings.supportRatio > 1)) throw InputError("solver: support_ratio must be more than 1");
  requireRoomForImages(settings, m->bounds);
  m->settings = settings;
  m->askedSubsteps = settings.substeps;
  m->configured = false;
}

void Solver::setThermal(const ThermalSettings& settings, const api::ThermalPlugin* model, std::string name,
                        std::vector<double> modelParameters) {
  m->thermal = settings;
  m->modelChanged = m->modelChanged || model != m->model;
  m->model = model;
  m->modelName = std::move(name);
  m->modelParameters = std::move(modelParameters);
  m->configured = false;
}

void Solver::setWalls(std::vector<Wall> walls) {
  m->walls = std::move(walls);
  m->configured = false;
}

void Solver::setShapes(std::vector<FixedShape> shapes) { m->shapes.set(std::move(shapes)); }

void Solver::setBounds(const Bounds& bounds) {
  requireRoomForImages(m->settings, bounds);
  m->bounds = bounds;
  m->configured = false;
}

void Solver::setBodyNames(std::vector<std::string> names) { m->bodyNames = std::move(names); }

void Solver::setMaterials(std::vector<BakedMaterial> materials) {
  m->materials = std::move(materials);
  m->configured = false;
}

void Solver::setMaterial(size_t index, BakedMaterial material) {
  m->materials.at(index) = std::move(material);
  m->configured = false;
}

std::span<const BakedMaterial> Solver::materials() const { return m->materials; }

uint32_t Solver::addConstraintSet(const AnyConstraint& plugin, std::string name, std::vector<double> parameters) {
  return m->constraints.addSet(plugin, std::move(name), std::move(parameters), m->store);
}

void Solver::setConstraintParameters(uint32_t set, uint32_t body, std::vector<double> parameters) {
  m->constraints.setParameters(set, body, std::move(parameters));
}

void Solver::setMotion(uint32_t body, const BodyMotion& motion) { m->motion.set(body, motion, m->store); }

void Solver::watchForces(std::span<const uint32_t> walls, std::span<const uint32_t> bodies) {
  if (m->forces.watch(walls, bodies)) m->anchorsKnown = false;
}

void Solver::measureBalance(bool on) {
  m->balance.watch(on);
  if (m->forces.watchAll(on)) m->anchorsKnown = false;
}

std::optional<Wrench> Solver::forceOnWall(size_t wall) const { return m->forces.onWall(wall); }
std::optional<Wrench> Solver::forceOnBody(uint32_t body) const { return m->forces.onBody(body); }

void Solver::setHeatSources(std::vector<HeatSource> sources) { m->heat.setSources(std::move(sources), m->store); }

void Solver::setHeating(std::span<const BodyHeat> bodies) { m->heat.bodyHeating().set(bodies); }

void Solver::Impl::configure() {
  if (configured) return;
  if (const Period period(bounds.minimum, bounds.maximum, bounds.periodic); !(period == store.period())) {
    store.setPeriod(period);
    reordered = true;
  }
  const double support = settings.spacing * settings.supportRatio;
  if (support != neighbours.support()) neighbours.configure(support, kSkinSpacings * settings.spacing);
  const std::span<const BakedMaterial> table(materials);
  constraints.configure(settings, table);
  shapes.configure(settings);
  shapeContact.configure(settings);
  density.configure(settings, walls, shapes);
  viscosity.configure(settings, walls, table, shapes);
  wallStage.configure(settings, walls);
  swept.configure(settings, shapes);
  contact.configure(settings, table);
  impacts.configure(settings, walls, table);
  rebound.configure(settings, walls, table);
  for (LiquidContact* kept : {&wet, &sheets}) kept->configure(settings.spacing, kSkinSpacings * settings.spacing);
  rigid.configure(settings, walls, table);
  gas.configure(settings, thermal, table);
  hovering.configure(settings, walls, table);
  heat.setModelName(modelName);
  heat.configure(thermal, settings, walls, bounds, table, model, modelParameters);
  phase.configure(settings, table);
  heat.derive(store);
  if (modelChanged) settleEnergy();  // two models may count the energy of the same matter differently
  modelChanged = false;
  configured = true;
  structureChanged = true;
}

/// Books the energy of matter that came or went while the clock runs, and renews what depends on who is there.
void Solver::Impl::matterChanged(double energyBefore, bool others) {
  if (frame > 0) heat.book(heat.energy(store) - energyBefore);
  settleEnergy();
  reordered = reordered || others;
  structureChanged = true;
  lastGoodValid = false;
}

void Solver::Impl::tie(std::span<const uint32_t> sets, std::span<const uint32_t> members) {
  const size_t count = members.size();
  const size_t searched = Neighbours::searchesAll(count, store.size()) ? 2 * store.size() : count;
  beginStage("Finding neighbours", static_cast<double>(count), static_cast<double>(searched));
  neighbours.buildOf(store, members.front());
  for (const uint32_t set : sets) constraints.build(set, store, neighbours, members);
}

TieChange Solver::Impl::tiesChanged(TieChange change) {
  if (change.empty()) return change;
  structureChanged = true;
  lastGoodValid = false;
  return change;
}

std::vector<uint32_t> Solver::spawn(const Spawn& spawn) {
  const size_t count = spawn.position.size();
  if (count == 0) return {};
  if (spawn.material >= m->materials.size()) throw Error("particles of a material that is not in the table");
  requireOneEach(spawn);
  m->configure();
  ParticleStore& store = m->store;
  const double energyBefore = m->frame > 0 ? m->heat.energy(store) : 0;
  const size_t first = store.add(count), last = first + count;
  const double spacing = m->settings.spacing, cell = spawn.volume > 0 ? spawn.volume : spacing * spacing * spacing;
  std::vector<uint32_t> ids(count), members(count);
  beginStage("Making matter", kMakingWeight * static_cast<double>(count), 4 * static_cast<double>(count));
  inSlices(0, count, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) {
      const size_t i = first + k;
      const api::Double3 p = spawn.position[k], v = spawn.velocity.empty() ? api::Double3{0, 0, 0} : spawn.velocity[k];
      store.position()[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                             static_cast<float>(cell)};
      store.previous()[i] = store.position()[i];
      store.velocity()[i] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
      store.material()[i] = spawn.material;
      store.body()[i] = spawn.body;
      const api::Phase born = spawn.phases.empty() ? spawn.phase : spawn.phases[k];
      store.phase()[i] = born;
      store.motion()[i] = spawn.fixed ? api::Motion::Static : motionOf(born);
      ids[k] = store.id()[i];
      members[k] = static_cast<uint32_t>(i);
    }
  });
  const std::vector<double> temperature =
      spawn.temperatures.empty() ? std::vector<double>(count, spawn.temperature) : spawn.temperatures;
  const std::vector<api::Phase> phase =
      spawn.phases.empty() ? std::vector<api::Phase>(count, spawn.phase) : spawn.phases;
  const auto setMass = [&] {
    inSlices(first, last, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        store.mass()[i] = static_cast<float>(m->phase.restDensity(store, i) * cell);
        store.velocity()[i].w = spawn.fixed ? 0 : 1 / store.mass()[i];
      }
    });
  };
  const auto setState = [&] {
    for (size_t i = first; i < last; ++i) {
      store.temperature()[i] = temperature[i - first];
      setShares(store, i, phase[i - first]);
    }
  };
  setState();
  setMass();
  if (!m->heat.initialise(store, first, last, temperature, phase)) setState();
  setMass();  // the model's fractions are the better ones
  inSlices(first, last,
           [&](size_t begin, size_t end) { m->phase.initialise(store, begin, end, !spawn.constraintSets.empty()); });
  for (size_t i = first; i < last && (spawn.fixed || spawn.held); ++i) {
    if (spawn.fixed) store.motion()[i] = api::Motion::Static;
    store.velocity()[i].w = 0;
  }
  m->motion.adopt(store, first, last, m->time);
  if (!spawn.constraintSets.empty()) m->tie(spawn.constraintSets, members);
  m->matterChanged(energyBefore);
  return ids;
}

void Solver::settle(std::span<const uint32_t> ids) {
  if (ids.empty()) return;
  m->configure();
  m->freshLists();
  const ParticleStore& store = m->store;
  std::vector<uint32_t> indices;
  for (const uint32_t id : ids) {
    const size_t i = store.indexOf(id);
    if (i < store.size() && (store.motion()[i] == api::Motion::Liquid || store.motion()[i] == api::Motion::Gas))
      indices.push_back(static_cast<uint32_t>(i));
  }
  m->density.handOver(m->store, m->neighbours, indices);
}

void Solver::release(std::span<const uint32_t> ids) {
  ParticleStore& store = m->store;
  for (const uint32_t id : ids) {
    const size_t i = store.indexOf(id);
    if (i < store.size()) store.velocity()[i].w = 1 / store.mass()[i];
  }
  m->structureChanged = true;
  m->lastGoodValid = false;
}

void Solver::hold(std::span<const Hold> bodies) {
  ParticleStore& store = m->store;
  for (size_t i = 0; i < store.size(); ++i) {
    const uint32_t body = store.body()[i];
    const Hold wanted = body < bodies.size() ? bodies[body] : Hold::AsItIs;
    api::Float4& velocity = store.velocity()[i];
    const bool held = velocity.w == 0;
    if (wanted == Hold::AsItIs || store.motion()[i] == api::Motion::Static || held == (wanted == Hold::Held)) continue;
    velocity = {0, 0, 0, held ? 1 / store.mass()[i] : 0};
    m->structureChanged = true;
    m->lastGoodValid = false;
  }
}

void Solver::remove(std::span<const uint32_t> ids) { extract(ids); }

ExtractedMatter Solver::extract(std::span<const uint32_t> ids) {
  m->configure();
  ParticleStore& store = m->store;
  const std::vector<uint32_t> indices = store.indicesOf(ids);
  if (indices.empty()) return {};
  ExtractedMatter extracted{store.copy(indices),
                            std::make_shared<const CopiedConstraints>(m->constraints.copy(store, indices))};
  const double before = m->heat.energy(store);
  m->constraints.removeParticles(store, indices);
  store.remove(indices);
  m->matterChanged(before);
  return extracted;
}

void Solver::putBack(const ExtractedMatter& matter) {
  if (matter.particles.id.empty()) return;
  m->configure();
  const double before = m->heat.energy(m->store);
  const size_t first = m->store.putBack(matter.particles);
  m->motion.putBack(m->store, first, m->store.size());
  m->constraints.putBack(m->store, *matter.constraints);
  m->matterChanged(before);
}

bool Solver::addHeat(std::span<double> joules) {
  if (joules.size() != m->store.size()) throw Error("heat for as many particles as there are is needed");
  m->configure();
  m->lastGoodValid = false;
  return m->heat.give(m->store, joules);
}

void Solver::addVelocities(std::span<const Vector3> change) {
  ParticleStore& store = m->store;
  if (change.size() != store.size()) throw Error("as many changes of velocity as particles are needed");
  m->lastGoodValid = false;
  for (size_t i = 0; i < change.size(); ++i) {
    api::Float4& velocity = store.velocity()[i];
    if (velocity.w > 0) assignTo(velocity, vectorOf(velocity) + change[i]);
  }
}

TieChange Solver::cut(std::span<const Blade> blades, std::span<const uint8_t> isSpared) {
  m->configure();
  m->holdLists();
  return m->tiesChanged(m->constraints.cut(m->store, m->neighbours, blades, isSpared));
}

TieChange Solver::weld(std::span<const Blade> balls, std::span<const uint8_t> isSpared) {
  m->configure();
  m->holdLists();
  return m->tiesChanged(m->constraints.weld(m->store, m->neighbours, balls, isSpared));
}

void Solver::undo(const TieChange& change) { m->changeTies(change, !change.made); }
void Solver::redo(const TieChange& change) { m->changeTies(change, change.made); }

void Solver::Impl::changeTies(const TieChange& change, bool made) {
  configure();
  holdLists();
  if (made)
    constraints.tie(store, neighbours, change);
  else
    constraints.sever(store, neighbours, change);
  tiesChanged(change);
}

StepReport Solver::step() {
  m->runFrame();
  return m->report;
}

ParticleStore& Solver::particles() { return m->store; }
const ParticleStore& Solver::particles() const { return m->store; }
size_t Solver::constraintCount() const { return m->constraints.count(); }
std::vector<uint32_t> Solver::pieces() const { return m->constraints.pieces(m->store.size()); }
double Solver::time() const { return m->time; }
double Solver::thermalTime() const { return m->thermalTime; }
uint64_t Solver::frame() const { return m->frame; }
const HeatLedger& Solver::heatLedger() const { return m->heat.ledger(); }
double Solver::thermalEnergy() const { return m->heat.energy(m->store); }
std::span<const double> Solver::thermalEnergies() const { return m->heat.energies(m->store); }
double Solver::latentHeat(size_t particle) const { return m->heat.latentHeat(m->store, particle); }
double Solver::heatOfFixed(uint32_t body) const {
  const std::span<const double> energies = thermalEnergies();
  double sum = 0;
  for (size_t i = 0; i < energies.size(); ++i) {
    if (m->store.body()[i] == body && m->store.motion()[i] == api::Motion::Static) sum += energies[i];
  }
  return sum;
}
double Solver::elasticEnergy() const { return m->constraints.energy(m->store); }

std::vector<Limit> Solver::limits() const {
  m->configure();
  std::vector<Limit> result;
  m->constraints.limits(m->store, result);
  m->viscosity.limits(m->store, m->time, result);
  m->rebound.limits(result);
  m->hovering.limits(result);
  const double asked = m->thermal.timeScale, delivered = m->heat.thermalTimeScaleDelivered();
  if (m->frame > 0 && delivered < asked) result.push_back({"solver.thermal_time_scale", asked, delivered, ""});
  if (m->overshot) result.push_back({"solver.thermal_cfl", m->thermal.cfl, 1, ""});
  if (const double gap = m->heat.narrowestGap(); gap > 0) result.push_back({kGapLimit, gap, m->settings.spacing, "m"});
  if (m->heat.opensEnergy()) {
    // Lost since the matter was last added, taken or put back by hand.
    if (const double open = m->openEnergy(); open != 0) result.push_back({kBalanceLimit, 0, open, "J"});
  }
  const double dt = m->settings.dt, excess = m->report.densityErrorMean;
  // Drops too few to speak for the solver (see StepFlag::Diverged) are reported here.
  const bool drops = excess > kDiverged && (m->report.flags & static_cast<StepFlags>(StepFlag::Diverged)) == 0;
  const bool squeezes = drops || m->motion.movesWithin(m->time - dt, dt) || m->contact.squeezedShare() > kSqueezedShare;
  if (excess > kSqueezed && squeezes)
    result.push_back({kSqueezeLimit, 0, excess, ""});
  else if (m->denseSeconds >= kDenseTime)
    result.push_back(denseLimit(m->askedSubsteps, excess));
  return result;
}

std::vector<PluginFault> Solver::drainFaults() { return m->drainFaults(); }

}  // namespace ps
