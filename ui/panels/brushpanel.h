// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/rows/parameterpanel.h"
#include "ui/tools/brushsettings.h"

#include <set>

namespace ps {

class ColourRow;
class Selection;
class Toolbox;

/// The brush's rows: which one, its size, the temperature of new matter, and what the chosen brush declares itself.
class BrushPanel : public ParameterPanel {
  Q_OBJECT
 public:
  /// Address of the row that says how far particles stand apart: what notes of this panel link to.
  static constexpr const char* kSpacing = "solver/particle_spacing";
  explicit BrushPanel(Toolbox& tools, QWidget* parent = nullptr);

 private:
  void rebuild();  ///< other rows
  void refresh();  ///< other values
  void showMaterial();
  void showCoarse();  ///< what particles are too large for
  void showColour();  ///< the swatch, of a brush that has one
  void takeColour(const QColor& colour);
  RowModel shapeRow() const;
  api::ParameterList ownParameters() const;  ///< of the chosen brush; empty when it is not installed
  void onEdited(const QString& key, const Value& value, Edit edit);
  const char* keep(const QString& text) const;

  Toolbox& m_tools;
  ColourRow* m_colour;                    ///< of a brush that declares a colour in parts
  QStringList m_coarse;                   ///< keys of rows that say so
  QString m_shown;                        ///< the brushes to choose from and the chosen one, whose rows stand here
  mutable std::set<std::string> m_texts;  ///< that rows borrow; grows with what is installed only
};

}  // namespace ps
