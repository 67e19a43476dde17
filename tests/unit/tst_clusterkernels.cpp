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
        displacement[a].push_back(some(-1e-3, 2e-3));
        way[a].push_back(some(-1e-3, 2e-3));
      }
      memberMass.push_back(mass[particles.back()]);
    }
    view.count = position.size();
    view.position = position.data(), view.previous = previous.data(), view.velocity = velocity.data();
    view.mass = mass.data();
  }
  ClusterMembers members() {
    return {particles.data(),
            particles.size(),
            {rest[0].data(), rest[1].data(), rest[2].data()},
            {displacement[0].data(), displacement[1].data(), displacement[2].data()},
            {way[0].data(), way[1].data(), way[2].data()},
            memberMass.data(),
            held};
  }
  ps::api::MovableParticles movable() { return {&view, position.data(), velocity.data()}; }
  Vector restOf(size_t k) const { return {rest[0][k], rest[1][k], rest[2][k]}; }
  Vector displacementOf(size_t k) const { return {displacement[0][k], displacement[1][k], displacement[2][k]}; }
  Vector wayOf(size_t k) const { return {way[0][k], way[1][k], way[2][k]}; }
  std::string bytes() const {
    return bytesOf(position) + bytesOf(velocity) + bytesOf(displacement[0]) + bytesOf(displacement[1]) +
           bytesOf(displacement[2]);
  }
  std::vector<ps::api::Float4> position, previous, velocity;
  std::vector<float> mass, memberMass;
  bool held = false;
  std::vector<uint32_t> particles;
  std::array<std::vector<float>, 3> rest, displacement, way;
  ps::api::ParticleView view{};
};

/// Each sum member by member, left in lane `k`.
void sumPlainly(const ClusterScene& scene, bool rubs, ClusterSums& sums, size_t k) {
  Vector origin = vectorOf(scene.position[scene.particles[0]]), place, shift, turning;
  Matrix moments, second;
  for (size_t member = 0; member < scene.particles.size(); ++member) {
    const uint32_t i = scene.particles[member];
    const double m = double{scene.mass[i]};
    const Vector x = vectorOf(scene.position[i]) - origin, way = x + origin - vectorOf(scene.previous[i]);
    place += m * x;
    addOuter(moments, m, x, scene.restOf(member));
    shift += m * way;
    turning += cross(x, m * way);
    addOuter(second, m, x, x);
  }
  const auto keep = [&](Vector v, ClusterVectors& to) { to[0][k] = v.x, to[1][k] = v.y, to[2][k] = v.z; };
  keep(origin, sums.origin), keep(place, sums.place);
  for (size_t a = 0; a < 3; ++a) keep(moments.row[a], sums.moments[a]);
  if (!rubs) return;
  keep(shift, sums.shift), keep(turning, sums.turning);
  const Vector &x = second.row[0], &y = second.row[1];
  const double parts[] = {x.x, y.y, second.row[2].z, x.y, x.z, y.z};
  for (size_t n = 0; n < 6; ++n) sums.second[n][k] = parts[n];
}

double massOf(const ClusterScene& scene) {
  double mass = 0;
  for (const float m : scene.memberMass) mass += double{m};
  return mass;
}

