// SPDX-License-Identifier: Apache-2.0
#pragma once

class QGridLayout;
class QString;
class QWidget;

namespace ps {

/// A field with its label before it, below what a dialog's two columns hold already.
void addDialogRow(QGridLayout& grid, const QString& label, QWidget* field, const QString& tip);

}  // namespace ps
