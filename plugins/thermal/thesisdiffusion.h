// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

#include "thesisdiffusionmodel.h"

/// The plugin "thesis_diffusion": ThesisDiffusionModel behind Qt's plugin door.
class ThesisDiffusionPlugin final : public QObject, public ps::thermal::ThesisDiffusionModel {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_THERMAL_IID FILE "thesisdiffusion.json")
  Q_INTERFACES(ps::api::ThermalPlugin)
};
