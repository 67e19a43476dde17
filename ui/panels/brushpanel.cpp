// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/brushpanel.h"

#include "ui/document/document.h"

namespace ps {
namespace {

using api::ParameterDeclaration;
using api::ParameterKind;
using api::Scale;

// key, label, symbol, unit, kind, scale, default, minimum, maximum, hardMinimum, hardMaximum,
// displayUnit, displayScale, displayOffset, choices, group, help, example, source
constexpr ParameterDeclaration kBrush[] = {
    {"shape", "Shape", "", "", ParameterKind::Choice, Scale::Linear, 0, 0, 1, 0, 1, "", 1, 0, "sphere|cube", "Brush",
     "What one stamp of the brush looks like.", "sphere for free forms, cube for walls and floors", ""},
    {"radius", "Radius", "r", "m", ParameterKind::Number, Scale::Logarithmic, 0.05, kBrushMinimum, 0.3, kBrushMinimum,
     kBrushMaximum, "mm", 1000, 0, "", "Brush",
     "Half the brush's width; the outline under the pointer shows it true to scale.", "a finger 10 mm, a fist 50 mm",
     ""},
    {"temperature", "Temperature", "T", "K", ParameterKind::Number, Scale::Linear, 293.15, 173.15, 773.15, 1, 10000,
     "°C", 1, -273.15, "", "New matter",
     "Temperature of what is drawn; below its melting point it is drawn as a bonded solid.",
     "ice from a freezer −18 °C, room 20 °C, hot oil 180 °C", ""},
};

}  // namespace

BrushPanel::BrushPanel(Document& document, QWidget* parent) : ParameterPanel(parent), m_document(document) {
  connect(this, &ParameterPanel::edited, this, &BrushPanel::onEdited);
}

void BrushPanel::setBrush(const BrushSettings& brush) {
  const bool first = rows().empty();
  const bool other = brush.material != m_brush.material || first;
  m_brush = brush;
  if (other) {
    QString label = QString::fromStdString(brush.material);
    for (const SceneMaterial& material : m_document.project().materials) {
      if ((material.id == brush.material || brush.material.empty()) && !material.label.empty()) {
        label = QString::fromStdString(material.label);
        break;
      }
    }
    setHeader(label, QStringLiteral("Choose other matter under Materials"));
  }
  ParameterSet set;
  set.values = {{"shape", brush.shape}, {"radius", brush.radius}, {"temperature", brush.temperature}};
  if (first) {
    setModel(rowModels(api::listOf(kBrush), set));
  } else {
    for (const auto& [key, value] : set.values) setValue(QString::fromStdString(key), value);
  }
}

void BrushPanel::onEdited(const QString& key, const Value& value, Edit edit) {
  if (edit == Edit::Begin) return;
  if (key == QLatin1String("shape")) m_brush.shape = std::get<std::string>(value);
  if (key == QLatin1String("radius")) m_brush.radius = std::get<double>(value);
  if (key == QLatin1String("temperature")) m_brush.temperature = std::get<double>(value);
  Q_EMIT brushEdited(m_brush);
}

}  // namespace ps
