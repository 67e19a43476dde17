// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/missingplugins.h"
#include "ui/session/messagelog.h"

#include <QtCore/QString>

#include <vector>

namespace ps {
class Document;
}

// Links of notes and messages that lead out of a trouble; who has the window follows them.
namespace ps::wayout {

inline constexpr const char* kPlugin = "plugin:";      ///< with a plugin's id: look for it
inline constexpr const char* kTryAgain = "tryagain:";  ///< with the id of one in quarantine: try it once more
inline constexpr const char* kMaterial = "material:";  ///< with a scene material's id: choose another for it

inline constexpr const char* kAction = "action:";  ///< with an action's name: do it

/// The link that does what a menu does: "simulation.tryVr".
QString action(const char* name);
/// Whether a link is one of these.
bool isWayOut(const QString& link);
/// "Find plugin…", or "Try again" of one in quarantine; "Use another material…".
std::vector<MessageLink> linksOf(const MissingPlugin& missing, const PluginRegistry& plugins);
/// What is missing, with these links, as ParameterRow::setLimit() takes it.
QString note(const MissingPlugin& missing, const Document& document);

}  // namespace ps::wayout
