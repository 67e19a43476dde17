// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/keptrows.h"

#include "core/scene/declare.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace ps {
namespace {

using nlohmann::json;

constexpr qsizetype kLongest = 60;
constexpr double kFarthest = 1e300;

/// "Tear strain" of "tear_strain".
std::string labelOf(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  if (!key.empty()) key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  return key;
}

json jsonOf(const Value& value) {
  if (const bool* on = std::get_if<bool>(&value)) return *on;
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  const Response& response = std::get<Response>(value);
  return response.kind == Response::Kind::Constant ? json(response.at(0)) : json("a curve over temperature");
}

/// All that the file says, by key.
std::map<std::string, json> valuesIn(const ParameterSet& set, const Unknown& unknown, const char* part) {
  std::map<std::string, json> values;
  const json* owner = unknown.get();
  if (owner && *part) owner = owner->contains(part) ? &owner->at(part) : nullptr;
  if (owner && owner->is_object() && owner->contains("parameters") && owner->at("parameters").is_object()) {
    for (const auto& [key, value] : owner->at("parameters").items()) values[key] = value;
  }
  for (const auto& [key, value] : set.values) values[key] = jsonOf(value);
  return values;
}

/// Words as a choice of one.
void showText(RowModel& row, const declare::Names& names, const declare::Words& words, const QString& text) {
  row.declaration = declare::choice(names, "kept", 0, words);
  row.value = std::string("kept");
  row.choiceLabels = {text.size() > kLongest ? text.left(kLongest - 1) + QStringLiteral("…") : text};
}

}  // namespace

std::vector<RowModel> keptRows(const ParameterSet& set, const Unknown& unknown, const char* part, const Address& any,
                               const std::string& plugin) {
  const QString id = QString::fromStdString(plugin);
  const declare::Words words{declare::kept(plugin + ", not installed"), "Kept for a plugin that is not installed.", "",
                             ""};
  std::map<std::string, json> values = valuesIn(set, unknown, part);
  const bool none = values.empty();
  if (none) values["values"] = "the plugin’s defaults";
  std::vector<RowModel> rows;
  for (const auto& [key, value] : values) {
    RowModel row;
    Address address = any;
    address.key = key;
    row.key = QString::fromStdString(address.text());
    const declare::Names names{declare::kept(key), declare::kept(labelOf(key)), "", ""};
    if (value.is_boolean()) {
      row.declaration = declare::toggle(names, value.get<bool>(), words);
      row.value = value.get<bool>();
    } else if (value.is_number()) {
      const auto number = value.get<double>();
      row.declaration =
          declare::number(names, {number, std::min(number, 0.0), std::max(number, 1.0), -kFarthest, kFarthest}, words);
      row.value = number;
    } else {
      showText(row, names, words, QString::fromStdString(value.is_string() ? value.get<std::string>() : value.dump()));
    }
    row.defaultValue = row.value;
    row.kept = true;
    row.disabledReason =
        QStringLiteral("The plugin “%1” is not installed. Values are kept as they stand in the file.").arg(id);
    rows.push_back(std::move(row));
  }
  return rows;
}

void paintPlaceholder(QPainter& painter, const QRectF& square) {
  const Theme& theme = Theme::current();
  painter.setPen(QPen(theme[Token::Muted], 1));
  painter.setBrush(QBrush(theme[Token::Muted], Qt::BDiagPattern));
  painter.drawEllipse(square);
  const double side = std::min(16.0, 0.6 * square.width());
  QRectF plug(0, 0, side, side);
  plug.moveCenter(square.center());
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme[Token::Panel]);
  painter.drawEllipse(plug.adjusted(-1, -1, 1, 1));
  paintIcon(painter, plug, QStringLiteral("plugin"), theme[Token::Text2]);
}

}  // namespace ps
