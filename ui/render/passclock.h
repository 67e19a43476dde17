// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <epoxy/gl.h>

#include "ui/render/renderer.h"

#include <utility>
#include <vector>

namespace ps::render {

/// Asks the graphics card when it has done the passes of a picture; does nothing without somewhere to put that.
class PassClock {
 public:
  explicit PassClock(std::vector<PassTime>* into);
  ~PassClock();  ///< waits for the card, and adds up
  PassClock(const PassClock&) = delete;
  PassClock& operator=(const PassClock&) = delete;
  /// What was asked of the card since the mark before, or since the beginning, is `pass`: a text that stays.
  void mark(const char* pass);

 private:
  std::vector<PassTime>* m_into;
  std::vector<std::pair<const char*, GLuint>> m_marks;  // with their queries
};

}  // namespace ps::render
