// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"

#include <string>
#include <string_view>

class QJsonObject;

namespace ps {

/// "" or what is wrong with a plugin's id: 1 to 64 characters, lower-case words of letters and digits joined by '.',
/// '_' or '-', beginning with a letter: "water", "org.example.rust".
std::string problemOfId(std::string_view id);
/// "" or what is wrong with an API version "MAJOR.MINOR": the major must be ours, the minor not above ours.
std::string problemOfApi(std::string_view api);
/// "" or what is wrong with a version "1.0.0": one to four numbers joined by dots, then an optional "-beta2".
std::string problemOfVersion(std::string_view version);

/// Reads what a library holds as its metadata, `info` as far as it can be read; "" or what is wrong.
std::string checkMetadata(const QJsonObject& root, PluginInfo& info);

/// Reads a library's metadata and checks them; no code of the library runs. What can be read is in the result even when
/// `problem` is set.
PluginInfo readLibraryMetadata(const std::string& path);

}  // namespace ps
