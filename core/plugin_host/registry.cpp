// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/registry.h"

#include "core/base/error.h"
#include "core/plugin_host/crashwatch.h"
#include "core/plugin_host/hostservices.h"
#include "core/plugin_host/materialjson.h"
#include "core/plugin_host/pluginloader.h"
#include "core/plugin_host/pluginmetadata.h"
#include "core/plugin_host/pluginpaths.h"
#include "core/plugin_host/pluginscan.h"
#include "core/plugin_host/quarantine.h"

#include <QDir>
#include <QFileInfo>
#include <QString>

#include <algorithm>
#include <functional>
#include <map>
#include <mutex>
#include <tuple>

namespace ps {

const char* pluginKindName(PluginKind kind) {
  switch (kind) {
    case PluginKind::Material:
      return "material";
    case PluginKind::Constraint:
      return "constraint";
    case PluginKind::Thermal:
      return "thermal";
    case PluginKind::HeatSource:
      return "heat_source";
    case PluginKind::Brush:
      return "brush";
  }
  return "";
}

const char* pluginStateName(PluginInfo::State state) {
  switch (state) {
    case PluginInfo::State::Loaded:
      return "loaded";
    case PluginInfo::State::Refused:
      return "refused";
    case PluginInfo::State::Quarantined:
      return "quarantined";
  }
  return "";
}

namespace {

/// A file whose metadata are sound.
struct Candidate {
  PluginInfo info;
  size_t directory = 0;  ///< index of its directory: higher ones take precedence
  bool shipped = false;  ///< came with the program
  Material material;     ///< of JSON files
};

bool before(const PluginInfo& a, const PluginInfo& b) {
  if (a.id.empty() != b.id.empty()) return b.id.empty();
  return std::tie(a.id, a.path) < std::tie(b.id, b.path);
}

std::string quarantined(const PluginInfo& info, const std::string& why) {
  return info.path + ": " + why +
         ", so it is not loaded any more; try it again with \"phasesketch-cli plugins --allow " + info.id +
         "\" or install another version";
}

bool sameMaterial(const Material& a, const Material& b) {
  const auto sameSource = [](const auto& one, const auto& other) {
    return one.first == other.first && one.second.source == other.second.source &&
           one.second.grade == other.second.grade;
  };
  return a.label == b.label && a.properties == b.properties && a.adheresTo == b.adheresTo &&
         std::equal(a.provenance.begin(), a.provenance.end(), b.provenance.begin(), b.provenance.end(), sameSource);
}

std::string nameOf(const PluginInfo& info) {
  return info.version.empty() ? info.path : "version " + info.version + " in " + info.path;
}

}  // namespace

// Infos change only by fault(), which another thread may call while somebody reads plugins(): it publishes a changed
// copy and keeps the old ones, so that references stay good.
struct PluginRegistry::Impl {
  explicit Impl(const Options& options) : patience(options.patience), state(stateDirectory()), quarantine(state) {
    scan(pluginDirectories(options));
    forgiveShipped();
    if (options.scans) tryUnknown();
    watchForCrashes(quarantine);
    for (auto& [id, list] : candidates) {
      chooseStandard(list);
      loadBest(list);
    }
    accuseNobodyAtExit();
    candidates.clear();
    offerMaterials();
    std::sort(found.begin(), found.end(), before);
    generations.push_back(std::make_unique<const std::vector<PluginInfo>>(std::move(found)));
  }

  ~Impl() {
    const std::lock_guard lock(installed->mutex);
    installed->byId.clear();
  }

  void scan(const std::vector<PluginDirectory>& directories);
  void read(const std::string& path, size_t directory, bool own);
  void forgiveShipped();
  void tryUnknown();
  void note(const PluginInfo& info, const ScanVerdict& verdict);
  void chooseStandard(const std::vector<Candidate>& list);
  void loadBest(std::vector<Candidate>& list);
  bool load(Candidate& candidate);
  void markFault(const std::string& id, const std::string& message);
  void publish(const std::string& id, PluginInfo::State from, const std::function<void(PluginInfo&)>& change);
  const LoadedPlugin* get(const std::string& id) const {
    const std::lock_guard lock(mutex);
    const auto it = loaded.find(id);
    return it == loaded.end() || faulted.contains(id) ? nullptr : &it->second;
  }

  /// What is offered of one that is loaded.
  const Material* materialOf(const std::string& id) const {
    const LoadedPlugin* plugin = get(id);
    if (!plugin || plugin->material.id.empty()) return nullptr;
    const std::lock_guard lock(mutex);
    const auto again = reread.find(id);
    return again == reread.end() ? &plugin->material : again->second.back().get();
  }

  void offerMaterials();

