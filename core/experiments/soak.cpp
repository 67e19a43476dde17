// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/soak.h"

#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/filling.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// More particles than this many times the project's own are not soaked: a run would take hours.
constexpr double kMostGrowth = 4;
/// Part of a run before the slider moves, so that it meets matter in motion; part after which a run that is still bit
/// for bit the project's own one ends, for the scene does not use what was moved.
constexpr double kBefore = 0.05, kProof = 0.25;

struct SoakOutcome {
  StepFlags flags = 0;
  std::string message;
  double topSpeed = 0;  ///< m/s, since the change
  std::vector<std::string> limits;
  double milliseconds = 0;  ///< mean of a frame
  uint64_t proof = 0;       ///< hash of the state at kProof
  bool unused = false;      ///< the change has changed nothing until then
};

std::string shown(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* toggle = std::get_if<bool>(&value)) return *toggle ? "on" : "off";
  if (const auto* number = std::get_if<double>(&value)) return numberText(*number);
  return numberText(std::get<Response>(value).at(293.15));
}

/// Both ends of a slider, the other state of a toggle, each other choice; nothing for what is only seen.
std::vector<Value> endsOf(const api::ParameterDeclaration& declaration, const Value& present) {
  std::vector<Value> values;
  if (std::string_view(declaration.key).starts_with("color_")) return values;
  switch (declaration.kind) {
    case api::ParameterKind::Toggle:
      values = {!std::get<bool>(present)};
      break;
    case api::ParameterKind::Choice: {
      std::string_view remaining = declaration.choices;
      while (!remaining.empty()) {
        const std::string_view choice = remaining.substr(0, remaining.find('|'));
        values.emplace_back(std::string(choice));
        remaining.remove_prefix(std::min(remaining.size(), choice.size() + 1));
      }
      std::erase(values, present);
      break;
    }
    default:
      for (const double end : {declaration.minimum, declaration.maximum}) {
        const Value value = conformed(Value(end), declaration);
        if (!(value == present)) values.push_back(value);
      }
  }
  return values;
}

double topSpeed(const ParticleStore& store) {
  double most = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    const api::Float4 v = store.velocity()[i];
    most = std::max(most, std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z));
  }
  return most;
}

void addLimits(Engine& engine, SoakOutcome& outcome) {
  for (const Limit& limit : engine.limits()) outcome.limits.push_back(limit.what);
}

/// One run; `change` is nullptr for the project as it is, whose `proof` others compare themselves with. Throws
/// InputError for a change that the scene refuses.
SoakOutcome soak(const Project& project, PluginRegistry& plugins, const SliderChange* change, double seconds,
                 uint64_t proof, const StopTest& stop) {
  Engine engine(project, plugins);
  SoakOutcome outcome;
  double sum = 0;
  long frames = 0;
  const auto each = [&](const StepReport& step, const FrameStats&) {
    outcome.flags |= step.flags;
    if (outcome.message.empty()) outcome.message = step.message;
    if (step.flags != 0 && outcome.limits.empty()) addLimits(engine, outcome);  // what went on as it happened
    outcome.topSpeed = std::max(outcome.topSpeed, topSpeed(engine.particles()));
    sum += step.totalMilliseconds;
    ++frames;
  };
  const auto run = [&](double time) {
    const double count = std::max(1.0, std::round(time / frameLength(engine.project())));
    return runFrames(engine, static_cast<long>(count), each, stop);
  };
  bool whole = run(kBefore * seconds);
  if (whole && change && !engine.setParameter(change->address, change->value)) engine.reset();
  outcome.topSpeed = 0;
  const bool again = engine.solver().time() == 0;  // after a reset: as long as the run that it is compared with
  whole = whole && run((again ? kProof : kProof - kBefore) * seconds);
  outcome.proof = engine.stateHash();
  outcome.unused = whole && change && outcome.proof == proof;
  whole = whole && (outcome.unused || run((1 - kProof) * seconds));
  if (!whole && stop && stop()) throw Error("stopped");
  if (outcome.limits.empty()) addLimits(engine, outcome);
  outcome.milliseconds = sum / static_cast<double>(std::max(1L, frames));
  return outcome;
}

