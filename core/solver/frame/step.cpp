// SPDX-License-Identifier: Apache-2.0
// One frame: substepped XPBD (Macklin et al. 2019), then heat, then phase changes, which edit the structure. Every loop
// writes only its own particle, so that the result does not depend on the number of threads.
#include "core/base/parallel.h"
#include "core/solver/contact/handover.h"
#include "core/solver/frame/solverimpl.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Liquid on a sheet outweighs it many times, and must not press it apart before its springs have answered.
constexpr int kSheetPasses = 4;
constexpr double kLeastLiquid = 0.01;  ///< share of what moves, below which the mean says nothing of the solver
/// Spacings that a tool may go in a substep, and how many times the substeps that were asked for a frame may take so
/// that it goes no farther: beyond that it goes more slowly.
constexpr double kLeadStep = 1;
constexpr int kMostTimes = 8;
/// How far the heat balance may be open: a share of what was exchanged, and of the whole for rounding.
constexpr double kOpenExchange = 1e-6, kOpenRounding = 1e-11;

using Part = MechanicalRecord::Part;

std::string bodyText(const std::vector<std::string>& names, uint32_t body) {
  return body < names.size() ? "'" + names[body] + "'" : "body " + std::to_string(body);
}

}  // namespace

Solver::Impl::Impl() {
  Reactions& told = forces.reactions();
  const auto tell = [&](auto&... stages) { (stages.tell(told), ...); };
  tell(density, viscosity, wallStage, shapeContact, swept, contact, impacts, wet, sheets, rigid, rebound);
}

Vector3 Solver::Impl::momentum() {
  return sumOfChunks(weight, store.size(), grain::kParticles, [&](size_t first, size_t last) {
    Vector3 sum;
    for (size_t i = first; i < last; ++i) {
      if (store.velocity()[i].w > 0) sum += double{store.mass()[i]} * vectorOf(store.velocity()[i]);
    }
    return sum;
  });
}

Vector3 Solver::Impl::momentumOfHanging() {
  return sumOfChunks(weight, hanging.size(), grain::kParticles, [&](size_t first, size_t last) {
    Vector3 sum;
    for (size_t k = first; k < last; ++k)
      sum += double{store.mass()[hanging[k]]} * vectorOf(store.velocity()[hanging[k]]);
    return sum;
  });
}

Vector3 Solver::Impl::displacementOfHanging() {
  return sumOfChunks(weight, hanging.size(), grain::kParticles, [&](size_t first, size_t last) {
    Vector3 sum;
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = hanging[k];
      sum += double{store.mass()[i]} * (vectorOf(store.position()[i]) - vectorOf(store.previous()[i]));
    }
    return sum;
  });
}

template <class Call>
void Solver::Impl::structure(Call&& call, double dt) {
  timed(Stage::Structure, [&] {
    const Vector3 before = displacementOfHanging();
    forces.beforeTies(store, hanging, 1 / dt);
    call();
    forces.afterTies(store, hanging, 1 / dt);
    external.add(1 / dt * (displacementOfHanging() - before));
  });
}

void Solver::Impl::findThinSolids() {
  const std::span<const uint8_t> thin = constraints.thinBodies();
  thinSolids.clear();
  if (std::find(thin.begin(), thin.end(), uint8_t{1}) == thin.end()) return;
  findIndices(store.size(), thinSolids, [&](size_t i) {
    const uint32_t body = store.body()[i];
    return store.motion()[i] == api::Motion::Solid && body < thin.size() && thin[body] != 0;
  });
}

std::string Solver::Impl::describe(size_t i) const {
  return "particle " + std::to_string(store.id()[i]) + " of " + bodyText(bodyNames, store.body()[i]);
}

void Solver::Impl::raise(StepFlag flag, const std::string& message) {
  report.flags |= static_cast<StepFlags>(flag);
  if (!report.message.empty()) report.message += "; ";
  report.message += message;
}

/// A tool that a hand leads fast takes more of them in a frame: where it went farther in one, what it strikes would be
/// pressed through itself before its ties have answered, and fly apart.
void Solver::Impl::chooseSubsteps() {
  const double way = motion.nextWay(settings.dt);
  int times = 1;
  while (times < kMostTimes && way > times * askedSubsteps * kLeadStep * settings.spacing) times *= 2;
  if (settings.substeps == times * askedSubsteps) return;
  settings.substeps = times * askedSubsteps;
  configured = false;
}

void Solver::Impl::startLeads() {
  motion.startFrame(settings.substeps, settings.dt, settings.substeps * kLeadStep * settings.spacing);
}

