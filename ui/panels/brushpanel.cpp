// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/brushpanel.h"

#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/rows/colourpicker.h"
#include "ui/session/selection.h"
#include "ui/theme/paint.h"
#include "ui/tools/becoming.h"
#include "ui/tools/coarsebrush.h"
#include "ui/tools/livetouch.h"
#include "ui/tools/toolbox.h"

#include <QtWidgets/QBoxLayout>

#include <array>
#include <iterator>
#include <utility>

namespace ps {
namespace {

using api::ParameterDeclaration;
using api::ParameterKind;
using api::Scale;

const QString kShape = QStringLiteral("shape");
/// By which a brush for colours declares its own, each from 0 to 1 (sRGB); plugins/examples/README.md says so.
constexpr std::array kParts{"red", "green", "blue"};
const QString kOwn = QStringLiteral("brush/");  // before the keys of the chosen brush's own parameters

/// What the choices of a row are called.
QStringList labelsOf(const QString& key) {
  if (key == QLatin1String("becomes")) {
    QStringList labels;
    for (const auto& [name, label] : becomings()) labels << label;
    return labels;
  }
  if (key == QLatin1String("draw_on"))
    return {QStringLiteral("Surfaces"),
            QStringLiteral("A level plane"),
            QStringLiteral("An upright plane across x"),
            QStringLiteral("An upright plane across z"),
            QStringLiteral("A plane that faces the view"),
            QStringLiteral("A plane at any pose")};
  if (key == QLatin1String("snap_to"))
    return {QStringLiteral("Nothing"), QStringLiteral("The grid"), QStringLiteral("Strokes"),
            QStringLiteral("Ends of strokes")};
  if (key == QLatin1String("mirror"))
    return {QStringLiteral("None"), QStringLiteral("Across x"), QStringLiteral("Across y"), QStringLiteral("Across z")};
  return {};
}

}  // namespace

BrushPanel::BrushPanel(Toolbox& tools, QWidget* parent)
    : ParameterPanel(parent), m_tools(tools), m_colour(new ColourRow(QStringLiteral("Colour"))) {
  // Below the header, where its brush is named.
  static_cast<QBoxLayout*>(layout())->insertWidget(1, m_colour);
  m_colour->setToolTip(QStringLiteral("Choose the colour"));
  connect(m_colour, &ColourRow::picked, this, &BrushPanel::takeColour);
  connect(this, &ParameterPanel::edited, this, &BrushPanel::onEdited);
  connect(&tools, &Toolbox::brushChanged, this, &BrushPanel::refresh);
  connect(&tools.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event)) refresh();
    const auto* parameter = std::get_if<ParameterChanged>(&event);
    if (parameter && parameter->address.text() == kSpacing) showCoarse();
    if (parameter && parameter->address.key == "thermal_time_scale") refresh();
    if (std::holds_alternative<MaterialsChanged>(event) || m_tools.stampsShape()) showMaterial();
  });
  if (tools.document().plugins()) refresh();  // made later than they came
}

const char* BrushPanel::keep(const QString& text) const { return m_texts.insert(text.toStdString()).first->c_str(); }

api::ParameterList BrushPanel::ownParameters() const {
  const PluginRegistry* plugins = m_tools.document().plugins();
  return plugins ? plugins->parameters(m_tools.brush().shape) : api::ParameterList{};
}

