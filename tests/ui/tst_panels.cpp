// SPDX-License-Identifier: Apache-2.0
#include "tests/ui/rowtesting.h"
#include "ui/rows/groupheading.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QPointer>
#include <QtCore/QTimer>
#include <QtGui/QContextMenuEvent>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QToolTip>

using namespace ps;
using namespace ps::testing;

namespace {

/// Opens a row's menu by the keyboard and takes the entry that begins with `text`.
void chooseFromMenu(ParameterRow& row, const QString& text) {
  bool found = false;
  QTimer::singleShot(0, &row, [&] {
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    for (QAction* action : menu->actions()) {
      if (!action->text().startsWith(text)) continue;
      found = true;
      menu->setActiveAction(action);
    }
    QTest::keyClick(menu, found ? Qt::Key_Return : Qt::Key_Escape);
  });
  QContextMenuEvent ask(QContextMenuEvent::Keyboard, QPoint(20, 10), row.mapToGlobal(QPoint(20, 10)));
  QApplication::sendEvent(&row, &ask);
  QVERIFY2(found, qPrintable(text));
}

/// All rows once in each of some groups, under keys of their own: "Cold lid/conductivity".
std::vector<RowModel> inGroups(std::initializer_list<const char*> groups) {
  std::vector<RowModel> rows;
  for (const char* name : groups) {
    for (RowModel& row : rowModels(list(), {}, {}, QString::fromLatin1(name) + QLatin1Char('/'))) {
      row.declaration.group = name;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

class TestPanels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void panelGroupsAndFilters();
  void headingsCountWhatIsShown();
  void revealPutsTheHeadingOnTop();
  void notesMoveNoRowUnderThePointer();
  void explainShowsTheTip();
  void pinnedOriginalsOfferTheWayBack();
  void panelCountsChanges();
  void pinnedRowsFollowTheirOriginals();
  void panelKeepsFoldsOverAModel();
  void aNewModelEndsOpenGestures_data();
  void aNewModelEndsOpenGestures();
  void aRowMayAskForANewModel();
  void changedMeansOtherThanTheMaterial();
  void aMaterialsOwnValueIsUsual();
  void emptyPanelHasItsSentence();
  void noTextIsCut_data();
  void noTextIsCut();
  void wideSymbolsAreWhole();
  void captionsStandWholeOrNotAtAll();
  void aLongLabelTakesItsSlidersRoom();
  void themeChangesWhileRunning();
};

void TestPanels::panelGroupsAndFilters() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.resize(392, 600);
  show(panel);
  const auto shown = [&panel] {
    QStringList keys;
    for (const ParameterRow* row : panel.rows()) {
      if (panel.isRowShown(row)) keys << row->key();
    }
    return keys.join(QLatin1Char(' '));
  };
  // Groups in the order in which they first appear: all of Heat, then Mechanics.
  QCOMPARE(shown(), QStringLiteral("plate_temperature conductivity youngs_modulus substeps gravity_on kernel"));
  panel.setFilter(QStringLiteral("TEMP"));
  QCOMPARE(shown(), QStringLiteral("plate_temperature"));
  panel.setGroupFolded(QStringLiteral("Heat"), true);
  QCOMPARE(shown(), QStringLiteral("plate_temperature"));  // what is searched for is not hidden by a fold
  panel.setFilter({});
  QCOMPARE(shown(), QStringLiteral("youngs_modulus substeps gravity_on kernel"));
  panel.setFilter(QStringLiteral("xyzzy"));
  QCOMPARE(shown(), QString());
  bool said = false;
  for (const QLabel* label : panel.findChildren<QLabel*>())
    said |= label->isVisible() && label->text().contains(QStringLiteral("xyzzy"));
  QVERIFY(said);
  for (QLabel* label : panel.findChildren<QLabel*>()) {
    if (label->text().contains(QStringLiteral("xyzzy"))) Q_EMIT label->linkActivated(QStringLiteral("clear"));
  }
  QCOMPARE(shown(), QStringLiteral("youngs_modulus substeps gravity_on kernel"));
  panel.setFilter(QStringLiteral("xyzzy"));
  QVERIFY(panel.reveal(QStringLiteral("conductivity")));
  QVERIFY(panel.isRowShown(panel.row(QStringLiteral("conductivity"))));
  QTRY_VERIFY(panel.row(QStringLiteral("conductivity"))->hasFocus());
  QVERIFY(!panel.reveal(QStringLiteral("nothing")));
}

void TestPanels::headingsCountWhatIsShown() {
  std::vector<RowModel> rows = rowModels(list(), {});
  RowModel pinned = rows[0];
  pinned.pinned = true;
  rows.push_back(pinned);
  ParameterPanel panel;
  panel.setModel(rows);
  const auto counts = [&panel] {
    QStringList texts;
    for (const GroupHeading* heading : panel.findChildren<GroupHeading*>()) {
      if (!heading->isHidden()) texts << heading->title() + QLatin1Char(' ') + heading->count();
    }
    return texts.join(QStringLiteral(", "));
  };
  QCOMPARE(counts(), QStringLiteral("Try these 1 pinned, Heat 2, Mechanics 4"));
  panel.setFilter(QStringLiteral("conductivity"));
  QCOMPARE(counts(), QStringLiteral("Heat 1 of 2"));
  panel.setFilter({});
  panel.setChangedOnly(true);
  panel.row(QStringLiteral("substeps"))->enter(QStringLiteral("7"));
  panel.setFilter(QStringLiteral("substeps"));
  QCOMPARE(counts(), QStringLiteral("Mechanics 1 of 4"));
}

/// A group far down is seen whole, from its heading on, and who asked keeps the focus where told so.
void TestPanels::revealPutsTheHeadingOnTop() {
  ParameterPanel panel;
  panel.setModel(inGroups({"Left side", "Right side", "Cold lid", "Hot plate", "Front"}));
  panel.resize(392, 300);
  show(panel);
  QVERIFY(panel.reveal(QStringLiteral("Cold lid/plate_temperature"), false));
  const ParameterRow* row = panel.row(QStringLiteral("Cold lid/plate_temperature"));
  QVERIFY(!row->hasFocus());
  const auto* scroll = panel.findChild<QScrollArea*>();
  for (const GroupHeading* heading : panel.findChildren<GroupHeading*>()) {
    if (heading->title() == QStringLiteral("Cold lid")) {
      QCOMPARE(heading->mapTo(scroll->viewport(), QPoint(0, 0)).y(), 0);
    }
  }
  panel.setGroupFolded(QStringLiteral("Hot plate"), true);
  QVERIFY(panel.reveal(QStringLiteral("Hot plate/conductivity")));
  QTRY_VERIFY(panel.row(QStringLiteral("Hot plate/conductivity"))->hasFocus());
  QVERIFY(scroll->viewport()->rect().contains(
      panel.row(QStringLiteral("Hot plate/conductivity"))->mapTo(scroll->viewport(), QPoint(1, 1))));
}

/// The tip asked for by the menu outlives the events that the closing menu leaves behind.
void TestPanels::explainShowsTheTip() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.resize(392, 600);
  show(panel);
  chooseFromMenu(*panel.row(QStringLiteral("conductivity")), QStringLiteral("Explain"));
  // As the window system has it: the window is activated once the menu has let go of the keys.
  QCoreApplication::postEvent(&panel, new QEvent(QEvent::WindowActivate));
  QTRY_VERIFY(QToolTip::isVisible());
  QTest::qWait(400);  // a tip that is sent away goes after 300 ms
  QVERIFY(QToolTip::isVisible());
  QVERIFY2(QToolTip::text().contains(QStringLiteral("How well heat passes")), qPrintable(QToolTip::text()));
  QToolTip::hideText();
}

void TestPanels::pinnedOriginalsOfferTheWayBack() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  QList<bool> asked;
  connect(&panel, &ParameterPanel::pinToggled, &panel, [&asked](const QString&, bool pinned) { asked << pinned; });
  panel.setModel(rowModels(list(), {}));  // rows offer what is listened to
  panel.resize(392, 600);
  show(panel);
  ParameterRow& row = *panel.row(QStringLiteral("conductivity"));
  chooseFromMenu(row, QStringLiteral("Pin to"));
  panel.setPinned({QStringLiteral("conductivity")});
  chooseFromMenu(row, QStringLiteral("Remove from"));
  QCOMPARE(asked, (QList<bool>{true, false}));
  panel.setModel(rowModels(list(), {}));
  QVERIFY(panel.row(QStringLiteral("conductivity"))->model().isPinned);
  QVERIFY(!panel.row(QStringLiteral("substeps"))->model().isPinned);
}

