// SPDX-License-Identifier: Apache-2.0
// Numbers as people type them, into one of the program's fields, which the first byte chooses.
#include "ui/theme/numbers.h"
#include "core/matter/material.h"
#include "core/scene/project.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace ps;

std::vector<api::ParameterDeclaration> fields() {
  std::vector<api::ParameterDeclaration> all;
  for (const api::ParameterList list : {solverParameters(), environmentParameters(), wallParameters(), bodyParameters(),
                                        emitterParameters(), bodyMotionParameters(), propertyCatalogue()}) {
    for (size_t i = 0; i < list.count; ++i) {
      const api::ParameterKind kind = list[i].kind;
      if (kind != api::ParameterKind::Toggle && kind != api::ParameterKind::Choice) all.push_back(list[i]);
    }
  }
  return all;
}

/// What a field shows of a value means that value when it is typed, but for the digits that it rounds away.
void requireReadsBack(const api::ParameterDeclaration& field, double value) {
  const QString shown = formatValue(field, value);
  const Typed again = parseTyped(shown, field, value);
  const std::string words = std::string(field.key) + " shows " + shown.toStdString();
  fuzz::require(again.problem.isEmpty(), words + ": " + again.problem.toStdString());
  const double before = toDisplay(field, value), after = toDisplay(field, again.value);
  const double rounding =
      6e-4 * std::abs(before) + 1e-11 * std::abs(field.displayOffset) + std::numeric_limits<double>::min();
  const double whole = field.kind == api::ParameterKind::Integer ? 0.5 : 0;
  fuzz::require(std::abs(after - before) <= std::max(rounding, whole), words + " for " + std::to_string(before));
}

}  // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::vector<api::ParameterDeclaration> all = fields();
  if (size == 0) return 0;
  const api::ParameterDeclaration& field = all[data[0] % all.size()];
  const QString text = QString::fromUtf8(reinterpret_cast<const char*>(data + 1), static_cast<qsizetype>(size - 1));
  const Typed typed = parseTyped(text, field, field.defaultValue);
  if (typed.problem.isEmpty()) {
    fuzz::require(std::isfinite(typed.value) && std::isfinite(typed.factor), "what was typed is a number");
    requireReadsBack(field, typed.value);
  }
  if (const std::optional<double> number = parseNumber(text))
    fuzz::require(std::isfinite(*number), "what was typed is a number");
  return 0;
}
