// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/scriptedrun.h"

#include "ui/vr/openxr.h"

#include <QFile>
#include <QFileInfo>
#include <QGuiApplication>
#include <QSaveFile>
#include <QTest>

#include <algorithm>

namespace ps {
namespace {

constexpr const char* kLayer = "XR_APILAYER_LUNARG_core_validation";
constexpr const char* kVariables[] = {"XR_RUNTIME_JSON",
                                      "PS_XR_SCRIPT",
                                      "PS_XR_LOG",
                                      "PS_XR_PICTURES",
                                      "PS_XR_WITHOUT",
                                      "XR_ENABLE_API_LAYERS",
                                      "XR_CORE_VALIDATION_EXPORT_TYPE",
                                      "XR_CORE_VALIDATION_FILE_NAME"};

bool isInstalled() {
  uint32_t count = 0;
  if (XR_FAILED(xrEnumerateApiLayerProperties(0, &count, nullptr))) return false;
  XrApiLayerProperties one{};
  one.type = XR_TYPE_API_LAYER_PROPERTIES;
  std::vector<XrApiLayerProperties> layers(count, one);
  if (XR_FAILED(xrEnumerateApiLayerProperties(count, &count, layers.data()))) return false;
  return std::any_of(layers.begin(), layers.end(),
                     [](const auto& layer) { return std::string(layer.layerName) == kLayer; });
}

/// The layer keeps the name of the file that it is told first, and makes it when it has something to say.
QString fileOfLayer() {
  static const QTemporaryDir kFolder;
  return kFolder.filePath(QStringLiteral("validation.txt"));
}

void validate() {
  static const bool kInstalled = isInstalled();
  if (!kInstalled || QGuiApplication::platformName() != QStringLiteral("xcb")) return;
  qputenv("XR_ENABLE_API_LAYERS", kLayer);
  qputenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text");
  qputenv("XR_CORE_VALIDATION_FILE_NAME", fileOfLayer().toUtf8());
  qputenv("PS_XR_WITHOUT", "XR_EXT_local_floor");  // is newer than Debian 12's layer
}

}  // namespace

ScriptedRun::ScriptedRun(const std::string& script) {
  QFile file(this->file("script.json"));
  if (!file.open(QFile::WriteOnly)) qFatal("the script cannot be written");
  file.write(QByteArray::fromStdString(script));
  qputenv("XR_RUNTIME_JSON", PS_BINARY_DIR "/tests/vr/runtime/runtime.json");
  qputenv("PS_XR_SCRIPT", file.fileName().toUtf8());
  qputenv("PS_XR_LOG", this->file("log.jsonl").toUtf8());
  qputenv("PS_XR_PICTURES", m_folder.path().toUtf8());
  validate();
  forgive();  // earlier runs
}

ScriptedRun::~ScriptedRun() {
  for (const char* name : kVariables) qunsetenv(name);
  const QByteArray text = said();
  if (!text.isEmpty() && QTest::currentTestFunction()) QTest::qFail(text.constData(), __FILE__, __LINE__);
}

QByteArray ScriptedRun::said() const {
  QFile file(fileOfLayer());
  if (!file.open(QFile::ReadOnly) || !file.seek(m_forgiven)) return {};
  return file.readAll();
}

void ScriptedRun::forgive() { m_forgiven = QFileInfo(fileOfLayer()).size(); }

void ScriptedRun::goOn(const std::string& script) {
  QSaveFile file(this->file("script.json.later"));  // whole, or not there
  if (!file.open(QFile::WriteOnly)) qFatal("the script cannot be written");
  file.write(QByteArray::fromStdString(script));
  if (!file.commit()) qFatal("the script cannot be written");
}

std::vector<nlohmann::json> ScriptedRun::lines(const std::string& key) const {
  std::vector<nlohmann::json> found;
  if (const QByteArray text = said(); !text.isEmpty() && (key.empty() || key == "violation"))
    found.push_back({{"violation", text.toStdString()}, {"call", kLayer}});
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
