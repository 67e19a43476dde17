// SPDX-License-Identifier: Apache-2.0
#include "core/base/jsontext.h"

#include "core/base/error.h"
#include "core/base/utf8.h"

#include <cmath>
#include <limits>
#include <vector>

template class nlohmann::basic_json<>;

namespace ps {
namespace {

using nlohmann::json;

/// Builds the value event by event, so that depth, duplicates and numbers are checked before anything is kept.
class Builder final : public nlohmann::json_sax<json> {
 public:
  Builder(std::string_view text, const std::string& name) : m_text(text), m_name(name) {}

  json result() { return std::move(m_root); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t& token) override {
    if (!std::isfinite(value)) failLarge(token);
    return put(value);
  }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    m_levels.back().key = name;
    if (m_levels.back().value->contains(name)) fail("the key '" + shownText(name, 80) + "' stands here twice");
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& problem) override {
    if (problem.id == 406) failLarge(token);
    fail(place(position) + ": " + reason(position, problem.what()));
  }

 private:
  struct Level {
    json* value;
    std::string key;  ///< of the member being read
  };

  bool put(json&& value) {
    if (++m_count > kMaximumValues) fail("holds more than " + std::to_string(kMaximumValues) + " values");
    append(std::move(value));
    return true;
  }

  json* append(json&& value) {
    if (m_levels.empty()) return &(m_root = std::move(value));
    Level& level = m_levels.back();
    if (level.value->is_object()) return &((*level.value)[level.key] = std::move(value));
    level.value->push_back(std::move(value));
    return &level.value->back();
  }

  bool open(json&& empty) {
    if (m_levels.size() == kMaximumDepth) {
      fail("brackets are nested deeper than " + std::to_string(kMaximumDepth) + " levels");
    }
    if (++m_count > kMaximumValues) fail("holds more than " + std::to_string(kMaximumValues) + " values");
    m_levels.push_back({append(std::move(empty)), {}});
    return true;
  }

  bool close() {
    m_levels.pop_back();
    return true;
  }

  std::string pointer() const {
    std::string text;
    for (const Level& level : m_levels) {
      const bool object = level.value->is_object();
      if (object && level.key.empty()) continue;
      const bool open = &level != &m_levels.back();  // the element being read is already in the array
      text += "/" + (object ? pointerPart(level.key) : std::to_string(level.value->size() - (open ? 1 : 0)));
      if (text.size() > 200) return cutText(text, 200);
    }
    return text.empty() ? "/" : text;
  }

  std::string place(size_t position) const {
    const std::string_view read = m_text.substr(0, std::min(position > 0 ? position - 1 : 0, m_text.size()));
    size_t line = 1, column = 1;
    for (const char c : read) {
      column = c == '\n' ? 1 : column + ((c & 0xC0) != 0x80);
      line += c == '\n';
    }
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
  }

  /// The parser's words without its prefix.
  std::string reason(size_t position, const std::string& what) const {
    if (what.find("unexpected end of input") != std::string::npos ||
        what.find("missing closing quote") != std::string::npos) {
      return "the file ends too early; it may have been cut off";
    }
    if (what.find("ill-formed UTF-8") != std::string::npos) return "not UTF-8 text";
    if (what.find("surrogate") != std::string::npos) return "half a character: \\uD800 to \\uDFFF stand in pairs";
    const char last = position > 0 && position <= m_text.size() ? m_text[position - 1] : ' ';
    if ((last == 'N' || last == 'I') && what.find("; expected") == std::string::npos) {
      return "NaN and Infinity are not numbers in JSON";
    }
    const auto has = [&](const char* words) { return what.find(words) != std::string::npos; };
    const bool value = has("literal; expected") || has("unexpected '{'") || has("unexpected '['");
    if (value && (what.ends_with("expected '}'") || what.ends_with("expected ']'")))
      return "not valid JSON: a comma is missing before it";
    const size_t dash = what.find(" - ");
    const std::string words = dash == std::string::npos ? what : what.substr(dash + 3);
    return shownText("not valid JSON: " + words, 160);  // they may end within a character
  }

  [[noreturn]] void failLarge(const std::string& number) const {
    fail("the number " + shownText(number, 40) + " is too large");
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(m_name + ":" + pointer() + ": " + what); }

  std::string_view m_text;
  const std::string& m_name;
  json m_root;
  std::vector<Level> m_levels;
  size_t m_count = 0;
};

/// Refuses what is no text at all with a better word than a syntax error's.
void checkEncoding(std::string_view text, const std::string& name) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) throw InputError(name + ":/: the file is empty");
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw InputError(name + ":/: is UTF-16 text; save it as UTF-8");
  }
  if (text.find('\0') != std::string_view::npos) throw InputError(name + ":/: is not text but binary data");
}

}  // namespace

json parseJson(std::string_view text, const std::string& name) {
  checkEncoding(text, name);
  Builder builder(text, name);
  json::sax_parse(text.begin(), text.end(), &builder);
  return builder.result();
}

std::string pointerPart(std::string_view key) {
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
  return cutText(part, 80);
}

std::string jsonInWords(const json& value) {
  switch (value.type()) {
    case json::value_t::null:
      return "null";
    case json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    case json::value_t::string:
      return "the text '" + shownText(value.get_ref<const std::string&>(), 40) + "'";
    case json::value_t::array:
      return "a list";
    case json::value_t::object:
      return "an object";
    default:
      return "the number " + value.dump();
  }
}

json jsonNumber(double value) {
  constexpr double kExact = 9007199254740992.0;  // 2^53: every whole number below is exact
  if (std::isfinite(value) && std::fabs(value) < kExact && value == std::floor(value)) {
    return static_cast<int64_t>(value);
  }
  return value;
}

}  // namespace ps
