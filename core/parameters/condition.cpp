// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/condition.h"

#include "core/base/error.h"

#include <algorithm>
#include <charconv>
#include <iterator>

namespace ps {
namespace {

using api::ParameterDeclaration;
using api::ParameterKind;
using Words = std::vector<std::string_view>;

constexpr std::string_view kComparisons[] = {"<", "<=", "=", ">=", ">", "!="};  // in the order of Comparison
constexpr std::string_view kConstant = "constant";

Words wordsOf(std::string_view text) {
  Words words;
  for (size_t first = 0; (first = text.find_first_not_of(' ', first)) < text.size();) {
    const size_t last = std::min(text.find(' ', first), text.size());
    words.push_back(text.substr(first, last - first));
    first = last;
  }
  return words;
}

std::vector<std::string> split(std::string_view text, char between) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == between) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Takes words from the front; what is not there is said by its name.
class Reader {
 public:
  explicit Reader(std::string_view text) : m_text(text), m_words(wordsOf(text)) {}
  bool done() const { return m_next == m_words.size(); }
  bool takes(std::string_view word) {
    if (done() || m_words[m_next] != word) return false;
    ++m_next;
    return true;
  }
  std::string_view next(const char* what) {
    if (done()) fail(std::string("ends where ") + what + " is due");
    return m_words[m_next++];
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError("\"" + std::string(m_text) + "\" " + what); }

 private:
  std::string_view m_text;
  Words m_words;
  size_t m_next = 0;
};

Clause readClause(Reader& reader, std::string_view key) {
  Clause clause{std::string(key), Comparison::Equal, 0.0};
  const std::string_view sign = reader.next("a comparison");
  const auto* const found = std::find(std::begin(kComparisons), std::end(kComparisons), sign);
  if (found == std::end(kComparisons)) reader.fail("has no comparison in '" + std::string(sign) + "'");
  clause.comparison = static_cast<Comparison>(found - std::begin(kComparisons));
  const std::string_view word = reader.next("a value");
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool equality = clause.comparison == Comparison::Equal || clause.comparison == Comparison::NotEqual;
  if (error == std::errc() && end == word.data() + word.size()) {
    clause.to = number;
  } else if (equality) {
    clause.to = split(word, '|');
  } else {
    clause.to = std::string(word);
  }
  return clause;
}

Condition readCondition(Reader& reader) {
  Condition condition;
  do {
    const std::string_view key = reader.next("a key");
    condition.clauses.push_back(readClause(reader, key));
  } while (reader.takes("&"));
  return condition;
}

Relation readRelation(std::string_view text, const char* key) {
  Reader reader(text);
  Relation relation;
  if (reader.takes("plus")) relation.plus = reader.next("a key");
  relation.must = reader.takes("must");
  if (!relation.must && !reader.takes("should")) reader.fail("needs \"must be\" or \"should be\"");
  if (!reader.takes("be")) reader.fail("needs \"must be\" or \"should be\"");
  relation.clause = readClause(reader, key);
  if (reader.takes("when")) relation.when = readCondition(reader);
  if (reader.takes("unless")) relation.unless = readCondition(reader);
  if (!reader.done()) reader.fail("goes on with '" + std::string(reader.next("")) + "'");
  return relation;
}

std::optional<double> numberIn(const Value& value) {
  if (const bool* on = std::get_if<bool>(&value)) return *on ? 1 : 0;
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const Response* response = std::get_if<Response>(&value)) return response->at(293.15);
  return std::nullopt;
}

std::string nameOf(const Value& value) {
  if (const bool* on = std::get_if<bool>(&value)) return *on ? "on" : "off";
  if (const std::string* name = std::get_if<std::string>(&value)) return *name;
  const Response* response = std::get_if<Response>(&value);
  return !response || response->kind == Response::Kind::Constant ? std::string(kConstant) : "curve";
}

bool compares(double a, Comparison comparison, double b) {
  switch (comparison) {
    case Comparison::Below:
      return a < b;
    case Comparison::AtMost:
      return a <= b;
    case Comparison::Equal:
      return a == b;
    case Comparison::AtLeast:
      return a >= b;
    case Comparison::Above:
      return a > b;
    case Comparison::NotEqual:
      break;
  }
  return a != b;
}

std::optional<double> numberAt(const ValueOfKey& values, const std::string& key) {
  const std::optional<Value> value = values(key);
  return value ? numberIn(*value) : std::nullopt;
}

