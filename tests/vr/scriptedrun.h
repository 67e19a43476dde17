// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QImage>
#include <QTemporaryDir>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace ps {

/// What the scripted runtime finds in its environment for as long as this lives, and what it leaves: its log, and its
/// pictures. One at a time.
class ScriptedRun {
 public:
  explicit ScriptedRun(const std::string& script = "{}");  ///< JSON
  ~ScriptedRun();
  ScriptedRun(const ScriptedRun&) = delete;
  ScriptedRun& operator=(const ScriptedRun&) = delete;

  /// What head and hands do from now on, from this script's own frame 0.
  void goOn(const std::string& script);
  /// The lines of the log that have this key, "" for all.
  std::vector<nlohmann::json> lines(const std::string& key) const;
  /// What is under the key in each of them, in words: {"IDLE", "READY", ...} for "state".
  std::vector<std::string> texts(const std::string& key) const;
  QImage picture(int frame, size_t eye) const;
  QString file(const QString& name) const { return m_folder.filePath(name); }

 private:
  QTemporaryDir m_folder;
};

}  // namespace ps
