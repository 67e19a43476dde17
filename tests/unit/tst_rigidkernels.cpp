// SPDX-License-Identifier: Apache-2.0
// Sums over rigid bodies and the places of their members, beside the plainest way to compute the same.
#include "core/solver/solver.h"
#include "plugins/constraints/rigidkernels.h"
#include "plugins/constraints/rigidrest.h"
#include "tests/shared/random.h"

#include <QTest>

#include <cmath>

using namespace ps::constraint;

namespace {

template <class List>
std::string bytesOf(const List& list) {
  return std::string(reinterpret_cast<const char*>(list.data()), sizeof(list[0]) * list.size());
}

/// Runs the last chunk first: what is summed must not depend on the order in which threads come to their chunks.
class BackwardThreads final : public ps::api::Threads {
 public:
  void share(size_t count, size_t grain, double, void (*body)(void* data, size_t first, size_t last),
             void* data) const override {
    ++loops;
    for (size_t chunk = (count + grain - 1) / grain; chunk-- > 0;)
      body(data, chunk * grain, std::min(count, (chunk + 1) * grain));
  }
  mutable int loops = 0;
};

/// Members of one body among other particles, somewhere else than where its pose has them.
struct BodyScene {
  explicit BodyScene(size_t members) {
    ps::testing::Random engine(17);
    const auto some = [&](double low, double size) { return static_cast<float>(engine.next(low, size)); };
    for (size_t i = 0; i < 2 * members; ++i) {
      const float x = some(0.9, 0.2), y = some(-0.1, 0.2), z = some(2, 0.2);
      position.push_back({x, y, z, some(1e-6, 1e-6)});
      previous.push_back({x + some(-1e-3, 2e-3), y, z, 0});
      velocity.push_back({some(-1, 2), some(-1, 2), some(-1, 2), 500});
      mass.push_back(some(0.001, 0.002));
    }
    for (size_t k = 0; k < members; ++k) {
      particles.push_back(static_cast<uint32_t>(2 * k + k % 2));
      for (auto& column : rest) column.push_back(some(-0.1, 0.2));
    }
    view.count = position.size();
    view.position = position.data(), view.previous = previous.data(), view.velocity = velocity.data();
    view.mass = mass.data();
    pose.centre = {1, 0, 2.1}, pose.restCentre = {0.01, -0.02, 0.03};
    pose.turned = matrixOf(normalised({0.2, -0.1, 0.4, 1}));
    for (Vector& row : pose.turned.row) row = 1.01 * row;
  }
  RigidMembers members() const {
    return {particles.data(), particles.size(), {rest[0].data(), rest[1].data(), rest[2].data()}, threads};
  }
  Vector restOf(size_t k) const { return {rest[0][k], rest[1][k], rest[2][k]}; }
  Vector armOf(size_t k) const { return pose.turned * (restOf(k) - pose.restCentre); }
  double massOf(size_t k) const { return double{mass[particles[k]]}; }
  ps::api::Float4 placeOf(size_t k) const {
    ps::api::Float4 at = position[particles[k]];
    setVector(at, pose.centre + armOf(k));
    return at;
  }
  std::vector<ps::api::Float4> position, previous, velocity;
  std::vector<float> mass;
  std::vector<uint32_t> particles;
  std::array<std::vector<float>, 3> rest;
  RigidPose pose;
  ps::api::ParticleView view{};
  const ps::api::Threads* threads = nullptr;
};

void add(std::vector<double>& list, Vector v) { list.insert(list.end(), {v.x, v.y, v.z}); }
void add(std::vector<double>& list, const Matrix& m) {
  for (const Vector& row : m.row) add(list, row);
}

/// All sums of a body.
std::vector<double> sumsOf(const BodyScene& s) {
  std::vector<double> all;
  const RigidMass mass = massOf(s.view, s.members());
  all.push_back(mass.mass), add(all, mass.moment);
  const RigidOffset offset = offsetOf(s.view, s.members(), s.pose, s.position.data());
  all.push_back(offset.moved ? 1 : 0), add(all, offset.shift), add(all, offset.moments);
  const RigidSpread spread = spreadOf(s.view, s.members(), s.pose.restCentre);
  add(all, spread.second), all.push_back(spread.farthest2);
  for (const RigidMomentum& m : {momentumOf(s.view, s.members(), s.pose.centre, s.previous.data()),
                                 extraMomentumOf(s.view, s.members(), s.pose.centre, 400)}) {
    add(all, m.linear), add(all, m.angular);
  }
  return all;
}

/// The same, member by member.
std::vector<double> plainSumsOf(const BodyScene& s) {
  RigidMass mass;
  RigidOffset offset;
  RigidSpread spread;
  RigidMomentum momentum, extra;
  for (size_t k = 0; k < s.particles.size(); ++k) {
    const uint32_t i = s.particles[k];
    const double m = s.massOf(k);
    const Vector x = vectorOf(s.position[i]), off = x - vectorOf(s.placeOf(k)), r = s.restOf(k) - s.pose.restCentre;
    mass.mass += m, mass.moment += m * s.restOf(k);
    offset.moved = offset.moved || dot(off, off) > 0;
    offset.shift += m * off;
    addOuter(offset.moments, m, s.armOf(k) + off, r);
    addOuter(spread.second, m, r, r);
    spread.farthest2 = std::max(spread.farthest2, dot(s.restOf(k), s.restOf(k)));
    const Vector impulse = m * vectorOf(s.velocity[i]);
    momentum.linear += impulse, momentum.angular += cross(vectorOf(s.previous[i]) - s.pose.centre, impulse);
    const ps::api::Float4 &at = s.position[i], &from = s.previous[i];
    const Vector way{400 * (at.x - from.x), 400 * (at.y - from.y), 400 * (at.z - from.z)};
    const Vector beyond = m * (vectorOf(s.velocity[i]) - way);
    extra.linear += beyond, extra.angular += cross(x - s.pose.centre, beyond);
  }
  std::vector<double> all{mass.mass};
  add(all, mass.moment);
  all.push_back(offset.moved ? 1 : 0), add(all, offset.shift), add(all, offset.moments);
  add(all, spread.second), all.push_back(spread.farthest2);
  for (const RigidMomentum& m : {momentum, extra}) add(all, m.linear), add(all, m.angular);
  return all;
}

template <class Call>
void onEachInstructionSet(Call&& call) {
  for (const std::string& name : ps::availableInstructionSets()) {
    ps::setInstructionSet(name);
    call(name);
  }
  ps::setInstructionSet("");
}

class TstRigidKernels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void bodiesAreSummed_data() {
    QTest::addColumn<int>("members");
    for (const int members : {1, 4, 8, 45, 1000, 1025, 70000}) QTest::addRow("%d members", members) << members;
  }
  /// In another order than one after the other: some roundings of terms that cancel, each below 1 in SI units.
  void bodiesAreSummed() {
    QFETCH(int, members);
    const BodyScene scene(static_cast<size_t>(members));
    const std::vector<double> plain = plainSumsOf(scene);
    const double rounding = 1e-14 * std::max(1.0, members / 1000.0);
    std::string first;
    onEachInstructionSet([&](const std::string& name) {
      const std::vector<double> sums = sumsOf(scene);
      QCOMPARE(sums.size(), plain.size());
      for (size_t k = 0; k < sums.size(); ++k)
        QVERIFY2(std::abs(sums[k] - plain[k]) <= rounding + 1e-13 * std::abs(plain[k]), name.c_str());
      if (first.empty()) first = bytesOf(sums);
      QVERIFY2(bytesOf(sums) == first, name.c_str());
    });
  }
  void threadsShareWhatIsLarge_data() { bodiesAreSummed_data(); }
  void threadsShareWhatIsLarge() {
    QFETCH(int, members);
    BodyScene scene(static_cast<size_t>(members));
    const std::string alone = bytesOf(sumsOf(scene));
    const BackwardThreads threads;
    scene.threads = &threads;
    QVERIFY(bytesOf(sumsOf(scene)) == alone);
    QCOMPARE(threads.loops > 0, members > 1024);
  }
  /// What is noted of two bodies is found until they are predicted again, by when masses may be others.
  void whatRestsIsNotedAnewInEachSubstep() {
    BodyScene scene(100);
    const RigidMembers whole = scene.members(), one{whole.particles, 40, whole.rest};
    const RigidMembers other{whole.particles + 40, 60, {whole.rest[0] + 40, whole.rest[1] + 40, whole.rest[2] + 40}};
    RigidRests rests;
    QVERIFY(!rests.find(one));
    for (int substep = 0; substep < 3; ++substep) {
      for (float& mass : scene.mass) mass *= 1.5f;
      rests.note(scene.view, one);
      rests.note(scene.view, other);
      for (const RigidMembers& members : {one, other}) {
        const RigidRest* rest = rests.find(members);
        QVERIFY(rest);
        const RigidMass mass = massOf(scene.view, members);
        QCOMPARE(rest->mass.mass, mass.mass);
        QCOMPARE(rest->spread.farthest2, spreadOf(scene.view, members, 1 / mass.mass * mass.moment).farthest2);
        QCOMPARE(rest->spread.second.row[1].y,
                 spreadOf(scene.view, members, 1 / mass.mass * mass.moment).second.row[1].y);
      }
      QVERIFY2(!rests.find(whole), "another group that begins at the same place");
    }
  }
  void membersStandWhereThePoseHasThem_data() { bodiesAreSummed_data(); }
  void membersStandWhereThePoseHasThem() {
    QFETCH(int, members);
    BodyScene plain(static_cast<size_t>(members));
    const Vector velocity{1, 2, 3}, spin{-4, 5, 6};
    for (size_t k = 0; k < plain.particles.size(); ++k) {
      plain.position[plain.particles[k]] = plain.placeOf(k);
      setVector(plain.velocity[plain.particles[k]], velocity + cross(spin, plain.armOf(k)));
    }
    onEachInstructionSet([&](const std::string& name) {
      BodyScene scene(static_cast<size_t>(members));
      placeMembers(scene.members(), scene.pose, scene.position.data());
      setVelocities(scene.members(), scene.pose, velocity, spin, scene.velocity.data());
      QVERIFY2(bytesOf(scene.position) == bytesOf(plain.position), name.c_str());
      QVERIFY2(bytesOf(scene.velocity) == bytesOf(plain.velocity), name.c_str());
      QVERIFY(!offsetOf(scene.view, scene.members(), scene.pose, scene.position.data()).moved);
      float& one = scene.position[scene.particles.back()].y;
      one = std::nextafter(one, 10.0f);
      QVERIFY(offsetOf(scene.view, scene.members(), scene.pose, scene.position.data()).moved);
    });
  }
};

}  // namespace

QTEST_GUILESS_MAIN(TstRigidKernels)
#include "tst_rigidkernels.moc"
