// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

/// A hollow strand around the way of the stroke, open at its ends.
class TubeBrush final : public QObject, public ps::api::Described<ps::api::BrushPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_BRUSH_IID FILE "tube.json")
  Q_INTERFACES(ps::api::BrushPlugin)

 public:
  TubeBrush();

  void stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
              const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const override;
  ps::api::Double3 extent(const ps::api::StrokeContext& context) const noexcept override;
};