void Solver::Impl::runFrame() {
  report = {};
  const StageClock clock;
  chooseSubsteps();
  configure();
  const bool good = store.size() == 0 || (!rejectIfNotFinite() && advance());
  if (good) {
    ++frame;
    time += settings.dt;
    thermalTime += settings.dt * std::min(thermal.timeScale, heat.thermalTimeScaleDelivered());
  }
  report.faults = drainFaults();
  for (const PluginFault& fault : report.faults) {
    raise(StepFlag::PluginFault, "plugin '" + fault.plugin + "': " + fault.what);
  }
  report.totalMilliseconds = clock.passed();
  report.totalSerialMilliseconds = clock.alone();
}

/// False when the frame has been taken back.
bool Solver::Impl::advance() {
  keepLastGood();
  constraints.setTime(time);
  startLeads();
  heat.setClock(time, thermalTime);
  timed(Stage::Neighbours, [&] { freshLists(); });
  constraints.setPasses(static_cast<uint32_t>(settings.iterations * structurePasses()));
  external.drain();
  if (!anchorsKnown) forces.findAnchors(store, pieceOf, hanging);
  anchorsKnown = true;
  forces.reactions().setStep(settings.dt / settings.substeps);
  forces.begin(store);
  balance.begin(store, vectorOf(settings.gravity));
  density.startPressure();
  contact.startFrame();
  report.momentum.start = double3Of(momentum());
  gas.setAir(heat.airTemperature());
  timed(Stage::Phase, [&] { gas.measure(store, neighbours); });
  timed(Stage::Viscosity, [&] { viscosity.refresh(store, neighbours, density); });
  for (int s = 0; s < settings.substeps; ++s) {
    substep(static_cast<uint32_t>(s));
    if (rejectIfNotFinite() || rejectIfLeapt()) return false;
  }
  checkBounds();
  report.momentum.end = double3Of(momentum());
  report.momentum.external = double3Of(external.drain());
  report.mechanical = balance.end(forces.given().torque);
  forces.end(store, vectorOf(settings.gravity), settings.dt);
  measureDensity();
  bool exchanged = false;
  timed(Stage::Heat, [&] { exchanged = exchangeHeat(); });
  if (!exchanged || rejectIfNotFinite() || rejectIfUnphysical()) return false;
  closeFrame();
  return true;
}

std::vector<PluginFault> Solver::Impl::drainFaults() {
  std::vector<PluginFault> faults = constraints.drainFaults();
  for (PluginFault& fault : heat.drainSourceFaults()) faults.push_back(std::move(fault));
  if (std::optional<std::string> fault = heat.takeFault()) faults.push_back({modelName, std::move(*fault)});
  if (!faults.empty()) structureChanged = true;
  return faults;
}

/// As the frame leaves it, while the near lists of the last substep are there: heat, which moves nothing, needs their
/// room.
void Solver::Impl::measureDensity() {
  timed(Stage::Neighbours, [&] {
    if (!neighbours.stale(store)) return;
    neighbours.build(store);
    listsChanged(false);
  });
  timed(Stage::Density, [&] { densityError = density.measure(store, neighbours, bounds); });
}

/// Of a frame that stands.
void Solver::Impl::judgeDensity() {
  const DensityError& error = densityError;
  report.densityErrorMean = error.mean;
  report.densityErrorMax = error.max;
  denseSeconds = error.mean > kDense ? denseSeconds + settings.dt : 0;
  report.viscosityIterations = viscosity.iterations();
  // A few drops in soft matter that is being squeezed are as dense as it is, which no solver could mend.
  const api::Motion* motions = store.motion();
  const auto moving = [&] { return store.size() - std::count(motions, motions + store.size(), api::Motion::Static); };
  if (error.mean > kDiverged && double(error.liquids) >= kLeastLiquid * double(moving())) {
    const float* c = store.densityError();
    const size_t worst = static_cast<size_t>(std::max_element(c, c + store.size()) - c);
    const auto percent = [](double share) { return std::to_string(static_cast<int>(100 * share)) + " %"; };
    raise(StepFlag::Diverged, bodyText(bodyNames, store.body()[worst]) + ": density error " + percent(c[worst]) +
                                  " where it is worst, " + percent(error.mean) + " in the mean of all liquid");
  }
}

void Solver::Impl::closeFrame() {
  judgeDensity();
  timed(Stage::Contact, [&] {
    hovering.observe({store, neighbours, pieceOf, pieces, density.wetSolids(), hanging, constraints.thinBodies()});
  });
  timed(Stage::Phase, [&] { changePhases(); });
  timed(Stage::Structure, [&] { structureChanged = constraints.topology(store, neighbours) || structureChanged; });
  checkEnergy();
}

