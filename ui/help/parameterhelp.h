// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/help/helppages.h"

#include <QtCore/QStringList>

#include <string>
#include <vector>

namespace ps {

class Document;
struct RowModel;

/// An installed material's figure for a property.
struct KnownFigure {
  std::string material;  ///< its id
  QString label;
  double value = 0;  ///< SI
};
/// Figures of all installed materials that state this property and have it at this temperature (K), least first.
std::vector<KnownFigure> knownFigures(const Document& document, const std::string& property, double temperature);

/// What a row's present value means, one sentence each: in other units, against its default, on its slider, among known
/// materials, and why it does nothing where that is so.
QStringList explainedValue(const RowModel& row, const Document& document);

/// All that is declared of a parameter, and what its present value means.
HelpPage parameterHelp(const RowModel& row, const Document& document);

}  // namespace ps
