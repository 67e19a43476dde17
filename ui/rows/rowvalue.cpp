// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/rowvalue.h"

#include "ui/theme/numbers.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

using api::ParameterDeclaration;
using api::ParameterKind;

bool isLogarithmic(const ParameterDeclaration& d) {
  return d.scale == api::Scale::Logarithmic && d.minimum > 0 && d.maximum > d.minimum;
}

/// Multiples of 10^exponent, by division where the power is negative: 3 tenths are 0.3 to the last bit.
double roundedTo(double value, int exponent) {
  const double unit = std::pow(10.0, std::abs(exponent));
  return exponent < 0 ? std::round(value * unit) / unit : std::round(value / unit) * unit;
}

double toSignificant(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return value;
  return roundedTo(value, static_cast<int>(std::floor(std::log10(std::abs(value)))) - digits + 1);
}

/// 1, 2 or 5 times a power of ten, at most `step`.
double roundStep(double step) {
  const double decade = std::pow(10.0, std::floor(std::log10(step)));
  const double mantissa = step / decade;
  return decade * (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1);
}

double displayedRange(const ParameterDeclaration& d) { return std::abs((d.maximum - d.minimum) * displayFactor(d)); }

/// Everywhere this much more; of laws the linear one alone.
void raise(Response& response, double added) {
  for (CurvePoint& point : response.points) point.y += added;
  if (response.kind == Response::Kind::Law) response.coefficients[0] += added;
}

double withinSlider(const ParameterDeclaration& d, double value) { return std::clamp(value, d.minimum, d.maximum); }

}  // namespace

double sliderPosition(const ParameterDeclaration& d, double value) {
  if (!(d.maximum > d.minimum) || !std::isfinite(value)) return 0;
  if (isLogarithmic(d)) {
    if (value <= d.minimum) return 0;
    return std::min(1.0, std::log(value / d.minimum) / std::log(d.maximum / d.minimum));
  }
  return std::clamp((value - d.minimum) / (d.maximum - d.minimum), 0.0, 1.0);
}

double valueAtPosition(const ParameterDeclaration& d, double position) {
  const double t = std::clamp(position, 0.0, 1.0);
  if (isLogarithmic(d)) return d.minimum * std::pow(d.maximum / d.minimum, t);
  return d.minimum + (d.maximum - d.minimum) * t;
}

double roundedForSlider(const ParameterDeclaration& d, double value, bool fine) {
  if (d.kind == ParameterKind::Integer) return withinSlider(d, std::round(value));
  double shown = toDisplay(d, value);
  if (isLogarithmic(d)) {
    shown = toSignificant(shown, fine ? 4 : 3);
  } else if (const double range = displayedRange(d); range > 0 && std::isfinite(range)) {
    shown = roundedTo(shown, static_cast<int>(std::floor(std::log10(range / 400) + 1e-9)) - (fine ? 1 : 0));
  }
  return withinSlider(d, fromDisplay(d, shown));
}

double snappedToRound(const ParameterDeclaration& d, double value) {
  const double shown = toDisplay(d, value);
  if (isLogarithmic(d) && shown > 0) {
    const double decade = std::pow(10.0, std::floor(std::log10(shown)));
    double best = decade;
    for (const double factor : {2.0, 5.0, 10.0}) {
      if (std::abs(std::log(decade * factor / shown)) < std::abs(std::log(best / shown))) best = decade * factor;
    }
    return withinSlider(d, fromDisplay(d, best));
  }
  const double range = displayedRange(d);
  if (!(range > 0) || !std::isfinite(range)) return value;
  const double step = d.kind == ParameterKind::Integer ? std::max(1.0, roundStep(range / 20)) : roundStep(range / 20);
  return roundedForSlider(d, fromDisplay(d, std::round(shown / step) * step), true);
}

double stepped(const ParameterDeclaration& d, double value, double steps, bool fine) {
  if (d.kind == ParameterKind::Integer)
    return withinSlider(d, std::round(value) + std::copysign(std::max(1.0, std::round(std::abs(steps))), steps));
  if (isLogarithmic(d)) return roundedForSlider(d, value * std::pow(10.0, steps * (fine ? 0.005 : 0.05)), fine);
  const double range = displayedRange(d);
  if (!(range > 0) || !std::isfinite(range)) return value;
  const double step = roundStep(range / 100 * 1.0000001) * (fine ? 0.1 : 1);
  return roundedForSlider(d, fromDisplay(d, toDisplay(d, value) + steps * step), fine);
}

