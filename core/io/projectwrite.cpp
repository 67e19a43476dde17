// SPDX-License-Identifier: Apache-2.0
#include "core/base/hash.h"
#include "core/base/jsontext.h"
#include "core/io/filestamp.h"
#include "core/io/outputfile.h"
#include "core/io/projectfields.h"
#include "core/io/projectio.h"

#include <cmath>

namespace ps {
namespace {

using nlohmann::json;

/// JSON has no NaN or infinity: a file with one could not be opened again.
void requireFinite(const json& value, const std::string& pointer) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    throw Error("not saved: " + pointer + " is not a finite number; undo the last change");
  }
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) requireFinite(member, pointer + "/" + pointerPart(key));
  } else if (value.is_array()) {
    for (size_t i = 0; i < value.size(); ++i) {
      if (!value[i].is_number_integer()) requireFinite(value[i], pointer + "/" + std::to_string(i));
    }
  }
}

}  // namespace

std::string writeProject(const Project& project) {
  const json out = fields::projectFields().write(project);
  requireFinite(out, "");
  return writeJson(out);
}

std::vector<std::string> usedPlugins(const Project& project) { return fields::pluginsOf(project); }

std::string sceneHash(const Project& project) {
  json out = fields::projectFields().write(project);
  for (const char* key : {"description", "end", "generator", "graphs", "groups", "markers", "minVersion",
                          "pluginsRequired", "pluginsUsed", "probes", "thumbnail", "title", "toTry", "version", "view"})
    out.erase(key);
  // What only the view and lists go by; of bodies it counts, since stamps of earlier versions have it.
  const auto leave = [](json& owner, const char* list, std::initializer_list<const char*> keys) {
    if (!owner.contains(list)) return;
    for (json& item : owner[list])
      for (const char* key : keys) item.erase(key);
  };
  for (const char* list : {"emitters", "sinks"}) leave(out, list, {"visible", "locked"});
  if (out.contains("environment")) leave(out["environment"], "walls", {"visible", "locked"});
  leave(out, "materials", {"tags"});
  return hashText(hashOf(writeJson(out)));
}

void saveProject(const Project& project, const std::string& path) { writeFileAtomically(path, writeProject(project)); }

}  // namespace ps
