// SPDX-License-Identifier: Apache-2.0
#include "ui/theme/units.h"

#include "ui/theme/numbers.h"

#include <QtCore/QStringList>
#include <QtCore/QStringView>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace ps {
namespace {

struct Named {
  const char16_t* symbol;
  bool prefixes;  ///< takes k, M, m, µ, ...
  Unit unit;
};
// Dimensions: m, kg, s, K, mol, rad.
constexpr Named kNamed[] = {
    {u"m", true, {1, 0, {1, 0, 0, 0, 0, 0}}},
    {u"g", true, {1e-3, 0, {0, 1, 0, 0, 0, 0}}},
    {u"t", false, {1e3, 0, {0, 1, 0, 0, 0, 0}}},
    {u"s", true, {1, 0, {0, 0, 1, 0, 0, 0}}},
    {u"min", false, {60, 0, {0, 0, 1, 0, 0, 0}}},
    {u"h", false, {3600, 0, {0, 0, 1, 0, 0, 0}}},
    {u"K", true, {1, 0, {0, 0, 0, 1, 0, 0}}},
    {u"°C", false, {1, 273.15, {0, 0, 0, 1, 0, 0}}},
    {u"C", false, {1, 273.15, {0, 0, 0, 1, 0, 0}}},
    {u"°F", false, {5.0 / 9.0, 459.67 * 5.0 / 9.0, {0, 0, 0, 1, 0, 0}}},
    {u"F", false, {5.0 / 9.0, 459.67 * 5.0 / 9.0, {0, 0, 0, 1, 0, 0}}},
    {u"mol", true, {1, 0, {0, 0, 0, 0, 1, 0}}},
    {u"Hz", true, {1, 0, {0, 0, -1, 0, 0, 0}}},
    {u"N", true, {1, 0, {1, 1, -2, 0, 0, 0}}},
    {u"Pa", true, {1, 0, {-1, 1, -2, 0, 0, 0}}},
    {u"bar", true, {1e5, 0, {-1, 1, -2, 0, 0, 0}}},
    {u"atm", false, {101325, 0, {-1, 1, -2, 0, 0, 0}}},
    {u"J", true, {1, 0, {2, 1, -2, 0, 0, 0}}},
    {u"cal", true, {4.184, 0, {2, 1, -2, 0, 0, 0}}},
    {u"Wh", true, {3600, 0, {2, 1, -2, 0, 0, 0}}},
    {u"W", true, {1, 0, {2, 1, -3, 0, 0, 0}}},
    {u"L", true, {1e-3, 0, {3, 0, 0, 0, 0, 0}}},
    {u"l", true, {1e-3, 0, {3, 0, 0, 0, 0, 0}}},
    {u"rad", false, {1, 0, {0, 0, 0, 0, 0, 1}}},
    {u"°", false, {0.017453292519943295, 0, {0, 0, 0, 0, 0, 1}}},
    {u"%", false, {1e-2, 0, {}}},
    {u"×", false, {}},
    {u"1", false, {}},
};

double prefixFactor(QChar prefix) {
  switch (prefix.unicode()) {
    case u'n':
      return 1e-9;
    case u'\u00B5':
    case u'\u03BC':
    case u'u':
      return 1e-6;
    case u'm':
      return 1e-3;
    case u'c':
      return 1e-2;
    case u'd':
      return 1e-1;
    case u'h':
      return 1e2;
    case u'k':
      return 1e3;
    case u'M':
      return 1e6;
    case u'G':
      return 1e9;
    case u'T':
      return 1e12;
    default:
      return 0;
  }
}

std::optional<Unit> namedUnit(QStringView name) {
  for (const Named& named : kNamed) {
    if (name == named.symbol) return named.unit;
  }
  if (name.size() < 2) return std::nullopt;
  const double factor = prefixFactor(name.front());
  for (const Named& named : kNamed) {
    if (factor > 0 && named.prefixes && name.mid(1) == named.symbol) {
      Unit unit = named.unit;
      unit.scale *= factor;
      return unit;
    }
  }
  return std::nullopt;
}

/// Superscripts as "^n", dots as "*", no spaces.
QString plainText(const QString& text) {
  static const QString superscripts = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
  QString plain;
  bool raised = false;
  for (const QChar c : text) {
    if (c.isSpace()) continue;
    const qsizetype digit = superscripts.indexOf(c);
    const bool minus = c == QChar(0x207B);
    if ((digit >= 0 || minus) && !raised) plain += QLatin1Char('^');
    raised = digit >= 0 || minus;
    if (minus)
      plain += QLatin1Char('-');
    else if (digit >= 0)
      plain += QChar(static_cast<char16_t>(u'0' + digit));
    else if (c == QChar(0x00B7) || c == QChar(0x22C5))
      plain += QLatin1Char('*');
    else if (c == QChar(0x2212))
      plain += QLatin1Char('-');
    else
      plain += c;
  }
  return plain;
}

/// "m^-2" into a unit raised to a power.
std::optional<Unit> factorUnit(QStringView factor) {
  int power = 1;
  const qsizetype caret = factor.indexOf(u'^');
  if (caret >= 0) {
    bool ok = false;
    power = factor.mid(caret + 1).toInt(&ok);
    if (!ok || std::abs(power) > 9) return std::nullopt;
    factor = factor.left(caret);
  }
  std::optional<Unit> unit = namedUnit(factor);
  if (!unit) return std::nullopt;
  unit->scale = std::pow(unit->scale, power);
  for (int& exponent : unit->dimension) exponent *= power;
  if (power != 1) unit->offset = 0;
  return unit;
}

}  // namespace

