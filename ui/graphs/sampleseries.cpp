// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/sampleseries.h"

#include <algorithm>
#include <cmath>

namespace ps {

void SampleSeries::append(double time, double value) {
  if (!m_samples.empty() && !(time > m_samples.back().time)) return;
  m_last = std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
  const double stored = m_last;
  if (m_pending > 0 && m_pending < m_stride) {
    Sample& into = m_samples.back();
    if (!(into.low <= stored)) into.low = stored;  // a gap takes the value
    if (!(into.high >= stored)) into.high = stored;
    if (std::isnan(stored)) into.low = into.high = stored;
    ++m_pending;
  } else {
    if (m_samples.size() >= kCapacity) join();
    m_samples.push_back({time, stored, stored});
    m_pending = 1;
  }
  const size_t block = (m_samples.size() - 1) / kBlock;
  if (block == m_blocks.size()) m_blocks.emplace_back();
  if (!std::isnan(stored)) m_blocks[block].add(stored);
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
  for (size_t i = 0; i < half; ++i) {
    if (std::isnan(m_samples[i].low)) continue;
    m_blocks[i / kBlock].add(m_samples[i].low);
    m_blocks[i / kBlock].add(m_samples[i].high);
  }
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
