// SPDX-License-Identifier: Apache-2.0
// Help inside the program: F1 on rows, panels and tools, pages and their links, and the tour.
#include "core/plugin_host/registry.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/declared.h"
#include "ui/help/helpwindow.h"
#include "ui/help/parameterhelp.h"
#include "ui/panels/inspector.h"
#include "ui/panels/rowmodels.h"
#include "ui/rows/parameterpanel.h"
#include "ui/window/dock.h"
#include "ui/window/help.h"
#include "ui/window/tour.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QRegularExpression>
#include <QtGui/QAction>
#include <QtGui/QTextCursor>
#include <QtGui/QTextDocument>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QTextBrowser>

using namespace ps;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"};
const Address kConductivity{Owner::Material, "water", "conductivity_solid"};

}  // namespace

class TestHelp : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void cleanup() {
    delete m_window->help().dialog();
    m_window->tour().end();
    while (document().undoStack().canUndo()) document().undoStack().undo();
  }

  void valuesAreExplained() {
    const auto said = [this](const Address& address) {
      return explainedValue(*rowModelOf(document(), address), document()).join(QLatin1Char(' '));
    };
    QVERIFY2(said(kFloor).contains(QStringLiteral("That is 420 K, 146.9 °C and 296.3 °F.")), qPrintable(said(kFloor)));
    document().setParameter(kFloor, std::get<double>(document().defaultValue(kFloor)));
    QVERIFY2(said(kFloor).contains(QStringLiteral("It is the default.")), qPrintable(said(kFloor)));
    document().setParameter(kFloor, std::get<double>(document().defaultValue(kFloor)) + 80);
    QVERIFY2(said(kFloor).contains(QStringLiteral("It is 80 °C above the default of")), qPrintable(said(kFloor)));
    // Against the default, on the slider, and among what is installed.
    const double ice = document().declaration(kConductivity)->maximum;
    Response flat;
    flat.constant = ice;
    document().setParameter(kConductivity, flat);
    QVERIFY2(said(kConductivity).contains(QStringLiteral("times the default of")), qPrintable(said(kConductivity)));
    QVERIFY2(said(kConductivity).contains(QStringLiteral("the most that the slider offers")),
             qPrintable(said(kConductivity)));
    // A row that does nothing says so.
    const Address idle{Owner::Wall, "left", "temperature"};
    QVERIFY2(said(idle).contains(QStringLiteral("It does nothing at present.")), qPrintable(said(idle)));
  }

  void knownFiguresComeFromTheInstalled() {
    const auto figures = knownFigures(document(), "conductivity_solid", 263.15);
    QVERIFY(figures.size() > 5);
    QVERIFY(
        std::is_sorted(figures.begin(), figures.end(), [](const auto& a, const auto& b) { return a.value < b.value; }));
    const auto water =
        std::find_if(figures.begin(), figures.end(), [](const KnownFigure& f) { return f.material == "water"; });
    QVERIFY(water != figures.end());
    QCOMPARE(water->value, valueOf(*session().plugins()->material("water"), "conductivity_solid", 263.15));
    // Where a material is none: ice has no conductivity of ice at 100 °C.
    for (const KnownFigure& figure : knownFigures(document(), "conductivity_solid", 373.15))
      QVERIFY(figure.material != "water");
    const QStringList said = explainedValue(*rowModelOf(document(), kConductivity), document());
    QVERIFY2(said.join(QLatin1Char(' ')).contains(QStringLiteral("installed material")) ||
                 said.join(QLatin1Char(' ')).contains(QStringLiteral("It is that of")) ||
                 said.join(QLatin1Char(' ')).contains(QStringLiteral("It lies between")),
             qPrintable(said.join(QLatin1Char(' '))));
  }

  /// Every value of the scene has a page that says what is declared of it.
  void everyValueHasItsPage() {
    int count = 0;
    for (const Address& address : allAddresses(document().project(), document().plugins())) {
      const auto row = rowModelOf(document(), address);
      if (!row) continue;
      const HelpPage page = parameterHelp(*row, document());
      QVERIFY(page.text.contains(QString::fromUtf8(row->declaration.help).toHtmlEscaped()));
      QVERIFY(page.text.contains(QStringLiteral("Default")) && page.text.contains(row->key));
      ++count;
    }
    QVERIFY(count > 60);
  }

  void linksLeadSomewhere() {
    QVERIFY(writtenHelp().size() >= 6);
    static const QRegularExpression link(QStringLiteral("\\]\\((help|action):([^)]+)\\)"));
    for (const HelpPage& page : writtenHelp()) {
      QVERIFY2(!page.title.isEmpty() && page.text.size() > 300, qPrintable(page.id));
      for (auto found = link.globalMatch(page.text); found.hasNext();) {
        const auto match = found.next();
        const QString to = match.captured(2);
        if (match.captured(1) == QStringLiteral("action")) {
          QVERIFY2(m_window->action(to), qPrintable(to));
        } else {
          m_window->help().open(to);
          QCOMPARE(dialog()->current(), to);
        }
      }
    }
  }

  void f1ExplainsTheRowUnderThePointer() {
    m_window->inspectorDock()->showPage(QStringLiteral("Material"));
    ParameterRow* row = m_window->inspector().materialPanel()->row(QString::fromStdString(kConductivity.text()));
    QVERIFY(row && m_window->revealParameter(kConductivity, false));
    QTest::mouseMove(row, row->labelRect().center());
    f1();
    QCOMPARE(dialog()->current(), QStringLiteral("parameter/material/water/conductivity_solid"));
    for (const char* part : {"W/(m·K)", "Slider", "Default", "on the next frame", "The value now", "this value"})
      QVERIFY2(dialog()->text().contains(QString::fromUtf8(part)), part);
    picture("help_row_dark");
    m_window->setDark(false);
    picture("help_row_light");
    m_window->setDark(true);
  }

  void f1InPanelsAndTools() {
    Dock* transport = m_window->layoutOfDocks().dock(QStringLiteral("dock.transport"));
    QTest::mouseMove(transport, transport->rect().center());
    f1();
    QCOMPARE(dialog()->current(), QStringLiteral("timeline"));
    picture("help_page");
    m_window->tools().activate("brush");
    QTest::mouseMove(view(), view()->rect().center());
    f1();
    QCOMPARE(dialog()->current(), QStringLiteral("tool/brush"));
    QVERIFY(dialog()->text().contains(QStringLiteral("draw"), Qt::CaseInsensitive));
    m_window->tools().activate("select");
    Q_EMIT dialog()->findChild<QTextBrowser*>()->anchorClicked(QUrl(QStringLiteral("help:sketching")));
    QCOMPARE(dialog()->current(), QStringLiteral("sketching"));
  }

  /// At the line that tells of it, whichever way one comes.
  void aBrushHasItsPlaceOnThePage() {
    const auto sketching = std::find_if(writtenHelp().begin(), writtenHelp().end(),
                                        [](const HelpPage& page) { return page.id == QLatin1String("sketching"); });
    QVERIFY(sketching != writtenHelp().end() && !sketching->text.contains(QStringLiteral("{#")));
    for (const std::string& brush : session().plugins()->ids(PluginKind::Brush))
      QVERIFY2(sketching->sections.contains(QString::fromStdString(brush)), brush.c_str());
    m_window->help().open(QStringLiteral("sketching"));
    QApplication::setActiveWindow(m_window.get());
    auto* text = dialog()->findChild<QTextBrowser*>();
    const auto topOf = [&](const char* words) {
      QTextCursor found = text->document()->find(QString::fromLatin1(words), 0, QTextDocument::FindCaseSensitively);
      found.setPosition(found.selectionStart());
      return text->cursorRect(found).top();
    };
    QVERIFY(topOf("Heat and cool:") > text->viewport()->height());
    m_window->tools().activate("brush");
    m_window->tools().takeBrush("cool");
    Dock* bar = m_window->layoutOfDocks().dock(QStringLiteral("dock.brushes"));
    QTRY_VERIFY(bar->isVisible());
    const auto buttons = bar->findChildren<QAbstractButton*>();
    const auto of = [&](const char* shape) {
      return *std::find_if(buttons.begin(), buttons.end(), [&](const QAbstractButton* button) {
        return button->property("shape").toString() == QLatin1String(shape);
      });
    };
    dialog()->hide();  // it may lie over the bar
    const auto pointAtPaint = [&] {
      for (QScrollArea* area : bar->findChildren<QScrollArea*>()) area->ensureWidgetVisible(of("paint"));
      QTest::mouseMove(of("paint"), of("paint")->rect().center());
      return QApplication::widgetAt(QCursor::pos()) == of("paint");
    };
    QTRY_VERIFY(pointAtPaint());  // the bar has just been laid out
    f1();
    QCOMPARE(dialog()->current(), QStringLiteral("sketching"));
    const auto isOnTop = [&](const char* words) { return topOf(words) > -8 && topOf(words) < 40; };  // px
    QVERIFY2(isOnTop("Paint:"), qPrintable(QString::number(topOf("Paint:"))));
    // Of the brush in hand where none is pointed at; from the page of the tool as well.
    QTest::mouseMove(bar, QPoint(bar->width() / 2, bar->height() - 8));
    f1();
    QVERIFY2(isOnTop("Heat and cool:"), qPrintable(QString::number(topOf("Heat and cool:"))));
    QCOMPARE(m_window->tools().brush().shape, std::string("cool"));
    m_window->help().open(QStringLiteral("tool/brush"));
    QVERIFY(text->toHtml().contains(QStringLiteral("help:sketching#cool")));
    Q_EMIT text->anchorClicked(QUrl(QStringLiteral("help:sketching#cool")));
    QVERIFY(isOnTop("Heat and cool:"));
    m_window->tools().activate("select");
  }

  /// Of one that draws it is the keys that one asks for.
  void f1InTheViewTellsOfTheBrushThatWorksOnMatter() {
    m_window->tools().activate("brush");
    for (const auto& [brush, words] :
         {std::pair("heat", "Heat and cool:"), {"grab", "Grab:"}, {"cut", "Cut:"}, {"paint", "Paint:"}}) {
      m_window->tools().takeBrush(brush);
      if (dialog()) dialog()->hide();  // it may lie over the view
      view()->setFocus();
      QTest::mouseMove(view(), view()->rect().center());
      f1();
      QCOMPARE(dialog()->current(), QStringLiteral("sketching"));
      auto* text = dialog()->findChild<QTextBrowser*>();
      QTextCursor found = text->document()->find(QString::fromLatin1(words), 0, QTextDocument::FindCaseSensitively);
      found.setPosition(found.selectionStart());
      const int top = text->cursorRect(found).top();
      QVERIFY2(top > -8 && top < 40, qPrintable(QStringLiteral("%1 %2").arg(QLatin1String(brush)).arg(top)));
    }
    m_window->tools().takeBrush("sphere");
    dialog()->hide();
    QTest::mouseMove(view(), view()->rect().center() + QPoint(4, 0));
    f1();
    QCOMPARE(dialog()->current(), QStringLiteral("tool/brush"));
    m_window->tools().activate("select");
  }

  void allValuesAreListed() {
    m_window->help().open(QStringLiteral("values"));
    QVERIFY(dialog()->text().contains(QStringLiteral("Conductivity")));
    Q_EMIT dialog()->findChild<QTextBrowser*>()->anchorClicked(
        QUrl(QStringLiteral("help:parameter/") + QString::fromStdString(kFloor.text())));
    QCOMPARE(dialog()->current(), QStringLiteral("parameter/wall/floor/temperature"));
    QVERIFY(dialog()->text().contains(QStringLiteral("Hot plate")));
  }

  /// Names are others' words: shown, not obeyed.
  void namesAreNoMarkup() {
    document().renameBody(document().project().bodies[0].id, QStringLiteral("<img src='file:///dev/zero'>"));
    m_window->help().open(QStringLiteral("values"));
    QVERIFY(dialog()->text().contains(QStringLiteral("<img src='file:///dev/zero'>")));
  }

  void searchFindsPages() {
    m_window->action(QStringLiteral("edit.search"))->trigger();
    m_window->palette()->field()->setText(QStringLiteral("ghost in the scene"));
    QCOMPARE(m_window->palette()->currentTitle(), QStringLiteral("Time"));
    QTest::keyClick(m_window->palette()->field(), Qt::Key_Return);
    QCOMPARE(dialog()->current(), QStringLiteral("timeline"));
  }

  void theTourHasFiveStepsAndHoldsNothingUp() {
    m_window->action(QStringLiteral("help.tour"))->trigger();
    Tour& tour = m_window->tour();
    QWidget* card = m_window->findChild<QWidget*>(QStringLiteral("psTourCard"));
    const QPoint place = card->pos();
    for (int step = 0; step < 5; ++step) {
      QCOMPARE(tour.step(), step);
      QVERIFY(card->isVisible() && m_window->rect().contains(card->geometry()));
      QCOMPARE(card->pos(), place);  // an eye that reads on need not look for it
      picture(qPrintable(QStringLiteral("tour_%1").arg(step + 1)));
      // The scene is still at hand.
      QCOMPARE(m_window->childAt(view()->mapTo(m_window.get(), view()->rect().center())), view());
      button(*card, step < 4 ? QStringLiteral("Next") : QStringLiteral("Done"))->click();
    }
    QVERIFY(!tour.running() && !card->isVisible());
    m_window->startTour();
    button(*card, QStringLiteral("Skip the tour"))->click();
    QVERIFY(!tour.running());
    m_window->startTour();
    QTest::keyClick(view(), Qt::Key_Escape);
    QVERIFY(!tour.running());
  }

  /// In a low view, too, where it comes up to the axes instead.
  void theTourLeavesTheHintsInSight() {
    constexpr int kHints = 42;  // px above the lower edge of the view at which they begin
    const QSize size = m_window->size();
    QWidget* card = m_window->findChild<QWidget*>(QStringLiteral("psTourCard"));
    for (const int height : {800, 640}) {
      m_window->resize(1280, height);
      m_window->startTour();
      const auto bottom = [&] { return view()->mapTo(m_window.get(), view()->rect().bottomLeft()).y(); };
      QTRY_VERIFY2(card->isVisible() && card->geometry().bottom() < bottom() - kHints,
                   qPrintable(QStringLiteral("%1: %2 of %3").arg(height).arg(card->geometry().bottom()).arg(bottom())));
      m_window->tour().end();
    }
    m_window->resize(size);
  }

  /// By Return too, wherever the focus came from; over the library and the plugins the scene comes back.
  void theTourGoesByTheKeyboardAndFromAnyPage() {
    for (const char* page : {"add.library", "help.plugins"}) {
      m_window->action(QString::fromLatin1(page))->trigger();
      QVERIFY(!view()->isVisible());
      m_window->action(QStringLiteral("help.tour"))->trigger();
      QVERIFY2(view()->isVisible(), page);
    }
    QWidget* card = m_window->findChild<QWidget*>(QStringLiteral("psTourCard"));
    QPushButton* next = button(*card, QStringLiteral("Next"));
    next->setFocus();
    QTest::keyClick(next, Qt::Key_Return);
    QCOMPARE(m_window->tour().step(), 1);
    QPushButton* skip = button(*card, QStringLiteral("Skip the tour"));
    skip->setFocus();
    QTest::keyClick(skip, Qt::Key_Return);
    QVERIFY(!m_window->tour().running());
  }

  /// The border of a button that has the keys says so: nothing is drawn around its words as well.
  void aButtonWithTheKeysHasOneFrame() {
    m_window->startTour();
    QWidget* card = m_window->findChild<QWidget*>(QStringLiteral("psTourCard"));
    for (const char* text : {"Next", "Skip the tour"}) {
      QPushButton* one = button(*card, QString::fromLatin1(text));
      one->setFocus();
      QTRY_VERIFY(one->hasFocus());
      const QImage image = one->grab().toImage();
      // Between the border, which is two pixels wide, and the words below.
      const double scale = image.devicePixelRatio();
      const int y = static_cast<int>(3 * scale), begin = static_cast<int>(8 * scale), end = image.width() - begin;
      QVERIFY(begin < end);
      for (int x = begin; x < end; ++x)
        QVERIFY2(image.pixel(x, y) == image.pixel(begin, y),
                 qPrintable(QStringLiteral("%1, %2").arg(one->text()).arg(x)));
    }
    m_window->tour().end();
  }

  /// The card stands beside what it speaks of, and stays there when the window grows.
  void theCardFollowsTheWindow() {
    m_window->startTour();
    m_window->tour().next();
    const auto* card = m_window->findChild<QWidget*>(QStringLiteral("psTourCard"));
    const auto gap = [this, card] {
      const Dock* dock = m_window->inspectorDock();
      return dock->mapTo(m_window.get(), QPoint()).x() - card->geometry().right();
    };
    const int before = gap();
    QVERIFY2(before > 0 && before < 40, qPrintable(QString::number(before)));
    const QSize size = m_window->size();
    m_window->resize(size + QSize(300, 120));
    QTRY_COMPARE(gap(), before);
    m_window->resize(size);
    QTRY_COMPARE(gap(), before);
  }

 private:
  HelpWindow* dialog() { return m_window->help().dialog(); }
  void f1() {
    QTest::keyClick(m_window.get(), Qt::Key_F1);
    QVERIFY(dialog() && dialog()->isVisible());
    QApplication::setActiveWindow(m_window.get());
  }
  QPushButton* button(const QWidget& in, const QString& text) {
    for (QPushButton* each : in.findChildren<QPushButton*>()) {
      if (each->text() == text) return each;
    }
    return nullptr;
  }
  void picture(const char* name) {
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (folder.isEmpty()) return;
    QTest::qWait(150);
    QWidget* shown = dialog() && dialog()->isVisible() ? static_cast<QWidget*>(dialog()) : m_window.get();
    shown->grab().save(folder + QStringLiteral("/tst_") + QString::fromLatin1(name) + QStringLiteral(".png"));
  }
};

QTEST_MAIN(TestHelp)
#include "tst_help.moc"
