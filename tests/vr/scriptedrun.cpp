// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/scriptedrun.h"

#include <QFile>
#include <QSaveFile>

namespace ps {

ScriptedRun::ScriptedRun(const std::string& script) {
  QFile file(this->file("script.json"));
  if (!file.open(QFile::WriteOnly)) qFatal("the script cannot be written");
  file.write(QByteArray::fromStdString(script));
  qputenv("XR_RUNTIME_JSON", PS_BINARY_DIR "/tests/vr/runtime/runtime.json");
  qputenv("PS_XR_SCRIPT", file.fileName().toUtf8());
  qputenv("PS_XR_LOG", this->file("log.jsonl").toUtf8());
  qputenv("PS_XR_PICTURES", m_folder.path().toUtf8());
}

ScriptedRun::~ScriptedRun() {
  for (const char* name : {"XR_RUNTIME_JSON", "PS_XR_SCRIPT", "PS_XR_LOG", "PS_XR_PICTURES"}) qunsetenv(name);
}

void ScriptedRun::goOn(const std::string& script) {
  QSaveFile file(this->file("script.json.later"));  // whole, or not there
  if (!file.open(QFile::WriteOnly)) qFatal("the script cannot be written");
  file.write(QByteArray::fromStdString(script));
  if (!file.commit()) qFatal("the script cannot be written");
}

std::vector<nlohmann::json> ScriptedRun::lines(const std::string& key) const {
  std::vector<nlohmann::json> found;
  QFile log(file("log.jsonl"));
  if (!log.open(QFile::ReadOnly)) return found;
  while (!log.atEnd()) {
    nlohmann::json line = nlohmann::json::parse(log.readLine().toStdString());
    if (key.empty() || line.contains(key)) found.push_back(std::move(line));
  }
  return found;
}

std::vector<std::string> ScriptedRun::texts(const std::string& key) const {
  std::vector<std::string> found;
  for (const nlohmann::json& line : lines(key))
    found.push_back(line[key].is_string() ? line[key].get<std::string>() : line[key].dump());
  return found;
}

QImage ScriptedRun::picture(int frame, size_t eye) const {
  return QImage(file(QStringLiteral("frame%1-%2.png").arg(frame).arg(eye == 0 ? "left" : "right")));
}

}  // namespace ps
