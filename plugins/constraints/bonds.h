// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

#include "bondmodel.h"

/// The plugin "bonds": BondModel behind Qt's plugin door.
class BondsPlugin final : public QObject, public ps::constraint::BondModel {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_STRUCTURAL_IID FILE "bonds.json")
  Q_INTERFACES(ps::api::StructuralPlugin)
};
