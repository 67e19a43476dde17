// SPDX-License-Identifier: Apache-2.0
#include "ui/theme/numbers.h"

#include "core/parameters/parameterset.h"
#include "ui/theme/units.h"

#include <QtCore/QChar>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace ps {
namespace {

constexpr qsizetype kLongestTyped = 200;  ///< characters
constexpr QChar kMinus(0x2212), kGroup(0x202F);

/// Decimal digits by std::to_chars, which no locale touches. What lies on a half as people write it is rounded up,
/// though the double beside it may lie below: 293.15 is 293.2.
std::string digits(double value, std::chars_format format, int precision) {
  constexpr int kSure = 14;  // digits below which two units in the last place cannot be seen
  const bool scientific = format == std::chars_format::scientific;
  const int before = value == 0 || scientific || !std::isfinite(value)
                         ? 1
                         : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  if (before + precision < kSure) value *= 1 + 2 * std::numeric_limits<double>::epsilon();
  char buffer[512];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, precision);
  return std::string(buffer, end.ptr);
}

/// Minus sign and groups for "-12345.60".
QString dressed(const std::string& plain) {
  QString text = QString::fromLatin1(plain.c_str(), static_cast<qsizetype>(plain.size()));
  const bool negative = text.startsWith(QLatin1Char('-'));
  if (negative) text.remove(0, 1);
  if (negative && std::none_of(text.begin(), text.end(), [](QChar c) { return c >= u'1' && c <= u'9'; })) return text;
  qsizetype end = text.indexOf(QLatin1Char('.'));
  if (end < 0) end = text.size();
  for (qsizetype i = end - 3; i > 0; i -= 3) text.insert(i, kGroup);
  return negative ? kMinus + text : text;
}

std::string withoutZeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

QString superscript(int value) {
  static const QString raised = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
  QString text;
  if (value < 0) text += QChar(0x207B);
  for (const char c : std::to_string(std::abs(value))) text += raised[c - '0'];
  return text;
}

/// Exponent of ten of the value after rounding to so many digits; 0 where it has none.
int exponentOf(double value, int significant) {
  if (!std::isfinite(value)) return 0;
  const std::string text = digits(value, std::chars_format::scientific, significant - 1);
  int exponent = 0;
  const char* first = text.data() + text.find('e') + 1;
  if (*first == '+') ++first;
  std::from_chars(first, text.data() + text.size(), exponent);
  return exponent;
}

/// `minimumDecimals` of the rounded value stay although they are zeros; -1: all.
QString formatted(double value, int significant, int minimumDecimals) {
  if (!std::isfinite(value)) return QStringLiteral("—");
  if (value == 0) return dressed(digits(0, std::chars_format::fixed, std::max(0, minimumDecimals)));
  const int exponent = exponentOf(value, significant);
  if (exponent < -3 || exponent >= 7) {
    std::string mantissa = digits(value, std::chars_format::scientific, significant - 1);
    mantissa.resize(mantissa.find('e'));
    if (minimumDecimals >= 0) mantissa = withoutZeros(mantissa);
    return dressed(mantissa) + QStringLiteral(" × 10") + superscript(exponent);
  }
  // Digits in front of the point beyond the significant ones are rounded away too: 24 594 is 24 590.
  const double unit = std::pow(10.0, exponent - significant + 1);
  const double rounded = exponent >= significant ? std::round(value / unit) * unit : value;
  const int decimals = std::max(0, significant - 1 - exponent);
  std::string text = digits(rounded, std::chars_format::fixed, decimals);
  if (minimumDecimals >= 0) {
    while (text.find('.') != std::string::npos && text.back() == '0' &&
           static_cast<int>(text.size() - 1 - text.find('.')) > minimumDecimals) {
      text.pop_back();
    }
    if (text.back() == '.') text.pop_back();
  }
  return dressed(text);
}

/// Decimals that the slider's range can tell apart, in displayed units.
int fieldDecimals(const api::ParameterDeclaration& d, double shown) {
  if (d.kind == api::ParameterKind::Integer) return 0;
  if (d.scale == api::Scale::Logarithmic) {
    return shown == 0 ? 0 : std::clamp(2 - exponentOf(shown, 3), 0, 6);
  }
  const double range = std::abs((d.maximum - d.minimum) * d.displayScale);
  if (!(range > 0) || !std::isfinite(range)) return 0;
  // Temperatures are read to a tenth of a degree however wide their slider is.
  const int least = d.displayOffset != 0 ? 1 : 0;
  return std::clamp(static_cast<int>(std::ceil(-std::log10(range / 400) - 1e-9)), least, 6);
}

