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
  addToBlocks(m_samples.size() - 1);
}

void SampleSeries::replaceLast(double stored) {
  if (stored == m_last || (std::isnan(stored) && std::isnan(m_last))) return;
  m_last = stored;
  m_samples.back() = with(m_before, stored);
  remakeBlocks(m_samples.size() - 1);
}

SampleSeries::Extent SampleSeries::ofSample(size_t index) const {
  Extent extent;
  if (std::isnan(m_samples[index].low)) return extent;
  extent.add(m_samples[index].low);
  extent.add(m_samples[index].high);
  return extent;
}

void SampleSeries::addToBlocks(size_t index) {
  const Extent sample = ofSample(index);
  for (std::vector<Extent>& level : m_levels) {
    index /= kBlock;
    if (index == level.size()) level.emplace_back();
    level[index].add(sample);
  }
}

/// Those that the last sample is in.
void SampleSeries::remakeBlocks(size_t index) {
  for (size_t k = 0; k < kLevels; ++k) {
    const size_t block = index / kBlock, count = k == 0 ? m_samples.size() : m_levels[k - 1].size();
    Extent extent;
    for (size_t i = block * kBlock; i < count; ++i) extent.add(k == 0 ? ofSample(i) : m_levels[k - 1][i]);
    m_levels[k][block] = extent;
    index = block;
  }
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
  for (std::vector<Extent>& level : m_levels) level.clear();
  for (size_t i = 0; i < half; ++i) addToBlocks(i);
}

void SampleSeries::clear() { *this = SampleSeries(); }

size_t SampleSeries::indexAt(double time) const {
  const auto found = std::lower_bound(m_samples.begin(), m_samples.end(), time,
                                      [](const Sample& sample, double t) { return sample.time < t; });
  return static_cast<size_t>(found - m_samples.begin());
}

size_t SampleSeries::columnEnd(double time, size_t from, size_t width) const {
  // Away from the guess in steps that double: what is looked at is little, and lies close together.
  const size_t size = m_samples.size();
  const auto isBefore = [&](size_t index) { return m_samples[index].time < time; };
  size_t low = from, high = std::min(from + width, size - 1);
  if (isBefore(high)) {
    size_t step = 1;
    for (low = high; low + step < size && isBefore(low + step); step *= 2) low += step;
    high = std::min(low + step, size);
  } else {
    size_t step = 1;
    while (high > from + step && !isBefore(high - step)) high -= step, step *= 2;
    low = high > from + step ? high - step : from;
  }
  const auto at = [&](size_t index) { return m_samples.begin() + static_cast<std::ptrdiff_t>(index); };
  const auto found = std::lower_bound(at(low), at(high), time, [](const Sample& s, double t) { return s.time < t; });
  const auto end = static_cast<size_t>(found - m_samples.begin());
  constexpr size_t kFine = 16;  // blocks in a column, at least, for ends between two of them to be seen nowhere
  size_t block = 1;
  while ((end - from) / kFine >= block * kBlock) block *= kBlock;
  return std::min((end + block - 1) / block * block, size);
}

/// Up the levels as far as whole blocks fit, and down again at the end.
SampleSeries::Extent SampleSeries::extent(size_t first, size_t last) const {
  Extent extent;
  last = std::min(last, m_samples.size());
  while (first < last) {
    size_t level = 0, width = 1;  // of what is read: a sample, or a block of the level below
    while (level < kLevels && first % (width * kBlock) == 0 && first + width * kBlock <= last) {
      ++level;
      width *= kBlock;
    }
    extent.add(level == 0 ? ofSample(first) : m_levels[level - 1][first / width]);
    first += width;
  }
  return extent;
}

double SampleSeries::integral(double from, double to) const {
  double area = 0;
  const size_t before = indexAt(from);
  for (size_t i = before > 0 ? before - 1 : 0; i + 1 < m_samples.size() && m_samples[i].time < to; ++i) {
    const Sample &a = m_samples[i], &b = m_samples[i + 1];
    const double left = std::max(a.time, from), right = std::min(b.time, to);
    const double first = (a.low + a.high) / 2, slope = ((b.low + b.high) / 2 - first) / (b.time - a.time);
    if (!(right > left) || !std::isfinite(slope)) continue;
    area += (right - left) * (first + slope * ((left + right) / 2 - a.time));
  }
  return area;
}

double SampleSeries::lineAt(double time) const {
  const size_t next = indexAt(time);
  if (next == m_samples.size()) return kNaN;
  const Sample& b = m_samples[next];
  const double end = (b.low + b.high) / 2;
  if (b.time == time) return end;
  if (next == 0) return kNaN;
  const Sample& a = m_samples[next - 1];
  const double begin = (a.low + a.high) / 2;
  return begin + (end - begin) * (time - a.time) / (b.time - a.time);
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
