// SPDX-License-Identifier: Apache-2.0
#include "ui/session/filewatch.h"

#include "ui/document/document.h"
#include "ui/session/documentfiles.h"

#include <QtCore/QFileInfo>
#include <QtGui/QGuiApplication>

#include <utility>
#include <variant>

namespace ps {
namespace {

// ms from a sign to the look, as a file is written in many pieces, and at most from the first one of its own.
constexpr int kRest = 500, kLongest = 3000;

}  // namespace

FileWatch::FileWatch(const Document& document, DocumentFiles& files, QObject* parent)
    : QObject(parent), m_document(document), m_files(files) {
  m_rest.setSingleShot(true);
  m_rest.setInterval(kRest);
  // Of the folder not from the last sign: one that something is always written to would never be looked at.
  const auto sign = [this] {
    if (m_rest.isActive()) return;
    m_rest.start();
    m_first.start();
  };
  connect(&m_watcher, &QFileSystemWatcher::directoryChanged, this, sign);
  connect(&m_watcher, &QFileSystemWatcher::fileChanged, this, [this, sign] {
    sign();
    if (m_first.elapsed() < kLongest) m_rest.start();
  });
  connect(&m_rest, &QTimer::timeout, this, [this] {
    watch();
    if (!m_path.isEmpty()) m_files.look();
  });
  connect(&document, &Document::changed, this, [this, sign](const ChangeEvent& event) {
    if (!std::holds_alternative<FileChanged>(event)) return;
    follow();
    if (!m_path.isEmpty()) sign();  // work that is restored may be of a file that was changed meanwhile
  });
  if (const auto* application = qobject_cast<QGuiApplication*>(QCoreApplication::instance())) {
    connect(application, &QGuiApplication::applicationStateChanged, this, [this, sign](Qt::ApplicationState state) {
      if (state == Qt::ApplicationActive && !m_path.isEmpty()) sign();
    });
  }
  follow();
}

void FileWatch::follow() {
  const QString path = m_document.path();
  const QString now = m_files.isSample(path) ? QString() : path;
  if (std::exchange(m_path, now) == now) return;
  const QStringList watched = m_watcher.files() + m_watcher.directories();
  if (!watched.isEmpty()) m_watcher.removePaths(watched);
  watch();
}

/// The folder as well, since most programs put another file in its place: the one that was watched is gone then.
void FileWatch::watch() {
  if (m_path.isEmpty()) return;
  const QString folder = QFileInfo(m_path).absolutePath();
  if (m_watcher.directories().isEmpty() && QFileInfo::exists(folder)) m_watcher.addPath(folder);
  // Anew even where its name is known: it may be another file's by now.
  if (!m_watcher.files().isEmpty()) m_watcher.removePaths(m_watcher.files());
  if (QFileInfo::exists(m_path)) m_watcher.addPath(m_path);
}

}  // namespace ps
