// SPDX-License-Identifier: Apache-2.0
#include "core/io/recordingblocks.h"

#include "core/base/hash.h"
#include "core/simulation/particlefield.h"

#include <cmath>
#include <utility>

namespace ps::recording {
namespace {

constexpr double kLongest = 1e12;  // s
constexpr size_t kMostNames = 1'000'000;
constexpr size_t kOwnNumbers = 8;  // ranges beside those of fields: see FrameKey

/// All numbers of a frame's statistics, in the order of the file.
template <class Stats, class Visit>
void eachNumber(Stats& s, const Visit& visit) {
  visit(s.frame), visit(s.time), visit(s.thermalTime);
  for (auto& phase : s.phases) visit(phase.count), visit(phase.mass);
  visit(s.temperatureMin), visit(s.temperatureMean), visit(s.temperatureMax);
  visit(s.densityErrorMean), visit(s.densityErrorMax), visit(s.thermalEnergy), visit(s.kineticEnergy);
  auto& heat = s.heat;
  visit(heat.walls), visit(heat.air), visit(heat.radiation), visit(heat.heaters), visit(heat.sources);
  visit(heat.exchanged), visit(heat.airWarming);
  for (auto* flow : {&s.flow.poured, &s.flow.drained, &s.flow.held})
    visit(flow->count), visit(flow->mass), visit(flow->energy);
  for (auto* momentum : {&s.momentum.start, &s.momentum.end, &s.momentum.external})
    visit(momentum->x), visit(momentum->y), visit(momentum->z);
  for (auto& stage : s.milliseconds) visit(stage);
  visit(s.totalMilliseconds);
}

void packTexts(BytePacker& packer, const std::vector<std::string>& texts) {
  packer.value(static_cast<uint32_t>(texts.size()));
  for (const std::string& text : texts) packer.text(text);
}
std::vector<std::string> texts(ByteUnpacker& unpacker) {
  const auto count = unpacker.value<uint32_t>();
  if (count > kMostNames) unpacker.fail();
  std::vector<std::string> all;
  for (uint32_t k = 0; k < count; ++k) all.push_back(unpacker.text());
  return all;
}

void pack(BytePacker& packer, const Limit& limit) {
  for (const std::string* words : {&limit.what, &limit.unit, &limit.why, &limit.use}) packer.text(*words);
  packer.value(limit.asked);
  packer.value(limit.delivered);
  packer.value(static_cast<int32_t>(limit.body));
  packer.value(static_cast<uint8_t>(limit.kelvin.has_value()));
  for (const double end : limit.kelvin.value_or(std::array<double, 2>{})) packer.value(end);
}
Limit limit(ByteUnpacker& unpacker) {
  Limit one;
  for (std::string* words : {&one.what, &one.unit, &one.why, &one.use}) *words = unpacker.text();
  one.asked = unpacker.value<double>();
  one.delivered = unpacker.value<double>();
  one.body = unpacker.value<int32_t>();
  const bool curved = unpacker.value<uint8_t>() != 0;
  std::array<double, 2> kelvin{};
  for (double& end : kelvin) end = unpacker.value<double>();
  if (curved) one.kelvin = kelvin;
  return one;
}

void pack(BytePacker& packer, const ParticleField& field) {
  for (const std::string* words : {&field.name, &field.label, &field.unit}) packer.text(*words);
  packer.value(field.minimum);
  packer.value(field.maximum);
  packer.value(static_cast<uint8_t>(field.classes));
}
FieldPtr field(ByteUnpacker& unpacker) {
  ParticleField one;
  for (std::string* words : {&one.name, &one.label, &one.unit}) *words = unpacker.text();
  one.minimum = unpacker.value<double>();
  one.maximum = unpacker.value<double>();
  one.classes = unpacker.value<uint8_t>() != 0;
  if (!std::isfinite(one.minimum) || !std::isfinite(one.maximum)) unpacker.fail();
  static const ParticleFields kOurs;
  FieldPtr own = kOurs.find(one.name);  // knows more of itself
  if (own && own->classes == one.classes) return own;
  return std::make_shared<const ParticleField>(std::move(one));
}

void pack(BytePacker& packer, const Period& period) {
  for (size_t axis = 0; axis < 3; ++axis) {
    packer.value(period.low(axis));
    packer.value(period.length(axis));
  }
}
Period period(ByteUnpacker& unpacker) {
  std::array<double, 3> low{}, high{};
  std::array<bool, 3> axes{};
  for (size_t axis = 0; axis < 3; ++axis) {
    low[axis] = unpacker.value<double>();
    const auto length = unpacker.value<float>();
    if (!std::isfinite(low[axis]) || !(length >= 0 && length <= 1e15F)) unpacker.fail();
    high[axis] = low[axis] + static_cast<double>(length);
    axes[axis] = length > 0;
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}, axes};
}

}  // namespace

uint64_t headSumOf(const BlockHead& block, const std::string& head) {
  Hash hash;
  hash.add(&block, sizeof block - sizeof block.headSum);
  hash.add(head.data(), head.size());
  return hash.value();
}

std::string headOf(const RunHead& run) {
  BytePacker packer;
  packer.value(run.number);
  packer.value(run.apart);
  packer.text(run.name);
  packer.value(static_cast<uint64_t>(run.shared.size()));
  packer.array(run.shared, run.shared.size());
  return packer.bytes();
}

