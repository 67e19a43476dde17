// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/materialjson.h"

#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/matter/tags.h"
#include "core/plugin_host/declarations.h"
#include "core/plugin_host/pluginmetadata.h"

#include <QFile>
#include <QString>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace ps {
namespace {

using nlohmann::json;

constexpr int kFormatVersion = 1;
constexpr qint64 kMaxFileSize = 1 << 20;
constexpr size_t kMaxPoints = 4096;

/// A value and where it stands, so that every complaint names its place.
struct Place {
  const json& value;
  const std::string& file;
  std::string pointer;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file + ":" + (pointer.empty() ? "/" : pointer) + ": " + what);
  }
  Place at(const std::string& key) const { return {value.at(key), file, pointer + "/" + pointerPart(key)}; }
  Place at(size_t index) const { return {value.at(index), file, pointer + "/" + std::to_string(index)}; }
  bool has(const char* key) const { return value.contains(key); }

  Place needed(const char* key) const {
    if (!has(key)) Place{value, file, pointer + "/" + key}.fail("is missing");
    return at(key);
  }
  std::string text() const {
    if (!value.is_string()) fail("must be a text, not " + jsonInWords(value));
    return value.get<std::string>();
  }
  double number() const {
    if (!value.is_number()) fail("must be a number, not " + jsonInWords(value));
    return value.get<double>();
  }
  const Place& object() const {
    if (!value.is_object()) fail("must be an object, not " + jsonInWords(value));
    return *this;
  }
  const Place& list() const {
    if (!value.is_array()) fail("must be a list, not " + jsonInWords(value));
    if (value.size() > kMaxPoints) fail("has more than " + std::to_string(kMaxPoints) + " entries");
    return *this;
  }
  void only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, ignored] : value.items()) {
      if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
      std::string known;
      for (const std::string_view k : keys) known += (known.empty() ? "" : ", ") + std::string(k);
      at(key).fail("is not a key of this format; known here are " + known);
    }
  }
};

/// How a point goes on, and with which slopes.
void readWay(const Place& place, CurvePoint& point) {
  place.object().only({"to_next", "slope_before", "slope_after"});
  if (place.has("to_next")) {
    const std::vector<std::string>& names = toNextNames();
    const auto found = std::find(names.begin(), names.end(), place.at("to_next").text());
    if (found == names.end()) place.at("to_next").fail("must be \"step\", \"linear\" or \"smooth\"");
    point.toNext = static_cast<ToNext>(found - names.begin());
  }
  if (place.has("slope_before")) point.slopeBefore = place.at("slope_before").number();
  if (place.has("slope_after")) point.slopeAfter = place.at("slope_after").number();
}

std::vector<CurvePoint> readPoints(const Place& place) {
  std::vector<CurvePoint> points;
  for (size_t i = 0; i < place.list().value.size(); ++i) {
    const Place point = place.at(i);
    const size_t size = point.list().value.size();
    if (size != 2 && size != 3)
      point.fail("must be [temperature in K, value], and {\"to_next\": ...} behind them where it goes on otherwise");
    points.push_back({point.at(0).number(), point.at(1).number()});
    if (size == 3) readWay(point.at(2), points.back());
  }
  return points;
}

Response readResponse(const Place& place) {
  if (place.value.is_boolean()) return Response(place.value.get<bool>() ? 1.0 : 0.0);
  if (!place.value.is_object()) return Response(place.number());
  place.only({"value", "points", "law", "coefficients", "source", "grade"});
  const int forms = place.has("value") + place.has("points") + place.has("law");
  if (forms != 1) place.fail("needs one of \"value\", \"points\" or \"law\"");
  if (place.has("coefficients") && !place.has("law")) place.at("coefficients").fail("belongs to a \"law\" only");
  Response response;
  if (place.has("value")) {
    const Place value = place.at("value");
    response.constant = value.value.is_boolean() ? (value.value.get<bool>() ? 1.0 : 0.0) : value.number();
  } else if (place.has("points")) {
    response.kind = Response::Kind::Curve;
    response.points = readPoints(place.at("points"));
  } else {
    response.kind = Response::Kind::Law;
    response.law = place.at("law").text();
    const Place coefficients = place.needed("coefficients");
    for (size_t i = 0; i < coefficients.list().value.size(); ++i)
      response.coefficients.push_back(coefficients.at(i).number());
  }
  return response;
}