void TestPanels::panelCountsChanges() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  QCOMPARE(panel.changedCount(), 0);
  QList<Edit> edits;
  connect(&panel, &ParameterPanel::edited, &panel,
          [&edits](const QString&, const Value&, Edit edit) { edits << edit; });
  panel.row(QStringLiteral("conductivity"))->enter(QStringLiteral("3"));
  QCOMPARE(edits, (QList<Edit>{Edit::Begin, Edit::Live, Edit::End}));
  QCOMPARE(panel.changedCount(), 1);
  panel.setChangedOnly(true);
  QVERIFY(panel.isRowShown(panel.row(QStringLiteral("conductivity"))));
  QVERIFY(!panel.isRowShown(panel.row(QStringLiteral("substeps"))));
  panel.setValue(QStringLiteral("conductivity"), Response(2.2));
  QCOMPARE(panel.changedCount(), 0);
  QCOMPARE(edits.size(), 3);  // what comes from outside is not told back
}

void TestPanels::pinnedRowsFollowTheirOriginals() {
  std::vector<RowModel> rows = rowModels(list(), {});
  RowModel pinned = rows[0];
  pinned.pinned = true;
  rows.push_back(pinned);
  ParameterPanel panel;
  panel.setModel(rows);
  const std::vector<ParameterRow*> all = panel.rows();
  QCOMPARE(all[0]->key(), all[1]->key());  // "Try these" stands on top
  all[0]->enter(QStringLiteral("50"));
  QCOMPARE(all[1]->number(), 323.15);
  QCOMPARE(panel.changedCount(), 1);
}

