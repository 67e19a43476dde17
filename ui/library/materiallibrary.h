// SPDX-License-Identifier: Apache-2.0
// A preset is a project that holds one material and nothing else: what reads, checks and writes projects does so for
// it, and any project's materials can be imported.
#pragma once
#include "core/matter/material.h"
#include "core/matter/phasebands.h"
#include "core/plugin_host/registry.h"
#include "core/scene/project.h"

#include <QtCore/QDateTime>
#include <QtCore/QFileSystemWatcher>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QTimer>
#include <QtGui/QColor>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ps {

class Session;

/// A material that can be brought into a scene.
struct LibraryEntry {
  SceneMaterial material;  ///< as it comes
  Material values;         ///< all its properties
  QString label, about;
  QString file;      ///< of a preset; "": installed
  QStringList tags;  ///< words to choose by: what it is by its values, and those of its file
  QColor colour;
  std::vector<PhaseBand> bands;  ///< coldest first
  /// Which one it is: several may have one label.
  QString key() const { return file + QLatin1Char('/') + QString::fromStdString(material.id); }
};

/// Installed materials, and the presets of the user's folder. Files of both are read again when they change; of one
/// that is broken by then, what was read before stays. The present scene's matter does not change with a file: values
/// that a scene has of its own never do, and an installed material that its run is made of stays as it is until
/// somebody takes the new values, with which the run begins anew. UI thread; files are read and written by the
/// session's worker.
class MaterialLibrary : public QObject {
  Q_OBJECT
 public:
  /// `folder`: of presets; "": the user's, by preference or else usualFolder(). It is made when it is missing.
  explicit MaterialLibrary(Session& session, const QString& folder = {}, QObject* parent = nullptr);
  const std::vector<LibraryEntry>& entries() const { return m_entries; }  ///< by label, installed ones first
  const QString& folder() const { return m_folder; }
  void setFolder(const QString& folder);  ///< likewise
  static QString usualFolder();
  QStringList tags() const;
  void read();
  /// A material with the values that it has now, under a name of its own.
  void savePreset(const SceneMaterial& material, const QString& name);
  /// All materials of a project or preset become presets.
  void importFrom(const QString& path);
  void exportTo(const LibraryEntry& entry, const QString& path);
  void removePreset(const LibraryEntry& entry);
  /// `words`: with commas between them. Nothing else of the preset's file changes.
  void setTags(const LibraryEntry& preset, const QString& words);
  /// Labels of installed materials whose files have other values by now than the scene's run is made of.
  QStringList waiting() const;
  /// Those come to act: the scene goes back to its start.
  void takeWaiting();

 Q_SIGNALS:
  void changed();
  void said(bool failed, const QString& text);  ///< what became of reading or writing
  void waitingChanged();

 private:
  struct Preset;
  using Readings = std::vector<PluginRegistry::MaterialReading>;
  using Problems = std::map<QString, QString>;  ///< by the file's path
  using Stamps = std::map<QString, QDateTime>;  ///< when a file was written last, by its path
  void adopt(const std::vector<Preset>& presets, const Readings& readings, const Stamps& stamps);
  void adoptInstalled(const Readings& readings, Problems& problems);
  void adoptPresets(const std::vector<Preset>& presets, const std::vector<LibraryEntry>& before, Problems& problems);
  LibraryEntry entryOf(const SceneMaterial& material, const QString& file) const;
  LibraryEntry entryOf(const PluginRegistry::MaterialReading& waiting) const;
  void tell(Problems problems);
  void watch(const Stamps& read);
  QString placeOf(const QString& label, bool replaces, const QStringList& taken) const;
  bool isAlone(const LibraryEntry& entry) const;  ///< in its file
  void keep(SceneMaterial material, const QString& label, const QString& path);
  /// `text` is made by the worker; what it throws is said.
  void write(const QString& path, const QString& done, std::function<std::string()> text);
  std::vector<std::string> tagsOfKept(const QString& label, const SceneMaterial& material) const;
  Session& m_session;
  QString m_folder;
  QFileSystemWatcher m_watcher;
  QTimer m_rest;  ///< a file that is being written changes several times
  std::vector<LibraryEntry> m_entries;
  std::map<std::string, PluginRegistry::MaterialReading> m_waiting;  ///< by id
  Problems m_problems;                                               ///< as they were told
  std::map<QString, std::string> m_texts;                            ///< of presets, as they were read last, by path
  std::set<QString> m_written;                                       ///< by the library, which has told of it
};

}  // namespace ps