RowModel BrushPanel::shapeRow() const {
  const PluginRegistry* plugins = m_tools.document().plugins();
  QStringList ids, labels;
  for (const std::string& id : plugins ? idsByLabel(*plugins, PluginKind::Brush) : std::vector<std::string>{}) {
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
  std::vector<RowModel> common = rowModels(brushParameters(), valuesOf(brush));
  for (RowModel& row : common) row.choiceLabels = labelsOf(row.key);
  rows.push_back(std::move(common.front()));
  const ParameterSet standard = standardValues(m_tools.document(), brush.shape);
  for (RowModel& own : rowModels(ownParameters(), brush.shapeParameters(), standard, kOwn))
    rows.push_back(std::move(own));
  rows.insert(rows.end(), std::make_move_iterator(common.begin() + 1), std::make_move_iterator(common.end()));
  setModel(std::move(rows));
}

void BrushPanel::refresh() {
  const BrushSettings& brush = m_tools.brush();
  const RowModel shape = shapeRow();
  const ParameterSet standard = standardValues(m_tools.document(), brush.shape);
  QString shown = QString::fromUtf8(shape.declaration.choices) + QLatin1Char('=') + QString::fromStdString(brush.shape);
  for (const auto& [key, value] : standard.values) shown += QStringLiteral(" %1").arg(std::get<double>(value));
  if (shown != m_shown || rows().empty()) {
    m_shown = shown;
    rebuild();
  }
  const auto show = [this](const std::vector<RowModel>& models) {
    for (const RowModel& row : models) {
      setValue(row.key, row.value);
      setDisabledReason(row.key, row.disabledReason);
    }
  };
  show(rowModels(brushParameters(), valuesOf(brush)));
  show(rowModels(ownParameters(), brush.shapeParameters(), standard, kOwn));
  if (m_tools.scaleParameter())
    setDisabledReason(QStringLiteral("radius"), QStringLiteral("The scale says how large the copies are"));
  if (m_tools.touchesMatter() || m_tools.reworks()) {
    for (const char* key : {"temperature", "becomes", "joins", "held", "draw_on", "plane_at", "plane_x", "plane_y",
                            "plane_z", "plane_tilt", "plane_heading", "grid", "snap_to", "snap_within", "steady"})
      setDisabledReason(QString::fromLatin1(key), QStringLiteral("This brush works on the matter that is there"));
  }
  showColour();
  showMaterial();
  showCoarse();
}

void BrushPanel::showCoarse() {
  const PluginRegistry* plugins = m_tools.document().plugins();
  if (!plugins) return;
  QStringList keys;
  for (const Coarseness& coarse : coarsenessOf(m_tools.brush(), *plugins, m_tools.spacing())) {
    keys << (coarse.own ? kOwn : QString()) + coarse.row;
    setLimit(keys.back(), asNote(coarse.text) + QStringLiteral(" [Show the spacing](%1)").arg(QLatin1String(kSpacing)));
  }
  for (const QString& key : std::exchange(m_coarse, keys)) {
    if (!keys.contains(key)) setLimit(key, {});
  }
}

/// It is disabled where its parts do not act, as their rows are.
void BrushPanel::showColour() {
  const std::vector<RowModel> own = rowModels(ownParameters(), m_tools.brush().shapeParameters());
  std::array<float, 3> parts{};
  size_t found = 0;
  QString disabled;
  for (size_t k = 0; k < kParts.size() && m_tools.colours(); ++k) {
    const auto row = std::find_if(own.begin(), own.end(), [&](const RowModel& one) {
      const auto& range = one.declaration;
      return one.key == QLatin1String(kParts[k]) && range.hardMinimum == 0 && range.hardMaximum == 1;
    });
    if (row == own.end() || !std::holds_alternative<double>(row->value)) continue;
    parts[k] = static_cast<float>(std::get<double>(row->value));
    disabled = row->disabledReason;
    ++found;
  }
  m_colour->setVisible(found == kParts.size());
  if (found != kParts.size()) return;
  m_colour->setColour(QColor::fromRgbF(parts[0], parts[1], parts[2]));
  m_colour->alignTo(row(kShape));
  m_colour->setEnabled(disabled.isEmpty());
  m_colour->setToolTip(disabled.isEmpty() ? QStringLiteral("Choose the colour") : disabled);
}

void BrushPanel::takeColour(const QColor& colour) {
  BrushSettings brush = m_tools.brush();
  auto& values = brush.parameters[brush.shape].values;
  const double parts[] = {colour.redF(), colour.greenF(), colour.blueF()};
  for (size_t k = 0; k < kParts.size(); ++k) values[kParts[k]] = parts[k];
  m_tools.setBrush(brush);
}

void BrushPanel::showMaterial() {
  if (m_tools.touchesMatter()) {
    setHeader(pluginLabel(m_tools.document().plugins(), m_tools.brush().shape),
              QStringLiteral("Works on the matter that is there, while the scene runs"),
              QStringLiteral("The brush is no part of the scene: undo leaves it as it is"));
    return;
  }
  if (m_tools.colours()) {
    setHeader(pluginLabel(m_tools.document().plugins(), m_tools.brush().shape),
              QStringLiteral("Colours the matter that is there, and changes nothing else of it"),
              QStringLiteral("The brush is no part of the scene: undo leaves it as it is"));
    return;
  }
  const std::string& id = m_tools.brush().material;
  if (m_tools.stampsShape()) {
    const QString name = QString::fromStdString(m_tools.shapeName());
    setHeader(name.isEmpty() ? QStringLiteral("No shape yet") : QStringLiteral("Copies of %1").arg(name),
              QStringLiteral("Of %1. Select another body for its shape, or click it with Alt")
                  .arg(ownerLabel(m_tools.document().project(), {Owner::Material, id, ""})),
              QStringLiteral("The brush is no part of the scene: undo leaves it as it is"));
    return;
  }
  setHeader(ownerLabel(m_tools.document().project(), {Owner::Material, id, ""}),
            QStringLiteral("Choose other matter on the bar or under Materials"),
            QStringLiteral("The brush is no part of the scene: undo leaves it as it is"));
}

void BrushPanel::onEdited(const QString& key, const Value& value, Edit edit) {
  if (edit == Edit::Begin) return;
  if (key == kShape) {
    m_tools.takeBrush(std::get<std::string>(value));
    return;
  }
  BrushSettings brush = m_tools.brush();
  if (key.startsWith(kOwn)) {
    const std::string own = key.mid(kOwn.size()).toStdString();
    const ParameterSet standard = standardValues(m_tools.document(), brush.shape);
    const auto same = standard.values.find(own);
    // What is put back goes on with the scene.
    if (same != standard.values.end() && same->second == value)
      brush.parameters[brush.shape].values.erase(own);
    else
      brush.parameters[brush.shape].values[own] = value;
  } else {
    setValueOf(brush, key.toStdString(), value);
  }
  m_tools.setBrush(brush);
}

}  // namespace ps
