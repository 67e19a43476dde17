// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QFile>
#include <QProcess>
#include <QString>
#include <QStringList>
#include <QTemporaryDir>

// Drives the built program, as a shell would.
struct Ran {
  int code = -1;
  QByteArray out, err;
};

inline const QString kSample = PS_SOURCE_DIR "/projects/ice-on-hot-plate.json";

inline const QString kProgram = PS_BINARY_DIR "/bin/phasesketch-cli";

/// Waits for it; code -1 where it crashed or did not end.
inline Ran ended(QProcess& process) {
  if (!process.waitForFinished(100000) || process.exitStatus() != QProcess::NormalExit) return {};
  return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
}

inline Ran cli(const QStringList& arguments, const QString& pluginPath = {}) {
  QProcess process;
  if (!pluginPath.isEmpty()) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("PHASESKETCH_PLUGIN_PATH", pluginPath);
    process.setProcessEnvironment(environment);
  }
  process.start(kProgram, arguments);
  return ended(process);
}

/// A block of 5 x 5 x 5: enough to run every stage, small enough to be quick.
inline QStringList smallScene(const QStringList& more, const QString& project = kSample) {
  return QStringList{"simulate", project, "--set", "bodies/ice/shape/box/size=[0.1, 0.1, 0.1]", "--threads", "1"} +
         more;
}

/// A folder with one fixture, which behaves as it is called.
inline bool place(const QTemporaryDir& folder, const QString& fixture, const QString& name) {
  return QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/fixture_" + fixture + ".so",
                     folder.filePath(name + ".so"));
}
