// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/types.h>

namespace ps::api {

enum class ParameterKind : uint32_t {
  Number,    ///< a real number in `unit`
  Integer,   ///< a whole number
  Toggle,    ///< 0 or 1
  Choice,    ///< one of `choices`, stored by name
  Response,  ///< a number or a curve or law over temperature
};

enum class Scale : uint32_t { Linear, Logarithmic };

/// Declared once; becomes a slider, a JSON key, a tooltip, a plot source and a test row.
/// All numbers are SI (kelvin for temperatures); `display*` say how people see them.
struct ParameterDeclaration {
  const char* key;     ///< JSON name, lower_snake_case
  const char* label;   ///< "Conductivity, ice"
  const char* symbol;  ///< "k_s"; "" for none
  const char* unit;    ///< SI unit of the stored value: "W/(m·K)"; "" for none
  ParameterKind kind;
  Scale scale;
  double defaultValue;  ///< for Choice: index into `choices`
  double minimum;       ///< slider's range
  double maximum;
  double hardMinimum;  ///< values beyond these are refused
  double hardMaximum;
  const char* displayUnit;  ///< "°C"; "" shows `unit`
  double displayScale;      ///< shown = stored * displayScale + displayOffset
  double displayOffset;
  const char* choices;              ///< "cubic_spline|wendland_c2"; "" unless Choice
  const char* group;                ///< heading in the panel: "Heat"
  const char* help;                 ///< one plain sentence
  const char* example;              ///< "ice 2.2, wood 0.15, copper 400"
  const char* source;               ///< paper or handbook; "" for none
  const char* leastWord = nullptr;  ///< what hardMinimum means where it is no amount: "never"; nullptr: itself
};
using ParameterList = List<ParameterDeclaration>;

struct ResponsePoint {
  double x, y;  ///< K, unit of the property
};

/// A property's value: a constant, a monotone curve through points, or a named law of core/math with coefficients.
/// Never changes: MaterialProperty holds one by value.
struct ResponseSpec {
  enum class Kind : uint32_t { Constant, Curve, Law };
  Kind kind = Kind::Constant;
  double constant = 0;
  Span<const ResponsePoint> points{};
  const char* law = "";  ///< "arrhenius", "vogel", "exponential", "linear", "thesis_sigmoid"
  Span<const double> coefficients{};
};

}  // namespace ps::api
