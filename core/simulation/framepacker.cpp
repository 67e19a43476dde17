// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/packedframe.h"
#include "core/simulation/particlefield.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace ps {
namespace {

// The finest steps that are kept.
constexpr float kPlace = 0.01F;        // of the spacing
constexpr float kRadius = 1.0F / 256;  // of the largest
constexpr float kTemperature = 0.05F;  // K
constexpr float kField = 1.0F / 4096;  // of its range
constexpr size_t kPlaces = 3, kRadii = 3, kTemperatures = 4, kFirstRoot = 5, kFirstField = 8;

/// Each array of numbers of a snapshot, in the order of FrameKey::ranges: its row, and a function of the particle.
template <class Visit>
void eachNumbers(const Snapshot& s, const Visit& visit) {
  size_t row = 0;
  visit(row++, [&](size_t i) { return s.position[i].x; });
  visit(row++, [&](size_t i) { return s.position[i].y; });
  visit(row++, [&](size_t i) { return s.position[i].z; });
  visit(row++, [&](size_t i) { return s.position[i].w; });
  for (const auto* values : {&s.temperature, &s.speed, &s.densityError, &s.gasFraction})
    visit(row++, [values](size_t i) { return (*values)[i]; });
  for (const FieldValues& shown : s.fields) {
    if (!shown.field->classes) visit(row++, [&](size_t i) { return shown.values[i]; });
  }
}

struct Ends {
  float low = 0, high = 0;
};
template <class Value>
Ends endsOf(size_t count, const Value& value) {
  Ends ends;
  bool any = false;
  for (size_t i = 0; i < count; ++i) {
    const float v = value(i);
    if (!std::isfinite(v)) continue;
    ends = any ? Ends{std::min(ends.low, v), std::max(ends.high, v)} : Ends{v, v};
    any = true;
  }
  return ends;
}

/// With room for what comes: an eighth at either end, of roots to the next power of two.
Steps stepsOf(size_t row, const Ends& ends, double spacing) {
  if (row >= kFirstRoot && row < kFirstField) {
    const float most = std::max(std::abs(ends.low), std::abs(ends.high));
    return Steps::rootsOf(most > 0 ? std::exp2(std::ceil(std::log2(most) + 0.25F)) : 0);
  }
  // What is the same everywhere may change a little.
  const float range = std::max(ends.high - ends.low, 0.01F * std::max(std::abs(ends.low), std::abs(ends.high)));
  const auto place = static_cast<float>(spacing);
  const float least = row < kPlaces ? place : row == kRadii ? 0.01F * ends.high : row == kTemperatures ? 1 : 0;
  const float step = row < kPlaces          ? kPlace * place
                     : row == kRadii        ? kRadius * ends.high
                     : row == kTemperatures ? kTemperature
                                            : kField * range;
  // What steps are left over is room too.
  const float margin = std::max({range / 8, least, (step * Steps::kMost - range) / 2});
  return Steps::between(ends.low - margin, ends.high + margin, step);
}

/// A power of two: levels of a span are a few dozen bytes a particle and frame.
uint64_t spanOf(size_t particles) {
  constexpr size_t kMostHeld = 2'000'000;
  uint64_t span = FramePacker::kSpan;
  while (span > 2 && span * particles > kMostHeld) span /= 2;
  return span;
}

/// Ascending, without 0. They are few, and neighbours have the same.
std::vector<uint32_t> coloursOf(const Snapshot& s) {
  std::vector<uint32_t> colours;
  uint32_t last = 0;
  for (const uint32_t colour : s.colour) {
    if (colour == last || colour == 0) continue;
    last = colour;
    const auto at = std::lower_bound(colours.begin(), colours.end(), colour);
    if (at == colours.end() || *at != colour) colours.insert(at, colour);
  }
  return colours;
}

bool sameLook(const Snapshot& s, const FrameKey& key) {
  const Snapshot& a = key.look;
  return a.revision == s.revision && a.spacing == s.spacing && a.period == s.period && a.bodyIds == s.bodyIds &&
         a.heldBodies == s.heldBodies && a.materialIds == s.materialIds && a.materialLook == s.materialLook &&
         key.colours == coloursOf(s) &&
         std::equal(s.fields.begin(), s.fields.end(), key.fields.begin(), key.fields.end(),
                    [](const FieldValues& shown, const FieldPtr& field) { return shown.field == field; });
}

/// Without frame and particles.
Snapshot lookOf(const Snapshot& s) {
  Snapshot look;
  look.revision = s.revision;
  look.spacing = s.spacing;
  look.period = s.period;
  look.bodyIds = s.bodyIds;
  look.heldBodies = s.heldBodies;
  look.materialIds = s.materialIds;
  look.materialLook = s.materialLook;
  return look;
}

}  // namespace

void FramePacker::sort(const Snapshot& snapshot) {
  if (m_sorted && snapshot.id == m_ids) return;
  m_ids = snapshot.id;
  m_order.resize(m_ids.size());
  std::iota(m_order.begin(), m_order.end(), 0U);
  std::sort(m_order.begin(), m_order.end(), [&](uint32_t a, uint32_t b) { return m_ids[a] < m_ids[b]; });
  std::vector<uint32_t> sorted(m_ids.size());
  for (size_t k = 0; k < m_order.size(); ++k) sorted[k] = m_ids[m_order[k]];
  if (!m_sorted || *m_sorted != sorted) m_sorted = std::make_shared<const std::vector<uint32_t>>(std::move(sorted));
}

