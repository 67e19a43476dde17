// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

/// Gives a ball of the matter that is there a colour of its own at every sample of the stroke.
class TintBrush final : public QObject, public ps::api::Described<ps::api::BrushPlugin>, public ps::api::ColourBrush {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_BRUSH_IID FILE "tint.json")
  Q_INTERFACES(ps::api::BrushPlugin)

 public:
  TintBrush();

  void stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
              const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const override;
  ps::api::Double3 extent(const ps::api::StrokeContext& context) const noexcept override;
  ps::api::Double3 colour(const ps::api::StrokeContext& context) const noexcept override;
  const void* extension(const char* name) const noexcept override;
};
