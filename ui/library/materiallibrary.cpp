// SPDX-License-Identifier: Apache-2.0
#include "ui/library/materiallibrary.h"

#include "core/base/error.h"
#include "core/io/mixing.h"
#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/matter/tags.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/library/runmaterials.h"
#include "ui/session/preferences.h"
#include "ui/session/session.h"
#include "ui/session/worker.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QStandardPaths>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace ps {
namespace {

constexpr double kMetalConducts = 15, kMetalWeighs = 2000;  // W/(m·K), kg/m³: more than stone, less than steel
constexpr const char* kStays = "; what was read before stays";
constexpr int kRest = 200;  // ms

Project holding(const SceneMaterial& material) {
  Project project;
  project.title = material.label;
  project.materials.push_back(material);
  return project;
}

/// As tags show: "Food" of "food".
QString shownTag(const std::string& tag) {
  const QString text = QString::fromStdString(tag);
  return text.left(1).toUpper() + text.mid(1);
}

/// `own`: those of its file.
QStringList tagsOf(const LibraryEntry& entry, const std::vector<std::string>& own) {
  QStringList tags;
  for (const PhaseBand& band : entry.bands) {
    if (kRoom < band.from || kRoom >= band.to) continue;
    tags << (band.phase == api::Phase::Solid    ? QStringLiteral("Solids")
             : band.phase == api::Phase::Liquid ? QStringLiteral("Liquids")
                                                : QStringLiteral("Gases"));
  }
  if (valueOf(entry.values, "conductivity_solid", kRoom) > kMetalConducts &&
      valueOf(entry.values, "density_solid", kRoom) > kMetalWeighs)
    tags << QStringLiteral("Metals");
  if (!entry.file.isEmpty()) tags << QStringLiteral("Presets");
  for (const std::string& tag : own) tags << shownTag(tag);
  tags.removeDuplicates();
  return tags;
}

QString readAgain(const QString& label, const QString& path) {
  return QStringLiteral("“%1” was read again from %2.").arg(label, path);
}

std::map<QString, QDateTime> installedFiles(const PluginRegistry& plugins) {
  std::map<QString, QDateTime> files;
  for (const PluginInfo& plugin : plugins.plugins()) {
    if (!plugin.json || plugin.state != PluginInfo::State::Loaded) continue;
    const QString path = QString::fromStdString(plugin.path);
    files[path] = QFileInfo(path).lastModified();
  }
  return files;
}

/// What its plugin says of itself; nothing where that is not installed.
PluginInfo infoOf(const PluginRegistry& plugins, const SceneMaterial& material) {
  for (const PluginInfo& plugin : plugins.plugins()) {
    if (plugin.id == material.base) return plugin;
  }
  return {};
}

QString aboutOf(const PluginRegistry& plugins, const SceneMaterial& material) {
  if (material.mixture)
    return QStringLiteral("A mixture of %1.").arg(QString::fromStdString(mixtureText(*material.mixture)));
  return QString::fromStdString(infoOf(plugins, material).help);
}

QString folderMeant(const QString& asked) {
  const QString preferred = preferences::folder(preferences::Folder::Presets);
  return !asked.isEmpty() ? asked : preferred.isEmpty() ? MaterialLibrary::usualFolder() : preferred;
}

}  // namespace

/// A file of presets as it was read, before its materials are looked into.
struct MaterialLibrary::Preset {
  QString path, problem;
  std::vector<SceneMaterial> materials;
};

MaterialLibrary::MaterialLibrary(Session& session, const QString& folder, QObject* parent)
    : QObject(parent), m_session(session), m_folder(folderMeant(folder)) {
  QDir().mkpath(m_folder);
  m_rest.setSingleShot(true);
  m_rest.setInterval(kRest);
  connect(&m_watcher, &QFileSystemWatcher::directoryChanged, &m_rest, qOverload<>(&QTimer::start));
  connect(&m_watcher, &QFileSystemWatcher::fileChanged, &m_rest, qOverload<>(&QTimer::start));
  connect(&m_rest, &QTimer::timeout, this, &MaterialLibrary::read);
  connect(&session, &Session::ready, this, &MaterialLibrary::read);
  // The run of another project may not be made of what waits.
  connect(&session, &Session::projectShown, this, [this] {
    if (m_waiting.empty()) return;
    m_waiting.clear();
    read();
  });
}

QString MaterialLibrary::usualFolder() {
  return QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) + QStringLiteral("/phasesketch/presets");
}