void Solver::Impl::predict(uint32_t index, double dt) {
  motion.advance(store.period(), time + index * dt, dt);
  weight.start(chunkCount(store.size(), grain::kParticles));
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    api::Float4 *position = store.position(), *previous = store.previous(), *velocity = store.velocity();
    Vector3 before, after;
    const float keep = static_cast<float>(1 / (1 + settings.damping * dt)), step = static_cast<float>(dt);
    for (size_t i = first; i < last; ++i) {
      previous[i] = position[i];
      if (velocity[i].w > 0) before += double{store.mass()[i]} * vectorOf(velocity[i]);
      if (velocity[i].w > 0) velocity[i].x *= keep, velocity[i].y *= keep, velocity[i].z *= keep;
    }
    gas.apply(store, first, last, dt);
    for (size_t i = first; i < last; ++i) {
      if (velocity[i].w > 0) after += double{store.mass()[i]} * vectorOf(velocity[i]);
    }
    weight.add(first / grain::kParticles, 1, after - before);
    for (size_t i = first; i < last; ++i) {  // what is fixed moves too, at the velocity it was given
      position[i].x += step * velocity[i].x;
      position[i].y += step * velocity[i].y;
      position[i].z += step * velocity[i].z;
    }
    motion.lead(store, first, last);
  });
  external.add(weight.total());
}

void Solver::Impl::velocities(double dt) {
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    const api::Float4 *position = store.position(), *previous = store.previous();
    api::Float4* velocity = store.velocity();
    const float rate = static_cast<float>(1 / dt), step = static_cast<float>(dt);
    for (size_t i = first; i < last; ++i) {
      if (velocity[i].w == 0) continue;
      const api::Float4 &x = position[i], &from = previous[i];
      api::Float4& v = velocity[i];
      // Nothing has touched it: its velocity is what it was, and not the difference of two rounded places. Plugins of
      // groups count on that difference.
      const bool free = x.x == from.x + step * v.x && x.y == from.y + step * v.y && x.z == from.z + step * v.z;
      if (free && grouped[i] == 0) continue;
      v.x = rate * (x.x - from.x);
      v.y = rate * (x.y - from.y);
      v.z = rate * (x.z - from.z);
    }
  });
}

/// Passes over structure in an iteration.
int Solver::Impl::structurePasses() const {
  const int least = settings.iterations == 1 ? constraints.leastPasses() : 1;
  return std::max(sheets.any() ? kSheetPasses : 1, least);
}

/// What holds matter together and apart, in turns, until positions are those of the substep's end.
void Solver::Impl::iterate(uint32_t index, double dt) {
  const int passes = structurePasses();
  for (int iteration = 0; iteration < settings.iterations; ++iteration) {
    const uint32_t it = static_cast<uint32_t>(iteration);
    for (int pass = 0; pass < passes; ++pass) {
      structure([&] { constraints.projectStructure(store, index, it); }, dt);
      balance.mark(store, Part::Structure, 1 / dt);
      if (it == 0 && pass == 0 && constraints.count() > 0) noteLeaps(dt);
      timed(Stage::Contact, [&] { sheets.project(store); });
      balance.mark(store, Part::Contact, 1 / dt);
    }
    timed(Stage::Density, [&] { density.project(store, neighbours, iteration); });
    balance.mark(store, Part::Pressure, 1 / dt);
    if (constraints.gathers()) {
      structure([&] { constraints.projectNeighbours(store, neighbours, index, it); }, dt);
      balance.mark(store, Part::Structure, 1 / dt);
      if (it == 0) noteLeaps(dt);
    }
    timed(Stage::Contact, [&] {
      contact.project(store);
      wet.project(store);
      wallStage.projectNear(store);
      shapeContact.projectNear(store, shapes);
    });
    balance.mark(store, Part::Contact, 1 / dt);
    structure([&] { constraints.projectGroups(store, index, it); }, dt);
    balance.mark(store, Part::Structure, 1 / dt);
    if (it == 0 && constraints.groups()) noteLeaps(dt);
    timed(Stage::Contact, [&] { rigid.project(store); });
    balance.mark(store, Part::Contact, 1 / dt);
  }
}