double numberOfValue(const ParameterDeclaration& d, const Value& value, double temperature) {
  if (const bool* on = std::get_if<bool>(&value)) return *on ? 1 : 0;
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const Response* response = std::get_if<Response>(&value)) {
    return response->kind == Response::Kind::Constant ? response->constant : response->at(temperature);
  }
  return static_cast<double>(choiceNames(d).indexOf(QString::fromStdString(std::get<std::string>(value))));
}

Value valueOfNumber(const ParameterDeclaration& d, double number) {
  switch (d.kind) {
    case ParameterKind::Toggle:
      return number != 0;
    case ParameterKind::Response:
      return Response(number);
    case ParameterKind::Integer:
      return std::round(number);
    case ParameterKind::Choice: {
      const QStringList names = choiceNames(d);
      if (names.isEmpty()) return std::string();
      return names[std::clamp<qsizetype>(std::lround(number), 0, names.size() - 1)].toStdString();
    }
    case ParameterKind::Number:
      break;
  }
  return number;
}

bool isCurve(const Value& value) {
  const Response* response = std::get_if<Response>(&value);
  return response && response->kind != Response::Kind::Constant;
}

bool sameValue(const Value& a, const Value& b) {
  const auto constant = [](const Value& value) -> const double* {
    if (const double* number = std::get_if<double>(&value)) return number;
    const Response* response = std::get_if<Response>(&value);
    return response && response->kind == Response::Kind::Constant ? &response->constant : nullptr;
  };
  const double *x = constant(a), *y = constant(b);
  if (x && y) return *x == *y || std::abs(*x - *y) <= 1e-12 * std::max(std::abs(*x), std::abs(*y));
  return a == b;
}

QString scale(Value& value, const ParameterDeclaration& d, double factor, double added) {
  if (auto* number = std::get_if<double>(&value)) {
    *number = scaledValue(d, *number, factor) + added;
    return {};
  }
  auto* response = std::get_if<Response>(&value);
  if (!response) return QStringLiteral("Only numbers are scaled");
  if (response->kind == Response::Kind::Constant) {
    response->constant = scaledValue(d, response->constant, factor) + added;
    return {};
  }
  if (!(factor > 0)) return QStringLiteral("A curve is scaled by a factor above 0");
  if (response->kind == Response::Kind::Law && lawCoefficientCount(response->law) == 0)
    return QStringLiteral("The law “%1” is not known here and cannot be scaled")
        .arg(QString::fromStdString(response->law));
  if (added != 0 && response->kind == Response::Kind::Law && response->law != "linear")
    return QStringLiteral("Nothing can be added to the law “%1”; it can be scaled, as *2 does")
        .arg(QString::fromStdString(response->law));
  *response = response->scaled(factor);
  if (added != 0) raise(*response, added);
  return {};
}

QStringList choiceNames(const ParameterDeclaration& d) {
  const QString text = QString::fromUtf8(d.choices ? d.choices : "");
  return text.isEmpty() ? QStringList() : text.split(QLatin1Char('|'));
}

QString choiceLabel(const QString& name) {
  static const QStringList kAbbreviations{QStringLiteral("pbd"), QStringLiteral("xpbd"), QStringLiteral("xsph")};
  QStringList words = name.split(QLatin1Char('_'));
  for (QString& word : words) {
    // A letter with a number is a name: "Wendland C2".
    const bool numbered = word.size() > 1 && word[0].isLetter() &&
                          std::all_of(word.begin() + 1, word.end(), [](QChar c) { return c.isDigit(); });
    if (numbered || kAbbreviations.contains(word)) word = word.toUpper();
  }
  QString label = words.join(QLatin1Char(' '));
  if (!label.isEmpty()) label[0] = label[0].toUpper();
  return label;
}

QString refusal(const ParameterDeclaration& d, double value) {
  if (!std::isfinite(value)) return QStringLiteral("Must be a finite number");
  if (d.kind == ParameterKind::Integer && value != std::round(value)) return QStringLiteral("Must be a whole number");
  // A negative display scale would swap the two; none is declared.
  if (value < d.hardMinimum) return QStringLiteral("Must be at least %1").arg(formatBound(d, d.hardMinimum));
  if (value > d.hardMaximum) return QStringLiteral("Must be at most %1").arg(formatBound(d, d.hardMaximum));
  return {};
}

bool isOutOfRange(const ParameterDeclaration& d, double value) {
  if (d.kind == ParameterKind::Toggle || d.kind == ParameterKind::Choice || standsForNone(d, value)) return false;
  const double slack = 1e-12 * std::max(std::abs(d.minimum), std::abs(d.maximum));
  return value < d.minimum - slack || value > d.maximum + slack;
}

}  // namespace ps
