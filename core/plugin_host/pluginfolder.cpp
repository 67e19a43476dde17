// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/pluginfolder.h"

#include "core/plugin_host/materialjson.h"
#include "core/plugin_host/pluginmetadata.h"
#include "core/plugin_host/pluginpaths.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSaveFile>

namespace ps {
namespace {

void readFrom(const QDir& folder, std::vector<PluginInfo>& list) {
  for (const QString& name : folder.entryList({QStringLiteral("*.so"), QStringLiteral("*.json")}, QDir::Files)) {
    const std::string path = folder.filePath(name).toStdString();
    PluginInfo info;
    if (path.ends_with(".json")) {
      readMaterialFile(path, info);
    } else {
      info = readLibraryMetadata(path);
    }
    if (!info.id.empty()) list.push_back(std::move(info));
  }
}

}  // namespace

std::vector<PluginInfo> pluginsIn(const std::string& folder) {
  std::vector<PluginInfo> list;
  const QDir top(QString::fromStdString(folder));
  readFrom(top, list);
  for (const QString& name : top.entryList(QDir::Dirs | QDir::NoDotAndDotDot)) readFrom(QDir(top.filePath(name)), list);
  return list;
}

std::string installPlugin(const PluginInfo& info) {
  const QString folder = QString::fromStdString(userPluginDirectory()), from = QString::fromStdString(info.path);
  const QString to = folder + QLatin1Char('/') + QFileInfo(from).fileName();
  if (QFileInfo(from).canonicalFilePath() == QFileInfo(to).canonicalFilePath()) return to.toStdString();
  QFile source(from);
  QSaveFile copy(to);  // a program that runs may have the old one loaded: it keeps its file
  const auto refuse = [&](const QString& file, const QString& why) {
    throw Error("The plugin '" + info.id + "' was not installed: " + file.toStdString() + ": " + why.toStdString() +
                "; see that it can be read and that there is room, then try again");
  };
  if (!source.open(QIODevice::ReadOnly)) refuse(from, source.errorString());
  if (!QDir().mkpath(folder)) refuse(folder, QStringLiteral("the folder cannot be made"));
  if (!copy.open(QIODevice::WriteOnly) || copy.write(source.readAll()) != source.size() || !copy.commit())
    refuse(to, copy.errorString());
  return to.toStdString();
}

}  // namespace ps
