// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps {

/// A lock between programs, on a file of its own, for as long as this object lives. The kernel frees it when its
/// program ends, however it ends, so that a file that was left says nothing, whatever is in it.
class FileLock {
 public:
  /// Tries once. `note`: a line for whoever finds the file locked.
  explicit FileLock(std::string path, const std::string& note = {});
  ~FileLock();  ///< the file goes
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  const std::string& path() const { return m_path; }
  bool held() const;  ///< and nobody has taken it over since
  /// Somebody else had it. Neither held nor busy: no lock can be made here.
  bool busy() const { return m_busy; }
  const std::string& holder() const { return m_holder; }  ///< note of whom it was busy with
  /// Takes it from whoever holds it, who can see that: held() is false there from now on.
  void takeOver();

  /// Whether a program that runs holds it.
  static bool isHeld(const std::string& path);

 private:
  void lock();
  std::string m_path, m_note, m_holder;
  bool m_busy = false;
  int m_fd = -1;
};

}  // namespace ps