/// Sums and products of numbers, read from the left; a number may be followed by "× 10ⁿ".
class Expression {
 public:
  explicit Expression(std::string text) : m_text(std::move(text)) {}

  std::optional<double> value() {
    const double result = sum();
    if (!m_good || m_at != m_text.size() || !std::isfinite(result)) return std::nullopt;
    return result;
  }

 private:
  bool accept(char c) {
    if (m_at >= m_text.size() || m_text[m_at] != c) return false;
    ++m_at;
    return true;
  }
  double sum() {
    double result = product();
    for (;;) {
      if (accept('+'))
        result += product();
      else if (accept('-'))
        result -= product();
      else
        return result;
    }
  }
  double product() {
    double result = power();
    for (;;) {
      if (accept('*'))
        result *= power();
      else if (accept('/'))
        result /= power();
      else
        return result;
    }
  }
  double power() {
    const double base = signedAtom();
    return accept('^') ? std::pow(base, signedAtom()) : base;
  }
  double signedAtom() {
    if (++m_depth > 50) m_good = false;
    double result = 0;
    if (!m_good) return result;
    if (accept('-'))
      result = -signedAtom();
    else if (accept('+'))
      result = signedAtom();
    else if (accept('(')) {
      result = sum();
      m_good = m_good && accept(')');
    } else {
      result = number();
    }
    --m_depth;
    return result;
  }
  double number() {
    double result = 0;
    const char* first = m_text.data() + m_at;
    const char* last = m_text.data() + m_text.size();
    const bool starts = first < last && ((*first >= '0' && *first <= '9') || *first == '.');
    const auto [end, problem] = std::from_chars(first, last, result);
    if (!starts || problem != std::errc())
      m_good = false;
    else
      m_at += static_cast<size_t>(end - first);
    return result;
  }

  std::string m_text;
  size_t m_at = 0;
  int m_depth = 0;
  bool m_good = true;
};

bool takesPrefix(const UnitPrefix& prefix, const QString& plain) {
  const std::optional<Unit> unit = parseUnit(plain), scaled = parseUnit(prefix.symbol + plain);
  return unit && scaled && scaled->dimension == unit->dimension &&
         std::abs(scaled->scale - prefix.factor * unit->scale) <= 1e-9 * scaled->scale;
}

bool isGroupSpace(QChar c) { return c == kGroup || c == QChar(0x2009) || c == QChar(0x00A0) || c == QChar(' '); }

/// ASCII with a point: signs, superscripts and group spaces of formatted numbers taken back. nullopt: both separators
/// in one number.
std::optional<std::string> normalised(const QString& text) {
  static const QString raised = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
  std::string plain;
  bool power = false;
  int points = 0;
  for (qsizetype i = 0; i < text.size(); ++i) {
    const QChar c = text[i];
    const qsizetype digit = raised.indexOf(c);
    const bool raisedSign = c == QChar(0x207B);
    if ((digit >= 0 || raisedSign) && !power) plain += '^';
    power = digit >= 0 || raisedSign;
    if (raisedSign)
      plain += '-';
    else if (digit >= 0)
      plain += static_cast<char>('0' + digit);
    else if (c == kMinus)
      plain += '-';
    else if (c == QChar(0x00D7) || c == QChar(0x00B7))
      plain += '*';
    else if (c == QChar(0x00F7))
      plain += '/';
    else if (isGroupSpace(c)) {
      const bool before = i + 1 < text.size() && text[i + 1].isDigit();
      if (before && i > 0 && raised.contains(text[i - 1])) return std::nullopt;  // an exponent has no groups
      const bool inside = before && i > 0 && text[i - 1].isDigit();
      if (inside && (i + 3 >= text.size() || !text[i + 2].isDigit() || !text[i + 3].isDigit())) return std::nullopt;
    } else if (c == QLatin1Char(',') || c == QLatin1Char('.')) {
      plain += '.';
      if (++points > 1) return std::nullopt;
    } else if (c.unicode() < 128) {
      plain += static_cast<char>(c.unicode());
    } else {
      return std::nullopt;
    }
    if (!c.isDigit() && !isGroupSpace(c) && c != QLatin1Char(',') && c != QLatin1Char('.')) points = 0;
  }
  return plain;
}

/// Of numbers that each are sound, but not what their unit, the value before or the unit they are shown in makes of
/// them.
void requireFinite(Typed& typed, const api::ParameterDeclaration& d, const QString& text) {
  if (!std::isfinite(typed.value) || !std::isfinite(typed.factor) || !std::isfinite(toDisplay(d, typed.value)))
    typed.problem = QStringLiteral("“%1” is too large for a number").arg(text);
}

