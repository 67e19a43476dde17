// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/standing.h"

#include "core/simulation/restplaces.h"
#include "core/sketch/nearmatter.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ps {
namespace {

constexpr size_t kFewest = 12;       // particles that say how matter near a place stands
constexpr double kSame = 0.35;       // spacings off its place, by which matter still is where the frame has it
constexpr double kUndecided = 1e-9;  // of all arms: how much the turn before counts
constexpr int kRounds = 12;
constexpr size_t kMost = 20'000;  // particles that are looked at, evenly among all: a hand does not wait for millions

/// Solid matter of a body of which it is known where it was made; in a periodic box as near to `place` as it comes.
std::vector<RestPair> pairsOf(const Snapshot& scene, uint32_t body, const Vector3& place) {
  std::vector<RestPair> pairs;
  for (size_t i = 0; i < scene.body.size(); ++i) {
    if (scene.body[i] != body || !api::holds(scene.motion[i])) continue;
    const std::optional<Vector3> rest = scene.rest->of(scene.id[i]);
    if (rest) pairs.push_back({*rest, imageNear(scene.period, vectorOf(scene.position[i]), place)});
  }
  return pairs;
}

std::vector<RestPair> someOf(std::span<const RestPair> pairs) {
  const size_t step = pairs.size() / kMost + 1;
  std::vector<RestPair> some;
  for (size_t k = 0; k < pairs.size(); k += step) some.push_back(pairs[k]);
  return some;
}

double off(const RigidMove& move, const RestPair& pair) { return (move.of(pair.rest) - pair.place).norm(); }

std::vector<RestPair> within(std::span<const RestPair> pairs, const RigidMove& move, double distance) {
  std::vector<RestPair> near;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(near),
               [&](const RestPair& pair) { return off(move, pair) <= distance; });
  return near;
}

/// Of those that lie together as they were made; the others are left out one round after the other.
std::optional<RigidMove> frameOf(std::span<const RestPair> all, const Quaternion& turn, double same) {
  std::vector<RestPair> kept(all.begin(), all.end());
  for (int round = 0; round < kRounds && !kept.empty(); ++round) {
    const RigidMove move = bestMove(kept, turn);
    std::vector<double> distances;
    for (const RestPair& pair : kept) distances.push_back(off(move, pair));
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    const double allowed = std::max(same, 1.5 * *middle);
    std::vector<RestPair> next = within(kept, move, allowed);
    if (next.size() == kept.size() && allowed > same) return std::nullopt;  // nothing of it stands out
    const bool done = next.size() == kept.size();
    kept = std::move(next);
    if (done) return 2 * kept.size() >= all.size() ? std::optional(move) : std::nullopt;
  }
  return std::nullopt;
}

/// The frame of more and more of the body, as long as it is one with what is near.
RigidMove grown(RigidMove move, std::span<const RestPair> all, std::span<const RestPair> near, double same) {
  size_t before = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<RestPair> fitting = within(all, move, same);
    if (fitting.size() <= before) break;
    before = fitting.size();
    const RigidMove wider = bestMove(fitting, move.turn);
    const auto meanOff = [&](const RigidMove& one) {
      double sum = 0;
      for (const RestPair& pair : near) sum += std::min(off(one, pair), same);
      return sum / static_cast<double>(near.size());
    };
    if (meanOff(wider) > std::max(1.25 * meanOff(move), same / 3)) break;
    move = wider;
  }
  return move;
}

}  // namespace

RigidMove bestMove(std::span<const RestPair> pairs, const Quaternion& turn) {
  Vector3 rest = Vector3::Zero(), place = Vector3::Zero();
  for (const RestPair& pair : pairs) rest += pair.rest, place += pair.place;
  rest /= static_cast<double>(pairs.size()), place /= static_cast<double>(pairs.size());
  Matrix3 s = Matrix3::Zero();
  double arms = 0;
  for (const RestPair& pair : pairs) {
    const Vector3 from = pair.rest - rest, to = pair.place - place;
    s += from * to.transpose();
    arms += from.norm() * to.norm();
  }
  Matrix4 n;                                                                                  // of w, x, y, z
  n << s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),  //
      s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),   //
      s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),   //
      s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
  const Vector4 before(turn.w(), turn.x(), turn.y(), turn.z());
  n += (arms > 0 ? kUndecided * arms : 1) * before * before.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix4> solved(n);
  const Vector4 q = solved.eigenvectors().col(3);  // of the largest value
  const Quaternion best = Quaternion(q[0], q[1], q[2], q[3]).normalized();
  return {best, place - best * rest};
}

std::optional<RigidMove> standingNear(const Snapshot& scene, uint32_t body, const RigidMove& pose, const Vector3& place,
                                      double within) {
  if (!scene.rest || scene.rest->empty()) return std::nullopt;
  std::vector<RestPair> all = pairsOf(scene, body, place);
  if (all.empty()) return std::nullopt;
  const auto away = [&](const RestPair& pair) { return (pair.place - place).squaredNorm(); };
  const auto isNear = [&](const RestPair& pair) { return away(pair) <= within * within; };
  const auto inside = std::stable_partition(all.begin(), all.end(), isNear);
  auto count = static_cast<size_t>(inside - all.begin());
  if (count < kFewest) {
    count = std::min(kFewest, all.size());
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                      [&](const RestPair& a, const RestPair& b) { return away(a) < away(b); });
  }
  const std::vector<RestPair> near = someOf({all.data(), count});
  all = someOf(all);
  const double same = kSame * scene.spacing;
  std::optional<RigidMove> move = frameOf(near, pose.turn, same);
  if (!move) {  // half of it has melted and set again: as the rest of the body stands, where some of it agrees
    move = frameOf(all, pose.turn, same);
    if (!move || 4 * ps::within(near, *move, same).size() < near.size()) return std::nullopt;
  }
  return grown(*move, all, ps::within(near, *move, same), same);
}

}  // namespace ps
