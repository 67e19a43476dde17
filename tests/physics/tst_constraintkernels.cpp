// SPDX-License-Identifier: Apache-2.0
// What density does with each particle between its passes over pairs, and which walls particles are near, against plain
// loops and for every instruction set.
#include "core/solver/fluid/constraintkernels.h"
#include "core/solver/solver.h"
#include "tests/shared/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace ps;

namespace {

constexpr size_t kCount = 331, kSpare = 16;  // not a multiple of any vector
constexpr double kSpacing = 0.02, kSupport = 2 * kSpacing;
/// Of the terms' sizes: a handful of roundings to 6e-8 each.
constexpr double kTolerance = 1e-6;

/// Particles in a corner of two walls, and what a pass over pairs could have left.
struct Scene {
  std::vector<api::Float4> points, velocity, byOthers, beside, position, carried;
  std::vector<float> compression, squares, volume, mass, multiplierSum;
  std::vector<DensitySums> sums;
  std::vector<uint32_t> which;
  HalfSpaces walls;
  std::vector<WallSurface> faces;

  explicit Scene(bool curved = false) {
    testing::Random random(3);
    const auto within = [&](double least, double most) {
      return static_cast<float>(least + (most - least) * random.next());
    };
    const auto vector = [&](double most, float w) {
      return api::Float4{within(-most, most), within(-most, most), within(-most, most), w};
    };
    for (size_t i = 0; i < 2 * kCount; ++i) {
      // Some are below a wall.
      points.push_back({within(-0.01, 0.15), within(-0.01, 0.15), within(0, 0.1), within(0.2, 0.3)});
      mass.push_back(within(0.005, 0.01));
      velocity.push_back(vector(1, 1 / mass.back()));
      compression.push_back(i % 3 == 0 ? within(0, 0.1) : 0);
      volume.push_back(points.back().w);
      position.push_back({points[i].x, points[i].y, points[i].z, within(7e-6, 9e-6)});
      carried.push_back(vector(1e-3, within(0, 1e-4)));
      multiplierSum.push_back(within(0, 1e-4));
      if (i % 2 == 1) which.push_back(static_cast<uint32_t>(i));
    }
    for (size_t k = 0; k < kCount + kSpare; ++k) {
      sums.push_back({within(0.5, 1), within(-0.05, 0.05), within(-0.05, 0.05), within(-0.05, 0.05)});
      squares.push_back(within(10, 20));
      byOthers.push_back(vector(1e-6, 0));
      beside.push_back(vector(1e-5, 0));
    }
    SolverSettings settings;
    settings.spacing = kSpacing;
    settings.supportRatio = kSupport / kSpacing;
    std::vector<Wall> bounding(2);
    bounding[0].normal = {1, 0, 0};
    bounding[1].normal = {0.6, 0.8, 0};
    bounding[1].offset = 0.03;
    if (curved) {
      bounding.resize(4);
      bounding[2].form = WallForm::Sphere, bounding[2].centre = {0.07, 0.07, 0.05}, bounding[2].radius = 0.12;
      bounding[3].form = WallForm::Cylinder, bounding[3].centre = {0.1, 0.05, 0}, bounding[3].normal = {0, 0.6, 0.8};
      bounding[3].radius = 0.02, bounding[3].inside = false;
    }
    walls.configure(settings, bounding);
    walls.refresh(points);
    faces = walls.walls();
  }
};

struct Solved {
  std::vector<DensityConstraint> constraints;
  std::vector<api::Float4> multipliers;
};

constexpr ConstraintRule kRule{0.7f, 1e-6f / static_cast<float>(kSpacing* kSpacing),
                               static_cast<float>(1 / (kSupport * kSupport))};

Solved solve(const Scene& s, const HalfSpaces::Sum* shapes = nullptr) {
  Solved r;
  r.constraints.resize(kCount + kSpare);
  r.multipliers.resize(s.points.size());
  for (const auto& [first, last] : {std::pair<size_t, size_t>{0, 128}, {128, 256}, {256, kCount}})
    solveConstraints(kRule, {s.points.data(), s.velocity.data(), s.compression.data(), shapes}, s.walls, s.which.data(),
                     first, last, s.sums.data(), s.squares.data(), r.constraints.data(), r.multipliers.data());
  r.constraints.resize(kCount);
  return r;
}

struct Moved {
  std::vector<api::Float4> position, carried;
  std::vector<float> multiplierSum;
  api::Double3 sum;
};

struct MoveRow {
  float chebyshev;
  bool constrained, besides;
};

Moved move(const Scene& s, const Solved& solved, const MoveRow& row) {
  Moved r{s.position, s.carried, s.multiplierSum, {}};
  const MoveFields fields{r.position.data(), r.carried.data(), s.velocity.data(),
                          s.volume.data(),   s.mass.data(),    r.multiplierSum.data()};
  r.sum = applyMoves({row.chebyshev, kRule.inverseSupportSquared}, fields, s.which.data(), 0, kCount, s.byOthers.data(),
                     row.constrained ? solved.constraints.data() : nullptr, row.besides ? s.beside.data() : nullptr);
  return r;
}

void compare(float value, double expected, double size, const char* what) {
  QVERIFY2(std::abs(double{value} - expected) <= kTolerance * size, qPrintable(QStringLiteral("%1: %2 instead of %3")
                                                                                   .arg(QLatin1String(what))
                                                                                   .arg(value, 0, 'g', 9)
                                                                                   .arg(expected, 0, 'g', 9)));
}

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool sameNumbers(const api::Float4& a, const api::Float4& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

void addFaces() {
  QTest::addColumn<bool>("curved");
  QTest::newRow("planes") << false;
  QTest::newRow("curved walls") << true;
}

std::vector<uint32_t> below(const Scene& s, bool all) {
  WallSet every;
  for (size_t w = 0; w < s.faces.size(); ++w) every.add(w);
  std::vector<uint32_t> found(s.points.size() + kSpare);
  const size_t last = all ? s.points.size() : kCount;
  found.resize(findBelow(s.faces, every, s.points.data(), all ? nullptr : s.which.data(), 3, last, found.data()));
  return found;
}

std::vector<WallSet> nearWalls(const Scene& s, float reach) {
  std::vector<WallSet> near(s.points.size());
  findNearWalls(s.faces, reach, s.points, near);
  return near;
}

}  // namespace

class TestConstraintKernels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// -relaxation C/(sum w |grad C|2), with what walls and surfaces of fixed bodies add, and 0 where C is not positive.
  void constraintsAreSolved_data() {
    QTest::addColumn<bool>("shapes");
    QTest::addColumn<bool>("curved");
    QTest::newRow("walls") << false << false;
    QTest::newRow("walls and surfaces") << true << false;
    QTest::newRow("curved walls") << false << true;
  }
  void constraintsAreSolved() {
    QFETCH(bool, shapes);
    QFETCH(bool, curved);
    const Scene s(curved);
    std::vector<HalfSpaces::Sum> ofShapes(kCount + kSpare);
    for (size_t k = 0; shapes && k < kCount; k += 3) ofShapes[k] = {0.1f, -3, 2, 4};
    const Solved r = solve(s, shapes ? ofShapes.data() : nullptr);
    size_t active = 0, walled = 0;
    for (size_t k = 0; k < kCount; ++k) {
      const uint32_t i = s.which[k];
      HalfSpaces::Sum walls = s.walls.of(i, s.points[i]);
      walls.excess += ofShapes[k].excess, walls.x += ofShapes[k].x, walls.y += ofShapes[k].y, walls.z += ofShapes[k].z;
      const double perR2 = double{kRule.inverseSupportSquared};
      const double x = double{s.sums[k].x} * perR2 + double{walls.x}, y = double{s.sums[k].y} * perR2 + double{walls.y},
                   z = double{s.sums[k].z} * perR2 + double{walls.z};
      const double excess = double{s.points[i].w} + double{s.sums[k].excess} - 1 + double{walls.excess};
      const double c = excess - double{s.compression[i]};
      const double own = x * x + y * y + z * z + double{kRule.epsilon};
      const double denominator = double{s.velocity[i].w} * own + double{s.squares[k]} * perR2;
      const double lambda = c > 0 ? -double{kRule.relaxation} * c / denominator : 0;
      active += c > 0 ? 1 : 0;
      walled += walls.excess > 0 ? 1 : 0;
      const double slopes =
          0.05 * perR2 + std::abs(double{walls.x}) + std::abs(double{walls.y}) + std::abs(double{walls.z});
      compare(r.constraints[k].x, x, slopes, "x");
      compare(r.constraints[k].y, y, slopes, "y");
      compare(r.constraints[k].z, z, slopes, "z");
      // The multiplier is as good as C, which is a small difference.
      const double size = double{kRule.relaxation} * 3 / denominator + 2 * std::abs(lambda) * slopes * slopes / own;
      compare(r.constraints[k].lambda, lambda, size, "multiplier");
      QCOMPARE(r.multipliers[i].w, r.constraints[k].lambda);
      QVERIFY(r.multipliers[i].x == s.points[i].x && r.multipliers[i].z == s.points[i].z);
    }
    QVERIFY(active > kCount / 4 && active < kCount * 3 / 4);
    QVERIFY(walled > kCount / 8 && (curved || walled < kCount * 7 / 8));
  }