void MaterialLibrary::setFolder(const QString& folder) {
  m_watcher.removePath(m_folder);  // read() watches it again where installed materials are there too
  m_folder = folderMeant(folder);
  QDir().mkpath(m_folder);
  read();
}

void MaterialLibrary::read() {
  if (!m_session.plugins()) return;
  m_session.worker().run([this, plugins = m_session.registry(), folder = m_folder] {
    std::vector<Preset> found;
    Stamps stamps = installedFiles(*plugins);
    for (const QFileInfo& file : QDir(folder).entryInfoList({QStringLiteral("*.json")}, QDir::Files, QDir::Name)) {
      Preset& preset = found.emplace_back();
      preset.path = file.filePath();
      stamps[preset.path] = file.lastModified();
      try {
        preset.materials = loadProject(preset.path.toStdString(), *plugins).project.materials;
      } catch (const std::exception& error) {
        preset.problem = QString::fromUtf8(error.what());
      }
    }
    QMetaObject::invokeMethod(this, [this, found = std::move(found), stamps = std::move(stamps),
                                     readings = plugins->changedMaterials()] { adopt(found, readings, stamps); });
  });
}

void MaterialLibrary::adopt(const std::vector<Preset>& presets, const Readings& readings, const Stamps& stamps) {
  const std::vector<LibraryEntry> before = std::exchange(m_entries, {});
  Problems problems;
  adoptInstalled(readings, problems);
  adoptPresets(presets, before, problems);
  std::stable_sort(m_entries.begin(), m_entries.end(), [](const LibraryEntry& a, const LibraryEntry& b) {
    if (a.file.isEmpty() != b.file.isEmpty()) return a.file.isEmpty();
    return a.label.localeAwareCompare(b.label) < 0;
  });
  watch(stamps);
  tell(std::move(problems));
  Q_EMIT changed();
}

/// What no run is made of acts at once; the rest waits.
void MaterialLibrary::adoptInstalled(const Readings& readings, Problems& problems) {
  PluginRegistry& plugins = *m_session.plugins();
  const auto before = std::exchange(m_waiting, {});
  bool others = false, offered = false;
  for (const PluginRegistry::MaterialReading& reading : readings) {
    const std::string& id = reading.info.id;
    const QString path = QString::fromStdString(reading.info.path);
    if (!reading.info.problem.empty()) {
      problems[path] = QString::fromStdString(reading.info.problem) + QLatin1String(kStays);
    } else if (runIsMadeOf(m_session, id)) {
      const auto known = before.find(id);
      others |= known == before.end() || known->second.material.properties != reading.material.properties;
      m_waiting.emplace(id, reading);
    } else {
      plugins.offer(reading);
      offered = true;
      Q_EMIT said(false, readAgain(QString::fromStdString(reading.info.label), path));
    }
  }
  if (offered) m_session.document().setPlugins(&plugins);
  for (const std::string& id : plugins.ids(PluginKind::Material)) {
    const auto waits = m_waiting.find(id);
    SceneMaterial material;
    material.id = material.base = id;
    material.label = pluginLabel(&plugins, id).toStdString();
    try {
      m_entries.push_back(waits == m_waiting.end() ? entryOf(material, {}) : entryOf(waits->second));
    } catch (const std::exception& error) {
      problems[QString::fromStdString(id)] = QString::fromUtf8(error.what());
    }
  }
  if (others || before.size() != m_waiting.size()) Q_EMIT waitingChanged();
}

/// Of a file that is broken by now, what was read before stays.
void MaterialLibrary::adoptPresets(const std::vector<Preset>& presets, const std::vector<LibraryEntry>& before,
                                   Problems& problems) {
  const auto texts = std::exchange(m_texts, {});
  for (const Preset& preset : presets) {
    const auto known = texts.find(preset.path);
    std::vector<LibraryEntry> entries;
    Project whole;
    try {
      if (!preset.problem.isEmpty()) throw Error(preset.problem.toStdString());
      for (const SceneMaterial& material : preset.materials) entries.push_back(entryOf(material, preset.path));
      whole.materials = preset.materials;
      m_texts[preset.path] = writeProject(whole);
    } catch (const std::exception& error) {
      entries.clear();
      std::copy_if(before.begin(), before.end(), std::back_inserter(entries),
                   [&](const LibraryEntry& entry) { return entry.file == preset.path; });
      if (known != texts.end()) m_texts.insert(*known);
      problems[preset.path] = QString::fromUtf8(error.what()) + QLatin1String(entries.empty() ? "" : kStays);
      m_entries.insert(m_entries.end(), entries.begin(), entries.end());
      continue;
    }
    const bool own = m_written.erase(preset.path) > 0;
    if (!own && known != texts.end() && known->second != m_texts[preset.path] && !entries.empty())
      Q_EMIT said(false, readAgain(entries.front().label, preset.path));
    m_entries.insert(m_entries.end(), entries.begin(), entries.end());
  }
}

