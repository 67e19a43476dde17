// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

/// Parts matter along the way of the hand.
class CutBrush final : public QObject, public ps::api::Described<ps::api::BrushPlugin>, public ps::api::MatterBrush {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_BRUSH_IID FILE "cut.json")
  Q_INTERFACES(ps::api::BrushPlugin)

 public:
  CutBrush();

  void touch(const ps::api::StrokeContext& context, ps::api::EditKind kind,
             const ps::api::List<ps::api::StrokeSample>& samples, ps::api::TouchSink& sink) const override;
  void stroke(const ps::api::StrokeContext&, ps::api::EditKind, const ps::api::List<ps::api::StrokeSample>&,
              ps::api::EditSink&) const override {}
  ps::api::Double3 extent(const ps::api::StrokeContext& context) const noexcept override;
  const void* extension(const char* name) const noexcept override;
};
