// SPDX-License-Identifier: Apache-2.0
// Cells of the directions to neighbours, a vector at a time beside one after the other.
#include "core/solver/heat/covercells.h"
#include "core/solver/solver.h"
#include "tests/shared/random.h"

#include <QTest>

#include <numeric>

namespace {

class TstCoverCells : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cellsAreThoseOfOneAfterTheOther_data() {
    QTest::addColumn<int>("neighbours");
    for (const int neighbours : {0, 1, 15, 16, 17, 40, 64}) QTest::addRow("%d neighbours", neighbours) << neighbours;
  }
  void cellsAreThoseOfOneAfterTheOther() {
    QFETCH(int, neighbours);
    const auto count = static_cast<size_t>(neighbours);
    ps::testing::Random engine(11);
    std::vector<ps::api::Float4> at{{0.25f, -0.5f, 1, 0}};
    for (size_t k = 0; k < count; ++k) {
      ps::api::Float4 line{0, 0, 0, 0};
      // Along axes, along diagonals, at the particle itself, and anywhere.
      if (k % 5 != 0) line.x = static_cast<float>(engine.next(-0.1, 0.2));
      if (k % 5 == 1 || k % 5 == 3) line.y = k % 2 == 0 ? line.x : -line.x;
      if (k % 5 == 2 || k % 5 == 3) line.z = static_cast<float>(engine.next(-0.1, 0.2));
      at.push_back({at[0].x + line.x, at[0].y + line.y, at[0].z + line.z, 0});
    }
    std::vector<uint32_t> list(count);
    std::iota(list.rbegin(), list.rend(), 1u);
    constexpr float kLeast = 1e-8f, kMost = 0.01f;
    std::vector<uint32_t> expected, cells;
    for (const uint32_t j : list) {
      const float x = at[j].x - at[0].x, y = at[j].y - at[0].y, z = at[j].z - at[0].z, square = x * x + y * y + z * z;
      if (square > kMost || square < kLeast) continue;
      expected.push_back(j);
      cells.push_back(static_cast<uint32_t>(ps::coverCellOf(x, y, z)));
    }
    for (const std::string& name : ps::availableInstructionSets()) {
      ps::setInstructionSet(name);
      std::vector<uint32_t> neighbour(ps::kCoverRoom), cell(ps::kCoverRoom);
      const size_t found =
          ps::findCoverCells(at.data(), 0, list.data(), count, kLeast, kMost, neighbour.data(), cell.data());
      neighbour.resize(found), cell.resize(found);
      QVERIFY2(neighbour == expected && cell == cells, name.c_str());
    }
    ps::setInstructionSet("");
  }
  void facesOfTheCubeFollowEachOther() {
    constexpr size_t kFace = size_t{ps::kCoverCells} * ps::kCoverCells, kMiddle = kFace / 2;
    QCOMPARE(ps::coverCellOf(1, 0, 0), kMiddle);
    QCOMPARE(ps::coverCellOf(-1, 0, 0), kFace + kMiddle);
    QCOMPARE(ps::coverCellOf(0, 2, 0), 2 * kFace + kMiddle);
    QCOMPARE(ps::coverCellOf(0, 0, -3), 5 * kFace + kMiddle);
  }
};

}  // namespace

QTEST_GUILESS_MAIN(TstCoverCells)
#include "tst_covercells.moc"