  void movesAreApplied_data() {
    QTest::addColumn<float>("chebyshev");
    QTest::addColumn<bool>("constrained");
    QTest::addColumn<bool>("besides");
    QTest::newRow("fluid, Jacobi") << 1.0f << true << false;
    QTest::newRow("fluid, carried on") << 1.3f << true << false;
    QTest::newRow("solid, Jacobi") << 1.0f << false << false;
    QTest::newRow("solid, carried on, in a film") << 1.3f << false << true;
    QTest::newRow("fluid, carried on, in a film") << 1.3f << true << true;
  }
  void movesAreApplied() {
    QFETCH(float, chebyshev);
    QFETCH(bool, constrained);
    QFETCH(bool, besides);
    const Scene s;
    const Solved solved = solve(s);
    const Moved r = move(s, solved, {chebyshev, constrained, besides});
    Vector3 sum;
    double size = 0;
    for (size_t k = 0; k < kCount; ++k) {
      const uint32_t i = s.which[k];
      const double inverseMass = double{s.velocity[i].w}, on = double{chebyshev}, back = on - 1;
      const DensityConstraint& c = solved.constraints[k];
      const double others = inverseMass * double{s.volume[i]} * double{kRule.inverseSupportSquared};
      const double own = constrained ? inverseMass * double{c.lambda} : 0, film = besides ? inverseMass : 0;
      const auto step = [&](float byOther, float slope, float beside, float before) {
        const double now = others * double{byOther} + own * double{slope} + film * double{beside};
        return on == 1 ? now : on * now + back * double{before};
      };
      const api::Float4 &o = s.byOthers[k], &b = s.beside[k], &f = s.carried[i];
      const Vector3 way(step(o.x, c.x, b.x, f.x), step(o.y, c.y, b.y, f.y), step(o.z, c.z, b.z, f.z));
      const double reach = 0.2;  // m, places
      compare(r.position[i].x, double{s.position[i].x} + way.x(), reach, "x");
      compare(r.position[i].y, double{s.position[i].y} + way.y(), reach, "y");
      compare(r.position[i].z, double{s.position[i].z} + way.z(), reach, "z");
      QCOMPARE(r.position[i].w, s.position[i].w);
      compare(r.carried[i].x, way.x(), way.norm() + std::abs(others) * 1e-6, "carried");
      const double multiplier = constrained ? double{c.lambda} : 0,
                   mixed = on == 1 ? multiplier : on * multiplier + back * double{f.w};
      compare(r.carried[i].w, mixed, std::abs(multiplier) + double{f.w}, "carried multiplier");
      if (constrained) QCOMPARE(r.multiplierSum[i], s.multiplierSum[i] + r.carried[i].w);
      sum += double{s.mass[i]} * way;
      size += double{s.mass[i]} * way.norm();
    }
    QVERIFY((vectorOf(r.sum) - sum).norm() < kTolerance * size);
    for (size_t i = 0; i < s.position.size(); i += 2) {  // the others stay
      QVERIFY(sameNumbers(r.position[i], s.position[i]) && sameNumbers(r.carried[i], s.carried[i]));
    }
  }