void TestPanels::panelKeepsFoldsOverAModel() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.setGroupFolded(QStringLiteral("Heat"), true);
  panel.setModel(rowModels(list(), {}, {}, QStringLiteral("material/wax/")));
  QVERIFY(!panel.isRowShown(panel.row(QStringLiteral("material/wax/conductivity"))));
  QVERIFY(panel.isRowShown(panel.row(QStringLiteral("material/wax/substeps"))));
}

void TestPanels::aNewModelEndsOpenGestures_data() {
  QTest::addColumn<bool>("released");
  QTest::newRow("while the handle is held") << false;
  QTest::newRow("before the gesture has settled") << true;
}

/// Rows that go tell their End: a document would stay in the gesture otherwise.
void TestPanels::aNewModelEndsOpenGestures() {
  QFETCH(bool, released);
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.resize(392, 600);
  show(panel);
  QList<Edit> edits;
  connect(&panel, &ParameterPanel::edited, &panel,
          [&edits](const QString&, const Value&, Edit edit) { edits << edit; });
  ParameterRow* row = panel.row(QStringLiteral("plate_temperature"));
  drag(*row, onSlider(*row, 0.2), onSlider(*row, 0.6));
  if (released) QTest::mouseRelease(row, Qt::LeftButton, {}, onSlider(*row, 0.6));
  QVERIFY(edits.size() > 1 && edits.front() == Edit::Begin && edits.back() == Edit::Live);
  panel.setModel(rowModels(list(), {}));
  QCOMPARE(edits.count(Edit::End), qsizetype{1});
  QCOMPARE(edits.back(), Edit::End);
  QTest::qWait(kSettleMilliseconds + 50);
  QCOMPARE(edits.count(Edit::End), qsizetype{1});
}

