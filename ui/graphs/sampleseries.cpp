// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/sampleseries.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What stands for the samples of `before` and one more value; of a gap and a value the later one holds.
SampleSeries::Sample with(SampleSeries::Sample before, double value) {
  if (!(before.low <= value)) before.low = value;
  if (!(before.high >= value)) before.high = value;
  if (std::isnan(value)) before.low = before.high = value;
  return before;
}

}  // namespace

void SampleSeries::append(double time, double value) {
  const double stored = std::isfinite(value) ? value : kNaN;
  if (!m_samples.empty() && !(time > m_lastTime)) {
    if (time == m_lastTime) replaceLast(stored);
    return;
  }
  m_lastTime = time;
  m_last = stored;
  if (m_pending > 0 && m_pending < m_stride) {
    m_before = m_samples.back();
    m_samples.back() = with(m_before, stored);
    ++m_pending;
  } else {
    if (m_samples.size() >= kCapacity) join();
    m_before = {time, kNaN, kNaN};
    m_samples.push_back(with(m_before, stored));
    m_pending = 1;
  }
  const size_t block = (m_samples.size() - 1) / kBlock;
  if (block == m_blocks.size()) m_blocks.emplace_back();
  if (!std::isnan(stored)) m_blocks[block].add(stored);
}

void SampleSeries::replaceLast(double stored) {
  if (stored == m_last || (std::isnan(stored) && std::isnan(m_last))) return;
  m_last = stored;
  m_samples.back() = with(m_before, stored);
  m_blocks.back() = {};
  for (size_t i = (m_blocks.size() - 1) * kBlock; i < m_samples.size(); ++i) addToBlock(i);
}

void SampleSeries::addToBlock(size_t index) {
  if (std::isnan(m_samples[index].low)) return;
  m_blocks[index / kBlock].add(m_samples[index].low);
  m_blocks[index / kBlock].add(m_samples[index].high);
}

void SampleSeries::join() {
  const size_t half = m_samples.size() / 2;
  for (size_t i = 0; i < half; ++i) {
    const Sample a = m_samples[2 * i], b = m_samples[2 * i + 1];
    // fmin and fmax pass a number by a gap: a spike beside one stays.
    m_samples[i] = {a.time, std::fmin(a.low, b.low), std::fmax(a.high, b.high)};
  }
  m_samples.resize(half);
  m_stride *= 2;
  m_blocks.assign((half + kBlock - 1) / kBlock, {});
  for (size_t i = 0; i < half; ++i) addToBlock(i);
}

void SampleSeries::clear() { *this = SampleSeries(); }

size_t SampleSeries::indexAt(double time) const {
  const auto found = std::lower_bound(m_samples.begin(), m_samples.end(), time,
                                      [](const Sample& sample, double t) { return sample.time < t; });
  return static_cast<size_t>(found - m_samples.begin());
}

SampleSeries::Extent SampleSeries::extent(size_t first, size_t last) const {
  Extent extent;
  last = std::min(last, m_samples.size());
  while (first < last) {
    if (first % kBlock == 0 && first + kBlock <= last) {
      extent.add(m_blocks[first / kBlock]);
      first += kBlock;
    } else {
      if (!std::isnan(m_samples[first].low)) {
        extent.add(m_samples[first].low);
        extent.add(m_samples[first].high);
      }
      ++first;
    }
  }
  return extent;
}

double SampleSeries::valueAt(double time) const {
  if (m_samples.empty() || time < m_samples.front().time || time > m_samples.back().time) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  size_t index = indexAt(time);
  if (index == m_samples.size() || m_samples[index].time > time) --index;
  return index + 1 == m_samples.size() ? m_last : m_samples[index].high;
}

}  // namespace ps
