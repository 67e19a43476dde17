// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/parameter.h>

#include <QtCore/QString>

#include <optional>

// Numbers as people see and type them. Nothing here looks at the locale: a comma and a point both separate decimals,
// and the program always writes a point.
namespace ps {

/// Four significant digits unless asked otherwise, U+2212 as minus, groups of three by U+202F from 1000 on, powers of
/// ten below 0.001 and from ten million on: "24 590", "−0.9000", "3.000 × 10⁻⁶". "—" for what is not finite.
QString formatNumber(double value, int significant = 4);
/// The same without zeros at the end: "0.5", "3 × 10⁻⁶".
QString formatShort(double value, int significant = 4);
/// With a fixed number of decimals, grouped: "24 594", "−0.90". For counts and running values that must not jitter.
/// From 10¹⁵ on, where a double's digits end, as formatShort.
QString formatFixed(double value, int decimals = 0);
/// formatShort with the unit after a space: "120 °C".
QString formatQuantity(double value, const QString& unit, int significant = 4);

/// A prefix of its unit that keeps a value between 1 and 1000: 1e6 and "M". `value` is in the unit.
struct UnitPrefix {
  double factor = 1;
  QString symbol;
};
UnitPrefix prefixFor(double value, int significant = 4);
/// The same for a unit that may take none: "km²" is no thousand square metres, "kkg" nothing at all.
UnitPrefix prefixFor(double value, const QString& unit);
/// With the prefix that keeps it short: "76.40 MJ", "1.540 g", "0 J". For values in J, g, Pa, m.
QString formatPrefixed(double value, const QString& unit, int significant = 4);

/// A relative error, whatever its sign, to one digit: "3 × 10⁻⁶". Below 10⁻⁹ it is rounding and its digits say
/// nothing: "< 10⁻⁹".
QString formatError(double relative);

/// Stored (SI) value as people see it, and back.
double toDisplay(const api::ParameterDeclaration& declaration, double stored);
double fromDisplay(const api::ParameterDeclaration& declaration, double shown);
/// Of a difference: shown per stored.
double displayFactor(const api::ParameterDeclaration& declaration);
/// The unit that people see, of temperatures the one that they prefer: displayUnit, or unit where it is empty.
QString displayUnit(const api::ParameterDeclaration& declaration);
/// Whether a value is left out: a material that never boils has its boiling point at absolute zero, a tap that never
/// closes does so after 1e9 s, a rope that never tears does so at 0. Shown and typed as "none", "never" or the
/// declaration's own word.
bool standsForNone(const api::ParameterDeclaration& declaration, double stored);
/// A stored value as its field shows it, without unit: four significant digits, without zeros at the end that are finer
/// than the slider's range can tell (a logarithmic one: three significant digits; what has another zero than SI:
/// tenths).
QString formatField(const api::ParameterDeclaration& declaration, double stored);
/// The same with its displayed unit.
QString formatValue(const api::ParameterDeclaration& declaration, double stored);
/// The same for a narrow place: where SI knows a prefix for the unit, the one that keeps the number short: "3.97 kPa·s"
/// for 3 970 000 mPa·s. `running`: it keeps its zeros, and so its width, as it changes.
struct FieldText {
  QString value, unit;
};
FieldText shortField(const api::ParameterDeclaration& declaration, double stored, int significant = 3,
                     bool running = false);
/// A limit of the range with its unit: always the amount, never the word that it may stand for.
QString formatBound(const api::ParameterDeclaration& declaration, double stored);
/// A stored value times a factor as people see it: twice 10 °C is 20 °C.
double scaledValue(const api::ParameterDeclaration& declaration, double stored, double factor);

/// What somebody typed into a number field.
struct Typed {
  double value = 0;       ///< the new value in SI
  double factor = 1;      ///< of relative input
  double added = 0;       ///< SI, of relative input
  bool relative = false;  ///< "*2", "/3", "+10": acts on each value of a mixed selection
  QString problem;        ///< "" or one sentence that says what is wrong
};

/// Reads "25", "none" where a value may be left out, "25 °C", "77 °F", "300 K", "1,5", "1/3", "2*(3+4)", "*2", "/3",
/// "+10 °C", "1e-3", "3 × 10⁻⁶", "2.5 GPa". A bare number is in the displayed unit; a unit must be of the same kind as
/// the declaration's ("m" for a length). `current` (SI) is what relative input starts from. Does not look at ranges.
Typed parseTyped(const QString& text, const api::ParameterDeclaration& declaration, double current);

/// The number or sum alone ("1,5", "−3 × 10⁻⁶", "1/3", "24 594"), without a unit; nullopt when it is none.
std::optional<double> parseNumber(const QString& text);

}  // namespace ps
