// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

// Three kinds of records, each a small file about one build of one plugin: it is known to be sound; the program ended
// once while it was loaded, which a kill does as well as a crash; it is in quarantine.
//
// Why a file lock and not a process number: a plugin that aborts takes its process along without any code of ours
// running, so what it was doing must lie in a file beforehand. That file must count only when its writer is gone, while
// other programs are starting at the same moment. The writer holds a flock() on it; the system drops the lock when the
// process ends, however it ends, and it cannot be mistaken for a process that got the same number later or that lives
// in another container on the same home directory.
namespace ps {

/// Plugins that took the program down, or did not come back, while they were loaded or ran. All state lies in files
/// under one directory; a directory that cannot be written only means that nothing is remembered.
class Quarantine {
 public:
  /// Looks for the locks of dead processes: the plugins that they name are no longer known to be sound, and are in
  /// quarantine when that happened twice in a row.
  explicit Quarantine(const std::string& directory);

  struct Entry {
    std::string id, path;
    long long size = 0, modified = 0;  ///< bytes; ms since the epoch: another build of the file gets another try
    std::string why{};                 ///< of what is in quarantine: "it crashed ..."
  };
  /// Why this very file is in quarantine, or "". A record about an older build of the file is dropped.
  std::string why(const std::string& id, const std::string& path);
  /// Whether this very file was loaded before and came back.
  bool knows(const std::string& id, const std::string& path) const;
  /// It was loaded, and came back.
  void cameBack(const std::string& id, const std::string& path);
  /// Into quarantine.
  void accuse(const std::string& id, const std::string& path, const std::string& why);
  /// The file that puts this plugin into quarantine at the next start, and what it has to hold: for what must write it
  /// when the program is dying.
  std::pair<std::string, std::string> recordFor(const std::string& id, const std::string& path) const;
  const std::string& directory() const { return m_directory; }
  /// Forgets all records of an id; true when there was one.
  bool allow(const std::string& id);
  /// The same of one file alone.
  bool allow(const std::string& id, const std::string& path);

 private:
  void collectStaleLocks();
  void suspect(const Entry& entry);
  void readRecords();

  std::string m_directory;
  std::vector<Entry> m_entries;
};

/// Says "this process is loading this plugin" for as long as it lives. Destroyed normally, it leaves nothing behind.
class LoadingLock {
 public:
  LoadingLock(const std::string& directory, const std::string& id, const std::string& path);
  ~LoadingLock();
  LoadingLock(const LoadingLock&) = delete;
  LoadingLock& operator=(const LoadingLock&) = delete;

 private:
  std::string m_path;
  int m_file = -1;
};

}  // namespace ps
