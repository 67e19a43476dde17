// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <QtCore/QString>

namespace ps {

class PluginRegistry;

/// What a body is to the eye, as it begins: held in place, held together in some way, or else loose matter of a phase.
struct BodyKind {
  QString icon;  ///< of resources/icons
  QString name;  ///< "Rigid"; "": nothing can be said
};

/// By what plugins can hold together, whatever they are called. The phase is that at the usual pressure, unless the
/// body says it. `plugins`: nullptr where none are loaded.
BodyKind kindOf(const Body& body, const Project& project, const PluginRegistry* plugins);

}  // namespace ps
