// SPDX-License-Identifier: Apache-2.0
#include "ui/session/fileproblem.h"

#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/matter/material.h"
#include "core/parameters/parameterset.h"
#include "core/scene/project.h"

#include <QtCore/QFileInfo>

#include <algorithm>
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

/// Walks through a text that has been read as JSON, so that it may trust it.
class Walk {
 public:
  explicit Walk(std::string_view text) : m_text(text) {}
  size_t at() const { return m_at; }

  /// To where the member or element begins; false, and nowhere, when there is none.
  bool enter(const std::string& part) {
    skipSpace();
    const size_t start = m_at;
    const bool object = peek() == '{';
    if (!object && peek() != '[') return false;
    ++m_at;
    for (size_t index = 0; skipSpace(), m_at < m_text.size() && peek() != '}' && peek() != ']'; ++index) {
      const size_t begin = m_at;
      const bool found = object ? readText() == part : std::to_string(index) == part;
      if (object) skipSpace(), ++m_at, skipSpace();  // the colon
      if (found) {
        m_begin = begin;
        return true;
      }
      skipValue();
      skipSpace();
      if (peek() == ',') ++m_at;
    }
    m_at = start;
    return false;
  }
  size_t begin() const { return m_begin; }  ///< of the last that was entered, with its name

 private:
  char peek() const { return m_at < m_text.size() ? m_text[m_at] : '\0'; }
  void skipSpace() {
    while (m_at < m_text.size() && std::string_view(" \t\r\n").find(m_text[m_at]) != std::string_view::npos) ++m_at;
  }
  std::string readText() {
    const size_t from = m_at;
    for (++m_at; m_at < m_text.size() && m_text[m_at] != '"'; ++m_at) m_at += m_text[m_at] == '\\' ? 1 : 0;
    ++m_at;
    const json value = json::parse(m_text.substr(from, m_at - from), nullptr, false);
    return value.is_string() ? value.get<std::string>() : std::string();
  }
  void skipValue() {
    size_t depth = 0;
    do {
      skipSpace();
      const char c = peek();
      if (c == '"') {
        readText();
      } else if (c == '{' || c == '[') {
        ++depth, ++m_at;
      } else if (c == '}' || c == ']') {
        --depth, ++m_at;
      } else if (c == ',' || c == ':') {
        ++m_at;
      } else {
        while (m_at < m_text.size() && std::string_view(",:]} \t\r\n").find(m_text[m_at]) == std::string_view::npos)
          ++m_at;
      }
    } while (depth > 0 && m_at < m_text.size());
  }

  std::string_view m_text;
  size_t m_at = 0, m_begin = 0;
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
  Walk walk(text);
  size_t begin = 0;
  for (const std::string& part : partsOf(pointer)) {
    if (!walk.enter(part)) break;
    begin = walk.begin();
  }
  return 1 + static_cast<size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
}

QString fileProblem(const std::string& message, const QString& path, std::string_view text) {
  const std::string before = path.toStdString() + ":/";
  const QString whole = QString::fromStdString(message);
  if (!message.starts_with(before)) return whole;
  const size_t from = before.size() - 1, end = message.find(": ", from);
  if (end == std::string::npos) return whole;
  const std::string pointer = message.substr(from, end - from);
  const QString what = QString::fromStdString(message.substr(end + 2)), file = QFileInfo(path).fileName();
  const json document = text.size() > kLongest ? json(json::value_t::discarded)
                                               : json::parse(text, nullptr, false);  // parsed: it was read
  if (document.is_discarded())  // the sentence says line and column where it is no JSON
    return pointer == "/" ? QStringLiteral("%1: %2").arg(file, what)
                          : QStringLiteral("%1: %2 (at %3)").arg(file, what, QString::fromStdString(pointer));
  const QString thing = thingAt(pointer, document);
  const QString place = QStringLiteral("(%1, line %2: %3)")
                            .arg(file)
                            .arg(lineOfPointer(text, pointer))
                            .arg(QString::fromStdString(pointer));
  QString said = what;
  while (said.endsWith(QLatin1Char('.'))) said.chop(1);
  return (thing.isEmpty() ? QStringLiteral("The project") : thing) + QStringLiteral(": ") + said + QLatin1Char(' ') +
         place;
}

}  // namespace ps
