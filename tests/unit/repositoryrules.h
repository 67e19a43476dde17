// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
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

/// Colours of the interface come from resources/theme/tokens.json alone; those of data from maps.json beside it.
Problems colours(std::string_view path, std::string_view text);

/// Tooltips come through ui/theme/plaintext.h, which knows what is plain text.
Problems tips(std::string_view path, std::string_view text);

/// Nothing stands in the way with a question or news: notices and dialogs of our own say them.
Problems boxes(std::string_view path, std::string_view text);

/// Refusals and notices begin with a sentence and go on to say more, errors that are logged as well; nothing shouts.
Problems messages(std::string_view path, std::string_view text);

/// Markdown documents that are mentioned by name exist; `known` are the names of those that do.
Problems documents(std::string_view path, std::string_view text, const std::vector<std::string>& known);

/// What a file defines by name at the level of its namespaces: "ps::Body". Not what is its own (no name of a namespace)
/// or made once for each instruction set. Two classes of one name are one to the linker, which keeps the members of
/// either: matter of one is destroyed as the other.
std::vector<std::string> defined(std::string_view text);

/// What `path` defines and a file before it has defined; `before` says which, and takes on what is new.
Problems names(std::string_view path, std::string_view text, std::map<std::string, std::string>& before);

}  // namespace ps::rules
