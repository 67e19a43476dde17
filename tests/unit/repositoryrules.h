// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

// The rules that keep the house in order, as pure functions of a file's path and text, so that they can be tested
// against texts that break them. `path` is relative to the project's root, with '/'. Every problem is one line:
// "core/scene/x.h:12: ...".
namespace ps::rules {

using Problems = std::vector<std::string>;

/// Includes follow the arrows app -> ui -> core and plugins -> <phasesketch/...>; inside core and ui only from a later
/// room to an earlier one; core knows neither OpenGL nor Qt (plugin_host: QtCore), ui/render no Qt, app/cli no widgets.
Problems includes(std::string_view path, std::string_view text);

/// The first lines carry the licence: MIT for the SDK and the example plugins, Apache-2.0 for the rest.
Problems licence(std::string_view path, std::string_view text);

/// Nothing is left for later, and no path of somebody's machine is written down.
Problems words(std::string_view path, std::string_view text);

/// Colours of the interface come from resources/theme/tokens.json alone.
Problems colours(std::string_view path, std::string_view text);

/// Tooltips come through ui/theme/plaintext.h, which knows what is plain text.
Problems tips(std::string_view path, std::string_view text);

/// Nothing stands in the way with a question or news: notices and dialogs of our own say them.
Problems boxes(std::string_view path, std::string_view text);

/// Markdown documents that are mentioned by name exist; `known` are the names of those that do.
Problems documents(std::string_view path, std::string_view text, const std::vector<std::string>& known);

}  // namespace ps::rules
