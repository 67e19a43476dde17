// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

#include "clustermodel.h"

/// The plugin "clusters": ClusterModel behind Qt's plugin door.
class ClusterPlugin final : public QObject, public ps::constraint::ClusterModel {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_GROUP_IID FILE "clusters.json")
  Q_INTERFACES(ps::api::GroupPlugin)
};
