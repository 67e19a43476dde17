// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

#include <functional>

class QDialog;
class QGridLayout;
class QWidget;

namespace ps {

/// A field with its label before it, below what a dialog's two columns hold already.
void addDialogRow(QGridLayout& grid, const QString& label, QWidget* field, const QString& tip);

/// A row of a dialog, as Ctrl+K finds it.
struct DialogRow {
  QString label;
  QString words;  ///< further ones to find it by
};
/// Gives the field of that name the focus, or the first of its parts that takes it; "": nothing happens.
void focusDialogRow(const QWidget& dialog, const QString& label);
/// In front, beside the window, which stays in use: no dialog of ours holds it.
void bringUp(QDialog& dialog);
/// One of each name: what is open already, as it was left, or what `make` makes, and nullptr where that makes none.
QDialog* bringUp(QWidget& window, const QString& name, const std::function<QDialog*()>& make);

}  // namespace ps
