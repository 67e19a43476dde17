// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/parameters/condition.h"

// The sentences that people read of what declarations say: in tooltips, notes, refusals and the schema.
namespace ps {

/// A value as people see it: "−5 °C", "none".
std::string shownText(const api::ParameterDeclaration& declaration, double stored);
/// "Acts when “Heat” is fixed temperature or convective."; "" for what always acts. A key without a declaration stands
/// for itself.
std::string actsWhenText(const api::ParameterDeclaration& declaration, const DeclarationOfKey& find);
/// "Acts once back at the start."; "" for what acts at the next frame.
std::string actsAtText(api::ActsAt when);
/// "next frame", "next reset", as the schema says it.
const char* actsAtName(api::ActsAt when);
/// "Must be above “Melting point” unless …."; each relation of the declaration.
std::vector<std::string> relationTexts(const api::ParameterDeclaration& declaration, const DeclarationOfKey& find);
/// All of them: what a tooltip and the schema say beside the help.
std::vector<std::string> ruleTexts(const api::ParameterDeclaration& declaration, const DeclarationOfKey& find);

/// A relation that does not hold.
struct Breach {
  std::string key;       ///< whose declaration states it
  std::string sentence;  ///< "must be above “Melting point” (0 °C), not −5 °C"
};
/// The first relation of a list that must (or should) hold and does not, of those that speak of `of`, or of all.
std::optional<Breach> firstBreach(api::ParameterList list, const ValueOfKey& values, const DeclarationOfKey& find,
                                  bool must, std::string_view of = {});

}  // namespace ps