std::vector<double> numbersOf(const ClusterSums& sums, size_t k) {
  std::vector<double> all;
  for (const ClusterVectors* v :
       {&sums.origin, &sums.place, &sums.moments[0], &sums.moments[1], &sums.moments[2], &sums.shift, &sums.turning}) {
    for (const ClusterLanes& lanes : *v) all.push_back(lanes[k]);
  }
  for (const ClusterLanes& lanes : sums.second) all.push_back(lanes[k]);
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
    // One after the other: as asked, with members that cannot move, and not pulled.
    const auto scenes = [&] {
      std::array<ClusterScene, 3> made{ClusterScene(static_cast<size_t>(members)), ClusterScene(7), ClusterScene(12)};
      made[1].held = true;
      for (size_t k = 0; k < 7; k += 3) made[1].velocity[made[1].particles[k]].w = 0;
      return made;
    };
    ClusterPull pull{{0.961, 0.018, 2.007},
                     matrixOf(normalised({0.1, 0.2, -0.3, 1})),
                     {0.96, 0.02, 1.99},
                     {1e-3, 0, -1e-3},
                     {0.02, -0.01, 0.03},
                     rubs ? 0.5 : 0.0,
                     0.7};
    std::array<ClusterPull, 3> pulls{pull, pull, pull};
    pulls[2].softness = -1;
    ClusterSums expected{};
    auto plain = scenes();
    for (size_t k = 0; k < 3; ++k) sumPlainly(plain[k], rubs, expected, k);
    for (size_t k = 0; k < 2; ++k) pullPlainly(plain[k], pulls[k]);
    std::string first;
    onEachInstructionSet([&](const std::string& name) {
      auto found = scenes();
      std::string all;
      for (size_t k = 0; k < 3; ++k) {
        ClusterScratches scratch;
        ClusterSums sums{};
        const ClusterMembers one = found[k].members();
        sumMembers(found[k].view, &one, 1, rubs, scratch, sums);
        QVERIFY2(alike(numbersOf(sums, 0), numbersOf(expected, k)), name.c_str());
        pullMembers(found[k].movable(), &one, 1, &pulls[k], scratch);
        QVERIFY2(found[k].bytes() == plain[k].bytes(), name.c_str());
        all += bytesOf(numbersOf(sums, 0));
      }
      if (first.empty()) first = all;
      QVERIFY2(all == first, name.c_str());
    });
  }
  void clustersAreHandledAtOnce() {
    onEachInstructionSet([&](const std::string& name) {
      ClusterScene together(90), apart(90);
      const auto cut = [](ClusterScene& scene) {
        std::vector<ClusterMembers> parts;
        for (size_t first = 0, count = 5; first < 90; first += count, count += 10) {
          ClusterMembers part = scene.members();
          part.particles += first, part.count = std::min(count, 90 - first), part.mass += first;
          for (size_t a = 0; a < 3; ++a) part.rest[a] += first, part.displacement[a] += first, part.way[a] += first;
          parts.push_back(part);
        }
        return parts;
      };
      const std::vector<ClusterMembers> all = cut(together);
      ClusterPull pull;
      pull.offset = vectorOf(together.position[0]), pull.turned = matrixOf({}), pull.softness = 0.3;
      const std::vector<ClusterPull> pulls(all.size(), pull);
      ClusterScratches scratch;
      ClusterSums sums{};
      sumMembers(together.view, all.data(), all.size(), false, scratch, sums);
      pullMembers(together.movable(), all.data(), all.size(), pulls.data(), scratch);
      for (const ClusterMembers& one : cut(apart)) {
        sumMembers(apart.view, &one, 1, false, scratch, sums);
        pullMembers(apart.movable(), &one, 1, pulls.data(), scratch);
      }
      QVERIFY2(together.bytes() == apart.bytes(), name.c_str());
    });
  }
  void membersAreTurned() {
    ClusterScene start(45);
    ClusterSums expected{};
    sumPlainly(start, true, expected, 0);
    const Vector origin = laneOf(expected.origin, 0);
    Vector lost;
    for (size_t k = 0; k < start.particles.size(); ++k) {
      const Vector arm = vectorOf(start.position[start.particles[k]]) - origin;
      lost += double{start.memberMass[k]} * cross(start.wayOf(k) - arm, start.displacementOf(k));
    }
    const double mass = massOf(start);
    const Vector centre = origin + 1 / mass * laneOf(expected.place, 0);
    ClusterScene plain(45);
    const Vector spin{3, -2, 1};
    for (const uint32_t i : plain.particles) {
      const Vector x = vectorOf(plain.position[i]);
      setVector(plain.velocity[i], vectorOf(plain.velocity[i]) + cross(spin, x - centre));
    }
    onEachInstructionSet([&](const std::string& name) {
      ClusterScene scene(45);
      ClusterScratches scratch;
      ClusterTurns turns;
      const ClusterMembers members = scene.members();
      sumTurns(scene.view, &members, 1, scratch, turns);
      QVERIFY(turns.moved[0] > 0);
      const Vector found = laneOf(turns.lost, 0);
      QVERIFY2(alike({found.x, found.y, found.z}, {lost.x, lost.y, lost.z}), name.c_str());
      QVERIFY2(alike({inertiaOf(turns.sums, 0, mass).row[0].y}, {inertiaOf(expected, 0, mass).row[0].y}), name.c_str());
      turnMembers(scene.movable(), members, centre, spin, scratch[0]);
      QVERIFY2(scene.bytes() == plain.bytes(), name.c_str());
      for (auto& column : scene.displacement) std::fill(column.begin(), column.end(), 0.0f);
      sumTurns(scene.view, &members, 1, scratch, turns);
      QVERIFY(turns.moved[0] == 0);
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
  void shapesAreFoundAtOnce() {
    ps::testing::Random engine(9);
    const auto some = [&] { return Vector{engine.next(-1, 2), engine.next(-1, 2), engine.next(-1, 2)}; };
    ShapeFits start{};
    std::array<Vector, 5> offset;
    std::array<Matrix, 5> turned;
    const auto keep = [](Vector v, ShapeVectors& to, size_t k) { to[0][k] = v.x, to[1][k] = v.y, to[2][k] = v.z; };
    for (size_t k = 0; k < 5; ++k) {
      const Vector centre = some(), restCentre = some();
      const Quaternion from = normalised({engine.next(-1, 2), 0.2, 0.3, 1});
      Matrix about{{some(), some(), some()}};
      for (size_t a = 0; a < 3; ++a) keep(about.row[a], start.moments[a], k);
      keep(centre, start.centre, k), keep(restCentre, start.restCentre, k);
      const double parts[] = {from.x, from.y, from.z, from.w};
      for (size_t v = 0; v < 4; ++v) start.rotation[v][k] = parts[v];
      start.scale[k] = engine.next(0.9, 0.2);
      addOuter(about, -1, centre, restCentre);
      turned[k] = matrixOf(rotationOf(about, from, 1e-9));
      for (Vector& row : turned[k].row) row = start.scale[k] * row;
      offset[k] = centre - turned[k] * restCentre;
    }
    std::string first;
    onEachInstructionSet([&](const std::string& name) {
      ShapeFits fits = start;
      fitShapes(fits, 5, 1e-9);
      std::vector<double> all;
      for (size_t k = 0; k < 5; ++k) {
        for (size_t a = 0; a < 3; ++a) {
          const double* expected[] = {&turned[k].row[a].x, &turned[k].row[a].y, &turned[k].row[a].z};
          for (size_t b = 0; b < 3; ++b) {
            QVERIFY2(std::abs(fits.moments[a][b][k] - *expected[b]) < 1e-13, name.c_str());
            all.push_back(fits.moments[a][b][k]);
          }
          const double at[] = {offset[k].x, offset[k].y, offset[k].z};
          QVERIFY2(std::abs(fits.offset[a][k] - at[a]) < 1e-13, name.c_str());
          all.push_back(fits.offset[a][k]);
        }
      }
      if (first.empty()) first = bytesOf(all);
      QVERIFY2(bytesOf(all) == first, name.c_str());
    });
  }

 private:
  static void pullPlainly(ClusterScene& scene, const ClusterPull& pull) {
    for (size_t k = 0; k < scene.particles.size(); ++k) {
      const uint32_t i = scene.particles[k];
      ps::api::Float4& at = scene.position[i];
      const Vector x = vectorOf(at);
      Vector error = x - pull.offset - pull.turned * scene.restOf(k);
      if (pull.friction > 0) {
        const Vector way = x - vectorOf(scene.previous[i]);
        error += pull.friction * (way - pull.shift - cross(pull.turning, x - pull.centre));
      }
      const Vector before = scene.displacementOf(k);
      const Vector step = -1 / (1 + pull.friction + pull.softness) * (error + pull.softness * before);
      const Vector after = before + step;
      scene.displacement[0][k] = static_cast<float>(after.x);
      scene.displacement[1][k] = static_cast<float>(after.y);
      scene.displacement[2][k] = static_cast<float>(after.z);
      if (scene.velocity[i].w > 0) setVector(at, x + step);
    }
  }
};

}  // namespace

QTEST_GUILESS_MAIN(TstClusterKernels)
#include "tst_clusterkernels.moc"