bool holds(const Clause& clause, const ValueOfKey& values, double plus) {
  const std::optional<Value> value = values(clause.key);
  if (!value) return true;
  if (const auto* names = std::get_if<std::vector<std::string>>(&clause.to)) {
    const bool among = std::find(names->begin(), names->end(), nameOf(*value)) != names->end();
    return among == (clause.comparison == Comparison::Equal);
  }
  const auto* bound = std::get_if<double>(&clause.to);
  const std::optional<double> left = numberIn(*value);
  const std::optional<double> right = bound ? *bound : numberAt(values, std::get<std::string>(clause.to));
  return !left || !right || compares(*left + plus, clause.comparison, *right);
}

std::string problemOfNames(const Clause& clause, const ParameterDeclaration& d, const std::vector<std::string>& names) {
  const std::vector<std::string> known = d.kind == ParameterKind::Toggle     ? std::vector<std::string>{"on", "off"}
                                         : d.kind == ParameterKind::Choice   ? choicesOf(d)
                                         : d.kind == ParameterKind::Response ? std::vector{std::string(kConstant)}
                                                                             : std::vector<std::string>{};
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      return "'" + clause.key + "' is never '" + name + "'";
  return {};
}

bool isNumber(const ParameterDeclaration& d) {
  return d.kind != ParameterKind::Toggle && d.kind != ParameterKind::Choice;
}

std::string problemOfClause(const Clause& clause, const DeclarationOfKey& find) {
  const ParameterDeclaration* d = find(clause.key);
  if (!d) return "there is no parameter '" + clause.key + "'";
  if (const auto* names = std::get_if<std::vector<std::string>>(&clause.to)) return problemOfNames(clause, *d, *names);
  const auto* other = std::get_if<std::string>(&clause.to);
  const ParameterDeclaration* with = other ? find(*other) : d;
  if (!with) return "there is no parameter '" + *other + "'";
  if (!isNumber(*d) || !isNumber(*with)) return "'" + clause.key + "' or what it is compared with is no number";
  return {};
}

std::string problemOfCondition(const Condition& condition, const DeclarationOfKey& find) {
  for (const Clause& clause : condition.clauses)
    if (std::string problem = problemOfClause(clause, find); !problem.empty()) return problem;
  return {};
}

}  // namespace

Condition parseCondition(const char* text) {
  if (!text || !*text) return {};
  Reader reader(text);
  Condition condition = readCondition(reader);
  if (!reader.done()) reader.fail("goes on with '" + std::string(reader.next("")) + "'");
  return condition;
}

std::vector<Relation> parseRelations(const ParameterDeclaration& declaration) {
  std::vector<Relation> relations;
  if (!declaration.relations || !*declaration.relations) return relations;
  for (const std::string& text : split(declaration.relations, ';'))
    relations.push_back(readRelation(text, declaration.key));
  return relations;
}

std::string problemOfRules(const ParameterDeclaration& declaration, const DeclarationOfKey& find) {
  try {
    std::string problem = problemOfCondition(parseCondition(declaration.enabledWhen), find);
    if (!problem.empty()) return "its enabledWhen: " + problem;
    for (const Relation& relation : parseRelations(declaration)) {
      problem = problemOfClause(relation.clause, find);
      if (problem.empty() && !relation.plus.empty())
        problem = problemOfClause({relation.plus, Comparison::Above, 0.0}, find);
      if (problem.empty()) problem = problemOfCondition(relation.when, find);
      if (problem.empty() && relation.unless) problem = problemOfCondition(*relation.unless, find);
      if (!problem.empty()) return "its relations: " + problem;
    }
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

bool holds(const Condition& condition, const ValueOfKey& values) {
  return std::all_of(condition.clauses.begin(), condition.clauses.end(),
                     [&](const Clause& clause) { return holds(clause, values, 0); });
}

bool holds(const Relation& relation, const ValueOfKey& values) {
  if (!holds(relation.when, values) || (relation.unless && holds(*relation.unless, values))) return true;
  const std::optional<double> plus = relation.plus.empty() ? 0.0 : numberAt(values, relation.plus);
  return !plus || holds(relation.clause, values, *plus);
}

bool speaksOf(const Relation& relation, std::string_view key) {
  const auto inClause = [&](const Clause& clause) {
    const auto* other = std::get_if<std::string>(&clause.to);
    return clause.key == key || (other && *other == key);
  };
  const auto inCondition = [&](const Condition& c) {
    return std::any_of(c.clauses.begin(), c.clauses.end(), inClause);
  };
  return inClause(relation.clause) || relation.plus == key || inCondition(relation.when) ||
         (relation.unless && inCondition(*relation.unless));
}

}  // namespace ps