RunHead readRun(const std::string& head, const std::string& where) {
  ByteUnpacker unpacker(head, where);
  RunHead run{unpacker.value<uint64_t>(), unpacker.value<double>(), unpacker.text(), {}};
  const auto count = unpacker.value<uint64_t>();
  unpacker.array(run.shared, count);
  unpacker.finish();
  if (run.number == 0 || run.number > kMostNames || !(std::abs(run.apart) <= kLongest)) unpacker.fail();
  return run;
}

std::string headOf(const StateHead& state) {
  BytePacker packer;
  packer.value(state);
  return packer.bytes();
}

StateHead readState(const std::string& head, const std::string& where) {
  ByteUnpacker unpacker(head, where);
  const auto state = unpacker.value<StateHead>();
  unpacker.finish();
  return state;
}

std::string headOf(const FrameKey& key) {
  BytePacker packer;
  packer.value(key.number);
  packer.value(key.look.spacing);
  pack(packer, key.look.period);
  packTexts(packer, key.look.bodyIds ? *key.look.bodyIds : std::vector<std::string>());
  packTexts(packer, key.look.materialIds);
  packer.value(static_cast<uint32_t>(key.look.materialLook.size()));
  for (const auto& look : key.look.materialLook) packer.value(look);
  packer.value(static_cast<uint32_t>(key.fields.size()));
  for (const FieldPtr& field : key.fields) pack(packer, *field);
  packer.value(static_cast<uint32_t>(key.ranges.size()));
  for (const Steps& steps : key.ranges) packer.value(steps);
  // Only of scenes that have some: others are as they were before there were any.
  for (const uint32_t colour : key.colours) packer.value(colour);
  return packer.bytes();
}

std::string headOf(const PartHead& part) {
  BytePacker packer;
  packer.value(part);
  return packer.bytes();
}

PartHead readPart(const std::string& head, const std::string& where) {
  ByteUnpacker unpacker(head, where);
  const auto part = unpacker.value<PartHead>();
  unpacker.finish();
  return part;
}

FrameKey readKey(const std::string& head, const std::string& where) {
  ByteUnpacker unpacker(head, where);
  FrameKey key;
  key.number = unpacker.value<uint64_t>();
  key.look.spacing = unpacker.value<double>();
  key.look.period = period(unpacker);
  key.look.bodyIds = std::make_shared<const std::vector<std::string>>(texts(unpacker));
  key.look.materialIds = texts(unpacker);
  const auto looks = unpacker.value<uint32_t>();
  if (looks > kMostNames) unpacker.fail();
  for (uint32_t k = 0; k < looks; ++k) key.look.materialLook.push_back(unpacker.value<std::array<float, 4>>());
  size_t numbers = kOwnNumbers;
  for (auto fields = unpacker.value<uint32_t>(); fields > 0; --fields) {
    key.fields.push_back(field(unpacker));
    if (!key.fields.back()->classes) ++numbers;
  }
  if (unpacker.value<uint32_t>() != numbers) unpacker.fail();
  for (; numbers > 0; --numbers) key.ranges.push_back(unpacker.value<Steps>());
  while (!unpacker.atEnd()) key.colours.push_back(unpacker.value<uint32_t>());
  if (!(key.look.spacing > 0 && key.look.spacing <= 1e6)) unpacker.fail();
  for (const auto& look : key.look.materialLook) {
    for (const float part : look) {
      if (!std::isfinite(part)) unpacker.fail();
    }
  }
  return key;
}

std::string headOf(const PackedFrame& frame, const FrameParts& parts) {
  BytePacker packer;
  packer.value(parts.part);
  packer.value(parts.probes);
  packer.value(static_cast<uint32_t>(frame.stats.milliseconds.size()));
  eachNumber(frame.stats, [&](const auto& number) { packer.value(number); });
  packer.value(static_cast<uint32_t>(frame.stats.probes.size()));
  for (const double value : frame.stats.probes) packer.value(value);
  packer.value(static_cast<uint32_t>(frame.flags));
  packer.value(static_cast<uint32_t>(frame.limits.size()));
  for (const Limit& limit : frame.limits) pack(packer, limit);
  return packer.bytes();
}

PackedFrame readFrame(const std::string& head, const std::string& where, FrameParts& parts) {
  ByteUnpacker unpacker(head, where);
  PackedFrame frame;
  parts.part = unpacker.value<uint32_t>();
  parts.probes = unpacker.value<uint32_t>();
  if (unpacker.value<uint32_t>() != frame.stats.milliseconds.size()) unpacker.fail();
  eachNumber(frame.stats, [&](auto& number) { number = unpacker.value<std::decay_t<decltype(number)>>(); });
  const auto probes = unpacker.value<uint32_t>();
  if (probes > head.size()) unpacker.fail();
  for (uint32_t k = 0; k < probes; ++k) frame.stats.probes.push_back(unpacker.value<double>());
  frame.flags = unpacker.value<uint32_t>();
  for (auto limits = unpacker.value<uint32_t>(); limits > 0; --limits) frame.limits.push_back(limit(unpacker));
  unpacker.finish();
  if (!(std::abs(frame.stats.time) <= kLongest) || !(std::abs(frame.stats.thermalTime) <= kLongest)) unpacker.fail();
  return frame;
}

}  // namespace ps::recording
