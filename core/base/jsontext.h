// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

// Compiled once, in jsontext.cpp: it is most of what a unit with JSON costs.
extern template class nlohmann::basic_json<>;

namespace ps {

/// Deepest nesting and largest number of values that are read from a file.
inline constexpr size_t kMaximumDepth = 64;
inline constexpr size_t kMaximumValues = 8'000'000;

/// Parses JSON (RFC 8259, UTF-8). Memory is bounded by the text, the stack by nothing the text can say.
/// Throws InputError "name:/json/pointer: what is wrong": empty, not UTF-8, a syntax error with line and column,
/// nesting deeper than kMaximumDepth, duplicate keys, NaN and infinities, numbers that overflow.
nlohmann::json parseJson(std::string_view text, const std::string& name);

/// Sorted keys, two spaces, shortest numbers that read back equal; arrays and small objects that fit stand on one line.
/// Newline at the end. What is not finite is written as null: check before.
std::string writeJson(const nlohmann::json& value);

/// One part of a JSON pointer (RFC 6901): ~ and / escaped.
std::string pointerPart(std::string_view key);

/// What a value is, for messages: "a list", "the text 'ice'", "the number 5".
std::string jsonInWords(const nlohmann::json& value);

/// A number as JSON keeps it best: whole numbers without ".0".
nlohmann::json jsonNumber(double value);

}  // namespace ps
