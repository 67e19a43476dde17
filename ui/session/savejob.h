// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/filelock.h"
#include "core/scene/project.h"
#include "ui/session/autosave.h"

#include <QtCore/QString>

#include <memory>
#include <optional>

namespace ps {

class PluginRegistry;

/// ".NAME.phasesketch-lock" beside a project: locked by the window that has it open.
QString lockPath(const QString& project);

/// What this window did to files, as its worker knows it: what it reports may not have been heard yet when the next job
/// is asked for. Used by jobs of one worker only.
struct OwnFiles {
  QString path;  ///< written last
  FileStamp file;
  std::weak_ptr<FileLock> lock;  ///< made last

  /// Locks lockPath(); `mine`: a lock that may be the one.
  std::shared_ptr<FileLock> lockOf(const QString& project, const std::shared_ptr<FileLock>& mine);
};
/// "Ada on lab-3", "" when it is the same user here: of whoever holds a lock.
QString holderText(const FileLock& lock);

/// Why a file was not replaced, though it could have been.
enum class SaveRefusal {
  None,
  Elsewhere,  ///< another window has it open
  Changed,    ///< another program has written it since it was opened or saved here
};

/// All that it takes to save a project, for the worker: whether the file may be replaced, what it held kept as a
/// version, copies that are older marked as such, the bytes, and the copies gone.
struct SaveJob {
  QString path;
  Project project;
  const PluginRegistry* plugins = nullptr;  ///< for the project's state; none: it is not looked at
  std::optional<FileStamp> known;  ///< what the file must still be; nothing: whatever stands there was given up
  bool locks = true;               ///< needs the file's lock where there can be one
  std::shared_ptr<FileLock> lock;  ///< the one that is held, perhaps of another file
  std::shared_ptr<OwnFiles> own;
  Autosave::AroundSave around;         ///< empty: nothing is kept, nor what stands there
  std::optional<FileStamp> givenUp{};  ///< what the file may be as well: somebody has seen it and does not want it

  struct Result {
    SaveRefusal refusal = SaveRefusal::None;
    QString problem;       ///< "" when it was saved, or why not
    QString stateLeftOut;  ///< why the project's state was, or ""
    QString noVersion;     ///< why what stood there was not kept, or ""
    FileStamp file;        ///< as it was written, or what stands there where that was Changed
    std::shared_ptr<FileLock> lock;
  };
  Result operator()() const;
};

}  // namespace ps
