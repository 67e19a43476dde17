// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// Honey: a material with a law of its own. Viscosity depends on temperature and on a parameter, the moisture.
class Honey final : public QObject, public ps::api::Described<ps::api::MaterialPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_MATERIAL_IID FILE "honey.json")
  Q_INTERFACES(ps::api::MaterialPlugin)

 public:
  Honey();

  ps::api::List<ps::api::MaterialProperty> properties() const noexcept override;
  bool evaluate(const char* key, ps::api::Span<const double> parameters, ps::api::Span<const double> temperature,
                ps::api::Span<double> out) const override;
};
