// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/declared.h"

#include <QtCore/QString>
#include <QtGui/QColor>

// How people see what an address means.
namespace ps {

/// Who an address belongs to, as people call it: "Water", "Hot plate", "Solver".
QString ownerLabel(const Project& project, const Address& address);
/// What a parameter is called away from its owner's other ones: "Hot plate temperature"; a label that says enough by
/// itself stays.
QString awayLabel(const Project& project, const Address& address, const QString& label);
/// How matter of a scene material is shown at 20 °C; grey where nothing says so.
QColor colourOf(const Project& project, const PluginRegistry* plugins, const std::string& material);

}  // namespace ps
