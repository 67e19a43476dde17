// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ps {

/// Where pictures go: a folder of PNG files, one file for the last of them, or a film. What is not finished leaves no
/// film; pictures stay.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// RGBA8 rows from the top; `frame` numbers the simulation's frames. Throws Error when it cannot be written.
  virtual void add(const std::vector<uint8_t>& pixels, long frame) = 0;
  /// Throws Error when the result is not whole.
  virtual void finish() = 0;
};

/// `out` ending in .mp4: a film of `framesPerSecond` through the program ffmpeg, which must be installed; in .png or
/// .jpg: one picture, the last; else a folder, made when it does not exist. Throws InputError for a size that a film
/// cannot have, Error when it cannot be made.
std::unique_ptr<FrameSink> makeFrameSink(const std::string& out, int width, int height, double framesPerSecond);
bool isFilm(const std::string& out);
bool isPicture(const std::string& out);

}  // namespace ps
