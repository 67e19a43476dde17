// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/formula.h"

#include "core/base/error.h"
#include "core/base/utf8.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <vector>

namespace ps {
namespace {

constexpr int kMostNested = 40;                 ///< parentheses, signs and powers within each other
constexpr size_t kMostShown = 40;               ///< bytes of a name in a message
constexpr size_t kAnyNumber = size_t{1} << 16;  ///< of arguments

using Values = std::span<const double>;

struct Function {
  size_t least, most;  ///< arguments
  double (*of)(Values);
};

const std::map<std::string, Function, std::less<>>& functions() {
  static const std::map<std::string, Function, std::less<>> all{
      {"abs", {1, 1, [](Values v) { return std::abs(v[0]); }}},
      {"cos", {1, 1, [](Values v) { return std::cos(v[0]); }}},
      {"exp", {1, 1, [](Values v) { return std::exp(v[0]); }}},
      {"log", {1, 1, [](Values v) { return std::log(v[0]); }}},
      {"max", {1, kAnyNumber, [](Values v) { return *std::max_element(v.begin(), v.end()); }}},
      {"min", {1, kAnyNumber, [](Values v) { return *std::min_element(v.begin(), v.end()); }}},
      {"pow", {2, 2, [](Values v) { return std::pow(v[0], v[1]); }}},
      {"sin", {1, 1, [](Values v) { return std::sin(v[0]); }}},
      {"sqrt", {1, 1, [](Values v) { return std::sqrt(v[0]); }}},
      {"tan", {1, 1, [](Values v) { return std::tan(v[0]); }}},
  };
  return all;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isOfName(char c) { return isLetter(c) || isDigit(c) || c == '_'; }

/// Recursive descent, a function for each rank of operators.
class Parser {
 public:
  Parser(std::string_view text, const FormulaNames& named) : m_text(text), m_named(named) {}

  double whole() {
    const double value = sum();
    if (!atEnd()) fail(m_at, "an operator or the end belongs here");
    return finite(value, 0);
  }

 private:
  /// What stands before a mistake is ASCII, so that bytes are characters.
  [[noreturn]] static void fail(size_t at, const std::string& what) {
    throw InputError("character " + std::to_string(at + 1) + ": " + what);
  }
  static double finite(double value, size_t at) {
    if (!std::isfinite(value)) fail(at, "this is no finite number");
    return value;
  }

  bool atEnd() {
    while (m_at < m_text.size() && (m_text[m_at] == ' ' || m_text[m_at] == '\t' || m_text[m_at] == '\n')) ++m_at;
    return m_at == m_text.size();
  }
  bool isNext(char c) { return !atEnd() && m_text[m_at] == c; }
  bool take(char c) {
    if (!isNext(c)) return false;
    ++m_at;
    return true;
  }
  void need(char c) {
    if (!take(c)) fail(m_at, std::string("a ") + c + " is missing");
  }

  double sum() {
    double value = product();
    while (isNext('+') || isNext('-')) {
      const double sign = m_text[m_at++] == '+' ? 1 : -1;
      value += sign * product();
    }
    return value;
  }

  double product() {
    double value = withSign();
    while (isNext('*') || isNext('/')) {
      const bool divides = m_text[m_at] == '/';
      const size_t here = m_at++;
      const double other = withSign();
      if (divides && other == 0) fail(here, "divides by 0");
      value = divides ? value / other : value * other;
    }
    return value;
  }

  /// Everything that nests comes through here.
  double withSign() {
    if (++m_depth > kMostNested) fail(m_at, "goes more than " + std::to_string(kMostNested) + " levels deep");
    double sign = 1;
    while (isNext('+') || isNext('-')) sign = m_text[m_at++] == '-' ? -sign : sign;
    const double value = sign * power();
    --m_depth;
    return value;
  }

  double power() {
    const double base = primary();
    const size_t here = m_at;
    return take('^') ? finite(std::pow(base, withSign()), here) : base;
  }

  double primary() {
    if (atEnd()) fail(m_at, "a number, a name or a ( is missing");
    if (take('(')) {
      const double value = sum();
      need(')');
      return value;
    }
    if (isDigit(m_text[m_at]) || m_text[m_at] == '.') return number();
    if (isLetter(m_text[m_at])) return ofName();
    fail(m_at, "a number, a name or a ( belongs here");
  }

  double number() {
    double value = 0;
    const char* begin = m_text.data() + m_at;
    const auto [end, problem] = std::from_chars(begin, m_text.data() + m_text.size(), value);
    if (problem != std::errc()) fail(m_at, "this is no number, or one that is too large or too small");
    m_at += static_cast<size_t>(end - begin);
    return value;
  }

  double ofName() {
    const size_t here = m_at;
    while (m_at < m_text.size() && isOfName(m_text[m_at])) ++m_at;
    const std::string name(m_text.substr(here, m_at - here));
    if (isNext('(')) return ofFunction(name, here);
    if (name == "pi") return std::numbers::pi;
    if (const std::optional<double> value = m_named(name)) return *value;
    fail(here, "there is no value '" + shownText(name, kMostShown) + "'");
  }

  double ofFunction(const std::string& name, size_t here) {
    const auto found = functions().find(name);
    if (found == functions().end()) fail(here, "there is no function '" + shownText(name, kMostShown) + "'");
    const Function& function = found->second;
    need('(');
    std::vector<double> values{sum()};
    while (take(',')) values.push_back(sum());
    need(')');
    if (values.size() < function.least || values.size() > function.most) {
      const bool one = function.least == 1;
      fail(here, name + " takes " + std::to_string(function.least) + (one ? " argument" : " arguments"));
    }
    return finite(function.of(values), here);
  }

  std::string_view m_text;
  const FormulaNames& m_named;
  size_t m_at = 0;
  int m_depth = 0;
};

}  // namespace

double valueOfFormula(std::string_view text, const FormulaNames& named) { return Parser(text, named).whole(); }

bool mayNameAValue(std::string_view name) {
  return !name.empty() && isLetter(name[0]) && std::all_of(name.begin(), name.end(), isOfName) && name != "pi" &&
         !functions().contains(name);
}

}  // namespace ps
