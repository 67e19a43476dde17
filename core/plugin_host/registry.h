// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/brush.h>
#include <phasesketch/material.h>
#include <phasesketch/thermal.h>

#include "core/base/error.h"
#include "core/matter/material.h"
#include "core/solver/anyconstraint.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ps {

enum class PluginKind { Material, Constraint, Thermal, HeatSource, Brush };
const char* pluginKindName(PluginKind kind);  ///< "material", ...

/// One plugin that was found, loaded or not.
struct PluginInfo {
  enum class State { Loaded, Refused, Quarantined };
  std::string id, label, version, api, licence, author, help, path;
  std::vector<std::string> capabilities;  ///< what it needs of the program beyond its kind's interface
  std::vector<std::string> adheresTo;     ///< of materials: Material::adheresTo
  std::vector<std::string> tags;          ///< of materials: words by which people find them
  std::string key;                        ///< of a brush: the letter of the keyboard that it asks for; "" for none
  PluginKind kind = PluginKind::Material;
  State state = State::Refused;
  std::string problem;    ///< one line: what, where, what to do; "" when loaded
  bool standard = false;  ///< its metadata offer it as what is meant where nothing names another one of its kind
  std::string note;       ///< one line about one that is loaded: "replaces version 1.0.0 in FILE"; "" mostly
  bool json = false;      ///< a material that is a JSON file alone
  bool own = false;       ///< one of the program's, or in the place of one of them
};

const char* pluginStateName(PluginInfo::State state);  ///< "loaded", "refused", "quarantined"

/// A plugin threw while it ran: it is left out from now on.
class PluginError : public Error {
 public:
  using Error::Error;
};

/// Finds plugins in the build tree or the install prefix, the user's data directory, extraPaths and
/// PHASESKETCH_PLUGIN_PATH (in rising order of precedence), reads their metadata before any code is loaded, and loads
/// what is sound. Broken ones are listed with the reason; the rest works. Of several with one id the last one that
/// works is used. A plugin that was not loaded before, or at whose loading a program ended, is loaded in a process of
/// its own first (pluginscan.h); one that crashes there, or does not come back, is in quarantine until its file changes
/// or tryAgain() is called. So is one at whose loading the program itself ended twice in a row.
///
/// The constructor is the only part that loads code; it needs no QCoreApplication. All other functions may be called
/// from any thread. Plugin objects live as long as the process, references from plugins() and pointers to materials as
/// long as the registry.
class PluginRegistry {
 public:
  struct Options {
    std::vector<std::string> extraPaths;  ///< directories, looked into before PHASESKETCH_PLUGIN_PATH
    bool builtIn = true;                  ///< build tree or install prefix
    bool userDirectory = true;
    bool environment = true;
    bool scans = true;     ///< false: plugins are loaded untried
    double patience = 10;  ///< s that a plugin may take to be tried
  };
  explicit PluginRegistry(const Options& options);
  PluginRegistry();
  ~PluginRegistry();

  /// Ascending by id, those without a readable id last.
  const std::vector<PluginInfo>& plugins() const;
  /// nullptr when not installed. Materials made of JSON alone have no MaterialPlugin, but a Material.
  const api::MaterialPlugin* materialPlugin(const std::string& id) const;
  const Material* material(const std::string& id) const;
  const api::ConstraintPlugin* constraint(const std::string& id) const;
  std::optional<AnyConstraint> constraintForm(const std::string& id) const;
  const api::ThermalPlugin* thermal(const std::string& id) const;
  const api::HeatSourcePlugin* heatSource(const std::string& id) const;
  const api::BrushPlugin* brush(const std::string& id) const;
  /// What a plugin declares, copied when it was loaded, whatever headers it was built with; empty when not installed.
  api::ParameterList parameters(const std::string& id) const;
  /// Per-particle fields that plugins declare, ascending by plugin, of those that failed since they were loaded too:
  /// particles go on having them.
  std::vector<api::FieldDeclaration> fields() const;
  /// Loaded ids of a kind, ascending.
  std::vector<std::string> ids(PluginKind kind) const;
  bool has(const std::string& id) const;
  /// Of a loaded one; nullptr when not installed.
  const PluginInfo* info(const std::string& id) const;
  /// Whether a loaded one needs something beyond its kind's interface, as its metadata say.
  bool needs(const std::string& id, std::string_view capability) const;
  /// What is meant where nothing names a plugin of this kind: the one whose metadata say so ("standard": true); of
  /// several the one that came with the program, then the first by id. Also one that was refused: a file that means it
  /// must not quietly go on with another. "" where there is none.
  std::string standard(PluginKind kind) const;
  /// A material with a plugin's own laws evaluated for these own parameters (in the order of its declarations; missing
  /// ones take their defaults). Throws Error for an unknown material, and PluginError when the plugin's law fails: the
  /// plugin is then refused as by fault().
  Material evaluated(const std::string& id, const std::vector<double>& parameters) const;
  /// A material that is a JSON file alone, read once more.
  struct MaterialReading {
    PluginInfo info;  ///< of the id that it had; `problem`: "", or the sentence with file and JSON pointer
    Material material;
  };
  /// Of loaded ones whose file stands there: those whose files say something else than what is offered, or are broken.
  /// Files that came since are found at the next start. Takes as long as reading them all.
  std::vector<MaterialReading> changedMaterials() const;
  /// One without a problem is what material() gives from now on, and what plugins are told that ask their host. What
  /// was given before stays good, and as it was. An engine that has made a table of it goes on with that until it makes
  /// another one: a run can be made again only where it began after this call.
  void offer(const MaterialReading& reading);
  /// A plugin threw while running: refuses it from now on, and says so in plugins(). Its object stays valid.
  void fault(const std::string& id, const std::string& message);
  /// Takes a plugin out of quarantine, to be loaded at the next start, unless it fails again in a process of its own:
  /// what stands in `problem` then is its sentence, and it stays. Takes as long as the plugin, and `patience` at most.
  struct SecondTry {
    bool known = false;   ///< one of that id was in quarantine
    std::string problem;  ///< "" when it came back
  };
  SecondTry tryAgain(const std::string& id);

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

}  // namespace ps
