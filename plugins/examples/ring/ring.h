// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// A brush that stamps a ring around the direction "up".
class Ring final : public QObject, public ps::api::Described<ps::api::BrushPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_BRUSH_IID FILE "ring.json")
  Q_INTERFACES(ps::api::BrushPlugin)

 public:
  Ring();

  void stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
              const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const override;
  ps::api::Double3 extent(const ps::api::StrokeContext& context) const noexcept override;
};