LibraryEntry MaterialLibrary::entryOf(const SceneMaterial& material, const QString& file) const {
  const PluginRegistry& plugins = *m_session.plugins();
  const Project project = holding(material);
  EvaluatedMaterials evaluated;
  LibraryEntry entry{material,
                     compileMaterial(project, material, plugins, evaluated),
                     QString::fromStdString(material.label),
                     aboutOf(plugins, material),
                     file,
                     {},
                     colourOf(project, &plugins, material.id),
                     {}};
  entry.bands = bandsOf(entry.values);
  entry.tags = tagsOf(entry, file.isEmpty() ? infoOf(plugins, material).tags : material.tags);
  return entry;
}

/// As its file has it by now.
LibraryEntry MaterialLibrary::entryOf(const PluginRegistry::MaterialReading& waiting) const {
  SceneMaterial material;
  material.id = material.base = waiting.info.id;
  material.label = waiting.info.label;
  SceneMaterial coloured = material;
  for (const auto& [key, value] : waiting.material.properties) coloured.properties.values[key] = value;
  LibraryEntry entry = entryOf(coloured, {});
  entry.material = material;
  entry.values = waiting.material;
  entry.about = QString::fromStdString(waiting.info.help);
  entry.bands = bandsOf(entry.values);
  entry.tags = tagsOf(entry, waiting.info.tags);
  return entry;
}

/// Each problem once, as long as it stays the same.
void MaterialLibrary::tell(Problems problems) {
  for (const auto& [path, problem] : problems) {
    const auto told = m_problems.find(path);
    if (told == m_problems.end() || told->second != problem) Q_EMIT said(true, problem);
  }
  m_problems = std::move(problems);
}

/// A file that is replaced is another one to the watcher, and a folder tells of one that comes. What was written since
/// it was read, nobody may have been told of.
void MaterialLibrary::watch(const Stamps& read) {
  QStringList files, folders{m_folder};
  for (const auto& [path, written] : read) {
    files << path;
    folders << QFileInfo(path).path();
  }
  folders.removeDuplicates();
  if (const QStringList watched = m_watcher.files(); !watched.isEmpty()) m_watcher.removePaths(watched);
  m_watcher.addPaths(files);
  for (const QString& folder : m_watcher.directories()) folders.removeAll(folder);
  if (!folders.isEmpty()) m_watcher.addPaths(folders);
  if (std::any_of(read.begin(), read.end(),
                  [](const auto& file) { return QFileInfo(file.first).lastModified() != file.second; }))
    m_rest.start();
}

QStringList MaterialLibrary::waiting() const {
  QStringList labels;
  for (const auto& [id, reading] : m_waiting) labels << QString::fromStdString(reading.info.label);
  return labels;
}

void MaterialLibrary::takeWaiting() {
  if (m_waiting.empty()) return;
  for (const auto& [id, reading] : std::exchange(m_waiting, {})) {
    m_session.plugins()->offer(reading);
    Q_EMIT said(false,
                readAgain(QString::fromStdString(reading.info.label), QString::fromStdString(reading.info.path)));
  }
  m_session.document().setPlugins(m_session.plugins());
  m_session.reset();
  Q_EMIT waitingChanged();
  read();
}

QStringList MaterialLibrary::tags() const {
  QStringList tags;
  for (const LibraryEntry& entry : m_entries) tags += entry.tags;
  tags.removeDuplicates();
  tags.sort();
  return tags;
}

void MaterialLibrary::write(const QString& path, const QString& done, std::function<std::string()> text) {
  m_session.worker().run([this, text = std::move(text), path, done] {
    QString problem;
    try {
      writeFileAtomically(path.toStdString(), text());
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, path, done, problem] {
      if (problem.isEmpty()) m_written.insert(path);
      Q_EMIT said(!problem.isEmpty(), problem.isEmpty() ? done : problem);
      read();
    });
  });
}

