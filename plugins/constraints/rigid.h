// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

#include "rigidmodel.h"

/// The plugin "rigid": RigidModel behind Qt's plugin door.
class RigidPlugin final : public QObject, public ps::constraint::RigidModel {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_GROUP_IID FILE "rigid.json")
  Q_INTERFACES(ps::api::GroupPlugin)
};
