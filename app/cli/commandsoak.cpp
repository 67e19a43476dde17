// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--seconds", "S", "mechanical time of each run; without it 10"},
    {"--only", "ADDRESS", "soaks this parameter alone; may repeat, and the beginning of an address will do"},
    {"--list", "", "names the runs and does none"},
    kSet,
    kThreads,
    kIsa,
};

/// More particles than this many times the project's own are not soaked: a run would take hours.
constexpr double kMostGrowth = 4;
/// Part of a run before the slider moves, so that it meets matter in motion; part after which a run that is still bit
/// for bit the project's own one ends, for the scene does not use what was moved.
constexpr double kBefore = 0.05, kProof = 0.25;

struct Change {
  Address address;
  Value value;
};

struct Outcome {
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
      std::string_view rest = declaration.choices;
      while (!rest.empty()) {
        const std::string_view choice = rest.substr(0, rest.find('|'));
        values.emplace_back(std::string(choice));
        rest.remove_prefix(std::min(rest.size(), choice.size() + 1));
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

std::vector<Change> changesOf(const Project& project, const PluginRegistry& plugins,
                              const std::vector<std::string>& only) {
  std::vector<Change> changes;
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

double topSpeed(const ParticleStore& store) {
  double most = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    const api::Float4 v = store.velocity()[i];
    most = std::max(most, std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z));
  }
  return most;
}

void addLimits(Engine& engine, Outcome& outcome) {
  for (const Limit& limit : engine.solver().limits()) outcome.limits.push_back(limit.what);
}

/// One run; `change` is nullptr for the project as it is, whose `proof` others compare themselves with. Throws
/// InputError for a change that the scene refuses.
Outcome soak(const Project& project, PluginRegistry& plugins, const Change* change, double seconds, uint64_t proof) {
  Engine engine(project, plugins);
  Outcome outcome;
  double sum = 0;
  long frames = 0;
  const auto each = [&](const StepReport& step, const FrameStats&) {
    outcome.flags |= step.flags;
    if (outcome.message.empty()) outcome.message = step.message;
    if (step.flags != 0 && outcome.limits.empty()) addLimits(engine, outcome);  // what went on as it happened
    outcome.topSpeed = std::max(outcome.topSpeed, topSpeed(engine.solver().particles()));
    sum += step.totalMilliseconds;
    ++frames;
  };
  const auto run = [&](double time) {
    const double count = std::max(1.0, std::round(time / frameLength(engine.project())));
    return runFrames(engine, static_cast<long>(count), each);
  };
  bool whole = run(kBefore * seconds);
  if (whole && change && !engine.setParameter(change->address, change->value)) engine.reset();
  outcome.topSpeed = 0;
  const bool again = engine.solver().time() == 0;  // after a reset: as long as the run that it is compared with
  whole = whole && run((again ? kProof : kProof - kBefore) * seconds);
  outcome.proof = engine.solver().stateHash();
  outcome.unused = whole && change && outcome.proof == proof;
  whole = whole && (outcome.unused || run((1 - kProof) * seconds));
  if (!whole && interrupted()) throw Error("stopped");
  if (outcome.limits.empty()) addLimits(engine, outcome);
  outcome.milliseconds = sum / static_cast<double>(std::max(1L, frames));
  return outcome;
}

/// Why a flag is what the change asks for, or "" when it is a failure. A NaN, a plugin's fault and an open balance are
/// never asked for.
std::string explanation(const Project& project, const Outcome& outcome, const Change* change) {
  constexpr auto kAsked = static_cast<StepFlags>(StepFlag::LostParticle) | static_cast<StepFlags>(StepFlag::Diverged);
  if ((outcome.flags & ~kAsked) != 0 || !change) return {};
  const std::string& key = change->address.key;
  const bool lost = (outcome.flags & static_cast<StepFlags>(StepFlag::LostParticle)) != 0;
  const bool diverged = (outcome.flags & static_cast<StepFlags>(StepFlag::Diverged)) != 0;
  // Only who moves a body can ask it to leave no room, or to be squeezed by what it strikes.
  const auto counts = [&](const std::string& limit) {
    return limit != kSqueezeLimit || change->address.owner == Owner::Body;
  };
  const auto found = std::find_if(outcome.limits.begin(), outcome.limits.end(), counts);
  const std::string limit = found == outcome.limits.end() ? std::string() : *found;
  const bool closed = project.environment.walls.size() >= 6, coarse = change->address.owner == Owner::Solver;
  if (((diverged && !coarse) || (lost && closed)) && limit.empty()) return {};
  std::string why = diverged && coarse ? "coarser than the scene needs: " + key : limit;
  if (lost && !closed) why += std::string(why.empty() ? "" : "; ") + "the scene is open";
  return why;
}

/// One line of the printed table per run.
class Verdicts {
 public:
  explicit Verdicts(std::string project) : m_project(std::move(project)) {}

