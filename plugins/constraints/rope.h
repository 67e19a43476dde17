// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

#include "ropemodel.h"

/// The plugin "rope": RopeModel behind Qt's plugin door.
class RopePlugin final : public QObject, public ps::constraint::RopeModel {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_STRUCTURAL_IID FILE "rope.json")
  Q_INTERFACES(ps::api::StructuralPlugin)
};