void Solver::Impl::substep(uint32_t index) {
  const double dt = settings.dt / settings.substeps;
  timed(Stage::Contact, [&] {
    predict(index, dt);
    balance.mark(store, Part::Surroundings, 0);
    balance.mark(store, Part::Scheme, 1 / dt);  // places are rounded
    impacts.sweep(store, neighbours, {constraints, pieceOf, rigid.members()});
    wallStage.project(store);
    shapes.advance(store);
    shapeContact.sweep(store, shapes);
  });
  balance.mark(store, Part::Contact, 1 / dt);
  timed(Stage::Neighbours, [&] {
    if (neighbours.stale(store)) {
      neighbours.build(store);
      listsChanged(false);
    }
  });
  timed(Stage::Contact, [&] {
    shapes.follow(store, neighbours);
    rigid.strike(store);
  });
  balance.mark(store, Part::Impact, 1 / dt);
  structure([&] { constraints.predict(store, index); }, dt);
  balance.mark(store, Part::Structure, 1 / dt);
  timed(Stage::Contact, [&] {
    rigid.begin(store);
    contact.begin(store);
    impacts.collect(store, contact, constraints, rigid.members());
    rebound.meet(store, {constraints, pieceOf, pieces, rigid}, impacts);
  });
  balance.mark(store, Part::Impact, 1 / dt);
  structure([&] { constraints.carry(store, index); }, dt);
  balance.mark(store, Part::Structure, 1 / dt);
  iterate(index, dt);
  timed(Stage::Contact, [&] {
    wallStage.project(store);
    swept.apply(store, neighbours, wallStage, contact, constraints.graph(store.size()), rigid.members());
    shapeContact.finish(store, shapes, wallStage);
    external.add(1 / dt * rigid.hold(store, swept.held(), swept.heldBy()));
    external.add(1 / dt * rigid.keepInside(store));
    balance.mark(store, Part::Contact, 1 / dt);
    pieceSpin.read(store, contact.couple(), dt);
    velocities(dt);
    pieceSpin.apply(store);
    balance.mark(store, Part::Scheme, 0);
    bookContact(dt);
  });
  changeVelocities(index, dt);
}

void Solver::Impl::changeVelocities(uint32_t index, double dt) {
  timed(Stage::Viscosity, [&] { viscosity.apply(store, neighbours, density); });
  balance.mark(store, Part::Viscosity, 0);
  timed(Stage::Structure, [&] {
    const Vector3 before = momentumOfHanging();
    forces.beforeTies(store, hanging, 0);
    constraints.deriveVelocities(store, index);
    forces.afterTies(store, hanging, 0);
    external.add(momentumOfHanging() - before);
  });
  balance.mark(store, Part::Structure, 0);
  timed(Stage::Contact, [&] {
    impacts.bounce(store);
    rigid.bounce(store);
    rebound.part(store, {constraints, pieceOf, pieces, rigid});
  });
  balance.mark(store, Part::Impact, 0);
  for (ExternalImpulse* impulse :
       {&viscosity.externalImpulse(), &impacts.externalImpulse(), &rebound.externalImpulse(), &rigid.externalImpulse()})
    external.add(impulse->drain());
  timed(Stage::Density, [&] { handover::decay(store, dt); });
}

/// What walls and fixed particles moved in this substep, as impulse.
void Solver::Impl::bookContact(double dt) {
  Vector3 moved = rigid.pushed();
  rigid.tellPushed(store);
  for (ExternalImpulse* impulse :
       {&wallStage.externalImpulse(), &contact.externalImpulse(), &wet.externalImpulse(), &sheets.externalImpulse(),
        &density.externalImpulse(), &swept.externalImpulse(), &shapeContact.externalImpulse()})
    moved += impulse->drain();
  external.add(1 / dt * moved);
}

bool Solver::Impl::exchangeHeat() {
  if (heat.advance(store, neighbours, settings.dt, frame, &density.lendRoom())) return true;
  backToLastGood();
  return false;
}

void Solver::Impl::changePhases() {
  melted.clear();
  if (phase.update(store, melted)) structureChanged = true;
  if (melted.empty()) return;
  shapes.refreshLists(store, neighbours, false);
  density.refresh(store, neighbours);
  density.handOver(store, neighbours, melted);
  structureChanged = true;
}

double Solver::Impl::openEnergy() {
  const double energy = heat.energy(store), open = energy - heat.ledger().net() - energyOffset;
  if (!heat.works()) return 0;
  const double allowed = kOpenExchange * heat.ledger().exchanged + kOpenRounding * std::abs(energy) + 1e-9;
  return std::abs(open) > allowed ? open : 0;
}

void Solver::Impl::checkEnergy() {
  const double open = openEnergy();
  if (open == 0 || heat.opensEnergy()) return;
  raise(StepFlag::EnergyOpen, "heat balance open by " + std::to_string(open) + " J of " +
                                  std::to_string(heat.ledger().exchanged) + " J exchanged");
}

}  // namespace ps