/// Where the unit begins: after the last character that belongs to a number or a sum.
qsizetype unitStart(const QString& text) {
  for (qsizetype length = text.size(); length > 0; --length) {
    if (parseNumber(text.left(length))) return length;
  }
  return 0;
}

}  // namespace

QString formatNumber(double value, int significant) { return formatted(value, significant, -1); }

QString formatShort(double value, int significant) { return formatted(value, significant, 0); }

QString formatFixed(double value, int decimals) {
  constexpr double kLongest = 1e15;  // a double holds no more digits
  if (!(std::abs(value) < kLongest)) return formatShort(value);
  return dressed(digits(value, std::chars_format::fixed, decimals));
}

UnitPrefix prefixFor(double value, int significant) {
  static const QString symbols[] = {QStringLiteral("µ"), QStringLiteral("m"), QString(),          QStringLiteral("k"),
                                    QStringLiteral("M"), QStringLiteral("G"), QStringLiteral("T")};
  if (value == 0 || !std::isfinite(value)) return {};
  const int thousands = std::clamp(static_cast<int>(std::floor(exponentOf(value, significant) / 3.0)), -2, 4);
  return {std::pow(1000.0, thousands), symbols[thousands + 2]};
}

UnitPrefix prefixFor(double value, const QString& unit) {
  const UnitPrefix prefix = prefixFor(value, 3);
  return takesPrefix(prefix, unit) ? prefix : UnitPrefix{};
}

QString formatPrefixed(double value, const QString& unit, int significant) {
  // Less than a thousandth of the least prefix is rounding.
  if (std::abs(value) < 1e-9) value = 0;
  const UnitPrefix prefix = prefixFor(value, significant);
  return formatNumber(value / prefix.factor, significant) + QLatin1Char(' ') + prefix.symbol + unit;
}

QString formatError(double relative) {
  const double size = std::abs(relative);
  return size > 0 && size < 1e-9 ? QStringLiteral("< 10⁻⁹") : formatShort(size, 1);
}

QString formatQuantity(double value, const QString& unit, int significant) {
  const QString number = formatShort(value, significant);
  return unit.isEmpty() ? number : number + QLatin1Char(' ') + unit;
}

namespace {

/// A temperature, which people see in the unit that they prefer; a difference of temperatures has K.
bool isTemperature(const api::ParameterDeclaration& d) {
  return d.displayUnit && std::string_view(d.displayUnit) == "°C";
}

}  // namespace

double toDisplay(const api::ParameterDeclaration& d, double stored) {
  if (isTemperature(d)) return shownTemperature(stored);
  return stored * d.displayScale + d.displayOffset;
}

double fromDisplay(const api::ParameterDeclaration& d, double shown) {
  if (isTemperature(d)) return kelvinOf(shown);
  return (shown - d.displayOffset) / d.displayScale;
}

double displayFactor(const api::ParameterDeclaration& d) {
  return isTemperature(d) ? degreesPerKelvin() : d.displayScale;
}

QString displayUnit(const api::ParameterDeclaration& d) {
  if (isTemperature(d)) return temperatureSymbol();
  return QString::fromUtf8(d.displayUnit && *d.displayUnit ? d.displayUnit : d.unit ? d.unit : "");
}

bool standsForNone(const api::ParameterDeclaration& d, double stored) {
  const std::optional<NoValue> none = noValueOf(d);
  return none && stored == none->stored;
}

QString formatField(const api::ParameterDeclaration& d, double stored) {
  if (standsForNone(d, stored)) return QString::fromUtf8(noValueOf(d)->word);
  double shown = toDisplay(d, stored);
  // 273.15 K - 273.15 is not always 0: what lies under the last bit of the sum is no information.
  if (std::abs(shown) < 1e-12 * std::abs(d.displayOffset)) shown = 0;
  if (d.kind == api::ParameterKind::Integer) return formatFixed(shown);
  return formatted(shown, 4, fieldDecimals(d, shown));
}

QString formatValue(const api::ParameterDeclaration& d, double stored) {
  const QString unit = standsForNone(d, stored) ? QString() : displayUnit(d);
  return unit.isEmpty() ? formatField(d, stored) : formatField(d, stored) + QLatin1Char(' ') + unit;
}

