// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/qtentry.h>

/// Density of liquid water in kg/m3 at 101325 Pa (Kell 1975, eq. 16), with the maximum of 999.972 kg/m3 at 3.98 °C.
/// `kelvin` is held within -30 °C (supercooled) to 150 °C, the range of the measurements behind it; error below
/// 0.01 kg/m3 from 0 to 100 °C.
double waterDensity(double kelvin);

/// Water, ice and steam.
class WaterMaterial final : public QObject, public ps::api::Described<ps::api::MaterialPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_MATERIAL_IID FILE "water.json")
  Q_INTERFACES(ps::api::MaterialPlugin)

 public:
  WaterMaterial();

  ps::api::List<ps::api::MaterialProperty> properties() const noexcept override;
  bool evaluate(const char* key, ps::api::Span<const double> parameters, ps::api::Span<const double> kelvin,
                ps::api::Span<double> out) const override;
};
