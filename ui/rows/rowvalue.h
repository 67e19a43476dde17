// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/parameters/parameterset.h"

#include <QtCore/QString>
#include <QtCore/QStringList>

// What a parameter row computes, without a widget: slider positions, steps, rounding, comparison. Values are SI.
namespace ps {

/// Position 0..1 of a value on its slider, linear or logarithmic as declared; clamped.
double sliderPosition(const api::ParameterDeclaration& declaration, double value);
double valueAtPosition(const api::ParameterDeclaration& declaration, double position);
/// The value rounded to what a pixel of the slider can tell apart in displayed units: a power of ten of about a
/// four-hundredth of a linear range, or three significant digits; ten times finer when `fine`. Whole numbers stay
/// whole. Within the slider's range.
double roundedForSlider(const api::ParameterDeclaration& declaration, double value, bool fine);
/// The nearest round value: a multiple of a twentieth of the range (1, 2 or 5 times a power of ten), or 1, 2, 5 × 10ⁿ.
double snappedToRound(const api::ParameterDeclaration& declaration, double value);
/// `steps` steps up (down): a hundredth of a linear range made round, a twentieth of a decade; a tenth of it when fine.
double stepped(const api::ParameterDeclaration& declaration, double value, double steps, bool fine);

/// A value as a number: toggle 0 or 1, choice its index, response at a temperature in K.
double numberOfValue(const api::ParameterDeclaration& declaration, const Value& value, double temperature);
/// The number as a value of the declared kind.
Value valueOfNumber(const api::ParameterDeclaration& declaration, double number);
/// A curve or law, rather than a number.
bool isCurve(const Value& value);
/// Equal as people see it: a constant response equals its number; numbers within 1e-12 of each other are equal, because
/// unit conversion of a typed value may cost the last bits.
bool sameValue(const Value& a, const Value& b);

/// Makes a number or a response `factor` times as much (as people see it: twice 10 °C is 20 °C) and `added` (SI) more.
/// "" or a sentence that says why it cannot be; the value then stays.
QString scale(Value& value, const api::ParameterDeclaration& declaration, double factor, double added);

QStringList choiceNames(const api::ParameterDeclaration& declaration);
/// "cubic_spline" as "Cubic spline".
QString choiceLabel(const QString& name);
/// "" or why the number is refused, in displayed units: "Must be at most 300 °C".
QString refusal(const api::ParameterDeclaration& declaration, double value);
bool isOutOfRange(const api::ParameterDeclaration& declaration, double value);

}  // namespace ps