FieldText shortField(const api::ParameterDeclaration& d, double stored, int significant, bool running) {
  const QString unit = QString::fromUtf8(d.unit ? d.unit : "");
  // A temperature has another zero.
  if (d.displayOffset != 0 || standsForNone(d, stored) || !takesPrefix(prefixFor(stored, 3), unit))
    return {formatField(d, stored), displayUnit(d)};
  const UnitPrefix prefix = prefixFor(stored, unit);
  const double shown = stored / prefix.factor;
  return {running ? formatNumber(shown, significant) : formatShort(shown, significant), prefix.symbol + unit};
}

QString formatBound(const api::ParameterDeclaration& d, double stored) {
  api::ParameterDeclaration plain = d;
  plain.leastWord = nullptr;
  return formatValue(plain, stored);
}

double scaledValue(const api::ParameterDeclaration& d, double stored, double factor) {
  return fromDisplay(d, toDisplay(d, stored) * factor);
}

std::optional<double> parseNumber(const QString& text) {
  const std::optional<std::string> plain = normalised(text.trimmed());
  if (!plain || plain->empty() || plain->size() > kLongestTyped) return std::nullopt;
  return Expression(*plain).value();
}

namespace {

/// What "+10" or "+10 K" adds, SI; nothing where it is no amount of the declaration's kind. A difference of
/// temperatures has no zero of its own.
std::optional<double> addedAmount(const QString& text, const api::ParameterDeclaration& d) {
  const qsizetype split = unitStart(text);
  const QString unitText = text.mid(split).trimmed();
  const std::optional<double> number = parseNumber(text.left(split));
  if (!number) return std::nullopt;
  if (unitText.isEmpty() || unitText == displayUnit(d)) return *number / displayFactor(d);
  const std::optional<Unit> unit = parseUnit(unitText), declared = parseUnit(QString::fromUtf8(d.unit));
  if (!unit || !declared || !(unit->dimension == declared->dimension)) return std::nullopt;
  return *number * unit->scale / declared->scale;
}

/// "*2", "/3", "+10".
Typed relativeTyped(const QString& text, const api::ParameterDeclaration& d, double current) {
  Typed result;
  result.relative = true;
  if (text[0] == QLatin1Char('+')) {
    const std::optional<double> added = addedAmount(text.mid(1), d);
    if (!added) result.problem = QStringLiteral("“%1” adds nothing; type for example +10").arg(text);
    result.added = added.value_or(0);
  } else {
    const bool divides = text[0] == QLatin1Char('/') || text[0] == QChar(0x00F7);
    const std::optional<double> factor = parseNumber(text.mid(1));
    if (!factor || (divides && *factor == 0))
      result.problem = QStringLiteral("“%1” is no factor; type for example *2 or /3").arg(text);
    else
      result.factor = divides ? 1 / *factor : *factor;
  }
  if (!result.problem.isEmpty()) return result;
  result.value = scaledValue(d, current, result.factor) + result.added;
  requireFinite(result, d, text);
  return result;
}

}  // namespace

Typed parseTyped(const QString& typed, const api::ParameterDeclaration& d, double current) {
  Typed result;
  QString text = typed.trimmed();
  if (text.size() > kLongestTyped) {
    result.problem = QStringLiteral("“%1…” is too long for a number").arg(text.left(20));
    return result;
  }
  if (const auto none = noValueOf(d); none && text.compare(none->word, Qt::CaseInsensitive) == 0) {
    result.value = none->stored;
    return result;
  }
  static const QString kRelative = QStringLiteral("*\u00D7/\u00F7+");
  if (!text.isEmpty() && kRelative.contains(text[0])) return relativeTyped(text, d, current);
  const qsizetype split = unitStart(text);
  const QString unitText = text.mid(split).trimmed();
  const std::optional<double> number = parseNumber(text.left(split));
  const QString shownUnit = displayUnit(d);
  if (!number) {
    result.problem = QStringLiteral("“%1” is no number; type for example %2").arg(text, formatValue(d, d.defaultValue));
    return result;
  }
  result.value = fromDisplay(d, *number);
  if (unitText.isEmpty() || unitText == shownUnit) {
    requireFinite(result, d, text);
    return result;
  }
  const std::optional<Unit> unit = parseUnit(unitText), declared = parseUnit(QString::fromUtf8(d.unit));
  if (unit && declared && unit->dimension == declared->dimension) {
    result.value = (*number * unit->scale + unit->offset - declared->offset) / declared->scale;
    requireFinite(result, d, text);
  } else if (shownUnit.isEmpty()) {
    result.problem = QStringLiteral("This value has no unit; “%1” was not understood").arg(unitText);
  } else {
    result.problem = QStringLiteral("“%1” does not fit a value in %2").arg(unitText, shownUnit);
  }
  return result;
}

}  // namespace ps
