// SPDX-License-Identifier: Apache-2.0
#include "ui/session/fileproblem.h"

#include "core/base/error.h"
#include "core/matter/material.h"
#include "core/parameters/parameterset.h"
#include "core/scene/project.h"

#include <QtCore/QFileInfo>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <vector>

namespace ps {
namespace {

using nlohmann::json;

constexpr size_t kLongest = 8'000'000;  // bytes of a text in which names are looked for

/// How people call what a list of the file holds, and what its members declare.
struct Kind {
  const char* list;  ///< "/materials"
  const char* one;
  api::ParameterList (*parameters)();
};

constexpr Kind kKinds[] = {{"/materials/", "The material", &propertyCatalogue},
                           {"/bodies/", "The body", &bodyParameters},
                           {"/emitters/", "The tap", &emitterParameters},
                           {"/sinks/", "The drain", &sinkParameters},
                           {"/environment/walls/", "The wall", &wallParameters},
                           {"/probes/", "The probe", nullptr},
                           {"/graphs/", "The graph", nullptr},
                           {"/groups/", "The group", nullptr},
                           {"/meshes/", "The mesh", nullptr},
                           {"/tracks/", "The keys over time of", nullptr},
                           {"/markers/", "The marker", nullptr}};

struct Part {
  const char* path;
  const char* name;
  api::ParameterList (*parameters)();
};

constexpr Part kParts[] = {{"/solver", "The solver", &solverParameters},
                           {"/environment", "The surroundings", &environmentParameters},
                           {"/state", "The saved state", nullptr},
                           {"/view", "The view", nullptr},
                           {"/pluginsRequired", "A plugin that the file requires", nullptr},
                           {"/pluginsUsed", "A plugin that the file uses", nullptr}};

std::vector<std::string> partsOf(std::string_view pointer) {
  std::vector<std::string> parts;
  for (size_t at = 0; at < pointer.size();) {
    const size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    std::string part;
    for (size_t k = at + 1; k < end; ++k) {
      const bool escaped = pointer[k] == '~' && k + 1 < end;
      part += !escaped ? pointer[k] : pointer[k + 1] == '0' ? '~' : '/';
      k += escaped ? 1 : 0;
    }
    if (!part.empty()) parts.push_back(std::move(part));
    at = end;
  }
  return parts;
}

/// Characters of a text for a parser, which counts the lines that it has read.
struct CountedText {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  struct Read {
    size_t lines = 0;
    char last = 0;
  };
  const char* at;
  Read* read;
  const char& operator*() const { return *at; }
  CountedText& operator++() {
    read->last = *at++;
    read->lines += read->last == '\n' ? 1 : 0;
    return *this;
  }
  bool operator==(const CountedText& other) const { return at == other.at; }
};

/// The line of what a pointer names, or of its last part that there is. Reads no further than that.
class LineFinder final : public nlohmann::json_sax<json> {
 public:
  LineFinder(const std::vector<std::string>& parts, const CountedText::Read& read) : m_parts(parts), m_read(read) {}
  size_t line() const { return m_line; }

