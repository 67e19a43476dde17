// SPDX-License-Identifier: MIT
#pragma once
// The one header of the SDK that needs QtCore. A plugin's header declares
//
//   class Wax final : public QObject, public ps::api::MaterialPlugin {
//     Q_OBJECT
//     Q_PLUGIN_METADATA(IID PHASESKETCH_MATERIAL_IID FILE "wax.json")
//     Q_INTERFACES(ps::api::MaterialPlugin)
//
// and wax.json holds {"id": "wax", "kind": "material", "api": "1.0", "version": "1.0.0", "licence": "MIT",
// "author": "..."}. The host reads it before any code is loaded. An optional "capabilities": ["opens_energy"] lists
// what the plugin cannot do without beyond the interface of its kind: a program that lacks one of them refuses the
// plugin and says which. The names are in the README of the examples.
#include <QObject>
#include <QtPlugin>

#include <phasesketch/brush.h>
#include <phasesketch/constraint.h>
#include <phasesketch/material.h>
#include <phasesketch/thermal.h>

Q_DECLARE_INTERFACE(ps::api::MaterialPlugin, PHASESKETCH_MATERIAL_IID)
Q_DECLARE_INTERFACE(ps::api::ConstraintPlugin, PHASESKETCH_CONSTRAINT_IID)
Q_DECLARE_INTERFACE(ps::api::ThermalPlugin, PHASESKETCH_THERMAL_IID)
Q_DECLARE_INTERFACE(ps::api::BrushPlugin, PHASESKETCH_BRUSH_IID)