  void add(const Project& project, const Outcome& outcome, const Change* change) {
    std::string verdict = outcome.unused ? "not used here" : "fine";
    if (outcome.flags != 0) {
      const std::string why = explanation(project, outcome, change);
      verdict.clear();
      for (const std::string& flag : flagNames(outcome.flags)) verdict += (verdict.empty() ? "" : ", ") + flag;
      verdict = (why.empty() ? "FAILED: " : "asked for: ") + verdict + ": " + (why.empty() ? outcome.message : why);
      if (why.empty()) ++m_failed;
    }
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "%8.3g m/s  %6.1f ms", outcome.topSpeed, outcome.milliseconds);
    print(change, numbers, verdict);
  }
  void refuse(const Change& change, const std::string& why) { print(&change, "", "refused: " + why); }
  void skip(const Change& change, const std::string& why) { print(&change, "", "left out: " + why); }
  void fail(const Change* change, const std::string& why) {
    print(change, "", "FAILED: " + why);
    ++m_failed;
  }
  int failed() const { return m_failed; }

 private:
  void print(const Change* change, const char* numbers, const std::string& verdict) const {
    const std::string what = change ? change->address.text() + " = " + shown(change->value) : "as it is";
    std::printf("%-20s  %-52s  %22s  %s\n", m_project.c_str(), what.c_str(), numbers, verdict.c_str());
    std::fflush(stdout);
  }

  std::string m_project;
  int m_failed = 0;
};

std::string nameOf(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  return file.substr(0, file.rfind('.'));
}

/// "" or why a change is not run.
std::string whyLeftOut(const Project& project, const Change& change) {
  Project changed = project;
  if (ParameterSet* set = findSet(changed, change.address)) set->values[change.address.key] = change.value;
  const double count = particleCount(changed);
  if (count <= kMostGrowth * particleCount(project)) return {};
  return numberText(std::round(count)) + " particles";
}

int soakProject(const std::string& path, const Arguments& arguments) {
  auto plugins = std::make_unique<PluginRegistry>();
  const Project project = loadFor(arguments, path, *plugins);
  const double seconds = arguments.number("--seconds", 1e-3, 1e6).value_or(10);
  const std::vector<Change> changes = changesOf(project, *plugins, arguments.all("--only"));
  for (const std::string& start : arguments.all("--only")) {
    const bool any = std::any_of(changes.begin(), changes.end(),
                                 [&](const Change& change) { return change.address.text().starts_with(start); });
    if (!any) throw InputError(path + ": no slider begins with '" + start + "'; --list names them");
  }
  if (arguments.has("--list")) {
    for (const Change& change : changes) {
      std::printf("%s  %s = %s\n", nameOf(path).c_str(), change.address.text().c_str(), shown(change.value).c_str());
    }
    return 0;
  }
  Verdicts verdicts(nameOf(path));
  uint64_t proof = 0;
  const auto attempt = [&](const Change* change) {
    try {
      const Outcome outcome = soak(project, *plugins, change, seconds, proof);
      // A plugin that has thrown is put aside for good; the next run shall have it.
      if (outcome.flags & static_cast<StepFlags>(StepFlag::PluginFault)) plugins = std::make_unique<PluginRegistry>();
      if (!change) proof = outcome.proof;
      verdicts.add(project, outcome, change);
    } catch (const InputError& error) {
      change ? verdicts.refuse(*change, error.what()) : verdicts.fail(change, error.what());
    } catch (const std::exception& error) {
      if (interrupted()) throw;
      verdicts.fail(change, error.what());
    }
  };
  attempt(nullptr);
  for (const Change& change : changes) {
    const std::string problem = problemWith(project, plugins.get(), change.address, change.value);
    const std::string reason = problem.empty() ? whyLeftOut(project, change) : std::string();
    if (!problem.empty()) {
      verdicts.refuse(change, problem);
    } else if (!reason.empty()) {
      verdicts.skip(change, reason);
    } else {
      attempt(&change);
    }
  }
  return verdicts.failed();
}

}  // namespace

std::string soakHelp() {
  return "phasesketch-cli soak PROJECT... [options]\n\nRuns each project as it is, and again with each of its sliders "
         "moved to either end of its range while it runs,\none at a time. Prints one line per run: what was moved, the "
         "highest speed of a particle, the mean length of a\nframe, and whether flags were raised. A slider that has "
         "changed nothing in a quarter of the run is not used "
         "by the scene\nand ends there. Exit code 1 when a run set a flag that its slider does not explain.\n\n" +
         optionHelp(kOptions);
}

int soakCommand(CommandArguments given) {
  const Arguments arguments(given, kOptions);
  if (arguments.positional().empty()) throw InputError("which project? --help says more");
  applyMachineOptions(arguments);
  int failed = 0;
  for (const std::string& path : arguments.positional()) failed += soakProject(path, arguments);
  if (failed == 0) return kFine;
  throw Error(counted(static_cast<size_t>(failed), "run") + " failed");
}

}  // namespace ps::cli
