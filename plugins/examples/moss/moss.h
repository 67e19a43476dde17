// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// A brush that goes by the matter that is there: it grows on it, and nowhere else.
class Moss final : public QObject, public ps::api::Described<ps::api::BrushPlugin>, public ps::api::SeeingBrush {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_BRUSH_IID FILE "moss.json")
  Q_INTERFACES(ps::api::BrushPlugin)

 public:
  Moss();

  double reach(const ps::api::StrokeContext& context) const noexcept override;
  void stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
              const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const override;
  ps::api::Double3 extent(const ps::api::StrokeContext& context) const noexcept override;
  const void* extension(const char* name) const noexcept override;
};
