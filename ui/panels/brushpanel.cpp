// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/brushpanel.h"

#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"

namespace ps {
namespace {

using api::ParameterDeclaration;
using api::ParameterKind;
using api::Scale;

const QString kShape = QStringLiteral("shape");
const QString kOwn = QStringLiteral("brush/");  // before the keys of the chosen brush's own parameters

// key, label, symbol, unit, kind, scale, default, minimum, maximum, hardMinimum, hardMaximum,
// displayUnit, displayScale, displayOffset, choices, group, help, example, source
constexpr ParameterDeclaration kBrush[] = {
    {"radius", "Radius", "r", "m", ParameterKind::Number, Scale::Logarithmic, 0.05, kBrushMinimum, 0.3, kBrushMinimum,
     kBrushMaximum, "mm", 1000, 0, "", "Brush",
     "Half the brush's width; the outline under the pointer shows it true to scale.", "a finger 10 mm, a fist 50 mm",
     ""},
    {"temperature", "Temperature", "T", "K", ParameterKind::Number, Scale::Linear, 293.15, 173.15, 773.15, 1, 10000,
     "°C", 1, -273.15, "", "New matter",
     "Temperature of what is drawn; below its melting point it is drawn as a solid that holds together.",
     "ice from a freezer −18 °C, room 20 °C, hot oil 180 °C", ""},
};

ParameterSet commonValues(const BrushSettings& brush) {
  ParameterSet set;
  set.values = {{"radius", brush.radius}, {"temperature", brush.temperature}};
  return set;
}

}  // namespace

BrushPanel::BrushPanel(Toolbox& tools, QWidget* parent) : ParameterPanel(parent), m_tools(tools) {
  connect(this, &ParameterPanel::edited, this, &BrushPanel::onEdited);
  connect(&tools, &Toolbox::brushChanged, this, &BrushPanel::refresh);
  connect(&tools.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event)) refresh();
    if (std::holds_alternative<MaterialsChanged>(event)) showMaterial();
  });
}

const char* BrushPanel::keep(const QString& text) const { return m_texts.insert(text.toStdString()).first->c_str(); }

api::ParameterList BrushPanel::ownParameters() const {
  const PluginRegistry* plugins = m_tools.document().plugins();
  return plugins ? plugins->parameters(m_tools.brush().shape) : api::ParameterList{};
}

RowModel BrushPanel::shapeRow() const {
  const PluginRegistry* plugins = m_tools.document().plugins();
  QStringList ids, labels;
  for (const std::string& id : plugins ? plugins->ids(PluginKind::Brush) : std::vector<std::string>{}) {
    ids << QString::fromStdString(id);
    labels << pluginLabel(plugins, id);
  }
  const QString present = QString::fromStdString(m_tools.brush().shape);
  if (!ids.contains(present)) {  // one that is not installed any more
    ids << present;
    labels << present;
  }
  const std::string standard = plugins ? plugins->standard(PluginKind::Brush) : std::string();
  const auto first = std::max<qsizetype>(0, ids.indexOf(QString::fromStdString(standard)));
  const auto last = static_cast<double>(ids.size() - 1);
  const api::BrushPlugin* brush = plugins ? plugins->brush(m_tools.brush().shape) : nullptr;
  RowModel row;
  row.key = kShape;
  row.declaration = {"shape",
                     "Shape",
                     "",
                     "",
                     ParameterKind::Choice,
                     Scale::Linear,
                     static_cast<double>(first),
                     0,
                     last,
                     0,
                     last,
                     "",
                     1,
                     0,
                     keep(ids.join(QLatin1Char('|'))),
                     "Brush",
                     brush ? brush->help() : "What one stamp of the brush looks like.",
                     "",
                     ""};
  row.choiceLabels = labels;
  row.value = m_tools.brush().shape;
  row.defaultValue = ids[first].toStdString();
  return row;
}

void BrushPanel::rebuild() {
  const BrushSettings& brush = m_tools.brush();
  std::vector<RowModel> rows{shapeRow()};
  std::vector<RowModel> common = rowModels(api::listOf(kBrush), commonValues(brush));
  rows.push_back(std::move(common[0]));
  for (RowModel& own : rowModels(ownParameters(), brush.shapeParameters(), {}, kOwn)) rows.push_back(std::move(own));
  rows.push_back(std::move(common[1]));
  setModel(std::move(rows));
}

void BrushPanel::refresh() {
  const BrushSettings& brush = m_tools.brush();
  const RowModel shape = shapeRow();
  const QString shown =
      QString::fromUtf8(shape.declaration.choices) + QLatin1Char('=') + QString::fromStdString(brush.shape);
  if (shown != m_shown || rows().empty()) {
    m_shown = shown;
    rebuild();
  }
  for (const auto& [key, value] : commonValues(brush).values) setValue(QString::fromStdString(key), value);
  const ParameterSet set = brush.shapeParameters();
  for (const RowModel& own : rowModels(ownParameters(), set, {}, kOwn)) {
    setValue(own.key, own.value);
    setDisabledReason(own.key, own.disabledReason);
  }
  showMaterial();
}

void BrushPanel::showMaterial() {
  const std::string& id = m_tools.brush().material;
  setHeader(ownerLabel(m_tools.document().project(), {Owner::Material, id, ""}),
            QStringLiteral("Choose other matter under Materials"),
            QStringLiteral("The brush is no part of the scene: undo leaves it as it is"));
}

void BrushPanel::onEdited(const QString& key, const Value& value, Edit edit) {
  if (edit == Edit::Begin) return;
  BrushSettings brush = m_tools.brush();
  if (key == kShape) {
    brush.shape = std::get<std::string>(value);
  } else if (key == QLatin1String("radius")) {
    brush.radius = std::get<double>(value);
  } else if (key == QLatin1String("temperature")) {
    brush.temperature = std::get<double>(value);
  } else if (key.startsWith(kOwn)) {
    brush.parameters[brush.shape].values[key.mid(kOwn.size()).toStdString()] = value;
  }
  m_tools.setBrush(brush);
}

}  // namespace ps
