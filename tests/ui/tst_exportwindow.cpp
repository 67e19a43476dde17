// SPDX-License-Identifier: Apache-2.0
// Exports of the recorded run through the editor: asked for in a dialog, written while the run goes on, given up.
#include "core/base/progress.h"
#include "core/export/exportformat.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/runrecord.h"
#include "tests/shared/scenes.h"
#include "tests/ui/answered.h"
#include "tests/ui/samplewindow.h"
#include "ui/session/messagelog.h"
#include "ui/session/preferences.h"
#include "ui/session/recordedview.h"
#include "ui/session/runwork.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/window/dock.h"
#include "ui/window/exportform.h"
#include "ui/window/filmform.h"
#include "ui/window/statusline.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QPointer>
#include <QtCore/QProcess>
#include <QtCore/QRegularExpression>
#include <QtCore/QStandardPaths>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTimer>
#include <QtGui/QAction>
#include <QtGui/QImage>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

#include <algorithm>
#include <cstdlib>
#include <future>

using namespace ps;

namespace {
constexpr uint64_t kFrames = 24;
/// Before the real one, as long as it is there.
class OtherFfmpeg {
 public:
  explicit OtherFfmpeg(const char* script) : m_before(qgetenv("PATH")) {
    QFile file(m_folder.filePath(QStringLiteral("ffmpeg")));
    if (!file.open(QIODevice::WriteOnly)) qFatal("no place for a program");
    file.write(QByteArray("#!/bin/sh\n") + script);
    file.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    qputenv("PATH", m_folder.path().toUtf8() + ':' + m_before);
  }
  ~OtherFfmpeg() { qputenv("PATH", m_before); }
  OtherFfmpeg(const OtherFfmpeg&) = delete;
  OtherFfmpeg& operator=(const OtherFfmpeg&) = delete;

 private:
  QTemporaryDir m_folder;
  QByteArray m_before;
};

}  // namespace

class TestExportWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    QVERIFY(m_window && m_folder.isValid());
    session().pause();
    toTheStart();
    for (uint64_t frame = 1; frame <= kFrames; ++frame) {
      session().step();
      QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, frame, kLong);
      session().engine()->recording().settle();  // what comes while it packs is left out
    }
  }

  void everyFormatIsWritten_data() {
    QTest::addColumn<int>("row");
    for (size_t k = 0; k < exportFormats().size(); ++k) QTest::newRow(exportFormats()[k].key) << static_cast<int>(k);
  }

  /// From 0.1 s to 0.3 s every sixth frame: 6, 12, 18.
  void everyFormatIsWritten() {
    QFETCH(const int, row);
    const ExportFormat& format = exportFormats()[static_cast<size_t>(row)];
    QVERIFY(openDialog<ExportForm>("file.export"));
    field<QComboBox>("Format")->setCurrentIndex(row);
    field<QLineEdit>("From, in s")->setText(QStringLiteral("0.1"));
    field<QLineEdit>("To, in s")->setText(QStringLiteral("0,3"));
    choose("Frames", 6);
    const QString folder = m_folder.filePath(QString::fromLatin1(format.key));
    place(folder);
    if (row == 0) dialogPicture(QStringLiteral("tst_exportwindow_dialog.png"));
    QSignalSpy written(&session().work(), &RunWork::done);
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QVERIFY(written.wait(kLong));
    QVERIFY(written.front().at(1).toString().startsWith(QStringLiteral("3 frames written to ")));
    QCOMPARE(session().log().messages().back().level, MessageLevel::Ok);
    QTRY_VERIFY2(m_window->notice()->text().contains(QStringLiteral("3 frames written to ")),
                 qPrintable(m_window->notice()->text()));
    const QStringList names{QString::fromLatin1(format.first) + QStringLiteral("-*")};
    const QStringList files = QDir(folder).entryList(names, QDir::Files, QDir::Name);
    QCOMPARE(files.size(), 3);
    QVERIFY(files.front().contains(QStringLiteral("000006.")) && files.back().contains(QStringLiteral("000018.")));
  }

  /// In the view's camera and colours: the middle of the picture is what the view shows there.
  void picturesAreWritten() {
    QVERIFY(openDialog<FilmForm>("file.film"));
    field<QComboBox>("Format")->setCurrentIndex(1);
    field<QComboBox>("Size")->setCurrentIndex(field<QComboBox>("Size")->count() - 1);
    const QSize seen = (QSizeF(view()->size()) * view()->devicePixelRatioF()).toSize();
    const QSize size(seen.width() / 2 * 2, seen.height() / 2 * 2);
    choose("Frames", 12);
    const QString folder = m_folder.filePath(QStringLiteral("pictures"));
    place(folder);
    dialogPicture(QStringLiteral("tst_exportwindow_film.png"));
    const QImage shown = view()->grabFramebuffer().convertToFormat(QImage::Format_RGB32);
    QSignalSpy written(&session().work(), &RunWork::done);
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QVERIFY(written.wait(kLong));
    QVERIFY(written.front().at(1).toString().startsWith(QStringLiteral("3 frames written to ")));
    const QImage last(folder + QStringLiteral("/frame-000024.png"));
    QCOMPARE(last.size(), size);
    QVERIFY(QFile::exists(folder + QStringLiteral("/frame-000000.png")));
    const auto mean = [](const QImage& image) {
      const QImage small = image.copy(image.width() / 3, image.height() / 3, image.width() / 3, image.height() / 3)
                               .scaled(1, 1, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
      return small.pixelColor(0, 0);
    };
    const QColor a = mean(shown), b = mean(last);
    QVERIFY2(
        std::abs(a.red() - b.red()) < 12 && std::abs(a.green() - b.green()) < 12 && std::abs(a.blue() - b.blue()) < 12,
        qPrintable(a.name() + b.name()));
  }

  /// By a program of that name, which shows what it is given: the frames, whole and in order.
  void filmsGoThroughFfmpeg() {
    const OtherFfmpeg ffmpeg("for last; do :; done\ncat > \"$last\"\n");
    QVERIFY(openDialog<FilmForm>("file.film"));
    field<QComboBox>("Format")->setCurrentIndex(0);
    field<QComboBox>("Size")->setCurrentIndex(0);
    choose("Frames", 12);
    const QString film = m_folder.filePath(QStringLiteral("film.mp4"));
    place(film);
    QVERIFY(anyLabelBegins("3 pictures, 0.6 s"));
    QSignalSpy written(&session().work(), &RunWork::done);
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QVERIFY(written.wait(kLong));
    QCOMPARE(QFileInfo(film).size(), qint64{3} * 1280 * 720 * 4);
    QCOMPARE(QDir(m_folder.path()).entryList({QStringLiteral("film*")}, QDir::Files), QStringList{"film.mp4"});
  }

  /// By the real one, where it is installed: its companion finds the pictures in the film, their size and their rate.
  void anotherProgramReadsTheFilm() {
    const QString probe = QStandardPaths::findExecutable(QStringLiteral("ffprobe"));
    if (probe.isEmpty() || QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty())
      QSKIP("films: apt install ffmpeg");
    QVERIFY(openDialog<FilmForm>("file.film"));
    field<QComboBox>("Format")->setCurrentIndex(0);
    field<QComboBox>("Size")->setCurrentIndex(0);
    choose("Frames", 12);
    const QString film = m_folder.filePath(QStringLiteral("real.mp4"));
    place(film);
    QSignalSpy written(&session().work(), &RunWork::done), failed(&session().work(), &RunWork::failed);
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(!written.isEmpty() || !failed.isEmpty(), kLong);
    QVERIFY2(failed.isEmpty(), failed.isEmpty() ? "" : qPrintable(failed.front().at(1).toString()));
    QProcess reader;
    reader.start(probe,
                 {QStringLiteral("-v"), QStringLiteral("error"), QStringLiteral("-count_frames"),
                  QStringLiteral("-show_entries"), QStringLiteral("stream=width,height,avg_frame_rate,nb_read_frames"),
                  QStringLiteral("-of"), QStringLiteral("default=noprint_wrappers=1"), film});
    QVERIFY(reader.waitForFinished(kLong));
    const QByteArray found = reader.readAllStandardOutput();
    for (const char* line : {"width=1280\n", "height=720\n", "avg_frame_rate=5/1\n", "nb_read_frames=3\n"})
      QVERIFY2(found.contains(line), found.constData());
  }

  void aFilmThatFailsLeavesNothing() {
    const OtherFfmpeg ffmpeg("echo no such encoder >&2\nexit 1\n");
    QVERIFY(openDialog<FilmForm>("file.film"));
    field<QComboBox>("Format")->setCurrentIndex(0);
    place(m_folder.filePath(QStringLiteral("none.mp4")));
    QSignalSpy failed(&session().work(), &RunWork::failed);
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QVERIFY(failed.wait(kLong));
    QVERIFY2(failed.front().at(1).toString().endsWith(QStringLiteral("ffmpeg made no film: no such encoder")),
             qPrintable(failed.front().at(1).toString()));
    QVERIFY(QDir(m_folder.path()).entryList({QStringLiteral("none*")}, QDir::Files).isEmpty());
    QVERIFY(!m_window->notice()->text().contains(QStringLiteral("place")));  // none would help
    m_window->notice()->close(QStringLiteral("export"));
  }

  void whatCannotBeIsSaid() {
    QVERIFY(openDialog<ExportForm>("file.export"));
    field<QLineEdit>("From, in s")->setText(QStringLiteral("0.3"));
    field<QLineEdit>("To, in s")->setText(QStringLiteral("0.1"));
    QVERIFY(!button("Export")->isEnabled());
    QVERIFY(anyLabelBegins("Nothing was recorded then"));
    field<QLineEdit>("To, in s")->setText(QStringLiteral("soon"));
    QVERIFY(!button("Export")->isEnabled());
    field<QLineEdit>("To, in s")->setText(QStringLiteral("0.4"));
    QVERIFY(button("Export")->isEnabled());
    place(QStringLiteral("/proc/nowhere"));
    QSignalSpy failed(&session().work(), &RunWork::failed);
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QVERIFY(failed.wait(kLong));
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("/proc/nowhere")),
             qPrintable(m_window->notice()->text()));
    picture(QStringLiteral("tst_exportwindow_failed.png"));
    m_window->notice()->close(QStringLiteral("export"));
  }

  /// The workspace Film asks for the same beside the view. Its range goes on with the run, until somebody types one.
  void aWorkspaceIsForFilms() {
    m_window->showWorkspace(MainWindow::kFilmTab);
    m_form = m_window->layoutOfDocks().dock(QStringLiteral("dock.film"))->findChild<FilmForm*>();
    QVERIFY(m_form && m_form->isVisible() && !m_window->inspectorDock()->isVisible());
    QTRY_COMPARE_WITH_TIMEOUT(field<QLineEdit>("To, in s")->text(), QStringLiteral("0.4"), kLong);
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(field<QLineEdit>("To, in s")->text() != QStringLiteral("0.4"), kLong);
    // Times in the figures that people read everywhere, meant as they are.
    QTRY_COMPARE_WITH_TIMEOUT(field<QLineEdit>("To, in s")->text(), QStringLiteral("0.4167"), kLong);
    QCOMPARE(countText(2358, QStringLiteral("picture"), QStringLiteral("pictures")),
             QStringLiteral("2\u202F358 pictures"));
    picture(QStringLiteral("tst_exportwindow_workspace.png"));
    field<QLineEdit>("To, in s")->selectAll();
    QTest::keyClicks(field<QLineEdit>("To, in s"), QStringLiteral("0.2"));
    field<QComboBox>("Format")->setCurrentIndex(1);
    choose("Frames", 6);
    field<QComboBox>("Size")->setCurrentIndex(0);
    const QString folder = m_folder.filePath(QStringLiteral("workspace"));
    place(folder);
    QSignalSpy written(&session().work(), &RunWork::done);
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QVERIFY(!button("Export")->isEnabled());
    QVERIFY(written.wait(kLong));
    QCOMPARE(QDir(folder).entryList({QStringLiteral("frame-*.png")}, QDir::Files).size(), 3);
    QTRY_VERIFY_WITH_TIMEOUT(button("Export")->isEnabled(), kLong);
    m_window->notice()->close(QStringLiteral("export"));
    m_window->showWorkspace(MainWindow::kSceneTab);
    QVERIFY(m_window->inspectorDock()->isVisible());
  }

  /// What was not recorded is said before it is missed in the film, and times beyond the record are too.
  void whatIsNotRecordedIsSaid() {
    QVERIFY(openDialog<FilmForm>("file.film"));
    const auto says = [this](const char* words) {
      const auto labels = m_form->findChildren<QLabel*>();
      return std::any_of(labels.begin(), labels.end(),
                         [&](const QLabel* label) { return label->text().contains(QLatin1String(words)); });
    };
    const auto type = [this](const char* name, const char* text) { field<QLineEdit>(name)->setText(text); };
    document().setColour("temperature");
    type("To, in s", "0.3");
    QVERIFY(says("in the colours of now."));
    QVERIFY(!says("Only"));
    document().setColour("pressure");
    type("To, in s", "0.29");
    QVERIFY(says("in the colours of matter: "));
    QVERIFY(says("Pressure was not recorded then"));
    document().setColour("material");
    type("To, in s", "99");
    QVERIFY(says("Only 0 to 0.4"));
    type("From, in s", "-3");
    QVERIFY(says("Only 0 to 0.4"));
    type("From, in s", "98");
    QVERIFY(says("Nothing was recorded then"));
    QVERIFY(!button("Export")->isEnabled());
    type("From, in s", "0.1");
    type("To, in s", "0.2");
    QVERIFY(!says("Only") && button("Export")->isEnabled());
    m_form->window()->close();
  }

  /// Esc in the view is acknowledged at once, and ends it; what was written is whole, and listed.
  void escGivesItUp() {
    QVERIFY(openDialog<ExportForm>("file.export"));
    const QString folder = m_folder.filePath(QStringLiteral("given-up"));
    field<QComboBox>("Format")->setCurrentIndex(0);
    place(folder);
    session().engine()->recording().settle();
    QSignalSpy cancelled(&session().work(), &RunWork::cancelled);
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QVERIFY(session().work().isBusy());
    QElapsedTimer clock;
    clock.start();
    QTest::keyClick(view(), Qt::Key_Escape);
    QVERIFY2(clock.elapsed() < kAnswered, qPrintable(QString::number(clock.elapsed())));
    QVERIFY(session().work().isCancelled() || !cancelled.isEmpty());
    QVERIFY(!cancelled.isEmpty() || cancelled.wait(kLong));
    QVERIFY(!session().work().isBusy());
    const qsizetype whole = QDir(folder).entryList({QStringLiteral("*.vtp")}, QDir::Files).size();
    QVERIFY(whole < static_cast<qsizetype>(kFrames + 1));
    QVERIFY(QDir(folder).entryList({QStringLiteral("*.part-*")}, QDir::Files).isEmpty());
  }

  /// The status line and the notice say how far a long one is, and the run goes on. It is as long as the test likes.
  void progressIsShown() {
    std::promise<void> end;
    const std::shared_future<void> ended(end.get_future());
    session().play();
    session().work().start({QStringLiteral("Long"), m_folder.path(), [ended](const KeptRun&) -> RunWork::Result {
                              beginStage("Exporting", 1, 4);
                              advance(1);
                              ended.wait();
                              return {QStringLiteral("It is done.")};
                            }});
    auto* line = m_window->findChild<StatusLine*>();
    // A quarter is done: the rest takes three times as long as that.
    const QRegularExpression left(QStringLiteral("25 % exporting · \\d+ s left"));
    QTRY_VERIFY_WITH_TIMEOUT(line->parts().join(' ').contains(left), kLong);
    const uint64_t frame = session().newest()->stats.frame;
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > frame, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(noticeButton(*m_window, QStringLiteral("Cancel")), kLong);
    picture(QStringLiteral("tst_exportwindow_working.png"));
    // Who gives it up is answered at once, also where a picture is still being drawn.
    noticeButton(*m_window, QStringLiteral("Cancel"))->click();
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("Giving up…")));
    end.set_value();
    QTRY_VERIFY_WITH_TIMEOUT(!session().work().isBusy(), kLong);
    QVERIFY(!noticeButton(*m_window, QStringLiteral("Cancel")));
    QVERIFY(!line->parts().join(' ').contains(QStringLiteral("exporting")));
    session().pause();
  }

  /// The run and other work go on behind it: what it asks for follows. A second asking brings the same one forward. It
  /// goes with the project, and the page of films exports nothing until the run of the next one is there.
  void aFormStandsBesideTheWindow() {
    QVERIFY(openDialog<FilmForm>("file.film"));
    QVERIFY(!m_form->window()->isModal());
    field<QComboBox>("Format")->setCurrentIndex(1);  // pictures, which need no other program
    m_window->action(QStringLiteral("file.film"))->trigger();
    QCOMPARE(m_window->findChildren<RunDialog*>().size(), 1);
    auto* to = field<QLineEdit>("To, in s");
    const QString before = to->text();
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(to->text() != before, kLong);
    session().pause();
    std::promise<void> end;
    session().work().start({QStringLiteral("Other"), m_folder.path(), [&end](const KeptRun&) -> RunWork::Result {
                              end.get_future().wait();
                              return {QStringLiteral("It is done.")};
                            }});
    QVERIFY(button("Export")->isEnabled());  // as it was painted last
    QTest::mouseClick(button("Export"), Qt::LeftButton);
    QVERIFY(m_form->isVisible() && !button("Export")->isEnabled());
    end.set_value();
    QTRY_VERIFY_WITH_TIMEOUT(!session().work().isBusy(), kLong);
    QTRY_VERIFY_WITH_TIMEOUT(button("Export")->isEnabled(), kLong);
    const QPointer<QWidget> dialog = m_form->window();
    m_window->showWorkspace(MainWindow::kFilmTab);
    m_form = m_window->layoutOfDocks().dock(QStringLiteral("dock.film"))->findChild<FilmForm*>();
    field<QComboBox>("Format")->setCurrentIndex(1);
    auto* from = field<QLineEdit>("From, in s");
    QTest::keyClicks(from, QStringLiteral("0"));
    QVERIFY(button("Export")->isEnabled());
    bool couldExport = true, asked = true;
    QObject here;
    connect(&document(), &Document::changed, &here, [&](const ChangeEvent& event) {
      if (!std::holds_alternative<ProjectOpened>(event)) return;
      couldExport = button("Export")->isEnabled() || ExportForm(session()).exportButton().isEnabled();
      m_window->action(QStringLiteral("file.export"))->trigger();
      asked = m_window->findChild<ExportForm*>() != nullptr;
    });
    QSignalSpy shown(&session(), &Session::projectShown);
    m_window->openFile(kSample);
    QTRY_VERIFY_WITH_TIMEOUT(!dialog, kLong);
    QVERIFY(!shown.isEmpty() || shown.wait(kLong));
    QVERIFY(!couldExport && !asked);
    QCOMPARE(from->text(), QStringLiteral("0"));
    QTRY_VERIFY_WITH_TIMEOUT(button("Export")->isEnabled(), kLong);
    session().pause();
  }

  /// A form asks for a place while another project comes: the question goes with the form, and nothing is chosen.
  void aQuestionGoesWithItsForm() {
    QVERIFY(openDialog<ExportForm>("file.export"));
    const QPointer<QWidget> dialog = m_form->window();
    QPointer<QFileDialog> asked;
    QObject here;
    QTimer::singleShot(0, &here, [&] {
      asked = m_form->findChild<QFileDialog*>();
      m_window->openFile(kSample);
      if (asked) QTimer::singleShot(kLong, asked.data(), &QDialog::reject);  // else a failure would wait for ever
    });
    QSignalSpy shown(&session(), &Session::projectShown);
    field<QPushButton>("Where")->click();
    QVERIFY(!dialog && !asked);
    QVERIFY(!shown.isEmpty() || shown.wait(kLong));
    session().pause();
  }

  /// Not in the folder that the program was started in: beside the project, or where projects are kept while it has no
  /// file.
  void filesGoBesideTheProject() {
    const auto places = [this] {
      const ExportForm particles(session());
      const FilmForm film(session(), view());
      QStringList tips;
      for (const RunForm* form : {static_cast<const RunForm*>(&particles), static_cast<const RunForm*>(&film)}) {
        for (const QPushButton* one : form->findChildren<QPushButton*>())
          if (one->accessibleName() == QStringLiteral("Where")) tips << one->toolTip();
      }
      return tips;
    };
    const QString own = m_folder.filePath(QStringLiteral("own.json"));
    m_window->saveTo(own);
    QTRY_COMPARE_WITH_TIMEOUT(document().path(), own, kLong);
    QCOMPARE(places().size(), 2);
    for (const QString& place : places())
      QVERIFY2(place.startsWith(QDir::toNativeSeparators(m_folder.filePath(QStringLiteral("own")))), qPrintable(place));
    document().open(document().project(), {}, false, false);
    const QString kept = preferences::projectFolder() + QLatin1Char('/');
    QVERIFY(kept.size() > 1);
    for (const QString& place : places()) QVERIFY2(place.startsWith(QDir::toNativeSeparators(kept)), qPrintable(place));
  }

 private:
  template <class Form>
  bool openDialog(const char* action) {
    m_window->action(QString::fromLatin1(action))->trigger();
    auto* dialog = m_window->findChild<RunDialog*>();
    m_form = dialog ? dialog->findChild<Form*>() : nullptr;
    return m_form != nullptr;
  }
  template <class Field>
  Field* field(const char* label) {
    for (Field* one : m_form->findChildren<Field*>())
      if (one->accessibleName() == QString::fromLatin1(label)) return one;
    return nullptr;
  }
  QPushButton* button(const char* text) {
    for (QPushButton* one : m_form->findChildren<QPushButton*>())
      if (one->text() == QString::fromLatin1(text)) return one;
    return nullptr;
  }
  bool anyLabelBegins(const char* text) {
    const auto labels = m_form->findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(),
                       [&](QLabel* label) { return label->text().startsWith(QString::fromUtf8(text)); });
  }
  void choose(const char* label, int data) {
    auto* box = field<QComboBox>(label);
    box->setCurrentIndex(box->findData(data));
  }
  void place(const QString& path) { m_form->setPlace(path); }
  void dialogPicture(const QString& name) {
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) m_form->window()->grab().save(folder + QLatin1Char('/') + name);
  }

  QTemporaryDir m_folder;
  RunForm* m_form = nullptr;
};

QTEST_MAIN(TestExportWindow)
#include "tst_exportwindow.moc"
