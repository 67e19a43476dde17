// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

#include "clothmodel.h"

/// The plugin "cloth": ClothModel behind Qt's plugin door.
class ClothPlugin final : public QObject, public ps::constraint::ClothModel {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_STRUCTURAL_IID FILE "cloth.json")
  Q_INTERFACES(ps::api::StructuralPlugin)
};