/// As "Pin to Try these" does from a row's menu: the row on the call stack lives until it has returned.
void TestPanels::aRowMayAskForANewModel() {
  ParameterPanel panel;
  connect(&panel, &ParameterPanel::pinToggled, &panel, [&panel] { panel.setModel(rowModels(list(), {})); });
  panel.setModel(rowModels(list(), {}));
  panel.resize(392, 600);
  show(panel);
  const QPointer<ParameterRow> row = panel.row(QStringLiteral("substeps"));
  QTimer::singleShot(0, &panel, [] {
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    for (QAction* action : menu->actions()) {
      if (action->text().startsWith(QStringLiteral("Pin"))) menu->setActiveAction(action);
    }
    QTest::keyClick(menu, Qt::Key_Return);
  });
  bool alive = false;
  connect(&panel, &ParameterPanel::pinToggled, &panel, [&] { alive = row != nullptr; });
  QContextMenuEvent ask(QContextMenuEvent::Keyboard, QPoint(20, 10), row->mapToGlobal(QPoint(20, 10)));
  QApplication::sendEvent(row, &ask);
  QVERIFY(alive);
  QVERIFY(panel.row(QStringLiteral("substeps")) != row);
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  QVERIFY(!row);
}

void TestPanels::changedMeansOtherThanTheMaterial() {
  ParameterSet base, own;
  base.values["conductivity"] = Response(0.6);
  ParameterRow row(rowModels(list(), own, base)[5]);
  QCOMPARE(row.number(), 0.6);  // what is not set has the material's value, not the catalogue's
  QVERIFY(!row.isChanged());
  row.enter(QStringLiteral("2.2"));
  QVERIFY(row.isChanged());
  row.reset();
  QCOMPARE(row.number(), 0.6);
  QVERIFY(sameValue(Value(0.6), Value(Response(0.6))));
}

/// Beyond the slider is what somebody sets there, not what the material has by itself.
void TestPanels::aMaterialsOwnValueIsUsual() {
  ParameterSet base, own;
  base.values["conductivity"] = Response(400.0);
  ParameterRow row(rowModels(list(), own, base)[5]);
  QVERIFY(isOutOfRange(row.model().declaration, row.number()));
  QVERIFY(!row.has(RowState::OutOfRange) && !row.has(RowState::Changed));
  QVERIFY(row.enter(QStringLiteral("399")));
  QVERIFY(row.has(RowState::OutOfRange));
  row.reset();
  QVERIFY(!row.has(RowState::OutOfRange));
}

void TestPanels::emptyPanelHasItsSentence() {
  ParameterPanel panel;
  panel.resize(392, 300);
  show(panel);
  bool said = false;
  for (const QLabel* label : panel.findChildren<QLabel*>()) {
    said |= label->isVisible() && label->text() == QStringLiteral("Select something, or press Ctrl+K");
  }
  QVERIFY(said);
}

void TestPanels::noTextIsCut_data() {
  QTest::addColumn<int>("width");
  QTest::addColumn<bool>("symbols");
  QTest::newRow("1280") << 332 << false;
  QTest::newRow("1600") << 392 << true;
  QTest::newRow("2560") << 460 << true;
}

/// Labels are whole at every size of the window; where room is short, symbols go first.
void TestPanels::noTextIsCut() {
  QFETCH(int, width);
  QFETCH(bool, symbols);
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.resize(width, 600);
  show(panel, width);
  for (const ParameterRow* row : panel.rows()) {
    QVERIFY2(row->labelRect().width() >= row->wantedLabelWidth() - 3, qPrintable(row->key()));
    QVERIFY(row->fieldRect().right() < row->width());
    QVERIFY(row->sliderRect().width() >= kMinimumSlider);
  }
  const ParameterRow* row = panel.row(QStringLiteral("conductivity"));
  QCOMPARE(row->sliderRect().left() - row->labelRect().right() > kSymbolWidth - 2, symbols);
}

/// A symbol that is wider than the column of symbols begins before it, and ends before the slider.
void TestPanels::wideSymbolsAreWhole() {
  std::vector<RowModel> models = rowModels(list(), {});
  models.front().declaration.symbol = "Q_ambient";
  const double wide = symbolWidth(QStringLiteral("Q_ambient"));
  QVERIFY(wide > kSymbolWidth);
  ParameterRow row(models.front());
  row.resize(460, kRowHeight);
  row.setLabelWidth(160);
  QVERIFY(row.sliderRect().left() - row.labelRect().right() - 1 >= wide);
}

