// SPDX-License-Identifier: Apache-2.0
#include "ui/help/parameterhelp.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/rows/parameterrow.h"
#include "ui/rows/rowvalue.h"
#include "ui/theme/numbers.h"
#include "ui/theme/units.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kEnd = 1e-3;    // share of a slider that counts as its end
constexpr double kAlike = 5e-3;  // relative difference below which two figures are the same
constexpr size_t kBeside = 4;    // figures shown below and above

using Declaration = api::ParameterDeclaration;

bool isNumeric(const Declaration& d) {
  return d.kind == api::ParameterKind::Number || d.kind == api::ParameterKind::Integer ||
         d.kind == api::ParameterKind::Response;
}
double numberIn(const RowModel& row, const Value& value) {
  return numberOfValue(row.declaration, value, row.temperature);
}

QString valueText(const RowModel& row, const Value& value) {
  const Declaration& d = row.declaration;
  if (isNumeric(d)) return formatValue(d, numberIn(row, value));
  if (d.kind == api::ParameterKind::Toggle)
    return numberIn(row, value) > 0 ? QStringLiteral("on") : QStringLiteral("off");
  const auto index = static_cast<qsizetype>(numberIn(row, value));
  if (index >= 0 && index < row.choiceLabels.size()) return row.choiceLabels[index];
  const QStringList names = choiceNames(d);
  return index >= 0 && index < names.size() ? choiceLabel(names[index]) : QStringLiteral("—");
}

/// "420 K, 146.9 °C and 296.3 °F", of a temperature alone; a difference of temperatures has no other zero.
QString inOtherUnits(const Declaration& d, double kelvin) {
  if (std::string_view(d.unit) != "K" || d.displayOffset == 0) return {};
  return QStringLiteral("That is %1 K, %2 °C and %3 °F.")
      .arg(formatShort(kelvin, 5), formatShort(kelvin - 273.15, 4), formatShort(kelvin * 9 / 5 - 459.67, 4));
}

QString againstDefault(const RowModel& row) {
  const Declaration& d = row.declaration;
  if (sameValue(row.value, row.defaultValue)) return QStringLiteral("It is the default.");
  const QString usual = valueText(row, row.defaultValue);
  if (!isNumeric(d)) return QStringLiteral("The default is “%1”.").arg(usual);
  const double now = numberIn(row, row.value), before = numberIn(row, row.defaultValue);
  if (standsForNone(d, now) || standsForNone(d, before)) return QStringLiteral("The default is %1.").arg(usual);
  if (d.displayOffset == 0 && now * before > 0) {
    const double ratio = now / before;
    if (std::abs(ratio - 1) < kAlike) return QStringLiteral("It is about the default of %1.").arg(usual);
    return ratio > 2 ? QStringLiteral("It is %1 times the default of %2.").arg(formatShort(ratio, 3), usual)
                     : QStringLiteral("It is %1 % of the default of %2.").arg(formatShort(100 * ratio, 3), usual);
  }
  const double difference = std::abs(toDisplay(d, now) - toDisplay(d, before));
  return QStringLiteral("It is %1 %2 the default of %3.")
      .arg(formatQuantity(difference, displayUnit(d)), now > before ? QStringLiteral("above") : QStringLiteral("below"),
           usual);
}

QString onSlider(const RowModel& row) {
  const Declaration& d = row.declaration;
  if (!(d.maximum > d.minimum)) return {};
  const double value = numberIn(row, row.value);
  if (standsForNone(d, value)) return {};
  if (isOutOfRange(d, value))
    return QStringLiteral("It lies beyond the slider, which goes from %1 to %2; it acts all the same.")
        .arg(formatBound(d, d.minimum), formatBound(d, d.maximum));
  const double place = sliderPosition(d, value);
  if (place < kEnd) return QStringLiteral("It is the least that the slider offers.");
  if (place > 1 - kEnd) return QStringLiteral("It is the most that the slider offers.");
  return QStringLiteral("It stands at %1 % of the slider%2.")
      .arg(formatFixed(100 * place),
           d.scale == api::Scale::Logarithmic ? QStringLiteral(", on which equal ways are equal factors") : QString());
}

