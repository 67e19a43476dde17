// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/pluginmetadata.h"

#include "core/matter/tags.h"
#include "core/plugin_host/pluginloader.h"

#include <phasesketch/stamp.h>

#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonObject>
#include <QPluginLoader>
#include <QString>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

namespace ps {
namespace {

struct KindOfPlugin {
  PluginKind kind;
  const char* iid;
};
constexpr std::array<KindOfPlugin, 7> kKinds{{{PluginKind::Material, PHASESKETCH_MATERIAL_IID},
                                              {PluginKind::Constraint, PHASESKETCH_STRUCTURAL_IID},
                                              {PluginKind::Constraint, PHASESKETCH_GROUP_IID},
                                              {PluginKind::Constraint, PHASESKETCH_NEIGHBOUR_IID},
                                              {PluginKind::Thermal, PHASESKETCH_THERMAL_IID},
                                              {PluginKind::HeatSource, PHASESKETCH_HEAT_SOURCE_IID},
                                              {PluginKind::Brush, PHASESKETCH_BRUSH_IID}}};

/// What this program offers to plugins beyond the interface of their kind. A plugin lists in its metadata what it
/// cannot do without; the same list, in words, stands in plugins/examples/README.md.
///   opens_energy  a thermal model may say, through Plugin::extension(), that it drops or invents heat by design; the
///                 open balance is then a limit of the model and no fault
///   pair_rates    a thermal model with a pair law of its own may say, likewise, how fast that law acts
///   holds_frozen  structure may say, likewise, that it takes in frozen matter of any body
///   structure_count  structure may say, likewise, how much of it there is per particle
///   spring_ties   structure of pairs may say, likewise, what each of its ties pulls with
///   group_poses   structure of groups may say, likewise, where each of them is, and follow when they are carried
///   holds_sheets  structure may say, likewise, that it makes cloth of what is one particle thick
///   holds_lines   structure may say, likewise, that it makes ropes of lines one particle thick
///   box_stamp     a brush may say, likewise, that its stamp is a box
///   touches_matter  a brush may work on the matter that is there, instead of drawing cells
///   paints_matter   a brush may make that matter of another material
///   smooths_matter  a brush may round what is drawn
///   fills_hollows   a brush may fill hollows
///   colours_matter  a brush may give that matter a colour of its own
///   stamps_shape    a brush may stamp the shape of a body
///   sees_matter     a brush may see the matter near the hand
///   welds_matter  structure of ties may say, likewise, that it joins what a hand welds
constexpr std::array<std::string_view, 17> kCapabilities{
    "opens_energy",  "pair_rates",     "holds_frozen", "structure_count", "spring_ties",   "group_poses",
    "holds_sheets",  "holds_lines",    "box_stamp",    "touches_matter",  "paints_matter", "smooths_matter",
    "fills_hollows", "colours_matter", "stamps_shape", "welds_matter",    "sees_matter"};

bool isLower(char c) { return c >= 'a' && c <= 'z'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Reads one decimal number and moves `text` behind it.
std::optional<int> takeNumber(std::string_view& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value < 0 || text.starts_with('-')) return std::nullopt;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return value;
}

/// A metadata key that must be a text; "" and a problem otherwise.
std::string textOf(const QJsonObject& object, const char* key, std::string& problem) {
  const QJsonValue value = object[QLatin1String(key)];
  if (value.isString() && !value.toString().isEmpty()) return oneLine(value.toString().toStdString());
  if (problem.empty()) {
    problem = std::string("its metadata ") + (value.isUndefined() ? "lack the key" : "need a text under the key") +
              " \"" + key + "\"; add it to the JSON file that Q_PLUGIN_METADATA names and build the plugin again";
  }
  return {};
}

/// Reads the optional list "capabilities"; "" or why the plugin cannot be used.
std::string readCapabilities(const QJsonObject& metadata, std::vector<std::string>& capabilities) {
  const QJsonValue list = metadata["capabilities"];
  const std::string rule =
      "its metadata need a list of lower_snake_case names under the key \"capabilities\", or none; correct the JSON "
      "file that Q_PLUGIN_METADATA names and build the plugin again";
  if (list.isUndefined()) return {};
  if (!list.isArray()) return rule;
  for (const QJsonValue& value : list.toArray()) {
    const std::string name = value.toString().toStdString();
    const auto inName = [](char c) { return isLower(c) || isDigit(c) || c == '_'; };
    if (name.empty() || !std::all_of(name.begin(), name.end(), inName)) return rule;
    capabilities.push_back(name);
  }
  for (const std::string& name : capabilities) {
    if (std::find(kCapabilities.begin(), kCapabilities.end(), name) == kCapabilities.end())
      return "it needs '" + name + "', which this version does not offer; update PhaseSketch";
  }
  return {};
}

/// Reads a material's optional list "adheres_to"; "" or why the plugin cannot be used.
std::string readAdheresTo(const QJsonObject& metadata, std::vector<std::string>& adheresTo) {
  const QJsonValue list = metadata["adheres_to"];
  const std::string rule =
      "its metadata need a list of the ids of materials under the key \"adheres_to\", or none; correct the JSON file "
      "that Q_PLUGIN_METADATA names and build the plugin again";
  if (list.isUndefined()) return {};
  if (!list.isArray()) return rule;
  for (const QJsonValue& value : list.toArray()) {
    adheresTo.push_back(value.toString().toStdString());
    if (!problemOfId(adheresTo.back()).empty()) return rule;
  }
  return {};
}

/// Reads a material's optional list "tags"; "" or why the plugin cannot be used.
std::string readTags(const QJsonObject& metadata, std::vector<std::string>& tags) {
  const QJsonValue list = metadata["tags"];
  const std::string rule =
      "its metadata need a list of short words under the key \"tags\", or none; correct the JSON file that "
      "Q_PLUGIN_METADATA names and build the plugin again";
  if (list.isUndefined()) return {};
  if (!list.isArray()) return rule;
  for (const QJsonValue& value : list.toArray()) tags.push_back(value.toString().toStdString());
  return problemOfTags(tags) ? rule : std::string();
}

/// Reads a brush's optional key; "" or why the plugin cannot be used.
std::string readKey(const QJsonObject& metadata, std::string& key) {
  const QJsonValue value = metadata["key"];
  if (value.isUndefined()) return {};
  key = value.toString().toStdString();
  if (key.size() == 1 && key[0] >= 'A' && key[0] <= 'Z') return {};
  return "its metadata need one letter of A to Z under the key \"key\", or none; correct the JSON file that "
         "Q_PLUGIN_METADATA names and build the plugin again";
}

/// The kind that the IID stands for, or a problem.
std::optional<PluginKind> kindOfIid(const std::string& iid, std::string& problem) {
  for (const KindOfPlugin& known : kKinds)
    if (iid == known.iid) return known.kind;
  const std::string family = iid.substr(0, iid.find('/'));
  for (const KindOfPlugin& known : kKinds) {
    if (!std::string_view(known.iid).starts_with(family + "/")) continue;
    problem =
        "it was built for the interface " + iid + ", this program has " + known.iid + "; get a build for this version";
    return std::nullopt;
  }
  problem = "it is a Qt plugin for another program (" + iid + "); remove it from this folder";
  return std::nullopt;
}

/// The headers that a plugin was built with: "0.9:1" of the stamp that they leave in it; "" without one.
std::string stampOf(const std::string& path) {
  QFile file(QString::fromStdString(path));
  if (!file.open(QIODevice::ReadOnly)) return {};
  const uchar* bytes = file.map(0, file.size());
  if (!bytes) return {};
  const std::string_view text(reinterpret_cast<const char*>(bytes), static_cast<size_t>(file.size()));
  constexpr std::string_view kHead = PHASESKETCH_STAMP_HEAD;
  const size_t at = text.find(kHead);
  if (at == std::string_view::npos) return {};
  const std::string_view stamp = text.substr(at + kHead.size(), 16);
  return std::string(stamp.substr(0, stamp.find('\0')));
}

struct Stamp {
  int major = 0, minor = 0, layout = 0;
};
std::optional<Stamp> parsedStamp(std::string_view text) {
  const auto major = takeNumber(text);
  if (!major || !text.starts_with('.')) return std::nullopt;
  text.remove_prefix(1);
  const auto minor = takeNumber(text);
  if (!minor || !text.starts_with(':')) return std::nullopt;
  text.remove_prefix(1);
  const auto layout = takeNumber(text);
  if (!layout || !text.empty()) return std::nullopt;
  return Stamp{*major, *minor, *layout};
}

/// What the compiler saw against what the program has and what the metadata say; `api` is sound.
std::string problemOfStamp(const std::string& text, std::string_view api) {
  const auto stamp = parsedStamp(text);
  if (!stamp) return "it carries no stamp of the plugin headers; build it with those of this program";
  if (stamp->major != api::kVersionMajor || stamp->layout != api::kLayout)
    return "it was built with the plugin headers " + text + ", which do not fit this program's, " +
           PHASESKETCH_STAMP_VERSION + "; build it again with these";
  takeNumber(api);
  api.remove_prefix(1);
  if (*takeNumber(api) > stamp->minor)
    return "its metadata ask for a later version of the plugin interface than its headers, " + text +
           ", have; build it with newer ones, or correct \"api\"";
  return {};
}

/// Qt's words for a file that is no plugin: "... 'PATH' is not a valid ELF object (file too small)". The path is left
/// out, the caller says it.
std::string refusalOf(const QPluginLoader& loader, const std::string& path) {
  std::string words = loader.errorString().toStdString();
  const std::string mention = path + "' is ";
  if (const size_t at = words.rfind(mention); at != std::string::npos) words.erase(0, at + mention.size());
  for (char& c : words)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return "it is not a plugin: " + words + "; remove it from this folder or build it again";
}

}  // namespace

std::string problemOfId(std::string_view id) {
  constexpr size_t kLongest = 64;
  const std::string rule = "must be lower-case letters and digits joined by '.', '_' or '-', like \"org.example.rust\"";
  if (id.empty() || id.size() > kLongest || !isLower(id.front())) return rule;
  char last = 'a';
  for (const char c : id) {
    const bool joint = c == '.' || c == '_' || c == '-';
    if (!isLower(c) && !isDigit(c) && !joint) return rule;
    if (joint && !isLower(last) && !isDigit(last)) return rule;
    last = c;
  }
  return isLower(last) || isDigit(last) ? std::string() : rule;
}

std::string problemOfApi(std::string_view api) {
  const std::string ours = std::to_string(api::kVersionMajor) + "." + std::to_string(api::kVersionMinor);
  std::string_view remaining = api;
  const auto major = takeNumber(remaining);
  const bool dot = remaining.starts_with('.');
  if (dot) remaining.remove_prefix(1);
  const auto minor = takeNumber(remaining);
  if (!major || !dot || !minor || !remaining.empty())
    return "its API version \"" + std::string(api) + "\" must be two numbers like \"" + ours + "\"";
  if (*major == api::kVersionMajor && *minor <= api::kVersionMinor) return {};
  const bool newer = *major > api::kVersionMajor || (*major == api::kVersionMajor && *minor > api::kVersionMinor);
  return "it was built for version " + std::string(api) + " of the plugin interface, this program has " + ours + "; " +
         (newer ? "update PhaseSketch or get an older build of the plugin" : "get a newer build of the plugin");
}

std::string problemOfVersion(std::string_view version) {
  const std::string rule = "must be numbers joined by dots, like \"1.0.0\"";
  std::string_view remaining = version;
  for (int part = 0; part < 4; ++part) {
    if (!takeNumber(remaining)) return rule;
    if (remaining.empty() || (remaining.front() == '-' && remaining.size() > 1)) return {};
    if (remaining.front() != '.') return rule;
    remaining.remove_prefix(1);
  }
  return rule;
}

std::string checkMetadata(const QJsonObject& root, PluginInfo& info) {
  std::string problem;
  const auto kind = kindOfIid(oneLine(root["IID"].toString().toStdString()), problem);
  const QJsonObject own = root["MetaData"].toObject();
  info.author = oneLine(own["author"].toString().toStdString());
  info.standard = own["standard"].toBool();
  info.id = textOf(own, "id", problem);
  const std::string kindName = textOf(own, "kind", problem);
  info.api = textOf(own, "api", problem);
  info.version = textOf(own, "version", problem);
  info.licence = textOf(own, "licence", problem);
  if (kind) info.kind = *kind;
  if (!problem.empty()) return problem;
  if (const std::string what = problemOfId(info.id); !what.empty()) {
    const std::string bad = std::exchange(info.id, {});
    return "the id \"" + bad + "\" " + what;
  }
  if (kindName != pluginKindName(*kind))
    return "its metadata say kind \"" + kindName + "\", but it implements the interface of a " + pluginKindName(*kind) +
           "; correct one of the two";
  if (std::string what = problemOfApi(info.api); !what.empty()) return what;
  if (const std::string what = problemOfVersion(info.version); !what.empty())
    return "the version \"" + info.version + "\" " + what;
  if (std::string what = readAdheresTo(own, info.adheresTo); !what.empty()) return what;
  if (std::string what = readTags(own, info.tags); !what.empty()) return what;
  if (std::string what = readKey(own, info.key); !what.empty()) return what;
  return readCapabilities(own, info.capabilities);
}

PluginInfo readLibraryMetadata(const std::string& path) {
  PluginInfo info;
  info.path = path;
  if (QFileInfo(QString::fromStdString(path)).size() == 0) {  // the loader would complain on standard error as well
    info.problem = path + ": it is not a plugin: the file is empty; build or install it again";
    return info;
  }
  QPluginLoader loader(QString::fromStdString(path));
  const QJsonObject root = loader.metaData();
  info.problem = root.isEmpty() ? refusalOf(loader, path) : checkMetadata(root, info);
  if (info.problem.empty()) info.problem = problemOfStamp(stampOf(path), info.api);
  if (!info.problem.empty()) info.problem = path + ": " + info.problem;
  return info;
}

}  // namespace ps
