// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/packedframe.h"

#include "core/base/bytepacker.h"
#include "core/simulation/particlefield.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ps {
namespace {

constexpr float kMost = 65535;
constexpr size_t kRanges = 5;
const std::string kWhere = "recorded run: ";

Steps stepsOf(float low, float high) { return {low, (high - low) / kMost}; }

float numberOf(const Snapshot& s, size_t range, size_t i) {
  const api::Float4& p = s.position[i];
  const float numbers[] = {p.x, p.y, p.z, p.w, s.temperature[i]};
  return numbers[range];
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

/// Differences of 16 bits, small ones of both signs as small numbers.
std::vector<uint16_t> changesOf(const std::vector<uint16_t>& now, const std::vector<uint16_t>& key) {
  std::vector<uint16_t> changes(now.size());
  for (size_t i = 0; i < now.size(); ++i) {
    const auto d = static_cast<int16_t>(static_cast<uint16_t>(now[i] - key[i]));
    changes[i] = static_cast<uint16_t>(static_cast<uint16_t>(d) << 1U) ^ static_cast<uint16_t>(d < 0 ? 0xFFFFU : 0U);
  }
  return changes;
}
void addChanges(std::vector<uint16_t>& key, const std::vector<uint16_t>& changes) {
  for (size_t i = 0; i < key.size(); ++i) {
    const uint16_t c = changes[i];
    const auto d = static_cast<uint16_t>((c >> 1U) ^ ((c & 1U) ? 0xFFFFU : 0U));
    key[i] = static_cast<uint16_t>(key[i] + d);
  }
}

/// Nothing where nothing has changed.
template <class T>
void packWhereOther(BytePacker& packer, const std::vector<T>& now, const std::vector<T>& key) {
  const bool other = now != key;
  packer.value(static_cast<uint8_t>(other));
  if (!other) return;
  std::vector<T> changes(now.size());
  for (size_t i = 0; i < now.size(); ++i) changes[i] = static_cast<T>(now[i] ^ key[i]);
  packer.array(changes, changes.size());
}
template <class T>
void unpackWhereOther(ByteUnpacker& unpacker, std::vector<T>& key) {
  if (!unpacker.value<uint8_t>()) return;
  std::vector<T> changes;
  unpacker.array(changes, key.size());
  for (size_t i = 0; i < key.size(); ++i) key[i] = static_cast<T>(key[i] ^ changes[i]);
}

void packLevels(BytePacker& packer, const FrameLevels& levels) {
  const size_t n = levels.id.size();
  packer.value(uint64_t{n});
  std::vector<uint32_t> gaps(n);
  std::adjacent_difference(levels.id.begin(), levels.id.end(), gaps.begin());
  packer.array(gaps, n);
  for (const auto& level : levels.level) packer.array(level, n);
  packer.array(levels.phase, n);
  packer.array(levels.motion, n);
  packer.array(levels.body, n);
  packer.array(levels.material, n);
}

FrameLevels unpackLevels(const std::string& bytes) {
  ByteUnpacker unpacker(bytes, kWhere);
  const auto n = static_cast<size_t>(unpacker.value<uint64_t>());
  FrameLevels levels;
  unpacker.array(levels.id, n);
  std::partial_sum(levels.id.begin(), levels.id.end(), levels.id.begin());
  for (auto& level : levels.level) unpacker.array(level, n);
  unpacker.array(levels.phase, n);
  unpacker.array(levels.motion, n);
  unpacker.array(levels.body, n);
  unpacker.array(levels.material, n);
  unpacker.finish();
  return levels;
}

/// In steps between its own ends.
void packNumbers(BytePacker& packer, const std::vector<float>& values, const std::vector<uint32_t>& order) {
  const Ends ends = endsOf(values.size(), [&](size_t i) { return values[i]; });
  const Steps steps = stepsOf(ends.low, ends.high);
  packer.value(steps);
  std::vector<uint16_t> levels(values.size());
  for (size_t k = 0; k < order.size(); ++k) levels[k] = steps.of(values[order[k]]);
  packer.array(levels, order.size());
}
void unpackNumbers(ByteUnpacker& unpacker, std::vector<float>& values, size_t n) {
  const auto steps = unpacker.value<Steps>();
  std::vector<uint16_t> levels;
  unpacker.array(levels, n);
  values.resize(n);
  for (size_t k = 0; k < n; ++k) values[k] = steps.value(levels[k]);
}

/// Numbers of classes are names: they are kept as they are.
void packField(BytePacker& packer, const FieldValues& shown, const std::vector<uint32_t>& order) {
  if (!shown.field->classes) return packNumbers(packer, shown.values, order);
  std::vector<float> values(order.size());
  for (size_t k = 0; k < order.size(); ++k) values[k] = shown.values[order[k]];
  packer.array(values, values.size());
}

bool sameLook(const Snapshot& a, const Snapshot& b) {
  return a.revision == b.revision && a.spacing == b.spacing && a.period == b.period && a.bodyIds == b.bodyIds &&
         a.materialIds == b.materialIds && a.materialLook == b.materialLook;
}

/// What everybody may rely on who gets a snapshot, whatever file it comes from.
bool isSound(const Snapshot& s) {
  // As far (m) and as large (m) as single precision can square: no scene comes near, and pictures are made of them.
  constexpr float kFarthest = 1e15F, kLargest = 1e12F;
  const size_t bodies = s.bodyIds ? s.bodyIds->size() : 0;
  for (size_t k = 0; k < s.id.size(); ++k) {
    const api::Float4& p = s.position[k];
    const bool here = std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
    if (!here || !(p.w >= 0 && p.w <= kLargest)) return false;
    if (s.phase[k] > api::Phase::Gas || s.motion[k] > api::Motion::Static) return false;
    if (s.body[k] >= bodies || s.material[k] >= s.materialLook.size()) return false;
    if (k > 0 && s.id[k] <= s.id[k - 1]) return false;
  }
  return true;
}

/// Without frame and particles.
Snapshot lookOf(const Snapshot& s) {
  Snapshot look;
  look.revision = s.revision;
  look.spacing = s.spacing;
  look.period = s.period;
  look.bodyIds = s.bodyIds;
  look.materialIds = s.materialIds;
  look.materialLook = s.materialLook;
  return look;
}

}  // namespace

uint16_t Steps::of(float value) const {
  if (step <= 0 || !(value > low)) return 0;  // not a number, too
  return static_cast<uint16_t>(std::lround(std::min((value - low) / step, kMost)));
}

size_t PackedFrame::bytes() const {
  return sizeof *this + stats.probes.capacity() * sizeof(double) + limits.capacity() * sizeof(Limit);
}

SnapshotPtr PackedFrame::snapshot(uint64_t revision) const {
  FrameLevels levels = unpackLevels(key->data->unpacked());
  const size_t n = levels.id.size();
  const std::string bytes = data->unpacked();
  ByteUnpacker unpacker(bytes, kWhere);
  auto s = std::make_shared<Snapshot>(key->look);
  s->stats = stats;
  s->revision = revision;
  s->flags = flags;
  s->limits = limits;
  for (auto& level : levels.level) {
    std::vector<uint16_t> changes;
    unpacker.array(changes, n);
    addChanges(level, changes);
  }
  unpackWhereOther(unpacker, levels.phase);
  unpackWhereOther(unpacker, levels.motion);
  unpackWhereOther(unpacker, levels.body);
  unpackWhereOther(unpacker, levels.material);
  for (std::vector<float>* numbers : {&s->speed, &s->densityError, &s->gasFraction})
    unpackNumbers(unpacker, *numbers, n);
  for (const FieldPtr& field : fields) {
    FieldValues shown{field, {}};
    if (field->classes)
      unpacker.array(shown.values, n);
    else
      unpackNumbers(unpacker, shown.values, n);
    s->fields.push_back(std::move(shown));
  }
  unpacker.finish();
  const auto& [x, y, z, w, warmth] = key->ranges;
  s->position.resize(n);
  s->temperature.resize(n);
  s->phase.resize(n);
  s->motion.resize(n);
  for (size_t k = 0; k < n; ++k) {
    const auto& level = levels.level;
    s->position[k] = {x.value(level[0][k]), y.value(level[1][k]), z.value(level[2][k]), w.value(level[3][k])};
    s->temperature[k] = warmth.value(level[4][k]);
    s->phase[k] = static_cast<api::Phase>(levels.phase[k]);
    s->motion[k] = static_cast<api::Motion>(levels.motion[k]);
  }
  s->id = std::move(levels.id);
  s->body = std::move(levels.body);
  s->material = std::move(levels.material);
  if (!isSound(*s)) unpacker.fail();
  return s;
}

void FramePacker::sort(const Snapshot& snapshot) {
  if (snapshot.id == m_ids) return;
  m_ids = snapshot.id;
  m_order.resize(m_ids.size());
  std::iota(m_order.begin(), m_order.end(), 0U);
  std::sort(m_order.begin(), m_order.end(), [&](uint32_t a, uint32_t b) { return m_ids[a] < m_ids[b]; });
  m_now.id.resize(m_ids.size());
  for (size_t k = 0; k < m_order.size(); ++k) m_now.id[k] = m_ids[m_order[k]];
}

bool FramePacker::fitsKey(const Snapshot& snapshot) const {
  if (!m_key || snapshot.stats.frame >= m_key->number + kKeyInterval || snapshot.stats.frame < m_key->number)
    return false;
  if (m_keyLevels.id != m_now.id || !sameLook(snapshot, m_key->look)) return false;
  for (size_t range = 0; range < kRanges; ++range) {
    const Ends ends = endsOf(m_ids.size(), [&](size_t i) { return numberOf(snapshot, range, i); });
    if (!m_ids.empty() && !(m_key->ranges[range].holds(ends.low) && m_key->ranges[range].holds(ends.high)))
      return false;
  }
  return true;
}

void FramePacker::takeLevels(const Snapshot& s, const std::array<Steps, 5>& ranges) {
  const size_t n = m_order.size();
  for (auto& level : m_now.level) level.resize(n);
  for (std::vector<uint8_t>* bytes : {&m_now.phase, &m_now.motion}) bytes->resize(n);
  for (std::vector<uint32_t>* words : {&m_now.body, &m_now.material}) words->resize(n);
  for (size_t k = 0; k < n; ++k) {
    const size_t i = m_order[k];
    for (size_t range = 0; range < kRanges; ++range) m_now.level[range][k] = ranges[range].of(numberOf(s, range, i));
    m_now.phase[k] = static_cast<uint8_t>(s.phase[i]);
    m_now.motion[k] = static_cast<uint8_t>(s.motion[i]);
    m_now.body[k] = s.body[i];
    m_now.material[k] = s.material[i];
  }
}

void FramePacker::makeKey(const Snapshot& snapshot) {
  auto key = std::make_shared<FrameKey>();
  key->look = lookOf(snapshot);
  key->number = snapshot.stats.frame;
  for (size_t range = 0; range < kRanges; ++range) {
    const Ends ends = endsOf(m_ids.size(), [&](size_t i) { return numberOf(snapshot, range, i); });
    const float least = range == 3 ? 0.01F * ends.high : range == 4 ? 1.0F : static_cast<float>(snapshot.spacing);
    const float margin = std::max((ends.high - ends.low) / 8, least);
    key->ranges[range] = stepsOf(ends.low - margin, ends.high + margin);
  }
  takeLevels(snapshot, key->ranges);
  BytePacker packer;
  packLevels(packer, m_now);
  key->data = std::make_shared<const PackedBytes>(packer.bytes(), m_count);
  m_keyLevels = m_now;
  m_key = std::move(key);
}

PackedFrame FramePacker::pack(const Snapshot& snapshot) {
  sort(snapshot);
  if (fitsKey(snapshot))
    takeLevels(snapshot, m_key->ranges);
  else
    makeKey(snapshot);
  const size_t n = m_order.size();
  BytePacker packer;
  for (size_t range = 0; range < kRanges; ++range)
    packer.array(changesOf(m_now.level[range], m_keyLevels.level[range]), n);
  packWhereOther(packer, m_now.phase, m_keyLevels.phase);
  packWhereOther(packer, m_now.motion, m_keyLevels.motion);
  packWhereOther(packer, m_now.body, m_keyLevels.body);
  packWhereOther(packer, m_now.material, m_keyLevels.material);
  for (const std::vector<float>* numbers : {&snapshot.speed, &snapshot.densityError, &snapshot.gasFraction})
    packNumbers(packer, *numbers, m_order);
  PackedFrame frame;
  for (const FieldValues& shown : snapshot.fields) {
    packField(packer, shown, m_order);
    frame.fields.push_back(shown.field);
  }
  frame.stats = snapshot.stats;
  frame.flags = snapshot.flags;
  frame.limits = snapshot.limits;
  frame.key = m_key;
  frame.data = std::make_shared<const PackedBytes>(packer.bytes(), m_count);
  return frame;
}

}  // namespace ps
