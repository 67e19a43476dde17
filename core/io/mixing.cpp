// SPDX-License-Identifier: Apache-2.0
#include "core/io/mixing.h"

#include "core/base/error.h"
#include "core/io/fieldkinds.h"
#include "core/io/mixturefields.h"
#include "core/matter/mixture.h"
#include "core/plugin_host/registry.h"

#include <cmath>

namespace ps {
namespace fields {

const FieldTable<Mixture::Part>& mixturePartFields() {
  static const FieldTable<Mixture::Part> table{
      .help = "a material with all its values",
      .rows = {field("label", &Mixture::Part::label, Text{}, "name shown to people"),
               field("properties", &Mixture::Part::properties, Declared{&propertyCatalogue}, ""),
               field("adheres_to", &Mixture::Part::adheresTo, List{Text{}, "id of a material"},
                     "materials that it holds on to when one of the two freezes")},
      .unknown = &Mixture::Part::unknown};
  return table;
}

const FieldTable<Mixture>& mixtureFields() {
  static const FieldTable<Mixture> table{
      .help = "what a material was mixed from; its properties are what came of it",
      .rows = {field("share", &Mixture::share, Number{0, 1}, "of the second part, by mass").required(),
               field("first", &Mixture::first, Object{mixturePartFields(), kMixturePart}, "").required(),
               field("second", &Mixture::second, Object{mixturePartFields(), kMixturePart}, "").required()},
      .unknown = &Mixture::unknown};
  return table;
}

}  // namespace fields

namespace {

constexpr double kReference = 293.15;  // K, at which numbers are read

Value asDeclared(const Response& response, const api::ParameterDeclaration& declaration) {
  switch (declaration.kind) {
    case api::ParameterKind::Response:
      return response;
    case api::ParameterKind::Toggle:
      return response.at(kReference) != 0;
    default:
      return response.at(kReference);
  }
}

/// The material's or the default, as a value of the declaration's kind.
Value valueIn(const Material& material, const api::ParameterDeclaration& declaration) {
  const auto found = material.properties.find(declaration.key);
  return asDeclared(found == material.properties.end() ? Response(declaration.defaultValue) : found->second,
                    declaration);
}

std::string percent(double share) { return numberText(std::round(share * 1e4) / 1e2) + "\u202f%"; }

const Material& standardOf(const PluginRegistry& plugins, const std::string& id) {
  const Material* standard = plugins.material(id);
  if (!standard) throw InputError("the material '" + id + "', which mixtures are written beside, is not installed");
  return *standard;
}

}  // namespace

Mixture::Part partOf(const Material& material) {
  Mixture::Part part;
  part.label = material.label.empty() ? material.id : material.label;
  part.adheresTo = material.adheresTo;
  const api::ParameterList catalogue = propertyCatalogue();
  for (const auto& [key, response] : material.properties) {
    const int index = propertyIndex(key);
    if (index >= 0) part.properties.values[key] = asDeclared(response, catalogue[static_cast<size_t>(index)]);
  }
  return part;
}

Material materialOf(const Mixture::Part& part) {
  Material material;
  material.label = part.label;
  material.adheresTo = part.adheresTo;
  for (const auto& [key, value] : part.properties.values) material.properties[key] = responseOf(value);
  return material;
}

Material materialOf(const Mixture& mixture) {
  Material material = mixed(materialOf(mixture.first), materialOf(mixture.second), mixture.share);
  material.label = mixtureText(mixture);
  return material;
}

std::string whyNot(const Mixture& mixture) {
  return whyNoMixture(materialOf(mixture.first), materialOf(mixture.second), mixture.share);
}

std::string mixtureText(const Mixture& mixture) {
  return percent(1 - mixture.share) + " " + mixture.first.label + " and " + percent(mixture.share) + " " +
         mixture.second.label + " by mass";
}

SceneMaterial writtenOut(const Material& whole, const PluginRegistry& plugins) {
  SceneMaterial out;
  out.base = plugins.standard(PluginKind::Material);
  const Material& standard = standardOf(plugins, out.base);
  const api::ParameterList catalogue = propertyCatalogue();
  for (size_t k = 0; k < catalogue.count; ++k) {
    const Value value = valueIn(whole, catalogue[k]);
    if (!(value == valueIn(standard, catalogue[k]))) out.properties.values[catalogue[k].key] = value;
  }
  out.label = whole.label;
  out.adheresTo = whole.adheresTo;
  return out;
}

SceneMaterial mixedMaterial(const Mixture& mixture, const PluginRegistry& plugins) {
  if (const std::string why = whyNot(mixture); !why.empty()) throw InputError(why);
  SceneMaterial out = writtenOut(materialOf(mixture), plugins);
  out.mixture = std::make_shared<const Mixture>(mixture);
  return out;
}

SceneMaterial withShare(const SceneMaterial& material, double share, const PluginRegistry& plugins) {
  if (!material.mixture) throw InputError("'" + material.id + "' is no mixture");
  Mixture mixture = *material.mixture;
  const SceneMaterial before = mixedMaterial(mixture, plugins);
  mixture.share = share;
  const SceneMaterial after = mixedMaterial(mixture, plugins);
  SceneMaterial out = material;
  const auto& was = before.properties.values;
  const auto& becomes = after.properties.values;
  const auto in = [](const auto& values, const std::string& key) -> std::optional<Value> {
    const auto found = values.find(key);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  };
  const api::ParameterList catalogue = propertyCatalogue();
  for (size_t k = 0; k < catalogue.count; ++k) {
    const std::string key = catalogue[k].key;
    if (in(material.properties.values, key) != in(was, key)) continue;
    out.properties.values.erase(key);
    if (const auto value = in(becomes, key)) out.properties.values[key] = *value;
  }
  if (material.label == before.label) out.label = after.label;
  out.mixture = after.mixture;
  return out;
}

}  // namespace ps
