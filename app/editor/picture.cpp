// SPDX-License-Identifier: Apache-2.0
#include "app/editor/picture.h"

#include "core/base/error.h"
#include "core/io/outputfile.h"
#include "ui/window/mainwindow.h"
#include "ui/window/screenshot.h"

#include <QtCore/QBuffer>
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
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  windowImage(m_window).save(&buffer, "PNG");
  try {
    writeFileAtomically(m_file.toStdString(), {bytes.constData(), static_cast<size_t>(bytes.size())});
    QCoreApplication::exit(0);
  } catch (const Error& problem) {
    std::fprintf(stderr, "phasesketch: %s\n", problem.what());
    QCoreApplication::exit(1);
  }
}

}  // namespace ps
