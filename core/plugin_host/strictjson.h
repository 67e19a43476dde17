// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace ps {

/// Parses JSON and refuses what nlohmann would silently accept or lose: nesting deeper than `maxDepth`, duplicate keys,
/// numbers that overflow. Throws InputError "name:/json/pointer: what is wrong" or, for broken syntax, "name: line L,
/// column C: ...".
nlohmann::json parseStrictJson(std::string_view text, const std::string& name, size_t maxDepth);

/// One part of a JSON pointer (RFC 6901): '~' and '/' escaped.
std::string jsonPointerPart(std::string_view key);
/// "a number", "a string", "an object", ... for messages.
const char* jsonTypeName(const nlohmann::json& value);

}  // namespace ps
