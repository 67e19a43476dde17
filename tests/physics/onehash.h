// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/solver/solver.h"

#include <QTest>

/// A scene must come to the same state, bit for bit, on any number of threads and any instruction set.
namespace onehash {

inline void addRows() {
  QTest::addColumn<int>("threads");
  QTest::addColumn<QString>("instructions");
  for (const int threads : {2, 8}) QTest::addRow("%d threads", threads) << threads << QString();
  for (const std::string& name : ps::availableInstructionSets()) {
    QTest::addRow("%s", name.c_str()) << 2 << QString::fromStdString(name);
  }
}

/// `hashOf()` runs the scene and returns its hash, 0 when something failed. The reference, one thread of the best
/// instruction set, is run once for each such function. Sets both; the test's cleanup() puts them back.
template <class HashOf>
void verify(HashOf&& hashOf) {
  QFETCH(int, threads);
  QFETCH(QString, instructions);
  ps::setThreadCount(1);
  static const uint64_t reference = hashOf();
  QVERIFY(reference != 0);
  ps::setThreadCount(threads);
  ps::setInstructionSet(instructions.toStdString());
  if (!instructions.isEmpty()) QCOMPARE(QString::fromStdString(ps::instructionSet()), instructions);
  QCOMPARE(hashOf(), reference);
}

}  // namespace onehash
