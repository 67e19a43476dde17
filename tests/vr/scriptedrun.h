// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QByteArray>
#include <QImage>
#include <QTemporaryDir>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace ps {

/// What the scripted runtime finds in its environment for as long as this lives, and what it leaves: its log, and its
/// pictures. One at a time. In tests with windows core_validation lies over it where that is installed, and a test
/// fails in which it has said something. Debian 12's takes no binding of EGL, which is what there is without windows.
class ScriptedRun {
 public:
  explicit ScriptedRun(const std::string& script = "{}");  ///< JSON
  ~ScriptedRun();
  ScriptedRun(const ScriptedRun&) = delete;
  ScriptedRun& operator=(const ScriptedRun&) = delete;

  /// What head and hands do from now on, from this script's own frame 0.
  void goOn(const std::string& script);
  /// The lines of the log that have this key, "" for all; what core_validation has said is a "violation" too.
  std::vector<nlohmann::json> lines(const std::string& key) const;
  /// What is under the key in each of them, in words: {"IDLE", "READY", ...} for "state".
  std::vector<std::string> texts(const std::string& key) const;
  QImage picture(int frame, size_t eye) const;
  QString file(const QString& name) const { return m_folder.filePath(name); }
  QByteArray said() const;  ///< by core_validation, since the run began or this was forgiven
  void forgive();           ///< it was meant

 private:
  QTemporaryDir m_folder;
  qint64 m_forgiven = 0;  ///< bytes of what it says
};

}  // namespace ps
