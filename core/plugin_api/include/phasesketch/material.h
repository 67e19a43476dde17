// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/plugin.h>

#define PHASESKETCH_MATERIAL_IID "org.phasesketch.Material/0.9"

namespace ps::api {

/// One property of a material: a key of the host's catalogue (`phasesketch-cli plugins --json` lists them).
struct MaterialProperty {
  const char* key;
  ResponseSpec value;
  const char* source;  ///< where the figure comes from
  char grade;          ///< 'A' reference data, 'B' handbook, 'C' representative
  char reserved[7]{};
};

class MaterialPlugin : public Plugin {
 public:
  virtual List<MaterialProperty> properties() const = 0;
  /// Optional: values of a property from the plugin's own law, baked into a table before a run.
  /// Returns false when the plugin leaves this property to `properties()`. May throw.
  virtual bool evaluate(const char* /*key*/, Span<const double> /*parameters*/, Span<const double> /*temperature_K*/,
                        Span<double> /*out*/) const {
    return false;
  }
};

}  // namespace ps::api