const char* whenText(const Declaration& d) {
  switch (d.actsAt) {
    case api::ActsAt::NextReset:
      return "at the next start (Home), and on what is drawn from now on";
    case api::ActsAt::NextFrameIfFixed:
      return "on the next frame for a body that is fixed, at the next start (Home) for any other";
    case api::ActsAt::WithItsMatter:
      return "on the next frame: the body's matter is carried along";
    case api::ActsAt::NextFrame:
      break;
  }
  return "on the next frame";
}

std::vector<KnownFigure> figuresFor(const RowModel& row, const Document& document) {
  const auto address = Address::parse(row.key.toStdString());
  if (!address || address->owner != Owner::Material || !isNumeric(row.declaration)) return {};
  return knownFigures(document, address->key, row.temperature);
}

QString amongKnown(const RowModel& row, const std::vector<KnownFigure>& figures) {
  if (figures.size() < 2) return {};
  const double value = numberIn(row, row.value);
  const KnownFigure *same = nullptr, *below = nullptr, *above = nullptr;
  for (const KnownFigure& figure : figures) {
    if (std::abs(figure.value - value) <= kAlike * std::abs(value)) same = same ? same : &figure;
    if (figure.value < value) below = &figure;
    if (figure.value > value && !above) above = &figure;
  }
  const auto text = [&](const KnownFigure& figure) {
    return QStringLiteral("%1 (%2)").arg(figure.label, formatValue(row.declaration, figure.value));
  };
  if (same) return QStringLiteral("It is that of %1.").arg(text(*same));
  if (below && above) return QStringLiteral("It lies between %1 and %2.").arg(text(*below), text(*above));
  if (below) return QStringLiteral("It is more than that of any installed material; next comes %1.").arg(text(*below));
  return above ? QStringLiteral("It is less than that of any installed material; next comes %1.").arg(text(*above))
               : QString();
}

QString cell(const QString& name, const QString& text) {
  if (text.isEmpty()) return {};
  return QStringLiteral("<tr><td class='name'>%1&nbsp;&nbsp;</td><td>%2</td></tr>")
      .arg(name.toHtmlEscaped(), text.toHtmlEscaped());
}

QString declared(const RowModel& row) {
  const Declaration& d = row.declaration;
  const auto text = [](const char* words) { return QString::fromUtf8(words ? words : ""); };
  QString rows;
  if (isNumeric(d)) {
    const QString unit = displayUnit(d), stored = QString::fromUtf8(d.unit);
    rows += cell(QStringLiteral("Unit"), unit == stored ? unit : QStringLiteral("%1, in files %2").arg(unit, stored));
    const auto range = [&](double least, double most) {
      return most > least ? QStringLiteral("%1 to %2").arg(formatBound(d, least), formatBound(d, most)) : QString();
    };
    rows += cell(QStringLiteral("Slider"), range(d.minimum, d.maximum));
    rows += cell(QStringLiteral("Typed values"), range(d.hardMinimum, d.hardMaximum));
  }
  rows += cell(QStringLiteral("Default"), isCurve(row.defaultValue) ? QStringLiteral("a curve over temperature")
                                                                    : valueText(row, row.defaultValue));
  rows += cell(QStringLiteral("Acts"), QString::fromUtf8(whenText(d)));
  for (const QString& rule : row.rules) rows += cell(QStringLiteral("Rule"), rule);
  rows += cell(QStringLiteral("Example"), text(d.example));
  rows += cell(QStringLiteral("Source"), row.source.isEmpty() ? text(d.source) : row.source);
  if (Address::parse(row.key.toStdString())) rows += cell(QStringLiteral("In files"), row.key);
  return QStringLiteral("<table>%1</table>").arg(rows);
}