  bool null() override { return element(); }
  bool boolean(bool) override { return element(); }
  bool number_integer(number_integer_t) override { return element(true); }
  bool number_unsigned(number_unsigned_t) override { return element(true); }
  bool number_float(number_float_t, const string_t&) override { return element(true); }
  bool string(string_t&) override { return element(); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(true); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    m_levels.back().name = name;
    return begin(false);
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  struct Level {
    bool object;
    std::string name{};  ///< of the member, or the number of the element, that is being read
    size_t elements = 0;
  };
  bool open(bool object) {
    const bool goesOn = element();
    m_levels.push_back({object});
    return goesOn;
  }
  bool close() {
    m_levels.pop_back();
    return true;
  }
  /// A number ends where the character after it has been read.
  bool element(bool ahead = false) {
    if (m_levels.empty() || m_levels.back().object) return true;
    m_levels.back().name = std::to_string(m_levels.back().elements++);
    return begin(ahead);
  }
  bool begin(bool ahead) {
    const auto same = std::mismatch(m_levels.begin(), m_levels.end(), m_parts.begin(), m_parts.end(),
                                    [](const Level& level, const std::string& part) { return level.name == part; });
    if (same.first != m_levels.end() || m_levels.size() <= m_found) return true;
    m_found = m_levels.size();
    m_line = 1 + m_read.lines - (ahead && m_read.last == '\n' ? 1 : 0);
    return m_found < m_parts.size();
  }

  const std::vector<std::string>& m_parts;
  const CountedText::Read& m_read;
  std::vector<Level> m_levels;
  size_t m_found = 0, m_line = 1;
};

/// "“Wood”": of an item of a list, as far as it says so.
QString nameIn(const json& item) {
  for (const char* key : {"label", "name", "title", "parameter", "id"}) {
    const auto found = item.is_object() ? item.find(key) : item.end();
    if (item.is_object() && found != item.end() && found->is_string() && !found->get<std::string>().empty())
      return QStringLiteral("“%1”").arg(QString::fromStdString(found->get<std::string>()));
  }
  return {};
}

const json* valueAt(const json& document, const std::vector<std::string>& parts, size_t count) {
  const json* value = &document;
  for (size_t k = 0; k < count; ++k) {
    if (value->is_object() && value->contains(parts[k])) {
      value = &(*value)[parts[k]];
    } else if (size_t index = 0; value->is_array() && parts[k].find_first_not_of("0123456789") == std::string::npos &&
                                 (index = std::strtoul(parts[k].c_str(), nullptr, 10)) < value->size()) {
      value = &(*value)[index];
    } else {
      return nullptr;
    }
  }
  return value;
}

/// ", Density, solid": the last part that a declaration has a name for; what is left as the file calls it.
QString rowIn(const std::vector<std::string>& parts, size_t from, api::ParameterList (*parameters)()) {
  for (size_t k = parts.size(); parameters && k-- > from;) {
    if (const api::ParameterDeclaration* declared = findDeclaration(parameters(), parts[k]))
      return QStringLiteral(", ") + QString::fromUtf8(declared->label);
  }
  return {};
}

/// "The material “Wood”, Density, solid"; "" where nothing in the file is meant.
QString thingAt(std::string_view pointer, const json& document) {
  const std::vector<std::string> parts = partsOf(pointer);
  for (const Kind& kind : kKinds) {
    if (!pointer.starts_with(kind.list)) continue;
    const size_t depth = partsOf(kind.list).size();
    const json* item = parts.size() > depth ? valueAt(document, parts, depth + 1) : nullptr;
    const QString name = item ? nameIn(*item) : QString();
    const QString which = !name.isEmpty() ? name
                          : parts.size() > depth
                              ? QStringLiteral("number %1").arg(std::strtoul(parts[depth].c_str(), nullptr, 10) + 1)
                              : QString();
    return QString::fromLatin1(kind.one) + QLatin1Char(' ') + which + rowIn(parts, depth + 1, kind.parameters);
  }
  for (const Part& part : kParts) {
    if (pointer.starts_with(part.path)) return QString::fromLatin1(part.name) + rowIn(parts, 1, part.parameters);
  }
  return {};
}

}  // namespace

size_t lineOfPointer(std::string_view text, std::string_view pointer) {
  const std::vector<std::string> parts = partsOf(pointer);
  CountedText::Read read;
  LineFinder finder(parts, read);
  json::sax_parse(CountedText{text.data(), &read}, CountedText{text.data() + text.size(), &read}, &finder);
  return finder.line();
}

FileProblems::FileProblems(const QString& path, std::string_view text) : m_path(path), m_text(text) {}

QString FileProblems::said(const std::string& message) {
  const std::string before = m_path.toStdString() + ":/";
  const QString whole = QString::fromStdString(message);
  if (!message.starts_with(before)) return whole;
  const size_t from = before.size() - 1, end = message.find(": ", from);
  if (end == std::string::npos) return whole;
  const std::string pointer = message.substr(from, end - from);
  const QString what = QString::fromStdString(message.substr(end + 2)), file = QFileInfo(m_path).fileName();
  if (!m_document)
    m_document = m_text.size() > kLongest ? json(json::value_t::discarded) : json::parse(m_text, nullptr, false);
  if (m_document->is_discarded())  // the sentence says line and column where it is no JSON
    return pointer == "/" ? QStringLiteral("%1: %2").arg(file, what)
                          : QStringLiteral("%1: %2 (at %3)").arg(file, what, QString::fromStdString(pointer));
  const QString thing = thingAt(pointer, *m_document);
  const QString place = QStringLiteral("(%1, line %2: %3)")
                            .arg(file)
                            .arg(lineOfPointer(m_text, pointer))
                            .arg(QString::fromStdString(pointer));
  QString said = what;
  while (said.endsWith(QLatin1Char('.'))) said.chop(1);
  return (thing.isEmpty() ? QStringLiteral("The project") : thing) + QStringLiteral(": ") + said + QLatin1Char(' ') +
         place;
}

}  // namespace ps