/// Of a preset of that name, which it replaces; a new file where there is none.
QString MaterialLibrary::placeOf(const QString& label, bool replaces, const QStringList& taken) const {
  QString stem = label.toLower();
  for (QChar& letter : stem) {
    if (!letter.isLetterOrNumber() || letter.unicode() > 127) letter = QLatin1Char('-');
  }
  for (const LibraryEntry& entry : m_entries) {
    if (replaces && entry.label == label && entry.file.startsWith(m_folder) && isAlone(entry)) return entry.file;
  }
  for (int number = 1;; ++number) {
    const QString path =
        QStringLiteral("%1/%2%3.json").arg(m_folder, stem, number > 1 ? QStringLiteral("-%1").arg(number) : QString());
    if (!QFile::exists(path) && !taken.contains(path)) return path;
  }
}

bool MaterialLibrary::isAlone(const LibraryEntry& entry) const {
  return std::count_if(m_entries.begin(), m_entries.end(),
                       [&](const LibraryEntry& other) { return other.file == entry.file; }) == 1;
}

void MaterialLibrary::keep(SceneMaterial material, const QString& label, const QString& path) {
  material.label = label.toStdString();
  material.id = material.mixture ? "mixture" : material.base;
  write(path, QStringLiteral("“%1” is kept among your presets.").arg(label),
        [material] { return writeProject(holding(material)); });
}

void MaterialLibrary::savePreset(const SceneMaterial& material, const QString& name) {
  const QString label = name.trimmed();
  if (label.isEmpty()) return Q_EMIT said(true, QStringLiteral("A preset needs a name."));
  SceneMaterial preset = material;
  preset.tags = tagsOfKept(label, material);
  keep(std::move(preset), label, placeOf(label, true, {}));
}

/// Its own, or those of the preset that it replaces, or of the installed one that it is of.
std::vector<std::string> MaterialLibrary::tagsOfKept(const QString& label, const SceneMaterial& material) const {
  if (!material.tags.empty()) return material.tags;
  for (const LibraryEntry& entry : m_entries) {
    if (entry.label == label && entry.file.startsWith(m_folder) && isAlone(entry)) return entry.material.tags;
  }
  return material.mixture ? std::vector<std::string>{} : infoOf(*m_session.plugins(), material).tags;
}

void MaterialLibrary::setTags(const LibraryEntry& preset, const QString& words) {
  std::vector<std::string> tags;
  for (const QString& word : words.split(QLatin1Char(','))) {
    if (const QString tag = word.simplified(); !tag.isEmpty()) tags.push_back(tag.toStdString());
  }
  if (tags == preset.material.tags) return;
  if (const auto wrong = problemOfTags(tags))
    return Q_EMIT said(true, QStringLiteral("The tag “%1” %2.")
                                 .arg(QString::fromStdString(tags[wrong->index]), QString::fromStdString(wrong->what)));
  write(preset.file, QStringLiteral("The tags of “%1” are kept.").arg(preset.label),
        [plugins = m_session.registry(), path = preset.file.toStdString(), id = preset.material.id, tags] {
          Project project = loadProject(path, *plugins).project;
          for (SceneMaterial& material : project.materials) {
            if (material.id == id) material.tags = tags;
          }
          return writeProject(project);
        });
}

void MaterialLibrary::importFrom(const QString& path) {
  m_session.worker().run([this, plugins = m_session.registry(), path] {
    std::vector<SceneMaterial> materials;
    QString problem;
    try {
      materials = loadProject(path.toStdString(), *plugins).project.materials;
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, materials, problem, name = QFileInfo(path).fileName()] {
      if (!problem.isEmpty()) return Q_EMIT said(true, problem);
      QStringList taken;
      for (const SceneMaterial& material : materials) {
        const QString label = QString::fromStdString(material.label.empty() ? material.base : material.label);
        taken << placeOf(label, false, taken);
        keep(material, label, taken.back());
      }
      if (materials.empty()) Q_EMIT said(true, QStringLiteral("“%1” holds no material.").arg(name));
    });
  });
}

void MaterialLibrary::exportTo(const LibraryEntry& entry, const QString& path) {
  write(path, QStringLiteral("“%1” is written to %2.").arg(entry.label, path),
        [material = entry.material] { return writeProject(holding(material)); });
}

void MaterialLibrary::removePreset(const LibraryEntry& entry) {
  if (entry.file.isEmpty()) return;
  if (!isAlone(entry))
    return Q_EMIT said(
        true, QStringLiteral("“%1” shares its file with others, which would go too: %2").arg(entry.label, entry.file));
  const bool gone = QFile::moveToTrash(entry.file) || QFile::remove(entry.file);
  Q_EMIT said(!gone, gone ? QStringLiteral("“%1” is no preset any more.").arg(entry.label)
                          : QStringLiteral("“%1” cannot be removed: its folder is read-only.").arg(entry.label));
  read();
}

}  // namespace ps
