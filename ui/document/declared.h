// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "core/simulation/declared.h"

#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtGui/QColor>

// How people see what an address means.
namespace ps {

/// What a body, wall, tap, drain or probe is called: its name, or else its id.
QString nameOf(const auto& item) { return QString::fromStdString(shownName(item)); }
/// Who an address belongs to, as people call it: "Water", "Hot plate", "Solver".
QString ownerLabel(const Project& project, const Address& address);
/// What a parameter is called away from its owner's other ones: "Hot plate temperature"; a label that says enough by
/// itself stays.
QString awayLabel(const Project& project, const Address& address, const QString& label);
/// What the choices of an address are called, in the order of its declaration: plugins and materials by their labels.
/// Empty where the names themselves say it.
QStringList choiceLabels(const Project& project, const PluginRegistry* plugins, const Address& address,
                         const api::ParameterDeclaration& declaration);
/// The label of a plugin, installed or found at least; its id otherwise.
QString pluginLabel(const PluginRegistry* plugins, const std::string& id);
/// Ids of the installed plugins of a kind, in the order of what they are called.
std::vector<std::string> idsByLabel(const PluginRegistry& plugins, PluginKind kind);
/// How matter of a scene material is shown at 20 °C; grey where nothing says so.
QColor colourOf(const Project& project, const PluginRegistry* plugins, const std::string& material);

}  // namespace ps
