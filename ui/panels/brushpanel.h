// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/rows/parameterpanel.h"
#include "ui/tools/viewtool.h"

namespace ps {

class Document;

/// The brush's own rows: shape, size, temperature of new matter, made from declarations like every other panel.
class BrushPanel : public ParameterPanel {
  Q_OBJECT
 public:
  explicit BrushPanel(Document& document, QWidget* parent = nullptr);
  void setBrush(const BrushSettings& brush);

 Q_SIGNALS:
  void brushEdited(const ps::BrushSettings& brush);

 private:
  void onEdited(const QString& key, const Value& value, Edit edit);
  Document& m_document;
  BrushSettings m_brush;
};

}  // namespace ps
