// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "ui/document/document.h"
#include "ui/session/autosave.h"
#include "ui/session/documentfiles.h"
#include "ui/session/worker.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>
#include <QtTest/QTest>

#include <string>

namespace ps {

inline const Address kFloor{Owner::Wall, "floor", "temperature"};

/// A document with its files and its autosave, as a session has them.
struct Desk {
  Desk(PluginRegistry& plugins, const QString& directory)
      : files(document, worker), autosave(document, worker, directory) {
    document.setPlugins(&plugins);
    files.keepWith(autosave);
    QObject::connect(&files, &DocumentFiles::reopened, &autosave, &Autosave::takeOver);
  }
  ~Desk() { worker.wait(); }
  void edit(double kelvin) { QCOMPARE(document.setParameter(kFloor, kelvin), QString()); }
  std::string text() const { return writeProject(document.project()); }

  Document document;
  Worker worker;
  DocumentFiles files;
  Autosave autosave;
};

/// The autosave folder as a crash at this moment leaves it: a copy of it whose locks nobody holds.
class Crashed {
 public:
  explicit Crashed(const QString& directory) {
    const QDir dir(directory);
    for (const QString& name : dir.entryList(QDir::Files)) QFile::copy(dir.filePath(name), m_copies.filePath(name));
  }
  QString copies() const { return m_copies.path(); }
  /// Of the only session there.
  static QString stemIn(const QString& directory) {
    const QDir dir(directory);
    return dir.filePath(dir.entryList({QStringLiteral("*.lock")}).value(0).chopped(5));
  }

 private:
  QTemporaryDir m_copies;
};

}  // namespace ps
