// SPDX-License-Identifier: MIT
#pragma once
// The one header of the SDK that needs QtCore. A plugin's header declares
//
//   class Wax final : public QObject, public ps::api::MaterialPlugin {
//     Q_OBJECT
//     Q_PLUGIN_METADATA(IID PHASESKETCH_MATERIAL_IID FILE "wax.json")
//     Q_INTERFACES(ps::api::MaterialPlugin)
//
// and wax.json holds {"id": "wax", "kind": "material", "api": "0.9", "version": "1.0.0", "licence": "MIT",
// "author": "..."}. The host reads it, and the stamp of the headers, before any code is loaded; `api` is the oldest
// interface that the plugin can live with. An optional "capabilities": ["opens_energy"] lists what the plugin cannot do
// without beyond the interface of its kind: a program that lacks one of them refuses the plugin and says which. The
// names are in the README of the examples.
#include <QObject>
#include <QtPlugin>

#include <phasesketch/brush.h>
#include <phasesketch/constraint.h>
#include <phasesketch/material.h>
#include <phasesketch/stamp.h>
#include <phasesketch/thermal.h>

Q_DECLARE_INTERFACE(ps::api::MaterialPlugin, PHASESKETCH_MATERIAL_IID)
Q_DECLARE_INTERFACE(ps::api::StructuralPlugin, PHASESKETCH_STRUCTURAL_IID)
Q_DECLARE_INTERFACE(ps::api::GroupPlugin, PHASESKETCH_GROUP_IID)
Q_DECLARE_INTERFACE(ps::api::NeighbourPlugin, PHASESKETCH_NEIGHBOUR_IID)
Q_DECLARE_INTERFACE(ps::api::ThermalPlugin, PHASESKETCH_THERMAL_IID)
Q_DECLARE_INTERFACE(ps::api::HeatSourcePlugin, PHASESKETCH_HEAT_SOURCE_IID)
Q_DECLARE_INTERFACE(ps::api::BrushPlugin, PHASESKETCH_BRUSH_IID)