  void whoIsBelowAWallIsFound_data() { addFaces(); }
  void whoIsBelowAWallIsFound() {
    QFETCH(bool, curved);
    const Scene s(curved);
    for (const bool all : {true, false}) {
      std::vector<uint32_t> expected;
      for (size_t k = 3; k < (all ? s.points.size() : kCount); ++k) {
        const uint32_t i = all ? static_cast<uint32_t>(k) : s.which[k];
        if (std::any_of(s.faces.begin(), s.faces.end(),
                        [&](const WallSurface& face) { return face.heightOf(s.points[i]) < 0; }))
          expected.push_back(i);
      }
      QVERIFY(expected.size() > 20);
      QVERIFY(below(s, all) == expected);
    }
  }

  void nearWallsAreFound_data() { addFaces(); }
  void nearWallsAreFound() {
    QFETCH(bool, curved);
    const Scene s(curved);
    constexpr float kReach = 0.03f;
    const std::vector<WallSet> near = nearWalls(s, kReach);
    for (size_t i = 0; i < near.size(); ++i) {
      for (size_t w = 0; w < s.faces.size(); ++w) {
        bool has = false;
        near[i].forEach(s.faces.size(), [&](size_t wall) { has = has || wall == w; });
        QCOMPARE(has, !(s.faces[w].heightOf(s.points[i]) > kReach));
      }
    }
  }

