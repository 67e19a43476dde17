// SPDX-License-Identifier: Apache-2.0
#include "ui/window/openingnote.h"

#include "ui/session/documentfiles.h"
#include "ui/window/statusline.h"

#include <QtCore/QFileInfo>
#include <QtGui/QCursor>
#include <QtGui/QGuiApplication>

#include <utility>

namespace ps {

OpeningNote::OpeningNote(DocumentFiles& files, StatusLine& status, QObject* parent)
    : QObject(parent), m_files(files), m_status(status) {
  m_wait.setSingleShot(true);
  m_wait.setInterval(kWait);
  connect(&m_wait, &QTimer::timeout, this, &OpeningNote::tell);
  connect(&files, &DocumentFiles::opening, this, [this](const QString& path) {
    end();
    m_name = QFileInfo(path).fileName();
    m_wait.start();
  });
  connect(&files, &DocumentFiles::opened, this, &OpeningNote::end);
  connect(&files, &DocumentFiles::openFailed, this, &OpeningNote::end);
}

OpeningNote::~OpeningNote() {
  if (!m_told.isEmpty()) QGuiApplication::restoreOverrideCursor();
}

bool OpeningNote::cancel() { return !m_told.isEmpty() && m_files.giveUpOpening(); }

void OpeningNote::tell() {
  m_told = QStringLiteral("Opening “%1”. Esc gives it up.").arg(m_name);
  m_status.say(m_told);
  QGuiApplication::setOverrideCursor(Qt::BusyCursor);
}

void OpeningNote::end() {
  m_wait.stop();
  if (m_told.isEmpty()) return;
  QGuiApplication::restoreOverrideCursor();
  if (m_status.state().note == std::exchange(m_told, QString())) m_status.say({});
}

}  // namespace ps
