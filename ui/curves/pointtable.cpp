// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/pointtable.h"

#include "core/math/responseedit.h"
#include "ui/theme/numbers.h"

#include <QtCore/QRegularExpression>
#include <QtCore/QStringList>

#include <algorithm>

namespace ps {
namespace {

constexpr size_t kMostRows = 1000;  // as files have

/// Whatever stands between columns, the clearest first: a comma may belong to a number.
QStringList columnsOf(const QString& line) {
  for (const char* divider : {"\t", ";", "\\s+", ","}) {
    static const QRegularExpression kEnds(QStringLiteral("^[\\s,]+|[\\s,]+$"));
    QStringList columns;
    for (QString column : line.trimmed().split(QRegularExpression(QString::fromLatin1(divider)), Qt::SkipEmptyParts))
      columns << column.remove(kEnds);
    columns.removeAll(QString());
    if (columns.size() == 2) return columns;
  }
  return {};
}

/// Of a heading: "K" of "T [K]", "T, K", "T/K".
QString unitIn(const QString& heading) {
  static const QRegularExpression kUnit(QStringLiteral("[\\[(,/]\\s*([^\\[(,/\\])]+)[\\])]?\\s*$"));
  return kUnit.match(heading).captured(1).trimmed();
}

Typed typedWith(const QString& text, const QString& unit, const api::ParameterDeclaration& declaration) {
  if (!unit.isEmpty() && parseNumber(text)) {
    if (const Typed typed = parseTyped(text + QLatin1Char(' ') + unit, declaration, 0); typed.problem.isEmpty())
      return typed;
  }
  return parseTyped(text, declaration, 0);
}

bool isHeading(const QStringList& columns) {
  return std::none_of(columns.begin(), columns.end(), [](const QString& text) {
    return text.contains(QRegularExpression(QStringLiteral("^[\\s+\u2212-]*[.,]?\\d")));
  });
}

}  // namespace

PastedTable readTable(const QString& text, const api::ParameterDeclaration& x, const api::ParameterDeclaration& y) {
  PastedTable table;
  const auto failed = [](const QString& problem) { return PastedTable{{}, problem}; };
  QString units[2];
  const QStringList lines = text.split(QRegularExpression(QStringLiteral("[\r\n]+")), Qt::SkipEmptyParts);
  for (qsizetype i = 0; i < lines.size(); ++i) {
    if (lines[i].trimmed().isEmpty()) continue;
    const QStringList columns = columnsOf(lines[i]);
    const bool heading = table.points.empty() && isHeading(columns.isEmpty() ? QStringList{lines[i]} : columns);
    if (heading) {
      for (qsizetype k = 0; k < columns.size(); ++k) units[k] = unitIn(columns[k]);
      continue;
    }
    if (columns.isEmpty()) return failed(QStringLiteral("Row %1 of what was copied has not two columns.").arg(i + 1));
    const Typed first = typedWith(columns[0], units[0], x), second = typedWith(columns[1], units[1], y);
    for (const Typed& typed : {first, second}) {
      if (!typed.problem.isEmpty() || typed.relative)
        return failed(QStringLiteral("Row %1 of what was copied: %2")
                          .arg(i + 1)
                          .arg(typed.relative ? QStringLiteral("This is not a number.") : typed.problem));
    }
    table.points.push_back({first.value, second.value});
    if (table.points.size() > kMostRows) return failed(QStringLiteral("A curve has %1 points at most.").arg(kMostRows));
  }
  if (table.points.empty())
    return failed(QStringLiteral("Nothing to paste: copy a table of two columns, %1 and %2.")
                      .arg(QString::fromUtf8(x.label).toLower(), QString::fromUtf8(y.label).toLower()));
  std::stable_sort(table.points.begin(), table.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto same = std::adjacent_find(table.points.begin(), table.points.end(),
                                       [](const auto& a, const auto& b) { return b.x - a.x < kPointGap; });
  if (same != table.points.end()) return failed(QStringLiteral("Two rows are at %1.").arg(formatValue(x, same->x)));
  return table;
}

}  // namespace ps
