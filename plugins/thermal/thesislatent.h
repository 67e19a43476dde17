// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

#include "thesislatentmodel.h"

/// The plugin "thesis_latent": ThesisLatentModel behind Qt's plugin door.
class ThesisLatentPlugin final : public QObject, public ps::thermal::ThesisLatentModel {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_THERMAL_IID FILE "thesislatent.json")
  Q_INTERFACES(ps::api::ThermalPlugin)
};
