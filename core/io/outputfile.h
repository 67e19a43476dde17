// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/filestamp.h"

#include <string>
#include <string_view>

namespace ps {

/// A file that is written bit by bit and takes its name when it is whole: the bytes go to a new file "path.part-..."
/// beside it, are flushed to the disk, and replace what stood there. The old file stays until then, and its permissions
/// are kept; through a symbolic link the file behind it is replaced. Into a pipe or a character device (/dev/stdout)
/// the bytes go as they come. Every function throws Error "path: what happened; what to do" (full disk, read-only,
/// missing folder).
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();  ///< what is not finished goes, and the old file stands
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);  ///< buffered: a full disk may be noticed later, in flush() at the latest
  void flush();
  FileStamp finish();  ///< of the file that has its name now, without its hash; not known for a pipe
  /// Leaves what was written under a name of its own, and says which; "" for a pipe. Nothing may be written any more.
  std::string keepPart();

 private:
  std::string m_path, m_target, m_part, m_buffer;
  int m_fd = -1;
};

/// An OutputFile of these bytes. Returns what stampOf() and hashOf() say of it; not known for a pipe.
FileStamp writeFileAtomically(const std::string& path, std::string_view bytes);

/// Throws what an OutputFile would throw for this path as things stand; leaves no trace. For results that come after
/// long work.
void requireWritable(const std::string& path);

/// Makes a folder for results where there is none. Throws Error where there can be none.
void makeFolder(const std::string& path);

/// Removes the new files "path.part-..." of programs that were ended before these had taken their name, and leaves
/// those that are being written. Not for a path where keepPart() has left what somebody may want.
void removeLeftParts(const std::string& path);
/// The same for all files of a folder; `name`: only for the one of that name.
void removeLeftParts(const std::string& folder, std::string_view name);

/// The same for two paths that lead to one file, were it one that is yet to be made; "" for a pipe or a device, into
/// which several may write.
std::string fileIdentity(const std::string& path);

}  // namespace ps