/// What is short of room gives up its captions, the name last.
void TestPanels::captionsStandWholeOrNotAtAll() {
  PanelHeader header;
  header.setTexts(QStringLiteral("Water"), QStringLiteral("Ice block, a bonded solid"),
                  QStringLiteral("Reference data of grade A, from more than one source"));
  const int all = header.heightForWidth(600), subtitle = header.heightForWidth(220), name = header.heightForWidth(120);
  QCOMPARE(all, 64);
  QCOMPARE(subtitle, 48);
  QCOMPARE(name, 30);
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.setHeader(QStringLiteral("Water"), QStringLiteral("Ice block, a bonded solid"),
                  QStringLiteral("Reference data of grade A, from more than one source"));
  show(panel, 600);
  auto* shown = panel.findChild<PanelHeader*>();
  QTRY_COMPARE(shown->height(), all);
  panel.resize(250, 400);
  QTRY_COMPARE(shown->height(), subtitle);
  QVERIFY(shown->toolTip().contains(QStringLiteral("more than one source")));
}

void TestPanels::aLongLabelTakesItsSlidersRoom() {
  std::vector<RowModel> models = rowModels(list(), {});
  models.front().declaration.label = "Temperature of warm plate";
  ParameterPanel panel;
  panel.setModel(models);
  show(panel, 332);
  const ParameterRow *longest = panel.rows().front(), *other = panel.row(QStringLiteral("youngs_modulus"));
  QVERIFY(longest->wantedLabelWidth() > 150);
  QVERIFY(longest->labelRect().width() >= longest->wantedLabelWidth() - 1);
  QVERIFY(longest->sliderRect().width() >= kLeastSlider);
  QVERIFY(other->sliderRect().width() >= kMinimumSlider);
  QCOMPARE(longest->sliderRect().right(), other->sliderRect().right());
}

/// A note that comes or goes above the row under the pointer leaves that where it is.
void TestPanels::notesMoveNoRowUnderThePointer() {
  ParameterPanel panel;
  panel.setModel(inGroups({"One", "Two", "Three", "Four"}));
  panel.resize(392, 300);
  show(panel);
  const auto* scroll = panel.findChild<QScrollArea*>();
  ParameterRow* row = panel.row(QStringLiteral("Two/conductivity"));
  QVERIFY(panel.reveal(row->key(), false));
  const QPoint rest = QCursor::pos();
  QCursor::setPos(row->mapToGlobal(row->rect().center()));
  QTRY_COMPARE(QCursor::pos(), row->mapToGlobal(row->rect().center()));
  const auto top = [&] { return row->mapTo(scroll->viewport(), QPoint()).y(); };
  const int before = top(), height = scroll->widget()->height();
  panel.setLimit(QStringLiteral("One/conductivity"), QStringLiteral("The solver reaches less than that."));
  QTRY_VERIFY(scroll->widget()->height() > height);
  QCOMPARE(top(), before);
  panel.setError(QStringLiteral("One/plate_temperature"), QStringLiteral("Below 0 K there is nothing."));
  QCOMPARE(top(), before);
  panel.setLimit(QStringLiteral("One/conductivity"), {});
  panel.setError(QStringLiteral("One/plate_temperature"), {});
  QTRY_COMPARE(scroll->widget()->height(), height);
  QCOMPARE(top(), before);
  QCursor::setPos(rest);
}

/// A panel on the screen takes the other theme's colours at once, notes with links included.
void TestPanels::themeChangesWhileRunning() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.resize(392, 400);
  panel.setLimit(QStringLiteral("youngs_modulus"), QStringLiteral("Less. [Mend](it)"));
  show(panel);
  const auto corner = [&panel] { return panel.grab().toImage().pixelColor(3, 60); };
  QCOMPARE(corner(), Theme::load(true)[Token::Panel]);
  Theme::apply(*qobject_cast<QApplication*>(qApp), false);
  QCOMPARE(corner(), Theme::load(false)[Token::Panel]);
  const auto* note = panel.findChild<QLabel*>(QStringLiteral("psLimit"));
  QVERIFY(note->text().contains(Theme::load(false)[Token::Accent].name()));
  Theme::apply(*qobject_cast<QApplication*>(qApp), true);
  QCOMPARE(corner(), Theme::load(true)[Token::Panel]);
}

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme::apply(application, true);
  TestPanels test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_panels.moc"