/// Those next to the value, with it in their midst.
QString figureTable(const RowModel& row, const std::vector<KnownFigure>& figures) {
  if (figures.size() < 2) return {};
  const double value = numberIn(row, row.value);
  const auto above =
      std::find_if(figures.begin(), figures.end(), [&](const KnownFigure& f) { return f.value > value; });
  const auto at = static_cast<size_t>(above - figures.begin());
  const size_t first = at > kBeside ? at - kBeside : 0, last = std::min(figures.size(), at + kBeside);
  const auto line = [&](const QString& name, double number, const char* kind) {
    return QStringLiteral("<tr><td class='%3'>%1&nbsp;&nbsp;</td><td class='%3' align='right'>%2</td></tr>")
        .arg(name.toHtmlEscaped(), formatValue(row.declaration, number).toHtmlEscaped(), QLatin1String(kind));
  };
  QString rows;
  for (size_t i = first; i < last; ++i) {
    if (i == at) rows += line(QStringLiteral("this value"), value, "here");
    rows += line(figures[i].label, figures[i].value, "name");
  }
  if (at >= last) rows += line(QStringLiteral("this value"), value, "here");
  return QStringLiteral("<h3>Among the installed materials, at %1</h3><table>%2</table>")
      .arg(temperatureText(row.temperature, 0), rows);
}

}  // namespace

std::vector<KnownFigure> knownFigures(const Document& document, const std::string& property, double temperature) {
  std::vector<KnownFigure> figures;
  const PluginRegistry* plugins = document.plugins();
  if (!plugins) return figures;
  for (const std::string& id : plugins->ids(PluginKind::Material)) {
    const Material* material = plugins->material(id);
    if (!material || !material->properties.contains(property) || !existsAt(*material, property, temperature)) continue;
    const double value = valueOf(*material, property, temperature);
    if (std::isfinite(value)) figures.push_back({id, pluginLabel(plugins, id), value});
  }
  std::stable_sort(figures.begin(), figures.end(),
                   [](const KnownFigure& a, const KnownFigure& b) { return a.value < b.value; });
  return figures;
}

QStringList explainedValue(const RowModel& row, const Document& document) {
  const Declaration& d = row.declaration;
  QStringList said;
  if (isCurve(row.value)) {
    said << QStringLiteral("It is a curve over temperature; at %1, where its matter stands now, it is %2.")
                .arg(temperatureText(row.temperature, 1), valueText(row, row.value));
  } else {
    said << QStringLiteral("It is %1.").arg(valueText(row, row.value));
  }
  if (isNumeric(d)) said << inOtherUnits(d, numberIn(row, row.value));
  said << againstDefault(row);
  if (isNumeric(d)) said << onSlider(row) << amongKnown(row, figuresFor(row, document));
  if (!row.disabledReason.isEmpty()) said << QStringLiteral("It does nothing at present. ") + row.disabledReason;
  said.removeAll(QString());
  return said;
}

HelpPage parameterHelp(const RowModel& row, const Document& document) {
  const auto address = Address::parse(row.key.toStdString());
  const QString label = QString::fromUtf8(row.declaration.label);
  QString html = QStringLiteral("<h1>%1</h1>").arg(label.toHtmlEscaped());
  if (address && address->owner != Owner::Scene)
    html += QStringLiteral("<p class='name'>%1</p>").arg(ownerLabel(document.project(), *address).toHtmlEscaped());
  html += QStringLiteral("<p>%1</p>").arg(QString::fromUtf8(row.declaration.help).toHtmlEscaped()) + declared(row);
  QStringList said;
  for (const QString& sentence : explainedValue(row, document)) said << sentence.toHtmlEscaped();
  html += QStringLiteral("<h3>The value now</h3><p>%1</p>").arg(said.join(QLatin1Char(' '))) +
          figureTable(row, figuresFor(row, document));
  return {QStringLiteral("parameter/") + row.key, label, html, true};
}

}  // namespace ps
