// SPDX-License-Identifier: Apache-2.0
// The welcome page: when it shows, its cards, templates and recent projects, what can be restored, and pictures.
#include "core/io/projectio.h"
#include "tests/shared/scenes.h"
#include "tests/ui/paintedtexts.h"
#include "tests/ui/windowtesting.h"
#include "ui/document/document.h"
#include "ui/film/thumbnail.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/session.h"
#include "ui/theme/theme.h"
#include "ui/viewport/viewport.h"
#include "ui/welcome/cardgrid.h"
#include "ui/welcome/thumbnails.h"
#include "ui/welcome/welcomepage.h"
#include "ui/window/dock.h"
#include "ui/window/tour.h"
#include "ui/window/welcome.h"

#include <QtCore/QDir>
#include <QtCore/QElapsedTimer>
#include <QtCore/QFileInfo>
#include <QtCore/QSettings>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTemporaryFile>
#include <QtCore/QTimer>
#include <QtGui/QAction>
#include <QtGui/QFontMetricsF>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

#include <cstdio>
#include <unistd.h>

using namespace ps;

namespace {

const QString kProjects = QStringLiteral(PS_SOURCE_DIR "/projects");
const Address kFloor{Owner::Wall, "floor", "temperature"};

}  // namespace

class TestWelcome : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    QSettings().clear();
    Theme::apply(*qApp, true);
    m_directory = std::make_unique<QTemporaryDir>();
  }
  void cleanup() { m_window.reset(); }
  void cleanupTestCase() { QSettings().clear(); }

  void days_data() {
    QTest::addColumn<QDateTime>("time");
    QTest::addColumn<QString>("text");
    const auto row = [](const char* time, const char* text) {
      QTest::newRow(text) << QDateTime::fromString(QLatin1String(time), Qt::ISODate) << QString::fromLatin1(text);
    };
    row("2026-03-01T08:05:00", "Today, 08:05");
    row("2026-02-28T23:59:00", "Yesterday, 23:59");
    row("2026-02-27T23:59:00", "27 February");
    row("2025-12-31T12:00:00", "31 December 2025");
  }
  void days() {
    QFETCH(QDateTime, time);
    QFETCH(QString, text);
    QCOMPARE(dayText(time, QDateTime::fromString(QStringLiteral("2026-03-01T09:00:00"), Qt::ISODate)), text);
  }

  /// No project of the folders without a card, no card without its words and its picture.
  void theGalleryIsWhole() {
    std::unique_ptr<Gallery> reading;
    Worker worker;  // ends before what it reads for, also where the test fails
    reading = std::make_unique<Gallery>(kProjects, worker);
    const Gallery& gallery = *reading;
    QSignalSpy loaded(&gallery, &Gallery::loaded);
    QVERIFY(loaded.wait(kLong));
    const QStringList filter{QStringLiteral("*.json")};
    const auto drawn = QDir(kProjects + QStringLiteral("/sketched")).entryList(filter).size();
    QCOMPARE(gallery.samples().size(), static_cast<size_t>(QDir(kProjects).entryList(filter).size() + drawn));
    QCOMPARE(gallery.templates().size(),
             static_cast<size_t>(QDir(kProjects + QStringLiteral("/templates")).entryList(filter).size()));
    for (const auto* list : {&gallery.samples(), &gallery.templates()}) {
      for (const Sample& sample : *list) {
        QVERIFY2(!sample.title.isEmpty() && !sample.summary.isEmpty() && !sample.picture.isNull(),
                 qPrintable(sample.path));
        QCOMPARE(sample.toTry.isEmpty(), list == &gallery.templates());
        QCOMPARE(sample.tags.isEmpty(), list == &gallery.templates());
      }
    }
    worker.wait();
  }

  /// In windows of any width: a summary takes the lines that it needs, and pictures stand in rows all the same.
  void wordsOfCardsAreWhole_data() {
    QTest::addColumn<int>("width");  // of the grid: 1600 pixels at 100, 125, 200 and 300 %, with what is beside it
    for (const int width : {1140, 860, 640, 420, 214, 200}) QTest::newRow(qPrintable(QString::number(width))) << width;
  }
  void wordsOfCardsAreWhole() {
    QFETCH(int, width);
    Theme::apply(*qApp, true);
    Sample brief, wordy;
    brief.title = wordy.title = QStringLiteral("A floor with keys");
    brief.summary = QStringLiteral("Ice");
    wordy.summary = QStringLiteral("A floor whose heat has keys over time, and what else it has");
    CardGrid grid;
    grid.setSamples({brief, wordy});
    grid.resize(width, grid.heightForWidth(width));
    grid.show();
    const std::vector<Card*> cards = grid.cards();
    QCOMPARE(cards.size(), size_t{2});
    if (cards[0]->y() == cards[1]->y()) QCOMPARE(cards[0]->height(), cards[1]->height());
    const QFontMetricsF metrics(Theme::font(TextRole::Normal));
    const int room = cards[1]->width() - 24;
    QVERIFY(metrics.horizontalAdvance(wordy.summary) <= room * cards[1]->lines());
    QVERIFY(cards[1]->lines() == cards[1]->linesIn(cards[1]->width()));
    QCOMPARE(cards.back()->geometry().bottom() + 1, grid.height());
    QCOMPARE(cards[1]->linesIn(1000), 1);
    QVERIFY(cards[1]->linesIn(200) > 1);
  }

  /// What to try stands on the card, in as many lines as it takes; what is longer than four ends in "…", and the tip
  /// has it whole.
  void aCardSaysWhatToTry_data() {
    QTest::addColumn<int>("width");
    for (const int width : {1140, 860, 640, 420, 214, 200}) QTest::newRow(qPrintable(QString::number(width))) << width;
  }
  void aCardSaysWhatToTry() {
    QFETCH(int, width);
    Theme::apply(*qApp, true);
    Sample brief, wordy, none;
    brief.title = wordy.title = none.title = QStringLiteral("A floor");
    brief.summary = wordy.summary = none.summary = QStringLiteral("Ice");
    brief.toTry = QStringLiteral("Warm the floor.");
    wordy.toTry = QStringLiteral("Warm the floor and look. ").repeated(20).trimmed();
    CardGrid grid;
    grid.setSamples({brief, wordy, none});
    grid.resize(width, grid.heightForWidth(width));
    grid.show();
    const std::vector<Card*> cards = grid.cards();
    const QFontMetricsF metrics(Theme::font(TextRole::Small));
    for (const Card* card : cards) {
      const QStringList lines = tryLinesOf(*card);
      QCOMPARE(lines.join(QLatin1Char(' ')).isEmpty(), card->sample().toTry.isEmpty());
      for (const QString& line : lines) QVERIFY(metrics.horizontalAdvance(line) <= card->width() - 24);
    }
    QCOMPARE(tryLinesOf(*cards[0]).join(QLatin1Char(' ')), QStringLiteral("Try it: Warm the floor."));
    const QStringList lines = tryLinesOf(*cards[1]);
    QCOMPARE(lines.size(), 4);
    QVERIFY2(lines.last().endsWith(QStringLiteral("…")), qPrintable(lines.last()));
    QVERIFY(cards[1]->toolTip().endsWith(wordy.toTry));
    QCOMPARE(cards[2]->wanted(cards[2]->width()).toTry, 0);
    QCOMPARE(cards.back()->geometry().bottom() + 1, grid.height());
  }

  void theFirstStartShowsTheSample() {
    open();
    QVERIFY(!m_window->welcome().shown());
    QVERIFY(m_window->inspectorDock()->isVisible());
    QTRY_VERIFY_WITH_TIMEOUT(m_window->session().playing(), kLong);
    // With a tour over it, once.
    QTRY_VERIFY(m_window->tour().running());
    m_window->tour().end();
    m_window.reset();
    open();
    QTest::qWait(100);
    QVERIFY(!m_window->tour().running());
  }

  /// From the window to matter that moves, in this order, and nobody has to click for it; then a drag turns the view at
  /// once.
  void theFirstStartReachesARunningSample() {
    const MainWindow::Options options = starting();
    QElapsedTimer since;
    since.start();
    m_window = std::make_unique<MainWindow>(options);
    Session& session = m_window->session();
    const auto order = std::make_shared<QStringList>();
    const auto note = [order](const char* what) { return [order, what] { *order << QLatin1String(what); }; };
    connect(&session, &Session::ready, this, note("plugins"));
    connect(&session.files(), &DocumentFiles::opened, this, note("opened"));
    connect(m_window.get(), &MainWindow::projectShown, this, note("shown"));
    m_window->resize(1600, 1000);
    m_window->show();
    QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    m_window->start();
    QTRY_VERIFY_WITH_TIMEOUT(order->contains(QStringLiteral("shown")), kLong);
    QTRY_VERIFY_WITH_TIMEOUT(session.now() > 0, kLong);
    qInfo("a running sample after %lld ms", static_cast<long long>(since.elapsed()));
    QCOMPARE(*order, QStringList({QStringLiteral("plugins"), QStringLiteral("opened"), QStringLiteral("shown")}));
    QCOMPARE(document().path(), options.sample);
    const double then = session.now();
    QTRY_VERIFY_WITH_TIMEOUT(session.now() > then, kLong);
    QVERIFY(session.playing() && !m_window->welcome().shown());
    QVERIFY(!QApplication::activeModalWidget() && !QApplication::activePopupWidget());
    Viewport* view = m_window->viewport();
    QTRY_VERIFY_WITH_TIMEOUT(!view->overlayHits().hintClose.isEmpty(), kLong);
    const QPoint middle = view->rect().center();
    const double azimuth = view->navigator().camera().azimuth;
    QTest::mousePress(view, Qt::LeftButton, {}, middle);
    QTest::mouseMove(view, middle + QPoint(5, 0));
    QVERIFY(view->navigator().camera().azimuth != azimuth && session.playing());
    QTest::mouseRelease(view, Qt::LeftButton, {}, middle + QPoint(5, 0));
  }

  void laterStartsShowThePage() {
    startLater();
    QVERIFY(m_window->welcome().shown());
    QVERIFY(!m_window->inspectorDock()->isVisible());
    QVERIFY(m_window->session().playing());  // what is open goes on behind it
    picture("welcome_dark");
    m_window->setDark(false);
    picture("welcome_light");
    m_window->setDark(true);
    m_window->resize(1280, 800);
    picture("welcome_small");
    QTRY_VERIFY(QApplication::focusWidget());
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
    QVERIFY(!m_window->welcome().shown());
    QVERIFY(m_window->inspectorDock()->isVisible());
    QVERIFY(m_window->viewport()->hasFocus());
  }

  void somebodyPrefersItNotTo() {
    preferences::setWelcomeAtStart(false);
    startLater();
    QVERIFY(!m_window->welcome().shown());
    m_window->action(QStringLiteral("help.welcome"))->trigger();
    QVERIFY(m_window->welcome().shown());
  }

  void aCardOpensItsSampleRunning() {
    startLater();
    Card* card = cardOf(page()->samples(), QStringLiteral("Candle"));
    QVERIFY(card);
    opens([card] { QTest::mouseClick(card, Qt::LeftButton); });
    QCOMPARE(document().title(), QStringLiteral("Candle"));
    QVERIFY(!m_window->welcome().shown());
    QTRY_VERIFY_WITH_TIMEOUT(m_window->session().playing(), kLong);
    QVERIFY(m_window->session().files().isSample(document().path()));
  }

  void theKeyboardGoesFromCardToCard() {
    startLater();
    const std::vector<Card*> cards = page()->samples()->cards();
    QVERIFY(cards.size() > 1);
    QCOMPARE(QApplication::focusWidget(), cards[0]);
    QTest::keyClick(cards[0], Qt::Key_Right);
    QCOMPARE(QApplication::focusWidget(), cards[1]);
    QTest::keyClick(cards[1], Qt::Key_Left);
    QTest::keyClick(cards[0], Qt::Key_Down);
    auto* below = qobject_cast<Card*>(QApplication::focusWidget());
    QVERIFY(below && below->y() > cards[0]->y());
    const QString title = below->sample().title;
    opens([below] { QTest::keyClick(below, Qt::Key_Return); });
    QCOMPARE(document().title(), title);
  }

  void chipsChoose() {
    startLater();
    const auto all = page()->samples()->cards().size();
    page()->samples()->setTag(QStringLiteral("Boiling"));
    const auto some = page()->samples()->cards();
    QVERIFY(!some.empty() && some.size() < all);
    for (Card* card : some) QVERIFY(card->sample().tags.contains(QStringLiteral("Boiling")));
  }

  void aTemplateBeginsANewProject() {
    startLater();
    Card* card = cardOf(page()->templates(), QStringLiteral("Tap and bowl"));
    QVERIFY(card);
    opens([card] { QTest::mouseClick(card, Qt::LeftButton); });
    QCOMPARE(document().path(), QString());
    QVERIFY(!document().isDirty());
    QCOMPARE(document().project().emitters.size(), size_t{1});
  }

  void searchFindsSamples() {
    startLater();
    m_window->action(QStringLiteral("edit.search"))->trigger();
    m_window->palette()->field()->setText(QStringLiteral("candle"));
    QCOMPARE(m_window->palette()->currentTitle(), QStringLiteral("Candle"));
    m_window->palette()->field()->setText(QStringLiteral("sublimation without a liquid"));
    QCOMPARE(m_window->palette()->shownCount(), 0);
    m_window->palette()->field()->setText(QStringLiteral("gas without a liquid"));  // words of its card
    QCOMPARE(m_window->palette()->currentTitle(), QStringLiteral("Dry ice in warm water"));
    opens([this] { QTest::keyClick(m_window->palette()->field(), Qt::Key_Return); });
    QCOMPARE(document().title(), QStringLiteral("Dry ice in warm water"));
    QVERIFY(!m_window->welcome().shown());
  }

  /// Saved: drawn beside the interface, kept in the cache, shown with its title and its folder.
  void whatIsSavedHasAPicture() {
    startLater();
    const QString path = m_directory->filePath(QStringLiteral("mine.json"));
    QFile::remove(thumbnailPath(path));
    ProjectAbout about = document().about();
    about.toTry = "Let the plate glow, and count the drops.";
    document().setAbout(about, QStringLiteral("what to try"));
    m_window->saveTo(path);
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(thumbnailPath(path)), kLong);
    const QImage image(thumbnailPath(path));
    QCOMPARE(image.size(), Thumbnails::kSize);
    std::set<QRgb> colours;
    for (int x = 0; x < image.width(); x += 4) colours.insert(image.pixel(x, image.height() / 2));
    QVERIFY2(colours.size() > 10, qPrintable(QString::number(colours.size())));  // no empty picture
    m_window->action(QStringLiteral("help.welcome"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(recent().size(), 1, kLong);
    QVERIFY(recent().front()->accessibleDescription() == path);
    QCOMPARE(recent().front()->project().toTry, QString::fromStdString(about.toTry));
    QVERIFY(recent().front()->toolTip().contains(recent().front()->project().toTry));
    QVERIFY(recent().front()->height() > 60);  // a line more
    m_window->session().files().newProject();
    QVERIFY(!m_window->welcome().shown());
    m_window->action(QStringLiteral("help.welcome"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(recent().size(), 1, kLong);
    picture("welcome_recent");
    opens([this] { recent().front()->click(); });
    QCOMPARE(document().path(), path);
  }

  /// What a project brings along is shown in place of what was last seen of it.
  void aPictureOfItsOwnGoesFirst() {
    startLater();
    const QString path = m_directory->filePath(QStringLiteral("red.json"));
    QFile::remove(thumbnailPath(path));
    QImage red(320, 180, QImage::Format_RGB32);
    red.fill(qRgb(255, 0, 0));
    ProjectAbout about = document().about();
    about.thumbnail = thumbnailOf(red);
    document().setAbout(about, QStringLiteral("picture"));
    m_window->saveTo(path);
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(thumbnailPath(path)), kLong);
    m_window->action(QStringLiteral("help.welcome"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(recent().size(), 1, kLong);
    const QImage shown = recent().front()->project().picture;
    QCOMPARE(shown.size(), red.size());
    QCOMPARE(shown.pixel(160, 90), red.pixel(160, 90));
  }

  /// What is no picture, or a part of one, is none, and no library complains of it on standard error.
  void whatIsNoPictureIsQuietlyNone() {
    QImage red(320, 180, QImage::Format_RGB32);
    red.fill(qRgb(255, 0, 0));
    const std::string whole = thumbnailOf(red);
    QTemporaryFile said;
    QVERIFY(said.open());
    std::fflush(stderr);
    const int before = ::dup(STDERR_FILENO);
    ::dup2(said.handle(), STDERR_FILENO);
    const bool any = !pictureOf("").isNull() || !pictureOf("AAAA").isNull() ||
                     !pictureOf(whole.substr(0, whole.size() / 2)).isNull();
    const bool same = pictureOf(whole).size() == red.size();
    std::fflush(stderr);
    ::dup2(before, STDERR_FILENO);
    ::close(before);
    QVERIFY(!any && same);
    QCOMPARE(QFileInfo(said.fileName()).size(), qint64{0});
  }

  /// Samples are in nobody's way: neither recent, nor drawn into the cache.
  void samplesAreNotAmongTheRecent() {
    startLater();
    Card* card = cardOf(page()->samples(), QStringLiteral("Box tower"));
    QVERIFY(card);
    opens([card] { card->click(); });
    const QString sample = document().path();
    QVERIFY(m_window->session().files().isSample(sample));
    m_window->welcome().keepPicture();
    // What is saved after it is listed and has its picture; by then the sample would have been and had too.
    const QString own = m_directory->filePath(QStringLiteral("own.json"));
    QFile::remove(thumbnailPath(own));
    m_window->saveTo(own);
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(thumbnailPath(own)), kLong);
    m_window->action(QStringLiteral("help.welcome"))->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!recent().isEmpty(), kLong);
    QCOMPARE(recent().size(), 1);
    QCOMPARE(recent().front()->accessibleDescription(), own);
    QVERIFY(!QFile::exists(thumbnailPath(sample)));
  }

  /// It stays in the list, and where it is now takes its place.
  void whatIsNotFoundCanBeLocated() {
    const QString was = m_directory->filePath(QStringLiteral("away.json"));
    const QString now = m_directory->filePath(QStringLiteral("moved.json"));
    QVERIFY(QFile::copy(kProjects + QStringLiteral("/box-tower.json"), now));
    QSettings().setValue(QStringLiteral("files/recent"), QStringList{was, now});
    startLater();
    QTRY_COMPARE_WITH_TIMEOUT(recent().size(), 2, kLong);
    RecentRow* row = recent().front();
    QVERIFY(row->project().gone && row->project().title == QStringLiteral("away") && !recent()[1]->project().gone);
    QStringList words;
    for (const PaintedText& text : paintedBy(*row)) words << text.text;
    QCOMPARE(words, (QStringList{QStringLiteral("away"), QStringLiteral("Not found · Locate…")}));
    QVERIFY(row->toolTip().contains(was));
    const auto answer = [](const QString& file) {
      QTimer::singleShot(0, qApp, [file] {
        auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        QVERIFY(dialog);
        if (file.isEmpty()) return dialog->reject();
        dialog->findChild<QLineEdit*>()->setText(file);
        static_cast<QDialog*>(dialog)->accept();
      });
    };
    answer({});
    recent().front()->click();
    QVERIFY(m_window->welcome().shown() && DocumentFiles::everRecent().contains(was));
    answer(now);
    opens([this] { recent().front()->click(); });
    QCOMPARE(document().path(), now);
    QVERIFY(!m_window->welcome().shown());
    QVERIFY(!DocumentFiles::everRecent().contains(was) && DocumentFiles::everRecent().front() == now);
  }

  void unsavedWorkIsRestoredFromThePage() {
    startLater();
    QCOMPARE(document().setParameter(kFloor, 351.0), QString());
    m_window->session().files().newProject();  // a copy is kept of what it replaces
    QTRY_VERIFY_WITH_TIMEOUT(restorable(), kLong);
    m_window->action(QStringLiteral("file.restore"))->trigger();
    m_window->action(QStringLiteral("help.welcome"))->trigger();
    QPushButton* restore = button(QStringLiteral("Restore"));
    QVERIFY(restore);
    QTRY_VERIFY(restore->isVisible());
    for (const QLabel* label : restore->parentWidget()->findChildren<QLabel*>())
      QVERIFY2(label->height() >= label->heightForWidth(label->width()), qPrintable(label->text()));  // nothing is cut
    for (const QPushButton* each : restore->parentWidget()->findChildren<QPushButton*>())
      QTRY_VERIFY2(each->width() >= each->sizeHint().width(), qPrintable(each->text()));
    picture("welcome_restore");
    opens([restore] { QTest::mouseClick(restore, Qt::LeftButton); });
    QCOMPARE(std::get<double>(document().value(kFloor)), 351.0);
    QVERIFY(document().isDirty());
    QVERIFY(!m_window->welcome().shown());
    QVERIFY(!button(QStringLiteral("Restore")));
  }

 private:
  Document& document() { return m_window->session().document(); }
  WelcomePage* page() { return m_window->welcome().page(); }
  MainWindow::Options starting() const {
    MainWindow::Options options;
    options.sample = kProjects + QStringLiteral("/ice-on-hot-plate.json");
    options.samples = kProjects;
    options.session.autosaveDirectory = m_directory->filePath(QStringLiteral("copies"));
    return options;
  }
  void open() {
    m_window = shownWindow(starting(), {1600, 1000});
    QVERIFY(m_window);
  }
  /// Not for the first time.
  void startLater() {
    QSettings().setValue(QStringLiteral("window/geometry"), QByteArray());
    open();
    QTRY_VERIFY_WITH_TIMEOUT(!page()->samples()->cards().empty(), kLong);
  }
  void opens(const std::function<void()>& act) {
    QSignalSpy opened(&m_window->session().files(), &DocumentFiles::opened);
    act();
    QVERIFY(!opened.isEmpty() || opened.wait(kLong));
  }
  bool restorable() {
    m_window->paletteEntries();  // looks what waits
    return m_window->action(QStringLiteral("file.restore"))->isEnabled();
  }
  /// The lines of small type in a card, of which all lie inside it.
  static QStringList tryLinesOf(const Card& card) {
    QStringList lines;
    for (const PaintedText& text : paintedBy(const_cast<Card&>(card))) {
      if (!lines.isEmpty() || text.text.startsWith(QStringLiteral("Try it:"))) lines << text.text;
      if (!QRectF(card.rect()).contains(text.place)) return {QStringLiteral("outside: ") + text.text};
    }
    return lines;
  }
  Card* cardOf(const CardGrid* grid, const QString& title) {
    for (Card* card : grid->cards()) {
      if (card->sample().title == title) return card;
    }
    return nullptr;
  }
  QList<RecentRow*> recent() {
    QList<RecentRow*> rows;
    for (RecentRow* row : page()->findChildren<RecentRow*>()) {
      if (!row->isHidden()) rows << row;
    }
    return rows;
  }
  QPushButton* button(const QString& text) {
    for (QPushButton* each : page()->findChildren<QPushButton*>()) {
      if (each->text() == text && each->isVisibleTo(page())) return each;
    }
    return nullptr;
  }
  void picture(const char* name) {
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (folder.isEmpty()) return;
    QTest::qWait(200);
    m_window->grab().save(folder + QStringLiteral("/tst_") + QString::fromLatin1(name) + QStringLiteral(".png"));
  }

  std::unique_ptr<QTemporaryDir> m_directory;
  std::unique_ptr<MainWindow> m_window;
};

QTEST_MAIN(TestWelcome)
#include "tst_welcome.moc"
