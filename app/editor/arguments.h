// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QSize>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <optional>

namespace ps {

/// What the editor was asked for on the command line.
struct EditorArguments {
  QString project;
  QString screenshot;  ///< file to write; "" for none
  double after = 3;    ///< s of wall time once the project is shown
  QSize size;          ///< of the window, logical pixels; invalid: the default
  std::optional<bool> dark;
  bool listPlugins = false, version = false, help = false;
  QString problem;  ///< "" or what is wrong, one line
};

EditorArguments parseArguments(const QStringList& arguments);  ///< without the program's name
extern const char* const kEditorUsage;

}  // namespace ps
