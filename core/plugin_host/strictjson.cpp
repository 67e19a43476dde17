// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/strictjson.h"

#include "core/base/error.h"

#include <set>
#include <vector>

namespace ps {
namespace {

using nlohmann::json;

/// Follows the parser from event to event and throws at the first thing that may not be.
class Watch {
 public:
  Watch(const std::string& name, size_t maxDepth) : m_name(name), m_maxDepth(maxDepth) {}

  bool operator()(int, json::parse_event_t event, json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        if (m_levels.size() == m_maxDepth)
          fail("brackets are nested deeper than " + std::to_string(m_maxDepth) + " levels");
        m_levels.push_back({event == json::parse_event_t::array_start, 0, {}, {}});
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        m_levels.pop_back();
        advance();
        break;
      case json::parse_event_t::key:
        m_levels.back().key = parsed.get<std::string>();
        if (!m_levels.back().keys.insert(m_levels.back().key).second) fail("this key stands here twice");
        break;
      case json::parse_event_t::value:
        advance();
        break;
    }
    return true;
  }

 private:
  struct Level {
    bool array;
    size_t index;
    std::string key;
    std::set<std::string> keys;
  };

  void advance() {
    if (!m_levels.empty() && m_levels.back().array) ++m_levels.back().index;
  }

  [[noreturn]] void fail(const std::string& what) const {
    constexpr size_t kShown = 8;  // a pointer into 200,000 brackets helps nobody
    std::string pointer;
    for (size_t i = 0; i < m_levels.size() && i < kShown; ++i) {
      pointer += '/';
      pointer += m_levels[i].array ? std::to_string(m_levels[i].index) : jsonPointerPart(m_levels[i].key);
    }
    if (m_levels.size() > kShown) pointer += "/...";
    throw InputError(m_name + ":" + (pointer.empty() ? "/" : pointer) + ": " + what);
  }

  const std::string& m_name;
  size_t m_maxDepth;
  std::vector<Level> m_levels;
};

/// "[json.exception.parse_error.101] parse error at line 3, column 5: ..." without what means nothing to a person.
std::string readable(std::string what) {
  if (const size_t bracket = what.find("] "); bracket != std::string::npos) what.erase(0, bracket + 2);
  for (const std::string_view prefix : {"parse error at ", "parse error: "})
    if (what.starts_with(prefix)) what.erase(0, prefix.size());
  for (char& c : what)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  constexpr size_t kLongest = 200;
  if (what.size() > kLongest) what = what.substr(0, kLongest) + "...";
  return what;
}

}  // namespace

json parseStrictJson(std::string_view text, const std::string& name, size_t maxDepth) {
  try {
    return json::parse(text.begin(), text.end(), Watch(name, maxDepth));
  } catch (const json::exception& problem) {
    throw InputError(name + ": is not valid JSON: " + readable(problem.what()));
  }
}

std::string jsonPointerPart(std::string_view key) {
  std::string part;
  for (const char c : key) {
    if (c == '~') {
      part += "~0";
    } else if (c == '/') {
      part += "~1";
    } else {
      part += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return part;
}

const char* jsonTypeName(const json& value) {
  switch (value.type()) {
    case json::value_t::null:
      return "null";
    case json::value_t::object:
      return "an object";
    case json::value_t::array:
      return "a list";
    case json::value_t::string:
      return "a text";
    case json::value_t::boolean:
      return "true or false";
    case json::value_t::number_integer:
    case json::value_t::number_unsigned:
    case json::value_t::number_float:
      return "a number";
    default:
      return "something else";
  }
}

}  // namespace ps
