// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ps {

/// The number of a name; nothing where there is none.
using FormulaNames = std::function<std::optional<double>(const std::string& name)>;

/// Value of a formula such as "sqrt(2 * g * h)": numbers with a decimal point, + - * / ^, parentheses, pi, what `named`
/// knows, and abs, cos, exp, log (natural), max, min, pow, sin, sqrt, tan; angles are radians. ^ binds closer than a
/// sign and from the right: -2^2 = -4, 2^3^2 = 512.
///
/// Throws InputError "character 5: what is wrong", also for a value that is not finite; what `named` throws goes
/// through.
double valueOfFormula(std::string_view text, const FormulaNames& named);

/// A letter, then letters, digits and _; and neither pi nor a function's name.
bool mayNameAValue(std::string_view name);

}  // namespace ps
