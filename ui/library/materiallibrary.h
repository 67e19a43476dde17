// SPDX-License-Identifier: Apache-2.0
// A preset is a project that holds one material and nothing else: what reads, checks and writes projects does so for
// it, and any project's materials can be imported.
#pragma once
#include "core/matter/material.h"
#include "core/scene/project.h"

#include <QtCore/QFileSystemWatcher>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QTimer>
#include <QtGui/QColor>

#include <vector>

namespace ps {

class PluginRegistry;
class Session;

inline constexpr double kRoom = 293.15;  ///< K, at which materials are listed and compared

/// Where matter is solid, liquid or gas under the air's usual pressure; K.
struct PhaseBand {
  double from = 0, to = 0;
  api::Phase phase = api::Phase::Solid;
};

/// A material that can be brought into a scene.
struct LibraryEntry {
  SceneMaterial material;  ///< as it comes
  Material values;         ///< all its properties
  QString label, about;
  QString file;      ///< of a preset; "": installed
  QStringList tags;  ///< words to choose by
  QColor colour;
  std::vector<PhaseBand> bands;  ///< coldest first
};

/// Installed materials, and the presets of the user's folder, which are read again when their files change. UI thread;
/// files are read and written by the session's worker.
class MaterialLibrary : public QObject {
  Q_OBJECT
 public:
  /// `folder`: of presets; "": the user's. It is made when it is missing.
  explicit MaterialLibrary(Session& session, const QString& folder = {}, QObject* parent = nullptr);
  const std::vector<LibraryEntry>& entries() const { return m_entries; }  ///< by label, installed ones first
  const QString& folder() const { return m_folder; }
  QStringList tags() const;
  void read();
  /// A material with the values that it has now, under a name of its own.
  void savePreset(const SceneMaterial& material, const QString& name);
  /// All materials of a project or preset become presets.
  void importFrom(const QString& path);
  void exportTo(const LibraryEntry& entry, const QString& path);
  void removePreset(const LibraryEntry& entry);

 Q_SIGNALS:
  void changed();
  void said(bool failed, const QString& text);  ///< what became of reading or writing

 private:
  struct Found;
  void adopt(std::vector<Found> found);
  QString placeOf(const QString& label, bool replaces, const QStringList& taken) const;
  bool isAlone(const LibraryEntry& entry) const;  ///< in its file
  void keep(SceneMaterial material, const QString& label, const QString& path);
  void write(const SceneMaterial& material, const QString& path, const QString& done);
  Session& m_session;
  QString m_folder;
  QFileSystemWatcher m_watcher;
  QTimer m_rest;  ///< a file that is being written changes several times
  std::vector<LibraryEntry> m_entries;
};

}  // namespace ps
