// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace ps {

/// Where a text stops being UTF-8 (RFC 3629: no overlong forms, no surrogates); its length where all of it is.
size_t utf8Length(std::string_view text);

/// For messages: at most `most` bytes of a text from outside, where control characters become spaces and what is not
/// UTF-8 becomes U+FFFD; with "…" behind what was cut.
std::string shownText(std::string_view text, size_t most);

/// At most `most` bytes of a UTF-8 text, cut at a character's end, with "…" behind what was cut.
std::string cutText(std::string_view text, size_t most);

}  // namespace ps
