// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace ps::vr {

/// How long the graphics card works on a frame. It is asked some frames later, so that nobody waits for it; made and
/// used with one OpenGL context current.
class CardClock {
 public:
  CardClock();
  ~CardClock();
  CardClock(const CardClock&) = delete;
  CardClock& operator=(const CardClock&) = delete;

  void begin();
  void end();
  double took() const { return m_took; }  ///< s, of the newest frame that it has told of; 0 before

 private:
  std::array<uint32_t, 4> m_queries{};
  size_t m_begun = 0, m_read = 0;  ///< frames
  double m_took = 0;
};

}  // namespace ps::vr
