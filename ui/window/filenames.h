// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

class QWidget;

namespace ps {

class Session;

/// What people call a file: "ice.json"; "New scene" for "".
QString nameOf(const QString& path);
/// A title as a file's name: without what some file system refuses.
QString fileNameFor(QString title);
/// Asks for a file to write; "" when given up. The ending of `suggestion` completes a name without one before the
/// question whether an existing file may be replaced, so that it is about the right file.
QString fileToWrite(QWidget* parent, const QString& title, const QString& suggestion, const QString& filter);

/// Asks for a file to read; "" when given up.
QString fileToRead(QWidget* parent, const QString& title, const QString& folder, const QString& filter);
/// Asks for a folder; "" when given up.
QString folderToUse(QWidget* parent, const QString& title, const QString& folder);
/// Where the files of the open project lie, or else, also where it is a sample, the user's documents.
QString folderBeside(Session& session);

}  // namespace ps