bool FramePacker::fitsKey(const Snapshot& snapshot) const {
  if (!m_key || snapshot.stats.frame >= m_key->number + kKeyInterval ||
      snapshot.stats.frame <= m_open.back().frame.stats.frame)
    return false;
  if (m_keyLevels.id != m_sorted || !sameLook(snapshot, *m_key)) return false;
  bool holds = true;
  eachNumbers(snapshot, [&](size_t row, const auto& value) {
    const Ends ends = endsOf(m_ids.size(), value);
    holds = holds && (m_ids.empty() || (m_key->ranges[row].holds(ends.low) && m_key->ranges[row].holds(ends.high)));
  });
  return holds;
}

FrameLevels FramePacker::levelsOf(const Snapshot& s) const {
  const size_t n = m_order.size();
  FrameLevels levels;
  levels.id = m_sorted;
  levels.numbers.resize(m_key->ranges.size());
  eachNumbers(s, [&](size_t row, const auto& value) {
    levels.numbers[row].resize(n);
    for (size_t k = 0; k < n; ++k) levels.numbers[row][k] = m_key->ranges[row].of(value(m_order[k]));
  });
  levels.phase.resize(n);
  levels.motion.resize(n);
  levels.body.resize(n);
  levels.material.resize(n);
  for (size_t k = 0; k < n; ++k) {
    const size_t i = m_order[k];
    levels.phase[k] = static_cast<uint8_t>(s.phase[i]);
    levels.motion[k] = static_cast<uint8_t>(s.motion[i]);
    levels.body[k] = s.body[i];
    levels.material[k] = s.colour.empty() ? s.material[i] : colourLevel(*m_key, s.material[i], s.colour[i]);
  }
  for (const FieldValues& shown : s.fields) {
    if (!shown.field->classes) continue;
    std::vector<uint32_t>& bits = levels.names.emplace_back(n);
    for (size_t k = 0; k < n; ++k) bits[k] = std::bit_cast<uint32_t>(shown.values[m_order[k]]);
  }
  return levels;
}

void FramePacker::makeKey(const Snapshot& snapshot) {
  auto key = std::make_shared<FrameKey>();
  key->look = lookOf(snapshot);
  key->colours = coloursOf(snapshot);
  key->number = snapshot.stats.frame;
  for (const FieldValues& shown : snapshot.fields) key->fields.push_back(shown.field);
  eachNumbers(snapshot, [&](size_t row, const auto& value) {
    key->ranges.push_back(stepsOf(row, endsOf(m_ids.size(), value), snapshot.spacing));
  });
  m_key = key;
  m_keyLevels = levelsOf(snapshot);
  BytePacker packer;
  packAll(packer, m_keyLevels);
  key->data = std::make_shared<const PackedBytes>(packer.bytes(), m_count);
}

std::shared_ptr<const FramePart> FramePacker::part(const FrameLevels& levels, const Open* left,
                                                   const Open* right) const {
  auto part = std::make_shared<FramePart>();
  part->key = m_key;
  if (left) part->left = left->frame.part;
  if (right) part->right = right->frame.part;
  for (const auto& below : {part->left, part->right}) {
    if (below) part->depth = std::max(part->depth, below->depth + 1);
  }
  BytePacker packer;
  if (left && right)
    packChanges(packer, between(left->levels, right->levels), levels);
  else
    packChanges(packer, left ? left->levels : m_keyLevels, levels);
  part->data = std::make_shared<const PackedBytes>(packer.bytes(), m_count);
  return part;
}

/// The one in the middle first, then those at its sides: the multiples of higher powers of two, so that every second
/// frame, and then every fourth one, may go without another leaning on it.
void FramePacker::packBetween(size_t left, size_t right, std::vector<PackedFrame>& anew) {
  if (right - left < 2) return;
  size_t middle = left + 1;
  for (size_t k = middle; k < right; ++k) {
    const auto powerOf = [&](size_t at) { return std::countr_zero(m_open[at].frame.stats.frame); };
    if (powerOf(k) > powerOf(middle)) middle = k;
  }
  Open& open = m_open[middle];
  open.frame.part = part(open.levels, &m_open[left], &m_open[right]);
  anew.push_back(open.frame);
  packBetween(left, middle, anew);
  packBetween(middle, right, anew);
}

/// All but the last one, which nothing changes any more.
void FramePacker::close(std::vector<PackedFrame>& anew) {
  if (m_open.size() < 2) return;
  packBetween(0, m_open.size() - 1, anew);
  m_open.erase(m_open.begin(), std::prev(m_open.end()));
}

FramePacker::Packed FramePacker::pack(const Snapshot& snapshot) {
  sort(snapshot);
  if (m_open.size() > 1 && m_open.back().frame.stats.frame == snapshot.stats.frame) m_open.pop_back();
  Packed packed;
  const bool fits = fitsKey(snapshot);
  if (!fits) {
    close(packed.anew);
    m_open.clear();
    makeKey(snapshot);
  }
  Open now{{snapshot.stats, snapshot.flags, snapshot.limits, nullptr}, fits ? levelsOf(snapshot) : m_keyLevels};
  now.frame.part = part(now.levels, nullptr, nullptr);
  packed.frame = now.frame;
  m_open.push_back(std::move(now));
  const uint64_t span = spanOf(m_ids.size());
  if (snapshot.stats.frame % span == 0 || m_open.size() > span) close(packed.anew);
  return packed;
}

}  // namespace ps
