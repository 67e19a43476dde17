// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>

namespace ps {

class MainWindow;

/// Writes a picture of the window once its project has been running for a while, then quits: exit code 0, 1 when the
/// file cannot be written, 2 when the project cannot be opened or built.
class PictureByCommand : public QObject {
  Q_OBJECT
 public:
  PictureByCommand(MainWindow& window, const QString& file, double after);

 private:
  void capture();
  MainWindow& m_window;
  QString m_file;
};

}  // namespace ps
