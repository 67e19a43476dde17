// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace ps {

/// Samples over ascending time, kept for hours of running. Why two levels: a long run has more samples than a screen
/// has columns, and a repaint must not walk through all of them. Samples lie in blocks of 64 with each block's lowest
/// and highest value beside it; a column reads whole blocks and at most two partial ones. Past kCapacity samples,
/// neighbours are joined in pairs (their lowest and highest stay), so that memory stays bounded and no spike is lost.
class SampleSeries {
 public:
  struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    bool empty() const { return !(low <= high); }
    void add(double value) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    void add(const Extent& other) {
      if (other.low < low) low = other.low;
      if (other.high > high) high = other.high;
    }
  };
  struct Sample {
    double time;       ///< s, of the first sample that this one stands for
    double low, high;  ///< equal unless samples were joined; NaN: a gap
  };
  static constexpr size_t kCapacity = 1u << 18, kBlock = 64;

  /// The time of the last sample again replaces its value; an earlier time is ignored.
  void append(double time, double value);
  void clear();
  size_t size() const { return m_samples.size(); }
  bool empty() const { return m_samples.empty(); }
  const Sample& operator[](size_t index) const { return m_samples[index]; }
  double firstTime() const { return m_samples.front().time; }
  double lastTime() const { return m_samples.back().time; }
  double lastValue() const { return m_last; }  ///< NaN when the last was a gap
  /// Index of the first sample at or after a time; size() when there is none.
  size_t indexAt(double time) const;
  /// Lowest and highest of the samples [first, last).
  Extent extent(size_t first, size_t last) const;
  /// Value at a time by the sample before it; NaN outside.
  double valueAt(double time) const;

 private:
  void join();
  void replaceLast(double stored);
  void addToBlock(size_t index);
  std::vector<Sample> m_samples;
  std::vector<Extent> m_blocks;
  size_t m_stride = 1, m_pending = 0;  ///< samples that one stands for, and how many of the last are in
  double m_last = std::numeric_limits<double>::quiet_NaN(), m_lastTime = 0;
  Sample m_before{};  ///< the last one as it was without the last value
};

}  // namespace ps