  std::shared_ptr<InstalledMaterials> installed = std::make_shared<InstalledMaterials>();
  const double patience;
  std::string state;
  Quarantine quarantine;
  std::map<std::string, std::vector<Candidate>> candidates;
  std::map<PluginKind, std::pair<size_t, std::string>>
      standards;  ///< directory and id; unchanged after the constructor
  std::vector<PluginInfo> found;
  std::map<std::string, LoadedPlugin> loaded;  ///< unchanged after the constructor

  mutable std::mutex mutex;  ///< guards what follows, and the quarantine
  std::map<std::string, std::string> faulted;
  std::map<std::string, std::vector<std::unique_ptr<const Material>>> reread;  ///< the last of them is offered
  std::vector<std::unique_ptr<const std::vector<PluginInfo>>> generations;
};

void PluginRegistry::Impl::scan(const std::vector<PluginDirectory>& directories) {
  for (size_t d = 0; d < directories.size(); ++d) {
    const QDir directory(QString::fromStdString(directories[d].path));
    if (!directory.exists()) {
      if (!directories[d].asked) continue;
      PluginInfo missing;
      missing.path = missing.label = directories[d].path;
      const bool exists = QFileInfo::exists(directory.path());
      missing.problem = directories[d].path + (exists ? ": is not a folder" : ": there is no such folder") +
                        "; correct " + directories[d].origin;
      found.push_back(std::move(missing));
      continue;
    }
    const QStringList names{QStringLiteral("*.so"), QStringLiteral("*.json")};
    for (const QString& name : directory.entryList(names, QDir::Files, QDir::Name | QDir::LocaleAware))
      read(directory.filePath(name).toStdString(), d, directories[d].own);
  }
}

void PluginRegistry::Impl::read(const std::string& path, size_t directory, bool own) {
  Candidate candidate;
  candidate.directory = directory;
  if (path.ends_with(".json")) {
    candidate.material = readMaterialFile(path, candidate.info);
  } else {
    candidate.info = readLibraryMetadata(path);
  }
  PluginInfo& info = candidate.info;
  info.own = candidate.shipped = own && info.id.find('.') == std::string::npos;  // a dot: other people's
  if (info.label.empty())
    info.label = info.id.empty() ? QFileInfo(QString::fromStdString(path)).fileName().toStdString() : info.id;
  if (!info.problem.empty()) {
    found.push_back(info);
    return;
  }
  std::vector<Candidate>& same = candidates[info.id];
  if (!same.empty() && same.back().directory == directory) {
    info.problem = path + ": the id \"" + info.id + "\" is taken by " + same.back().info.path +
                   " in the same folder; remove one of the two";
    found.push_back(info);
    return;
  }
  same.push_back(std::move(candidate));
}

/// What came with the program is looked at again at each start: a record of it may be that of an end of the program
/// which was none of its doing, and without it most scenes do not move.
void PluginRegistry::Impl::forgiveShipped() {
  for (const auto& [id, list] : candidates) {
    for (const Candidate& candidate : list) {
      if (candidate.shipped) quarantine.allow(id, candidate.info.path);
    }
  }
}

/// Those that are not known to be sound.
void PluginRegistry::Impl::tryUnknown() {
  std::vector<const PluginInfo*> unknown;
  std::vector<std::string> paths;
  for (const auto& [id, list] : candidates) {
    for (const Candidate& candidate : list) {
      const PluginInfo& info = candidate.info;
      if (info.json || quarantine.knows(info.id, info.path) || !quarantine.why(info.id, info.path).empty()) continue;
      unknown.push_back(&info);
      paths.push_back(info.path);
    }
  }
  const std::vector<ScanVerdict> verdicts = scanPlugins(paths, patience);
  for (size_t i = 0; i < unknown.size(); ++i) note(*unknown[i], verdicts[i]);
}

void PluginRegistry::Impl::note(const PluginInfo& info, const ScanVerdict& verdict) {
  if (verdict.kind == ScanVerdict::Kind::CameBack) quarantine.cameBack(info.id, info.path);
  if (verdict.kind == ScanVerdict::Kind::Failed) quarantine.accuse(info.id, info.path, verdict.why);
}

void PluginRegistry::Impl::chooseStandard(const std::vector<Candidate>& list) {
  for (const Candidate& candidate : list) {
    if (!candidate.info.standard) continue;
    const auto [place, fresh] = standards.try_emplace(candidate.info.kind, candidate.directory, candidate.info.id);
    if (!fresh && candidate.directory < place->second.first) place->second = {candidate.directory, candidate.info.id};
  }
}

void PluginRegistry::Impl::loadBest(std::vector<Candidate>& list) {
  for (size_t i = list.size(); i-- > 0;) {
    PluginInfo& info = list[i].info;
    info.own = list[0].info.own;
    if (load(list[i])) {
      info.state = PluginInfo::State::Loaded;
      for (size_t other = 0; other < i; ++other)
        info.note += (other == 0 ? "replaces " : " and ") + nameOf(list[other].info);
      found.push_back(info);
      if (!info.json && !list[i].shipped) noteForCrashes(quarantine, info.id, info.path);
      return;
    }
    if (i > 0) info.problem += "; until then " + nameOf(list[i - 1].info) + " takes its place";
    found.push_back(info);
  }
}

bool PluginRegistry::Impl::load(Candidate& candidate) {
  PluginInfo& info = candidate.info;
  LoadedPlugin plugin;
  if (info.json) {
    plugin.material = std::move(candidate.material);
  } else if (const std::string why = quarantine.why(info.id, info.path); !why.empty()) {
    info.state = PluginInfo::State::Quarantined;
    info.problem = quarantined(info, why);
    return false;
  } else {
    {
      const LoadingLock lock(state, info.id, info.path);
      plugin = loadLibrary(info, installed);
    }
    if (!quarantine.knows(info.id, info.path)) quarantine.cameBack(info.id, info.path);
  }
  if (!info.problem.empty()) return false;
  loaded[info.id] = std::move(plugin);
  return true;
}

void PluginRegistry::Impl::offerMaterials() {
  const std::lock_guard lock(installed->mutex);
  for (const auto& [id, plugin] : loaded) {
    if (!plugin.material.id.empty()) installed->byId[id] = &plugin.material;
  }
}

void PluginRegistry::Impl::markFault(const std::string& id, const std::string& message) {
  const std::lock_guard lock(mutex);
  if (!loaded.contains(id) || !faulted.emplace(id, message).second) return;
  publish(id, PluginInfo::State::Loaded, [&](PluginInfo& info) {
    info.state = PluginInfo::State::Refused;
    info.problem = info.path + ": it failed while it ran: " + oneLine(message) +
                   "; it is left out until the program starts again, " + whomToTell(info);
  });
}

/// Under the lock: those of an id that have the state `from`, changed.
void PluginRegistry::Impl::publish(const std::string& id, PluginInfo::State from,
                                   const std::function<void(PluginInfo&)>& change) {
  auto changed = std::make_unique<std::vector<PluginInfo>>(*generations.back());
  for (PluginInfo& info : *changed) {
    if (info.id == id && info.state == from) change(info);
  }
  generations.push_back(std::move(changed));
}

PluginRegistry::PluginRegistry(const Options& options) : m(std::make_unique<Impl>(options)) {}
PluginRegistry::PluginRegistry() : PluginRegistry(Options()) {}
PluginRegistry::~PluginRegistry() = default;

const std::vector<PluginInfo>& PluginRegistry::plugins() const {
  const std::lock_guard lock(m->mutex);
  return *m->generations.back();
}

const api::MaterialPlugin* PluginRegistry::materialPlugin(const std::string& id) const {
  const LoadedPlugin* plugin = m->get(id);
  return plugin ? plugin->materialPlugin : nullptr;
}

const Material* PluginRegistry::material(const std::string& id) const { return m->materialOf(id); }

const api::ConstraintPlugin* PluginRegistry::constraint(const std::string& id) const {
  const LoadedPlugin* plugin = m->get(id);
  return plugin ? plugin->constraint : nullptr;
}

std::optional<AnyConstraint> PluginRegistry::constraintForm(const std::string& id) const {
  const LoadedPlugin* plugin = m->get(id);
  if (!plugin || !plugin->constraint) return std::nullopt;
  if (plugin->structural) return plugin->structural;
  if (plugin->group) return plugin->group;
  return plugin->neighbour;
}

const api::HeatSourcePlugin* PluginRegistry::heatSource(const std::string& id) const {
  const LoadedPlugin* plugin = m->get(id);
  return plugin ? plugin->heatSource : nullptr;
}

api::ParameterList PluginRegistry::parameters(const std::string& id) const {
  const LoadedPlugin* plugin = m->get(id);
  return plugin ? api::listOf(plugin->parameters.data(), plugin->parameters.size()) : api::ParameterList{};
}

std::vector<api::FieldDeclaration> PluginRegistry::fields() const {
  std::vector<api::FieldDeclaration> all;
  for (const auto& [id, plugin] : m->loaded) all.insert(all.end(), plugin.fields.begin(), plugin.fields.end());
  return all;
}

const api::ThermalPlugin* PluginRegistry::thermal(const std::string& id) const {
  const LoadedPlugin* plugin = m->get(id);
  return plugin ? plugin->thermal : nullptr;
}

const api::BrushPlugin* PluginRegistry::brush(const std::string& id) const {
  const LoadedPlugin* plugin = m->get(id);
  return plugin ? plugin->brush : nullptr;
}

std::vector<std::string> PluginRegistry::ids(PluginKind kind) const {
  std::vector<std::string> result;
  for (const PluginInfo& info : plugins())
    if (info.kind == kind && info.state == PluginInfo::State::Loaded) result.push_back(info.id);
  return result;
}

std::string PluginRegistry::standard(PluginKind kind) const {
  const auto found = m->standards.find(kind);
  return found == m->standards.end() ? std::string() : found->second.second;
}

bool PluginRegistry::has(const std::string& id) const { return m->get(id) != nullptr; }

const PluginInfo* PluginRegistry::info(const std::string& id) const {
  const std::vector<PluginInfo>& all = plugins();
  const auto found = std::find_if(all.begin(), all.end(), [&](const PluginInfo& info) {
    return info.id == id && info.state == PluginInfo::State::Loaded;
  });
  return found == all.end() ? nullptr : &*found;
}

bool PluginRegistry::needs(const std::string& id, std::string_view capability) const {
  const PluginInfo* of = info(id);
  return of && std::find(of->capabilities.begin(), of->capabilities.end(), capability) != of->capabilities.end();
}

Material PluginRegistry::evaluated(const std::string& id, const std::vector<double>& parameters) const {
  const LoadedPlugin* plugin = m->get(id);
  const Material* offered = m->materialOf(id);
  if (!plugin || !offered) throw Error("The material '" + id + "' is not installed");
  if (!plugin->materialPlugin) return *offered;
  try {
    return evaluateLaws(*plugin, plugin->declared, parameters);
  } catch (...) {
    const std::string problem = currentExceptionText();
    m->markFault(id, problem);
    throw PluginError("The material '" + id + "' failed: " + problem);
  }
}

std::vector<PluginRegistry::MaterialReading> PluginRegistry::changedMaterials() const {
  std::vector<MaterialReading> changed;
  for (const PluginInfo& known : plugins()) {
    if (!known.json || known.state != PluginInfo::State::Loaded) continue;
    if (!QFileInfo::exists(QString::fromStdString(known.path))) continue;
    MaterialReading reading;
    reading.material = readMaterialFile(known.path, reading.info);
    PluginInfo& info = reading.info;
    const Material* offered = material(known.id);
    if (info.problem.empty() && info.id != known.id)
      info.problem = known.path + ":/id: was \"" + known.id +
                     "\" when the program started; another one is found at the next start";
    if (info.problem.empty() && offered && sameMaterial(*offered, reading.material) && info.help == known.help &&
        info.tags == known.tags)
      continue;
    info.id = known.id;
    if (info.label.empty()) info.label = known.label;
    info.state = known.state;
    info.standard = known.standard;
    info.own = known.own;
    info.note = known.note;
    changed.push_back(std::move(reading));
  }
  return changed;
}

void PluginRegistry::offer(const MaterialReading& reading) {
  const std::string& id = reading.info.id;
  const Material* offered = nullptr;
  {
    const std::lock_guard lock(m->mutex);
    offered = m->reread[id].emplace_back(std::make_unique<const Material>(reading.material)).get();
    m->publish(id, PluginInfo::State::Loaded, [&](PluginInfo& info) { info = reading.info; });
  }
  const std::lock_guard lock(m->installed->mutex);
  m->installed->byId[id] = offered;
}

void PluginRegistry::fault(const std::string& id, const std::string& message) { m->markFault(id, message); }

PluginRegistry::SecondTry PluginRegistry::tryAgain(const std::string& id) {
  using State = PluginInfo::State;
  SecondTry result;
  std::vector<PluginInfo> held;
  {
    const std::lock_guard lock(m->mutex);
    for (const PluginInfo& info : *m->generations.back())
      if (info.id == id && info.state == State::Quarantined) held.push_back(info);
    result.known = m->quarantine.allow(id);
  }
  for (const PluginInfo& info : held) {
    const ScanVerdict verdict = scanPlugins({info.path}, m->patience).front();
    const std::lock_guard lock(m->mutex);
    m->note(info, verdict);
    if (verdict.kind == ScanVerdict::Kind::Failed) result.problem = quarantined(info, verdict.why);
  }
  const std::lock_guard lock(m->mutex);
  const State now = result.problem.empty() ? State::Refused : State::Quarantined;
  m->publish(id, State::Quarantined, [&](PluginInfo& info) {
    info.state = now;
    info.problem = result.problem.empty()
                       ? info.path + ": it is allowed again, and loaded when the program starts again"
                       : result.problem;
  });
  return result;
}

}  // namespace ps