  void everyInstructionSetGivesTheSameBits_data() { addFaces(); }
  void everyInstructionSetGivesTheSameBits() {
    QFETCH(bool, curved);
    const Scene s(curved);
    const std::vector<std::string> sets = availableInstructionSets();
    if (sets.size() < 2) QSKIP("this machine knows one instruction set only");
    const Solved best = solve(s);
    const Moved fluid = move(s, best, {1.3f, true, true}), solid = move(s, best, {1, false, false});
    const std::vector<uint32_t> under = below(s, true);
    const std::vector<WallSet> near = nearWalls(s, 0.03f);
    for (const std::string& name : sets) {
      setInstructionSet(name);
      const Solved r = solve(s);
      const Moved again = move(s, r, {1.3f, true, true}), solidAgain = move(s, r, {1, false, false});
      QVERIFY2(sameBits(below(s, true), under) && sameBits(nearWalls(s, 0.03f), near), name.c_str());
      setInstructionSet("");
      QVERIFY2(sameBits(r.constraints, best.constraints) && sameBits(r.multipliers, best.multipliers), name.c_str());
      QVERIFY2(sameBits(again.position, fluid.position) && sameBits(again.carried, fluid.carried) &&
                   sameBits(solidAgain.position, solid.position),
               name.c_str());
      QVERIFY2(again.sum.x == fluid.sum.x && again.sum.y == fluid.sum.y && again.sum.z == fluid.sum.z, name.c_str());
    }
  }
};

QTEST_APPLESS_MAIN(TestConstraintKernels)
#include "tst_constraintkernels.moc"
