// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// While this lives, exit() ends the process at once, with status 1, as a kill would: nothing that other threads work
/// with is taken down below them. What was unsaved is kept for the next start, as after a kill. To be made and
/// destroyed on the main thread, one at a time.
class SuddenEnd {
 public:
  SuddenEnd();
  ~SuddenEnd();
  SuddenEnd(const SuddenEnd&) = delete;
  SuddenEnd& operator=(const SuddenEnd&) = delete;
};

}  // namespace ps
