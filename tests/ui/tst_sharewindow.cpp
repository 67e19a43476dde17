// SPDX-License-Identifier: Apache-2.0
// Copies for others in the real window: written with their end, opened, checked, and what is said where they differ.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "tests/shared/scenes.h"
#include "tests/ui/samplewindow.h"
#include "ui/session/documentfiles.h"
#include "ui/session/messagelog.h"
#include "ui/session/runwork.h"
#include "ui/session/session.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTimer>
#include <QtGui/QAction>
#include <QtGui/QImage>
#include <QtWidgets/QFileDialog>

using namespace ps;

class TestShareWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    QVERIFY(m_window && m_folder.isValid());
    m_project = m_folder.filePath(QStringLiteral("scene.json"));
    m_copy = m_folder.filePath(QStringLiteral("scene-shared.json"));
    Project project = scenes::iceOnPlate(4, 400);
    project.duration = 0.5;
    saveProject(project, m_project.toStdString());
    load(m_project);
    session().pause();
    QVERIFY(!m_window->action(QStringLiteral("file.checkEnd"))->isEnabled());
  }

  /// The name is suggested; the file has everything, a picture and the end.
  void aCopyIsWritten() {
    QTimer::singleShot(0, m_window.get(), [] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (dialog) static_cast<QDialog*>(dialog)->accept();
    });
    QSignalSpy done(&session().work(), &RunWork::done);
    m_window->action(QStringLiteral("file.share"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, kLong);
    QVERIFY2(done.front().at(1).toString().contains(QStringLiteral("after 30 frames")),
             qPrintable(done.front().at(1).toString()));
    const Project copy = loadProject(m_copy.toStdString(), *session().plugins()).project;
    QVERIFY(copy.end && copy.end->frame == 30);
    const QImage picture = QImage::fromData(QByteArray::fromBase64(QByteArray::fromStdString(copy.thumbnail)));
    QCOMPARE(picture.size(), QSize(320, 180));
    QVERIFY(!document().project().end);  // the open one is what it was
  }

  void theOpenFileIsNoCopy() {
    const QByteArray before = bytesOf(m_project);
    QTimer::singleShot(0, m_window.get(), [this] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (!dialog) return;
      dialog->setOption(QFileDialog::DontConfirmOverwrite);
      dialog->selectFile(m_project);
      static_cast<QDialog*>(dialog)->accept();
    });
    m_window->action(QStringLiteral("file.share"))->trigger();
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("the file that is open")),
             qPrintable(m_window->notice()->text()));
    QVERIFY(!session().work().isBusy());
    QCOMPARE(bytesOf(m_project), before);
    m_window->notice()->close(m_window->notice()->topic());
  }

  /// It offers the check, and comes to the same, though the scene that is open has been edited meanwhile.
  void aCopyIsChecked() {
    load(m_copy);
    QVERIFY(noticeButton(*m_window, QStringLiteral("Check it")));
    picture(QStringLiteral("tst_sharewindow_opened.png"));
    document().setParameter({Owner::Wall, "floor", "temperature"}, 350.0);
    QSignalSpy done(&session().work(), &RunWork::done);
    QTest::mouseClick(noticeButton(*m_window, QStringLiteral("Check it")), Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, kLong);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("Reproduced: after 30 frames")),
             qPrintable(m_window->notice()->text()));
    picture(QStringLiteral("tst_sharewindow_reproduced.png"));
  }

  /// A save of what was changed says nothing of the end; one of the copy as it is does.
  void savesKeepTheEndOfTheSameSceneAlone() {
    const auto savedEnd = [this](const QString& name) {
      QSignalSpy saved(&session().files(), &DocumentFiles::saved);
      session().files().save(m_folder.filePath(name));
      return saved.wait(kLong) &&
             loadProject(m_folder.filePath(name).toStdString(), *session().plugins()).project.end.has_value();
    };
    load(m_copy);
    QVERIFY(savedEnd(QStringLiteral("same.json")));
    document().setParameter({Owner::Wall, "floor", "temperature"}, 350.0);
    QVERIFY(!savedEnd(QStringLiteral("changed.json")));
  }

  /// Somebody has changed the file.
  void whatDiffersIsSaid() {
    Project copy = loadProject(m_copy.toStdString(), *session().plugins()).project;
    copy.environment.gravity = {0, -1.62, 0};
    saveProject(copy, m_copy.toStdString());
    load(m_copy);
    QSignalSpy done(&session().work(), &RunWork::done);
    m_window->action(QStringLiteral("file.checkEnd"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, kLong);
    const QString text = m_window->notice()->text();
    QVERIFY2(text.contains(QStringLiteral("Not reproduced: the project has been changed since")), qPrintable(text));
    picture(QStringLiteral("tst_sharewindow_differs.png"));
    load(m_project);
    QVERIFY(!m_window->action(QStringLiteral("file.checkEnd"))->isEnabled());
  }

 private:
  void load(const QString& path) {
    QSignalSpy shown(&session(), &Session::projectShown);
    session().files().open(path);
    QVERIFY(shown.wait(kLong));
  }
  static QByteArray bytesOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }

  QTemporaryDir m_folder;
  QString m_project, m_copy;
};

QTEST_MAIN(TestShareWindow)
#include "tst_sharewindow.moc"
