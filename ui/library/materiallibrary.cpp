// SPDX-License-Identifier: Apache-2.0
#include "ui/library/materiallibrary.h"

#include "core/base/error.h"
#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "ui/document/declared.h"
#include "ui/session/session.h"
#include "ui/session/worker.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QStandardPaths>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr double kPressure = 101325;                        // Pa
constexpr double kMetalConducts = 15, kMetalWeighs = 2000;  // W/(m·K), kg/m³: more than stone, less than steel
constexpr int kRest = 200;                                  // ms

Project holding(const SceneMaterial& material) {
  Project project;
  project.title = material.label;
  project.materials.push_back(material);
  return project;
}

std::vector<PhaseBand> bandsOf(const Material& material) {
  const PhaseDiagram diagram = phaseDiagramOf(material);
  const double end = std::numeric_limits<double>::infinity();
  const bool melts = diagram.meltingPoint0 > 0;
  if (diagram.sublimes(kPressure)) {
    const double at = diagram.sublimationPoint(kPressure);
    return {{0, at, api::Phase::Solid}, {at, end, api::Phase::Gas}};
  }
  const double melting = melts ? diagram.meltingPoint(kPressure) : 0, boiling = diagram.boilingPoint(kPressure);
  std::vector<PhaseBand> bands;
  if (melts) bands.push_back({0, melting, api::Phase::Solid});
  // What never melts is what it is made as; who states how thick a liquid it is means one.
  const bool flows = melts || material.properties.contains("viscosity");
  if (!melts && !std::isfinite(boiling)) return {{0, end, flows ? api::Phase::Liquid : api::Phase::Solid}};
  bands.push_back({melting, boiling, api::Phase::Liquid});
  if (std::isfinite(boiling)) bands.push_back({boiling, end, api::Phase::Gas});
  return bands;
}

QStringList tagsOf(const LibraryEntry& entry) {
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
  return tags;
}

QString aboutOf(const PluginRegistry& plugins, const std::string& base) {
  for (const PluginInfo& plugin : plugins.plugins()) {
    if (plugin.id == base) return QString::fromStdString(plugin.help);
  }
  return {};
}

}  // namespace

/// A material as it was read, before it is looked into.
struct MaterialLibrary::Found {
  SceneMaterial material;
  QString file, problem;
};

MaterialLibrary::MaterialLibrary(Session& session, const QString& folder, QObject* parent)
    : QObject(parent),
      m_session(session),
      m_folder(folder.isEmpty() ? QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) +
                                      QStringLiteral("/phasesketch/presets")
                                : folder) {
  QDir().mkpath(m_folder);
  m_watcher.addPath(m_folder);
  m_rest.setSingleShot(true);
  m_rest.setInterval(kRest);
  connect(&m_watcher, &QFileSystemWatcher::directoryChanged, &m_rest, qOverload<>(&QTimer::start));
  connect(&m_watcher, &QFileSystemWatcher::fileChanged, &m_rest, qOverload<>(&QTimer::start));
  connect(&m_rest, &QTimer::timeout, this, &MaterialLibrary::read);
  connect(&session, &Session::ready, this, &MaterialLibrary::read);
}

void MaterialLibrary::read() {
  if (!m_session.plugins()) return;
  m_session.worker().run([this, plugins = m_session.registry(), folder = m_folder] {
    std::vector<Found> found;
    for (const std::string& id : plugins->ids(PluginKind::Material)) {
      SceneMaterial material;
      material.id = material.base = id;
      material.label = pluginLabel(plugins.get(), id).toStdString();
      found.push_back({material, {}, {}});
    }
    const QDir presets(folder);
    for (const QString& name : presets.entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name)) {
      const QString path = presets.filePath(name);
      try {
        for (const SceneMaterial& material : loadProject(path.toStdString(), *plugins).project.materials)
          found.push_back({material, path, {}});
      } catch (const std::exception& error) {
        found.push_back({{}, path, QString::fromUtf8(error.what())});
      }
    }
    QMetaObject::invokeMethod(this, [this, found = std::move(found)]() mutable { adopt(std::move(found)); });
  });
}

void MaterialLibrary::adopt(std::vector<Found> found) {
  m_entries.clear();
  const PluginRegistry& plugins = *m_session.plugins();
  QStringList files;
  for (Found& each : found) {
    if (!each.file.isEmpty()) files << each.file;
    try {
      if (!each.problem.isEmpty()) throw Error(each.problem.toStdString());
      const Project project = holding(each.material);
      EvaluatedMaterials evaluated;
      LibraryEntry entry{each.material,
                         compileMaterial(project, each.material, plugins, evaluated),
                         QString::fromStdString(each.material.label),
                         aboutOf(plugins, each.material.base),
                         each.file,
                         {},
                         colourOf(project, &plugins, each.material.id),
                         {}};
      entry.bands = bandsOf(entry.values);
      entry.tags = tagsOf(entry);
      m_entries.push_back(std::move(entry));
    } catch (const std::exception& error) {
      Q_EMIT said(true, QString::fromUtf8(error.what()));
    }
  }
  std::stable_sort(m_entries.begin(), m_entries.end(), [](const LibraryEntry& a, const LibraryEntry& b) {
    if (a.file.isEmpty() != b.file.isEmpty()) return a.file.isEmpty();
    return a.label.localeAwareCompare(b.label) < 0;
  });
  if (const QStringList watched = m_watcher.files(); !watched.isEmpty()) m_watcher.removePaths(watched);
  if (!files.isEmpty()) m_watcher.addPaths(files);
  Q_EMIT changed();
}

QStringList MaterialLibrary::tags() const {
  QStringList tags;
  for (const LibraryEntry& entry : m_entries) tags += entry.tags;
  tags.removeDuplicates();
  tags.sort();
  return tags;
}

void MaterialLibrary::write(const SceneMaterial& material, const QString& path, const QString& done) {
  m_session.worker().run([this, material, path, done] {
    QString problem;
    try {
      writeFileAtomically(path.toStdString(), writeProject(holding(material)));
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, done, problem] {
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
  material.id = material.base;
  write(material, path, QStringLiteral("“%1” is kept among your presets.").arg(label));
}

void MaterialLibrary::savePreset(const SceneMaterial& material, const QString& name) {
  const QString label = name.trimmed();
  if (label.isEmpty()) return Q_EMIT said(true, QStringLiteral("A preset needs a name."));
  keep(material, label, placeOf(label, true, {}));
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
  write(entry.material, path, QStringLiteral("“%1” is written to %2.").arg(entry.label, path));
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
