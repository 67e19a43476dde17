// SPDX-License-Identifier: Apache-2.0
// exit() from a library, as at the loss of the display: what is static is not taken down below the threads that use it.
#include "app/editor/suddenend.h"

#include <QCoreApplication>
#include <QProcess>
#include <QTest>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <thread>

using namespace ps;

namespace {

struct Taken {
  ~Taken() {
    std::puts("taken down");
    std::fflush(stdout);
  }
};

/// A word for each letter: g a guard, x one that is gone again, s something static, t exit() on another thread.
int exitAs(std::string_view steps) {
  std::optional<SuddenEnd> guard;
  for (const char step : steps) {
    if (step == 'g') guard.emplace();
    if (step == 'x') guard.reset();
    if (step == 's') static const Taken taken;
    if (step == 't') std::thread([] { std::exit(5); }).join();
  }
  std::exit(5);
}

}  // namespace

class TestSuddenEnd : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void exitTakesNothingDown_data() {
    QTest::addColumn<QString>("steps");
    QTest::addColumn<bool>("sudden");
    QTest::newRow("without it") << "s" << false;
    QTest::newRow("made before it") << "sg" << true;
    QTest::newRow("made after it") << "gs" << true;
    QTest::newRow("on another thread") << "sgt" << true;
    QTest::newRow("after it") << "sgx" << false;
  }
  void exitTakesNothingDown() {
    QFETCH(QString, steps);
    QFETCH(bool, sudden);
    QProcess child;
    child.start(QCoreApplication::applicationFilePath(), {QStringLiteral("--exit"), steps});
    QVERIFY(child.waitForFinished());
    QCOMPARE(child.exitStatus(), QProcess::NormalExit);
    QCOMPARE(child.exitCode(), sudden ? 1 : 5);
    QCOMPARE(child.readAllStandardOutput().contains("taken down"), !sudden);
  }
};

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--exit") return exitAs(argv[2]);
  QCoreApplication application(argc, argv);
  TestSuddenEnd test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_suddenend.moc"
