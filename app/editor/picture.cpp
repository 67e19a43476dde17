// SPDX-License-Identifier: Apache-2.0
#include "app/editor/picture.h"

#include "ui/window/mainwindow.h"
#include "ui/window/screenshot.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QTimer>

#include <cstdio>

namespace ps {

PictureByCommand::PictureByCommand(MainWindow& window, const QString& file, double after)
    : m_window(window), m_file(file) {
  connect(
      &window, &MainWindow::projectShown, this,
      [this, after] { QTimer::singleShot(static_cast<int>(after * 1000), this, &PictureByCommand::capture); },
      Qt::SingleShotConnection);
  connect(&window, &MainWindow::startFailed, this, [](const QString& problem) {
    std::fprintf(stderr, "phasesketch: %s\n", qPrintable(problem));
    QCoreApplication::exit(2);
  });
}

void PictureByCommand::capture() {
  const bool good = windowImage(m_window).save(m_file, "PNG");
  if (!good) std::fprintf(stderr, "phasesketch: %s: cannot be written\n", qPrintable(m_file));
  QCoreApplication::exit(good ? 0 : 1);
}

}  // namespace ps
