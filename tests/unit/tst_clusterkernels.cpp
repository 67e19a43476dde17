// SPDX-License-Identifier: Apache-2.0
// Sums over clusters, what they do to members, and rotations, beside the plainest way to compute the same.
#include "core/solver/solver.h"
#include "plugins/constraints/clusterkernels.h"
#include "plugins/constraints/rotationkernels.h"
#include "tests/shared/random.h"

#include <QTest>

#include <cmath>

using namespace ps::constraint;

namespace {

template <class List>
std::string bytesOf(const List& list) {
  return std::string(reinterpret_cast<const char*>(list.data()), sizeof(list[0]) * list.size());
}

/// One cluster among other particles.
struct ClusterScene {
  explicit ClusterScene(size_t members) {
    ps::testing::Random engine(5);
    const auto some = [&](double low, double size) { return static_cast<float>(engine.next(low, size)); };
    for (size_t i = 0; i < 2 * members; ++i) {
      const float x = some(0.9, 0.1), y = some(-0.1, 0.1), z = some(2, 0.1);
      position.push_back({x, y, z, some(1e-6, 1e-6)});
      previous.push_back({x + some(-1e-3, 2e-3), y + some(-1e-3, 2e-3), z + some(-1e-3, 2e-3), 0});
      mass.push_back(some(0.001, 0.002));
      velocity.push_back({some(-1, 2), some(-1, 2), some(-1, 2), 1 / mass.back()});
    }
    for (size_t k = 0; k < members; ++k) {
      particles.push_back(static_cast<uint32_t>(2 * k + k % 2));
      const ps::api::Float4& x = position[particles.back()];
      const double at[] = {double{x.x} - 0.95, double{x.y}, double{x.z} - 2};
      for (size_t a = 0; a < 3; ++a) {
        rest[a].push_back(static_cast<float>(at[(a + 1) % 3]) + some(-1e-3, 2e-3));
        multiplier[a].push_back(some(-1e-6, 2e-6));
        way[a].push_back(some(-1e-3, 2e-3));
      }
    }
    view.count = position.size();
    view.position = position.data(), view.previous = previous.data(), view.velocity = velocity.data();
    view.mass = mass.data();
  }
  ClusterMembers members() {
    return {particles.data(),
            particles.size(),
            {rest[0].data(), rest[1].data(), rest[2].data()},
            {multiplier[0].data(), multiplier[1].data(), multiplier[2].data()},
            {way[0].data(), way[1].data(), way[2].data()}};
  }
  ps::api::MovableParticles movable() { return {&view, position.data(), velocity.data()}; }
  Vector restOf(size_t k) const { return {rest[0][k], rest[1][k], rest[2][k]}; }
  Vector multiplierOf(size_t k) const { return {multiplier[0][k], multiplier[1][k], multiplier[2][k]}; }
  Vector wayOf(size_t k) const { return {way[0][k], way[1][k], way[2][k]}; }
  std::string bytes() const {
    return bytesOf(position) + bytesOf(velocity) + bytesOf(multiplier[0]) + bytesOf(multiplier[1]) +
           bytesOf(multiplier[2]);
  }
  std::vector<ps::api::Float4> position, previous, velocity;
  std::vector<float> mass;
  std::vector<uint32_t> particles;
  std::array<std::vector<float>, 3> rest, multiplier, way;
  ps::api::ParticleView view{};
};

/// Each sum member by member.
ClusterSums plainSums(const ClusterScene& scene) {
  ClusterSums sums;
  sums.origin = vectorOf(scene.position[scene.particles[0]]);
  for (size_t k = 0; k < scene.particles.size(); ++k) {
    const uint32_t i = scene.particles[k];
    const double m = double{scene.mass[i]};
    const Vector x = vectorOf(scene.position[i]) - sums.origin, way = x + sums.origin - vectorOf(scene.previous[i]);
    sums.mass += m;
    sums.place += m * x;
    sums.rest += m * scene.restOf(k);
    addOuter(sums.moments, m, x, scene.restOf(k));
    sums.shift += m * way;
    sums.turning += cross(x, m * way);
    addOuter(sums.second, m, x, x);
  }
  return sums;
}

std::vector<double> numbersOf(const ClusterSums& sums) {
  std::vector<double> all{sums.mass};
  const auto add = [&](Vector v) { all.insert(all.end(), {v.x, v.y, v.z}); };
  for (const Vector& v : {sums.origin, sums.place, sums.rest, sums.shift, sums.turning}) add(v);
  for (const Matrix* m : {&sums.moments, &sums.second}) {
    for (const Vector& row : m->row) add(row);
  }
  return all;
}

/// Sums in another order differ by some roundings of their largest terms, here below 0.1 kg m2.
bool alike(const std::vector<double>& a, const std::vector<double>& b) {
  for (size_t k = 0; k < a.size(); ++k) {
    if (!(std::abs(a[k] - b[k]) <= 1e-15 + 1e-13 * std::abs(a[k]))) return false;
  }
  return a.size() == b.size();
}

template <class Call>
void onEachInstructionSet(Call&& call) {
  for (const std::string& name : ps::availableInstructionSets()) {
    ps::setInstructionSet(name);
    call(name);
  }
  ps::setInstructionSet("");
}

class TstClusterKernels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void membersAreSummedAndPulled_data() {
    QTest::addColumn<int>("members");
    QTest::addColumn<bool>("rubs");
    for (const int members : {4, 8, 45, 64, 300}) {
      QTest::addRow("%d members", members) << members << false;
      QTest::addRow("%d members that rub", members) << members << true;
    }
  }
  void membersAreSummedAndPulled() {
    QFETCH(int, members);
    QFETCH(bool, rubs);
    const auto count = static_cast<size_t>(members);
    ClusterScene start(count);
    ClusterSums expected = plainSums(start);
    if (!rubs) expected.shift = expected.turning = {}, expected.second = {};
    ClusterPull pull{{0.01, 0.02, -0.01},
                     {0.001, -0.002, 0.003},
                     matrixOf(normalised({0.1, 0.2, -0.3, 1})),
                     {1e-3, 0, -1e-3},
                     {0.02, -0.01, 0.03},
                     rubs ? 0.5 : 0.0,
                     0.7};
    ClusterScene plain(count);
    pullPlainly(plain, pull);
    std::string first;
    onEachInstructionSet([&](const std::string& name) {
      ClusterScene scene(count);
      ClusterScratch scratch;
      const ClusterSums sums = sumsOf(scene.view, scene.members(), rubs, scratch);
      QVERIFY2(alike(numbersOf(sums), numbersOf(expected)), name.c_str());
      pullMembers(scene.movable(), scene.members(), pull, scratch);
      QVERIFY2(scene.bytes() == plain.bytes(), name.c_str());
      const std::string all = bytesOf(numbersOf(sums));
      if (first.empty()) first = all;
      QVERIFY2(all == first, name.c_str());
    });
  }
  void membersAreTurned() {
    ClusterScene start(45);
    Vector lost;
    for (size_t k = 0; k < start.particles.size(); ++k)
      lost += cross(start.wayOf(k) - vectorOf(start.position[start.particles[k]]), start.multiplierOf(k));
    const ClusterSums expected = plainSums(start);
    ClusterScene plain(45);
    const Vector spin{3, -2, 1};
    for (const uint32_t i : plain.particles) {
      const Vector x = vectorOf(plain.position[i]) - expected.origin;
      setVector(plain.velocity[i], vectorOf(plain.velocity[i]) + cross(spin, x - expected.centre()));
    }
    onEachInstructionSet([&](const std::string& name) {
      ClusterScene scene(45);
      ClusterScratch scratch;
      const ClusterTurn turn = turnOf(scene.view, scene.members(), scratch);
      QVERIFY(turn.moved && !turn.held);
      QVERIFY2(alike({turn.lost.x, turn.lost.y, turn.lost.z}, {lost.x, lost.y, lost.z}), name.c_str());
      QVERIFY2(alike({turn.sums.inertia().row[0].y}, {expected.inertia().row[0].y}), name.c_str());
      turnMembers(scene.movable(), scene.members(), expected.centre(), spin, scratch);
      QVERIFY2(scene.bytes() == plain.bytes(), name.c_str());
      scene.velocity[scene.particles[44]].w = 0;
      for (auto& column : scene.multiplier) std::fill(column.begin(), column.end(), 0.0f);
      const ClusterTurn still = turnOf(scene.view, scene.members(), scratch);
      QVERIFY(!still.moved && still.held);
    });
  }
  /// Well-shaped ones, flat and straight ones, mirrored ones, nothing, and what is no number.
  void rotationsAreThoseOfOneAfterTheOther() {
    ps::testing::Random engine(3);
    std::vector<Matrix> matrices;
    std::vector<Quaternion> from, expected;
    for (int k = 0; k < 101; ++k) {
      Matrix& m = matrices.emplace_back();
      for (Vector& row : m.row) row = {engine.next(-1, 2), engine.next(-1, 2), engine.next(-1, 2)};
      if (k % 4 == 0) m = matrixOf(normalised({engine.next(-1, 2), engine.next(-1, 2), 0.1, 1}));
      if (k % 7 == 0) m.row[1] = {};
      if (k % 21 == 0) m.row[2] = {};
      if (k == 50) m = {};
      if (k == 51) m.row[0].x = std::nan("");
      from.push_back(k % 3 == 0 ? Quaternion{} : normalised({engine.next(-1, 2), engine.next(-1, 2), 0.3, 0.4}));
      expected.push_back(rotationOf(m, from.back(), 1e-9));
    }
    onEachInstructionSet([&](const std::string& name) {
      std::vector<Quaternion> found = from;
      findRotations(matrices.data(), found.data(), found.size(), 1e-9);
      QVERIFY2(bytesOf(found) == bytesOf(expected), name.c_str());
    });
  }

