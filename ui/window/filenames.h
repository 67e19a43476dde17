// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

class QWidget;

namespace ps {

/// What people call a file: "ice.json"; "New scene" for "".
QString nameOf(const QString& path);
/// A title as a file's name: without what some file system refuses.
QString fileNameFor(QString title);
/// Asks for a file to write; "" when given up. The ending of `suggestion` completes a name without one before the
/// question whether an existing file may be replaced, so that it is about the right file.
QString fileToWrite(QWidget* parent, const QString& title, const QString& suggestion, const QString& filter);

}  // namespace ps
