// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/packedframe.h"

#include "core/base/bytepacker.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/sceneneed.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr size_t kMostKnown = size_t{64} << 20;  // bytes of levels, or as many frames as one leans on at once:
constexpr size_t kLeast = 6, kMostFrames = 64;
const std::string kWhere = "recorded run: ";

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

/// The inverse of colourLevel().
void setMaterials(Snapshot& s, const FrameKey& key, const std::vector<uint32_t>& levels) {
  s.material = levels;
  const auto materials = static_cast<uint32_t>(key.look.materialLook.size());
  if (key.colours.empty() || materials == 0) return;
  s.colour.resize(levels.size());
  for (size_t k = 0; k < levels.size(); ++k) {
    const uint32_t colour = levels[k] / materials;
    if (colour > key.colours.size()) return;  // of no material either
    s.material[k] = levels[k] % materials;
    if (colour > 0) s.colour[k] = key.colours[colour - 1];
  }
}

size_t namedFields(const FrameKey& key) {
  return static_cast<size_t>(
      std::count_if(key.fields.begin(), key.fields.end(), [](const FieldPtr& field) { return field->classes; }));
}

void setNumbers(Snapshot& s, const FrameLevels& levels, const std::vector<Steps>& ranges) {
  const size_t n = levels.id->size();
  s.position.resize(n);
  for (size_t k = 0; k < n; ++k) {
    const auto value = [&](size_t row) { return ranges[row].value(levels.numbers[row][k]); };
    s.position[k] = {value(0), value(1), value(2), value(3)};
  }
  size_t row = 4;
  const auto setNext = [&](std::vector<float>& values) {
    values.resize(n);
    for (size_t k = 0; k < n; ++k) values[k] = ranges[row].value(levels.numbers[row][k]);
    ++row;
  };
  for (std::vector<float>* values : {&s.temperature, &s.speed, &s.densityError, &s.gasFraction}) setNext(*values);
  size_t name = 0;
  for (FieldValues& shown : s.fields) {
    if (!shown.field->classes) {
      setNext(shown.values);
      continue;
    }
    for (const uint32_t bits : levels.names[name]) shown.values.push_back(std::bit_cast<float>(bits));
    ++name;
  }
}

}  // namespace

uint32_t colourLevel(const FrameKey& key, uint32_t material, uint32_t colour) {
  if (colour == 0) return material;
  const auto at = std::lower_bound(key.colours.begin(), key.colours.end(), colour) - key.colours.begin();
  return material + static_cast<uint32_t>((static_cast<size_t>(at) + 1) * key.look.materialLook.size());
}

size_t PackedFrame::bytes() const {
  return sizeof *this + sizeof *part + stats.probes.capacity() * sizeof(double) + limits.capacity() * sizeof(Limit);
}

/// What was last made of something comes first, and what is last goes when there is much.
template <class Of, class Make>
FrameUnpacker::Levels FrameUnpacker::known(const std::shared_ptr<const Of>& of, const Make& make) const {
  {
    const std::lock_guard lock(m_mutex);
    const auto at = std::find_if(m_known.begin(), m_known.end(), [&](const auto& one) {
      return !one.first.owner_before(of) && !of.owner_before(one.first);
    });
    if (at != m_known.end()) {
      std::rotate(m_known.begin(), at, std::next(at));
      return m_known.front().second;
    }
  }
  auto levels = std::make_shared<const FrameLevels>(make());
  keep(of, levels);
  return levels;
}

void FrameUnpacker::keep(const std::shared_ptr<const void>& of, const Levels& levels) const {
  const std::lock_guard lock(m_mutex);
  m_known.emplace_front(of, levels);
  std::erase_if(m_known, [](const auto& one) { return one.first.expired(); });
  size_t bytes = 0;
  for (const auto& [what, kept] : m_known) bytes += kept->bytes();
  const size_t most = std::max(kMostKnown, kLeast * levels->bytes());
  for (; bytes > most || m_known.size() > kMostFrames; m_known.pop_back()) bytes -= m_known.back().second->bytes();
}

FrameUnpacker::Levels FrameUnpacker::levelsOf(const std::shared_ptr<const FrameKey>& key) const {
  return known(key, [&] {
    if (static_cast<double>(kLeast * key->data->rawSize()) > roomToGrow(memoryNow()))
      throw InputError("a recorded frame takes more memory than there is");
    const std::string bytes = key->data->unpacked();
    ByteUnpacker unpacker(bytes, kWhere);
    return unpackAll(unpacker, key->ranges.size(), namedFields(*key));
  });
}

FrameUnpacker::Levels FrameUnpacker::levelsOf(const std::shared_ptr<const FramePart>& part) const {
  return known(part, [&] {
    const Levels left = part->left ? levelsOf(part->left) : levelsOf(part->key);
    FrameLevels levels = part->right ? between(*left, *levelsOf(part->right)) : *left;
    const std::string bytes = part->data->unpacked();
    ByteUnpacker unpacker(bytes, kWhere);
    unpackChanges(unpacker, levels);
    return levels;
  });
}

SnapshotPtr FrameUnpacker::snapshot(const PackedFrame& frame, uint64_t revision) const {
  const Levels levels = levelsOf(frame.part);
  const FrameKey& key = *frame.part->key;
  auto s = std::make_shared<Snapshot>(key.look);
  s->stats = frame.stats;
  s->revision = revision;
  s->flags = frame.flags;
  s->limits = frame.limits;
  for (const FieldPtr& field : key.fields) s->fields.push_back({field, {}});
  setNumbers(*s, *levels, key.ranges);
  for (const uint8_t phase : levels->phase) s->phase.push_back(static_cast<api::Phase>(phase));
  for (const uint8_t motion : levels->motion) s->motion.push_back(static_cast<api::Motion>(motion));
  s->id = *levels->id;
  s->body = levels->body;
  setMaterials(*s, key, levels->material);
  if (!isSound(*s)) ByteUnpacker({}, kWhere).fail();
  return s;
}

}  // namespace ps
