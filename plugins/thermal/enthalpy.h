// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

#include "enthalpymodel.h"

/// The plugin "enthalpy": EnthalpyModel behind Qt's plugin door.
class EnthalpyPlugin final : public QObject, public ps::thermal::EnthalpyModel {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_THERMAL_IID FILE "enthalpy.json")
  Q_INTERFACES(ps::api::ThermalPlugin)
};
