// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <memory>
#include <random>
#include <string>
#include <vector>

namespace ps::tests {

/// A frame of particles anywhere in a cube of 1 m, for tests of what keeps frames.
inline SnapshotPtr plainFrame(uint64_t number, size_t particles = 1) {
  static const auto kBodies = std::make_shared<const std::vector<std::string>>(1, "b");
  auto s = std::make_shared<Snapshot>();
  s->stats.frame = number;
  s->stats.time = static_cast<double>(number) / 60;
  s->revision = 1;
  s->spacing = 0.01;
  s->bodyIds = kBodies;
  s->materialIds = {"m"};
  s->materialLook = {{1, 1, 1, 1}};
  std::mt19937 random(static_cast<unsigned>(number));
  const auto any = [&random] { return static_cast<float>(random() & 0xFFFFU) / 65536.0F; };
  s->position.resize(particles);
  for (api::Float4& p : s->position) p = {any(), any(), any(), 0.005F};
  s->temperature.assign(particles, 300);
  s->speed.assign(particles, 1);
  s->densityError.assign(particles, 0);
  s->gasFraction.assign(particles, 0);
  s->phase.assign(particles, api::Phase::Liquid);
  s->motion.assign(particles, api::Motion::Liquid);
  s->id.resize(particles);
  for (size_t i = 0; i < particles; ++i) s->id[i] = static_cast<uint32_t>(particles - i);
  s->body.assign(particles, 0);
  s->material.assign(particles, 0);
  return s;
}

}  // namespace ps::tests