 private:
  static void pullPlainly(ClusterScene& scene, const ClusterPull& pull) {
    const Vector origin = vectorOf(scene.position[scene.particles[0]]);
    for (size_t k = 0; k < scene.particles.size(); ++k) {
      const uint32_t i = scene.particles[k];
      ps::api::Float4& at = scene.position[i];
      const Vector x = vectorOf(at) - origin, arm = x - pull.centre;
      Vector error = arm - pull.turned * (scene.restOf(k) - pull.restCentre);
      if (pull.friction > 0) {
        const Vector way = vectorOf(at) - vectorOf(scene.previous[i]);
        error += pull.friction * (way - pull.shift - cross(pull.turning, arm));
      }
      const Vector before = scene.multiplierOf(k);
      const Vector step =
          -1 / (1 + pull.friction + pull.softness) * (double{scene.mass[i]} * error + pull.softness * before);
      const Vector after = before + step;
      scene.multiplier[0][k] = static_cast<float>(after.x);
      scene.multiplier[1][k] = static_cast<float>(after.y);
      scene.multiplier[2][k] = static_cast<float>(after.z);
      setVector(at, x + origin + double{scene.velocity[i].w} * step);
    }
  }
};

}  // namespace

QTEST_GUILESS_MAIN(TstClusterKernels)
#include "tst_clusterkernels.moc"
