// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/wording.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

using api::ParameterDeclaration;

constexpr const char* kWords[] = {"below", "at most", "", "at least", "above", "other than"};  // of Comparison

std::string wordOf(Comparison comparison) { return kWords[static_cast<size_t>(comparison)]; }

std::string labelOf(std::string_view key, const DeclarationOfKey& find) {
  const ParameterDeclaration* declaration = find(key);
  return "“" + (declaration ? std::string(declaration->label) : std::string(key)) + "”";
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// "above “Melting point”", "at most 5 s", "fixed temperature or convective".
std::string comparisonText(const Clause& clause, const DeclarationOfKey& find) {
  if (const auto* names = std::get_if<std::vector<std::string>>(&clause.to))
    return (clause.comparison == Comparison::NotEqual ? "not " : "") + joined(*names);
  const std::string word = wordOf(clause.comparison);
  if (const auto* other = std::get_if<std::string>(&clause.to)) return word + " " + labelOf(*other, find);
  const double number = std::get<double>(clause.to);
  const ParameterDeclaration* declaration = find(clause.key);
  if (!declaration) return word + " " + numberText(number);
  const std::optional<NoValue> none = noValueOf(*declaration);
  if (none && none->stored == number && clause.comparison != Comparison::Equal) return std::string("not ") + none->word;
  return word + (word.empty() ? "" : " ") + shownText(*declaration, number);
}

std::string conditionText(const Condition& condition, const DeclarationOfKey& find) {
  std::string text;
  for (const Clause& clause : condition.clauses)
    text += (text.empty() ? "" : " and ") + labelOf(clause.key, find) + " is " + comparisonText(clause, find);
  return text;
}

std::string subject(const Relation& relation, const DeclarationOfKey& find) {
  return (relation.plus.empty() ? std::string() : "and " + labelOf(relation.plus, find) + " together ") +
         (relation.must ? "must be " : "should be ");
}

double numberOfKey(const ValueOfKey& values, const std::string& key) {
  const std::optional<Value> value = values(key);
  return value ? responseOf(*value).at(293.15) : 0;
}

std::string breachText(const Relation& relation, const ValueOfKey& values, const DeclarationOfKey& find) {
  std::string text = subject(relation, find) + comparisonText(relation.clause, find);
  const auto* other = std::get_if<std::string>(&relation.clause.to);
  if (const ParameterDeclaration* declaration = other ? find(*other) : nullptr)
    text += " (" + shownText(*declaration, numberOfKey(values, *other)) + ")";
  const double sum =
      numberOfKey(values, relation.clause.key) + (relation.plus.empty() ? 0 : numberOfKey(values, relation.plus));
  if (const ParameterDeclaration* own = find(relation.clause.key)) text += ", not " + shownText(*own, sum);
  return text;
}

}  // namespace

std::string shownText(const ParameterDeclaration& d, double stored) {
  if (const std::optional<NoValue> none = noValueOf(d); none && none->stored == stored) return none->word;
  const std::string unit = *d.displayUnit ? d.displayUnit : d.unit;
  double shown = stored * d.displayScale + d.displayOffset;
  // What lies under the last bits of the offset is no information, nor is the seventh digit of anything.
  if (std::abs(shown) < 1e-12 * std::abs(d.displayOffset)) shown = 0;
  if (shown != 0 && std::isfinite(shown)) {
    const double unitInLastPlace = std::pow(10.0, std::floor(std::log10(std::abs(shown))) - 5);
    shown = unitInLastPlace < 1 ? std::round(shown * std::round(1 / unitInLastPlace)) / std::round(1 / unitInLastPlace)
                                : std::round(shown);
  }
  return numberText(shown) + (unit.empty() ? "" : " " + unit);
}

std::string actsWhenText(const ParameterDeclaration& declaration, const DeclarationOfKey& find) {
  const std::string condition = conditionText(parseCondition(declaration.enabledWhen), find);
  return condition.empty() ? condition : "Acts when " + condition + ".";
}

std::string actsAtText(api::ActsAt when) {
  if (when == api::ActsAt::NextReset) return "Acts once back at the start.";
  if (when == api::ActsAt::NextFrameIfFixed)
    return "Acts at the next frame on a body that is held in place, on any other once back at the start.";
  if (when == api::ActsAt::WithItsMatter) return "Carries the body's matter along at the next frame.";
  return {};
}

const char* actsAtName(api::ActsAt when) {
  return when == api::ActsAt::NextFrame          ? "next frame"
         : when == api::ActsAt::NextReset        ? "next reset"
         : when == api::ActsAt::NextFrameIfFixed ? "next frame if fixed, else next reset"
                                                 : "next frame, carrying its matter";
}

std::vector<std::string> relationTexts(const ParameterDeclaration& declaration, const DeclarationOfKey& find) {
  std::vector<std::string> texts;
  for (const Relation& relation : parseRelations(declaration)) {
    std::string text = subject(relation, find);
    text = relation.plus.empty() ? text : labelOf(declaration.key, find) + " " + text;
    text += comparisonText(relation.clause, find);
    if (!relation.when.clauses.empty()) text += ", when " + conditionText(relation.when, find);
    if (relation.unless) text += ", unless " + conditionText(*relation.unless, find);
    if (relation.plus.empty()) text.front() = relation.must ? 'M' : 'S';
    texts.push_back(text + ".");
  }
  return texts;
}

std::vector<std::string> ruleTexts(const ParameterDeclaration& declaration, const DeclarationOfKey& find) {
  std::vector<std::string> texts = relationTexts(declaration, find);
  for (const std::string& text : {actsWhenText(declaration, find), actsAtText(declaration.actsAt)})
    if (!text.empty()) texts.push_back(text);
  return texts;
}

std::optional<Breach> firstBreach(api::ParameterList list, const ValueOfKey& values, const DeclarationOfKey& find,
                                  bool must, std::string_view of) {
  for (size_t i = 0; i < list.count; ++i) {
    for (const Relation& relation : parseRelations(list[i])) {
      if (relation.must != must || (!of.empty() && !speaksOf(relation, of)) || holds(relation, values)) continue;
      return Breach{list[i].key, breachText(relation, values, find)};
    }
  }
  return std::nullopt;
}

}  // namespace ps
