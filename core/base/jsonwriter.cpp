// SPDX-License-Identifier: Apache-2.0
#include "core/base/jsontext.h"

#include <charconv>
#include <cmath>

namespace ps {
namespace {

using nlohmann::json;

constexpr size_t kLineWidth = 110;

void writeFloat(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  char buffer[40];
  const double size = std::fabs(value);
  const bool plain = size >= 1e-5 && size < 1e15;  // 0.0005 rather than 5e-04
  const char* end = (plain ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                           : std::to_chars(buffer, buffer + sizeof buffer, value))
                        .ptr;
  const std::string_view digits(buffer, static_cast<size_t>(end - buffer));
  out += digits;
  if (digits.find_first_of(".e") == std::string_view::npos) out += ".0";
}

void writeScalar(std::string& out, const json& value) {
  if (value.is_number_float()) {
    writeFloat(out, value.get<double>());
  } else {
    out += value.dump(-1, ' ', false, json::error_handler_t::replace);
  }
}

std::string quoted(const std::string& key) { return json(key).dump(-1, ' ', false, json::error_handler_t::replace); }

/// Writes on one line, giving up (false) past `limit` bytes. Arrays always; objects only where `objects`.
bool writeInline(std::string& out, const json& value, size_t limit, bool objects) {
  if (!value.is_structured()) {
    writeScalar(out, value);
    return out.size() <= limit;
  }
  if (value.is_object() && !objects && !value.empty()) return false;
  out += value.is_object() ? '{' : '[';
  bool first = true;
  for (auto item = value.begin(); item != value.end(); ++item) {
    if (!first) out += ", ";
    first = false;
    if (value.is_object()) out += quoted(item.key()) + ": ";
    if (!writeInline(out, *item, limit, objects) || out.size() > limit) return false;
  }
  out += value.is_object() ? '}' : ']';
  return out.size() <= limit;
}

/// An object that reads best on one line: a curve, a law, a small plain record without structure inside.
bool isSmallRecord(const json& value) {
  if (value.is_object() && (value.contains("curve") || value.contains("law"))) return true;
  return false;
}

void write(std::string& out, const json& value, size_t indent, size_t column) {
  std::string line;
  if (writeInline(line, value, kLineWidth > column ? kLineWidth - column : 0, isSmallRecord(value)) ||
      !value.is_structured()) {
    out += line;
    return;
  }
  const bool object = value.is_object();
  const std::string margin(indent + 2, ' ');
  out += object ? "{\n" : "[\n";
  for (auto item = value.begin(); item != value.end(); ++item) {
    if (item != value.begin()) out += ",\n";
    out += margin;
    const std::string key = object ? quoted(item.key()) + ": " : "";
    out += key;
    write(out, *item, indent + 2, indent + 2 + key.size());
  }
  out += "\n" + std::string(indent, ' ') + (object ? '}' : ']');
}

}  // namespace

std::string writeJson(const json& value) {
  std::string out;
  write(out, value, 0, 0);
  return out + "\n";
}

}  // namespace ps