Provenance readProvenance(const Place& place) {
  Provenance provenance;
  if (!place.value.is_object()) return provenance;
  if (place.has("source")) provenance.source = place.at("source").text();
  if (place.has("grade")) {
    const std::string grade = place.at("grade").text();
    if (grade != "A" && grade != "B" && grade != "C")
      place.at("grade").fail("must be \"A\" (reference data), \"B\" (handbook) or \"C\" (representative)");
    provenance.grade = grade[0];
  }
  return provenance;
}

/// Where within a property a complaint of problemOfProperty() belongs.
std::string detailOf(const json& value) {
  if (!value.is_object()) return "";
  return value.contains("value") ? "/value" : value.contains("points") ? "/points" : "/law";
}

void readProperties(const Place& place, Material& material) {
  if (place.object().value.empty()) place.fail("must hold at least one property");
  for (const auto& [key, value] : place.value.items()) {
    const Place property = place.at(key);
    if (propertyIndex(key) < 0) property.fail(problemOfProperty(key, Response()));
    const Response response = readResponse(property);
    if (const std::string problem = problemOfProperty(key, response); !problem.empty())
      Place{value, place.file, property.pointer + detailOf(value)}.fail(problem);
    material.properties[key] = response;
    material.provenance[key] = readProvenance(property);
  }
  if (const std::string problem = problemOf(material); !problem.empty()) place.fail(problem);
}

void readAdheresTo(const Place& place, Material& material) {
  for (size_t i = 0; i < place.list().value.size(); ++i) {
    const Place id = place.at(i);
    if (const std::string problem = problemOfId(id.text()); !problem.empty()) id.fail(problem);
    material.adheresTo.push_back(id.text());
  }
}

void readTags(const Place& place, std::vector<std::string>& tags) {
  for (size_t i = 0; i < place.list().value.size(); ++i) tags.push_back(place.at(i).text());
  if (const auto wrong = problemOfTags(tags)) place.at(wrong->index).fail(wrong->what);
}

void readFormat(const Place& root) {
  if (!root.has("format"))
    Place{root.value, root.file, "/format"}.fail(
        "is missing; a material begins with \"format\": \"phasesketch-material\"");
  if (root.at("format").text() != "phasesketch-material") root.at("format").fail("must be \"phasesketch-material\"");
  const Place version = root.needed("version");
  if (!version.value.is_number_integer()) version.fail("must be a whole number");
  if (version.number() < 1) version.fail("must be at least 1");
  if (version.number() > kFormatVersion)
    version.fail("is newer than this program, which reads version " + std::to_string(kFormatVersion) +
                 "; update PhaseSketch");
}

}  // namespace

Material parseMaterialJson(std::string_view text, const std::string& name, PluginInfo& info) {
  const json document = parseJson(text, name);
  const Place root{document, name, ""};
  root.object();
  readFormat(root);
  root.only({"format", "version", "id", "label", "licence", "author", "help", "data_version", "adheres_to", "tags",
             "properties"});
  Material material;
  const Place id = root.needed("id");
  if (const std::string problem = problemOfId(id.text()); !problem.empty()) id.fail(problem);
  info.id = material.id = id.text();
  info.label = material.label = root.needed("label").text();
  if (info.label.empty()) root.at("label").fail("must not be empty");
  info.licence = root.needed("licence").text();
  if (info.licence.empty()) root.at("licence").fail("must not be empty, e.g. \"CC0-1.0\"");
  if (root.has("author")) info.author = root.at("author").text();
  if (root.has("help")) info.help = root.at("help").text();
  info.version = root.has("data_version") ? root.at("data_version").text() : "1.0.0";
  if (const std::string problem = problemOfVersion(info.version); !problem.empty())
    root.at("data_version").fail(problem);
  if (root.has("adheres_to")) readAdheresTo(root.at("adheres_to"), material);
  info.adheresTo = material.adheresTo;
  if (root.has("tags")) readTags(root.at("tags"), info.tags);
  readProperties(root.needed("properties"), material);
  return material;
}

Material readMaterialFile(const std::string& path, PluginInfo& info) {
  info.path = path;
  info.json = true;
  info.kind = PluginKind::Material;
  QFile file(QString::fromStdString(path));
  if (!file.open(QIODevice::ReadOnly)) {
    info.problem = path + ": cannot be read: " + file.errorString().toStdString() + "; check its permissions";
    return {};
  }
  const QByteArray bytes = file.read(kMaxFileSize + 1);
  if (bytes.size() > kMaxFileSize) {
    info.problem = path + ": is larger than 1 MiB; a material is a short list of numbers";
    return {};
  }
  try {
    return parseMaterialJson({bytes.constData(), static_cast<size_t>(bytes.size())}, path, info);
  } catch (const std::exception& problem) {
    info.problem = problem.what();
    return {};
  }
}

}  // namespace ps