std::optional<Unit> parseUnit(const QString& text) {
  QString plain = plainText(text);
  Unit result;
  if (plain.isEmpty()) return result;
  const int slashes = static_cast<int>(plain.count(QLatin1Char('/')));
  if (slashes > 1) return std::nullopt;
  QStringList sides = plain.split(QLatin1Char('/'));
  if (slashes == 1 && sides[1].startsWith(QLatin1Char('(')) && sides[1].endsWith(QLatin1Char(')'))) {
    sides[1] = sides[1].mid(1, sides[1].size() - 2);
  }
  int factors = 0;
  for (int side = 0; side < sides.size(); ++side) {
    for (const QString& factor : sides[side].split(QLatin1Char('*'))) {
      const std::optional<Unit> unit = factorUnit(factor);
      if (!unit) return std::nullopt;
      ++factors;
      result.scale = side == 0 ? result.scale * unit->scale : result.scale / unit->scale;
      result.offset = unit->offset;
      for (size_t i = 0; i < result.dimension.size(); ++i) {
        result.dimension[i] += side == 0 ? unit->dimension[i] : -unit->dimension[i];
      }
    }
  }
  if (factors > 1) result.offset = 0;
  return result;
}

namespace {

struct ShownScale {
  const char16_t* symbol;
  double scale, offset;  ///< shown = kelvin * scale + offset
};
constexpr ShownScale kScales[] = {{u"°C", 1, -273.15}, {u"K", 1, 0}, {u"°F", 1.8, -459.67}};
std::atomic<TemperatureUnit> shownUnit{TemperatureUnit::Celsius};

const ShownScale& scale() { return kScales[static_cast<size_t>(shownUnit.load())]; }

}  // namespace

TemperatureUnit temperatureUnit() { return shownUnit; }
void setTemperatureUnit(TemperatureUnit unit) { shownUnit = unit; }
QString temperatureSymbol() { return QString::fromUtf16(scale().symbol); }
double shownTemperature(double kelvin) { return kelvin * scale().scale + scale().offset; }
double kelvinOf(double shown) { return (shown - scale().offset) / scale().scale; }
double degreesPerKelvin() { return scale().scale; }
QString temperatureText(double kelvin, int decimals) {
  return formatFixed(shownTemperature(kelvin), decimals) + QLatin1Char(' ') + temperatureSymbol();
}

}  // namespace ps
