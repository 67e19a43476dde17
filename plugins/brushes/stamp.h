// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

/// Puts copies of the shape of a body.
class StampBrush final : public QObject, public ps::api::Described<ps::api::BrushPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_BRUSH_IID FILE "stamp.json")
  Q_INTERFACES(ps::api::BrushPlugin)

 public:
  StampBrush();

  void stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
              const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const override;
  ps::api::Double3 extent(const ps::api::StrokeContext& context) const noexcept override;
  const void* extension(const char* name) const noexcept override;
};
