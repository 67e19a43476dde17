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

/// When a value that changes while the scene runs begins to act.
enum class ActsAt : uint32_t {
  NextFrame,
  NextReset,         ///< it is read where matter or structure is made: at the start, and for what is drawn later
  NextFrameIfFixed,  ///< of a body that is held in place at the next frame, of any other at the next reset
  WithItsMatter,     ///< where a body is: at the next frame its matter is carried along
};

/// Declared once; becomes a slider, a JSON key, a tooltip, a plot source and a test row.
/// All numbers are SI (kelvin for temperatures); `display*` say how people see them.
///
/// `enabledWhen` is a condition: clauses of three words with & between them, all of which must hold.
///   "heat = fixed_temperature|convective & environment/radiation = on"
/// A key is of the same list, or has its owner before it: environment/KEY, solver/KEY, scene/KEY. Choices and toggles
/// (on, off) are compared by = and !=, numbers by < <= > >= = != with a number (stored unit) or another key; a curve
/// counts by its value at 20 °C, and "KEY = constant" asks whether it is none. Where the condition does not hold the
/// row is greyed, and its tooltip says when it acts.
///
/// `relations` are refused (must) or warned of (should) where they do not hold; ; stands between two of them.
///   "must be > melting_temperature when boiling_temperature > 0 unless sublimes = on; should be < other"
///   "plus freeze_bond_fraction must be > 1"
/// The sentences that people read are made from both.
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
  const char* choices;                ///< "cubic_spline|wendland_c2"; "" unless Choice
  const char* group;                  ///< heading in the panel: "Heat"
  const char* help;                   ///< one plain sentence
  const char* example;                ///< "ice 2.2, wood 0.15, copper 400"
  const char* source;                 ///< paper or handbook; "" for none
  const char* leastWord = nullptr;    ///< what hardMinimum means where it is no amount: "never"; nullptr: itself
  const char* enabledWhen = nullptr;  ///< where the value acts; nullptr: always
  const char* relations = nullptr;    ///< to other parameters; nullptr: none
  ActsAt actsAt = ActsAt::NextFrame;
  uint32_t reserved = 0;
};
using ParameterList = List<ParameterDeclaration>;

/// A declaration with one of its last members set.
constexpr ParameterDeclaration actingWhen(const char* condition, ParameterDeclaration declaration) {
  declaration.enabledWhen = condition;
  return declaration;
}
constexpr ParameterDeclaration related(const char* relations, ParameterDeclaration declaration) {
  declaration.relations = relations;
  return declaration;
}
constexpr ParameterDeclaration atReset(ParameterDeclaration declaration) {
  declaration.actsAt = ActsAt::NextReset;
  return declaration;
}

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
