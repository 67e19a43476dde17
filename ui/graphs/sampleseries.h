// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace ps {

/// Samples over ascending time, kept for hours of running. Why a pyramid: a long run has more samples than a screen
/// has columns, and a repaint must not walk through all of them. Eight samples make a block with its lowest and highest
/// value, eight blocks one of the level above, and so on; a column reads at most fourteen of each level. Past kCapacity
/// samples,
/// neighbours are joined in pairs (their lowest and highest stay), so that memory stays bounded and no spike is lost.
class SampleSeries {
 public:
  struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    double positive = std::numeric_limits<double>::infinity();  ///< the lowest above 0
    bool empty() const { return !(low <= high); }
    void add(double value) {
      if (value < low) low = value;
      if (value > high) high = value;
      if (value > 0 && value < positive) positive = value;
    }
    void add(const Extent& other) {
      if (other.low < low) low = other.low;
      if (other.high > high) high = other.high;
      if (other.positive < positive) positive = other.positive;
    }
  };
  struct Sample {
    double time;       ///< s, of the first sample that this one stands for
    double low, high;  ///< equal unless samples were joined; NaN: a gap
  };
  static constexpr size_t kCapacity = 1u << 18, kBlock = 8, kLevels = 5;

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
  /// The same, of a time that lies behind sample `from`, likely by `width` samples; in whole blocks where these are
  /// fine enough for a column that begins there.
  size_t columnEnd(double time, size_t from, size_t width) const;
  /// Lowest and highest of the samples [first, last).
  Extent extent(size_t first, size_t last) const;
  /// Value at a time by the sample before it; NaN outside.
  double valueAt(double time) const;
  /// On the line through the samples at a time; NaN outside and beside a gap.
  double lineAt(double time) const;
  /// Area below the line between two times, in units of the value times s; gaps count for nothing.
  double integral(double from, double to) const;

 private:
  void join();
  void replaceLast(double stored);
  Extent ofSample(size_t index) const;
  void addToBlocks(size_t index);
  void remakeBlocks(size_t index);
  std::vector<Sample> m_samples;
  std::array<std::vector<Extent>, kLevels> m_levels;
  size_t m_stride = 1, m_pending = 0;  ///< samples that one stands for, and how many of the last are in
  double m_last = std::numeric_limits<double>::quiet_NaN(), m_lastTime = 0;
  Sample m_before{};  ///< the last one as it was without the last value
};

}  // namespace ps