/// Why a flag is what the change asks for, or "" when it is a failure. A NaN, a plugin's fault and an open balance are
/// never asked for.
std::string explanation(const Project& project, const SoakOutcome& outcome, const SliderChange* change) {
  constexpr auto kAsked = static_cast<StepFlags>(StepFlag::LostParticle) | static_cast<StepFlags>(StepFlag::Diverged);
  if ((outcome.flags & ~kAsked) != 0 || !change) return {};
  const std::string& key = change->address.key;
  if (change->address.owner == Owner::Wall && (key == "shape" || key == "matter" || key == "radius"))
    return "the wall comes to stand where matter is: " + key;
  const bool lost = (outcome.flags & static_cast<StepFlags>(StepFlag::LostParticle)) != 0;
  const bool diverged = (outcome.flags & static_cast<StepFlags>(StepFlag::Diverged)) != 0;
  // Only who moves a body can ask it to leave no room, or to be squeezed by what it strikes; nothing moves by
  // radiation, nor by matter that is there from the start.
  const auto counts = [&](const std::string& limit) {
    return limit != kGapLimit && limit != kFillLimit &&
           (limit != kSqueezeLimit || change->address.owner == Owner::Body);
  };
  const auto found = std::find_if(outcome.limits.begin(), outcome.limits.end(), counts);
  const std::string limit = found == outcome.limits.end() ? std::string() : *found;
  const bool closed = project.environment.walls.size() >= 6, coarse = change->address.owner == Owner::Solver;
  if (((diverged && !coarse) || (lost && closed)) && limit.empty()) return {};
  std::string why = diverged && coarse ? "coarser than the scene needs: " + key : limit;
  if (lost && !closed) why += std::string(why.empty() ? "" : "; ") + "the scene is open";
  return why;
}

/// "" or why a change is not run.
std::string whyLeftOut(const Project& project, const SliderChange& change) {
  Project changed = project;
  if (ParameterSet* set = findSet(changed, change.address)) set->values[change.address.key] = change.value;
  const double count = particleCount(changed);
  if (count <= kMostGrowth * particleCount(project)) return {};
  return numberText(std::round(count)) + " particles";
}

/// "fine", or the flags with why they are asked for or what they say.
SoakVerdict verdictOf(const Project& project, const SoakOutcome& outcome, const SliderChange* change) {
  SoakVerdict verdict{
      change, true, false, outcome.topSpeed, outcome.milliseconds, outcome.unused ? "not used here" : "fine"};
  if (outcome.flags == 0) return verdict;
  const std::string why = explanation(project, outcome, change);
  std::string flags;
  for (const std::string& flag : flagNames(outcome.flags)) flags += (flags.empty() ? "" : ", ") + flag;
  verdict.failed = why.empty();
  verdict.words = (why.empty() ? "FAILED: " : "asked for: ") + flags + ": " + (why.empty() ? outcome.message : why);
  return verdict;
}

SoakVerdict notRun(const SliderChange* change, const std::string& words, bool failed = false) {
  return {change, false, failed, 0, 0, words};
}

}  // namespace

std::string SliderChange::text() const { return address.text() + " = " + shown(value); }

std::vector<SliderChange> sliderChanges(const Project& project, const PluginRegistry& plugins,
                                        const std::vector<std::string>& only) {
  std::vector<SliderChange> changes;
  for (const Address& address : allAddresses(project, &plugins)) {
    const std::string text = address.text();
    const bool chosen = only.empty() || std::any_of(only.begin(), only.end(),
                                                    [&](const std::string& start) { return text.starts_with(start); });
    const bool edit =
        (address.owner == Owner::Body && (address.key == kStructureKey || address.key == kBodyMaterialKey)) ||
        !adhesionPartner(address).empty();
    if (!chosen || edit) continue;  // an edit of the document acts on no run
    const api::ParameterDeclaration* declaration = declarationOf(project, &plugins, address);
    for (Value& value : endsOf(*declaration, valueAt(project, &plugins, address))) {
      changes.push_back({address, std::move(value)});
    }
  }
  return changes;
}

void soakProject(Project project, std::unique_ptr<PluginRegistry>& plugins, const std::vector<SliderChange>& changes,
                 double seconds, const StopTest& stop, const SoakVisitor& each) {
  project.state = nullptr;  // a reset, which a slider may ask for, would lead elsewhere
  uint64_t proof = 0;
  const auto attempt = [&](const SliderChange* change) {
    try {
      const SoakOutcome outcome = soak(project, *plugins, change, seconds, proof, stop);
      // A plugin that has thrown is put aside for good; the next run shall have it.
      if (outcome.flags & static_cast<StepFlags>(StepFlag::PluginFault)) plugins = std::make_unique<PluginRegistry>();
      if (!change) proof = outcome.proof;
      return verdictOf(project, outcome, change);
    } catch (const InputError& error) {
      return notRun(change, (change ? "refused: " : "FAILED: ") + std::string(error.what()), !change);
    } catch (const std::exception& error) {
      if (stop && stop()) throw;
      return notRun(change, std::string("FAILED: ") + error.what(), true);
    }
  };
  each(attempt(nullptr));
  for (const SliderChange& change : changes) {
    const std::string problem = problemWith(project, plugins.get(), change.address, change.value);
    const std::string reason = problem.empty() ? whyLeftOut(project, change) : std::string();
    if (!problem.empty()) {
      each(notRun(&change, "refused: " + problem));
    } else if (!reason.empty()) {
      each(notRun(&change, "left out: " + reason));
    } else {
      each(attempt(&change));
    }
  }
}

}  // namespace ps
