// SPDX-License-Identifier: Apache-2.0
// The command palette of the whole window on a real scene: what it finds, in which order, and what follows.
#include "core/simulation/declared.h"
#include "tests/ui/samplewindow.h"
#include "ui/curves/curvetarget.h"
#include "ui/document/declared.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/panels/pluginpage.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/selection.h"
#include "ui/theme/plaintext.h"
#include "ui/window/actions.h"
#include "ui/window/dock.h"
#include "ui/window/libraryactions.h"
#include "ui/window/paneltable.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QRegularExpression>
#include <QtCore/QSet>
#include <QtCore/QSettings>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QWidgetAction>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace ps;

class TestCommandPalette : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    backToTheStart();
  }
  void cleanupTestCase() { m_window.reset(); }

  void thePaletteFindsParametersAndActions_data() {
    QTest::addColumn<QString>("query");
    QTest::addColumn<QString>("title");
    QTest::newRow("parameter") << "conductivity solid"
                               << "Conductivity, solid";
    QTest::newRow("wall") << "hot plate temperature"
                          << "Hot plate temperature";
    QTest::newRow("property of a wall") << "hot pl"
                                        << "Hot plate shape";
    QTest::newRow("what replaces the scene by its name") << "new sc"
                                                         << "New scene";
    QTest::newRow("solver") << "substeps"
                            << "Substeps";
    QTest::newRow("action") << "frame all"
                            << "Frame all";
    QTest::newRow("by key") << "thermal time scale"
                            << "Time lapse of heat";
    QTest::newRow("thing") << "ice block"
                           << "Ice block";
    QTest::newRow("row of the brush") << "steady hand"
                                      << "Steady hand";
    QTest::newRow("preference") << "copy it"
                                << "Copy it";
    QTest::newRow("property of the project") << "to try"
                                             << "To try";
  }
  void thePaletteFindsParametersAndActions() {
    QFETCH(QString, query);
    QFETCH(QString, title);
    m_window->action(QStringLiteral("edit.search"))->trigger();
    CommandPalette* palette = m_window->palette();
    QVERIFY(palette->isVisible());
    palette->field()->setText(query);
    QCOMPARE(palette->currentTitle(), title);
    palette->hide();
  }

  void thePaletteSelectsAThing() {
    m_window->action(QStringLiteral("edit.search"))->trigger();
    CommandPalette* palette = m_window->palette();
    palette->field()->setText(QStringLiteral("cold lid"));
    QTest::keyClick(palette->field(), Qt::Key_Return);
    QVERIFY(!palette->isVisible());
    QVERIFY(m_window->selection().items() == (std::vector<SelectedItem>{{OutlineKind::Wall, "lid"}}));
    m_window->selection().clear();
    m_window->viewport()->show(StandardView::Scene);
  }

  /// What stands beside a title is not in it already.
  void thePaletteSaysEachThingOnce() {
    Emitter pours;
    pours.material = "water";
    const Port tap = document().addEmitter(pours), drain = document().addSink({});
    Probe probe;
    probe.quantity = "temperature";
    document().addProbe(probe);
    const auto entries = m_window->paletteEntries();
    const auto where = [&](const char* title) {
      QStringList places;
      for (const PaletteEntry& entry : entries) {
        if (entry.title == QLatin1String(title)) places << entry.where;
      }
      return places.join(QLatin1Char(','));
    };
    QCOMPARE(document().portName(tap), QStringLiteral("Tap"));
    QCOMPARE(document().portName(drain), QStringLiteral("Drain"));
    QCOMPARE(where("Tap"), QStringLiteral("In the scene"));
    QCOMPARE(where("Tap speed"), QStringLiteral("Jet"));
    QCOMPARE(where("Drain open"), QStringLiteral("Sink"));
    QCOMPARE(where("Hot plate temperature"), QStringLiteral("Wall"));
    QCOMPARE(where("Place a tap"), QStringLiteral("Sketch"));
    for (const PaletteEntry& entry : entries) {
      QVERIFY2(entry.where.isEmpty() ||
                   !(QLatin1Char(' ') + entry.title).contains(QLatin1Char(' ') + entry.where, Qt::CaseInsensitive),
               qPrintable(entry.title + QStringLiteral(" / ") + entry.where));
    }
    for (int k = 0; k < 3; ++k) document().undoStack().undo();
  }

  /// All that menus have and all rows of panels are found by their whole titles, among the first few; what cannot be
  /// run now comes behind all that can.
  void thePaletteKnowsEveryActionAndEveryRow() {
    constexpr int kFew = 5;
    const auto entries = m_window->paletteEntries();
    QStringList missing, late;
    const auto look = [&](const QString& title, const std::function<bool(const PaletteEntry&)>& is) {
      int before = 0;
      for (const size_t k : paletteMatches(entries, title)) {
        if (is(entries[k])) {
          if (before >= kFew && entries[k].whyNot.isEmpty()) late << title;
          return;
        }
        before += entries[k].title != title ? 1 : 0;
      }
      missing << title;
    };
    const auto lookFor = [&](const QString& title) {
      look(title, [&](const PaletteEntry& entry) { return entry.title == title; });
    };
    const std::set<QString> actions = titlesInMenus();
    QVERIFY(actions.size() > 100);
    for (const QString& title : actions) lookFor(title);
    const std::set<std::string> rows = addressesOfRows();
    QVERIFY(rows.size() > 100);
    for (const std::string& text : rows) {
      const std::optional<Address> parsed = Address::parse(text);
      QVERIFY2(parsed, text.c_str());
      const Address& address = *parsed;
      const QString words = QLatin1Char(' ') + QString::fromStdString(text).replace(QLatin1Char('_'), QLatin1Char(' '));
      look(awayLabel(document().project(), address, QString::fromUtf8(document().declaration(address)->label)),
           [&](const PaletteEntry& entry) { return entry.words.endsWith(words); });
    }
    for (const ParameterRow* row : m_window->findChild<BrushPanel*>()->rows())
      lookFor(QString::fromUtf8(row->model().declaration.label));
    QVERIFY2(missing.isEmpty() && late.isEmpty(),
             qPrintable(QStringLiteral("missing: %1; late: %2")
                            .arg(missing.join(QStringLiteral(", ")), late.join(QStringLiteral(", ")))));
  }

  /// What pages of docks, the library and the plugins do by a button is found, in whatever workspace it stands, and by
  /// its place: a thing of the scene that is called as a button is does not take it away.
  void thePaletteKnowsEveryButton() {
    Body body = *document().body("ice");
    body.id = "find";
    body.name = "Find values";
    document().addBody(body);
    std::set<std::pair<QString, QString>> found;
    std::set<QString> titles;
    for (const PaletteEntry& entry : m_window->paletteEntries()) {
      found.emplace(entry.title, entry.where);
      titles.insert(entry.title);
    }
    document().undoStack().undo();
    QStringList missing;
    QSet<QString> actions;  // which do what buttons of their names do
    for (const QAction* action : m_window->findChildren<QAction*>(Qt::FindDirectChildrenOnly))
      actions.insert(fromButtonText(action->text()));
    const QRegularExpression key(QStringLiteral(" \\([^()]+\\)$"));
    int known = 0;
    const auto look = [&](const QWidget& page, const QString& place) {
      for (const QAbstractButton* button : page.findChildren<QAbstractButton*>()) {
        const QString own = button->accessibleName(), name = own.isEmpty() ? fromButtonText(button->text()) : own;
        // What scrolls tabs, and what filters.
        if (qobject_cast<const QTabBar*>(button->parentWidget()) || button->objectName() == QStringLiteral("psChip") ||
            button->objectName() == QStringLiteral("psChanged") || name.isEmpty())
          continue;
        ++known;
        if (actions.contains(QString(name).remove(key))) continue;
        const bool saysIt = (QLatin1Char(' ') + name).contains(QLatin1Char(' ') + place, Qt::CaseInsensitive);
        if (!found.count({name, saysIt ? QString() : place})) missing << name + QStringLiteral(" / ") + place;
      }
    };
    const WindowLayout& layout = m_window->layoutOfDocks();
    for (const DockRow& row : dockTable())
      look(*layout.dock(QString::fromLatin1(row.name))->titleBarWidget(), QString::fromLatin1(row.title));
    for (const PanelRow& row : panelTable()) {
      const QString title = QString::fromLatin1(row.title);
      look(*layout.dockOf(title)->page(title), title);
    }
    look(*m_window->library().page(), QStringLiteral("Materials of the library"));
    look(*m_window->pluginPage(), QStringLiteral("Plugins"));
    QVERIFY2(missing.isEmpty(), qPrintable(missing.join(QStringLiteral(", "))));
    QVERIFY(known > 50);
    QVERIFY(found.count({QStringLiteral("Find values"), QStringLiteral("Draw the result")}));
    for (const char* title : {"Fit law to points", "Sample law as points", "Mix…", "Row: reset", "Export as PNG…",
                              "Add graph: Mass by phase"})
      QVERIFY2(titles.count(QString::fromUtf8(title)), title);
    QVERIFY(!titles.count(QStringLiteral("1×")));
    QVERIFY(!paletteMatches(m_window->paletteEntries(), QStringLiteral("empty the disk")).empty());  // of a dialog
  }

  /// Pressed where it stands, which is in sight then.
  void aButtonIsPressedFromThePalette() {
    m_window->showWorkspace(MainWindow::kSceneTab);
    QVERIFY(m_window->revealParameter({Owner::Material, "water", "viscosity"}));
    m_window->curves().choose({Owner::Material, "water", "viscosity"});
    const int steps = document().undoStack().index();
    const auto entries = m_window->paletteEntries();
    const auto sample = std::find_if(entries.begin(), entries.end(), [](const PaletteEntry& entry) {
      return entry.title == QStringLiteral("Sample law as points");
    });
    QVERIFY(sample != entries.end() && sample->whyNot.isEmpty());
    sample->run();
    QCOMPARE(m_window->workspaceTab(), MainWindow::kTuneTab);
    QCOMPARE(document().undoStack().index(), steps + 1);
    document().undoStack().undo();
    m_window->showWorkspace(MainWindow::kSceneTab);
  }

  /// Each row that is found is led to.
  void whatThePaletteFindsIsShown() {
    const auto entries = m_window->paletteEntries();
    QStringList hidden;
    for (const std::string& text : addressesOfRows()) {
      const QString words = QLatin1Char(' ') + QString::fromStdString(text).replace(QLatin1Char('_'), QLatin1Char(' '));
      const auto entry = std::find_if(entries.begin(), entries.end(),
                                      [&](const PaletteEntry& one) { return one.words.endsWith(words); });
      QVERIFY2(entry != entries.end(), text.c_str());
      entry->run();
      const auto rows = m_window->findChildren<ParameterRow*>();
      const bool seen = std::any_of(rows.begin(), rows.end(), [&](const ParameterRow* row) {
        return row->key() == QString::fromStdString(text) && row->isVisible() && !row->visibleRegion().isEmpty();
      });
      if (!seen) hidden << QString::fromStdString(text);
    }
    m_window->selection().clear();
    QVERIFY2(hidden.isEmpty(), qPrintable(hidden.join(QStringLiteral(", "))));
  }

  /// The scene's own, by its name and by the tags of what is installed.
  void thePaletteFindsAMaterialByItsTags() {
    m_window->selection().setMaterial({});
    const auto entries = m_window->paletteEntries();
    const std::vector<size_t> found = paletteMatches(entries, QStringLiteral("ice water"));
    const auto water = std::find_if(found.begin(), found.end(), [&](size_t k) {
      return entries[k].title == QStringLiteral("Water") && entries[k].where == QStringLiteral("Material");
    });
    QVERIFY(water != found.end());
    entries[*water].run();
    QCOMPARE(m_window->selection().material(), std::string("water"));
  }

  /// By what its file calls it too; words that begin so come before those that hold it.
  void thePaletteFindsByOtherWords() {
    const auto entries = m_window->paletteEntries();
    const auto first = [&](const char* query) {
      const std::vector<size_t> found = paletteMatches(entries, QString::fromLatin1(query));
      return found.empty() ? QString() : entries[found.front()].title;
    };
    QCOMPARE(first("torus"), QStringLiteral("Add body: torus"));
    QCOMPARE(first("tint"), QStringLiteral("Brush shape: Paint colour"));
    QCOMPARE(first("ring"), QStringLiteral("Add body: torus"));  // and not "sharing"
    QCOMPARE(first("doughnut"), QStringLiteral("Add body: torus"));
    QCOMPARE(first("stove"), QStringLiteral("Add body: hot plate"));
  }

  /// It is found, behind what can be done.
  void whatCannotBeDoneSaysWhy() {
    const auto entries = m_window->paletteEntries();
    const auto real = std::find_if(entries.begin(), entries.end(), [](const PaletteEntry& entry) {
      return entry.title == QStringLiteral("Make it real");
    });
    QVERIFY(real != entries.end());
    const bool possible = m_window->action(QStringLiteral("sketch.real"))->isEnabled();
    QCOMPARE(real->whyNot, possible ? QString() : QStringLiteral("Nothing is held"));
    std::vector<PaletteEntry> some(2);
    some[0].title = QStringLiteral("Undo");
    some[0].whyNot = QStringLiteral("Nothing to undo");
    some[1].title = QStringLiteral("What undo does");
    QVERIFY(paletteMatches(some, QStringLiteral("undo")) == (std::vector<size_t>{1, 0}));
  }

  /// Own things first, unless it is called as one types.
  void whatReplacesTheSceneComesLater() {
    std::vector<PaletteEntry> some(2);
    some[0].title = QStringLiteral("Ice on a hot plate");
    some[0].replaces = true;
    some[1].title = QStringLiteral("Water on a hot plate");
    QVERIFY(paletteMatches(some, QStringLiteral("plate")) == (std::vector<size_t>{1, 0}));
    QVERIFY(paletteMatches(some, QStringLiteral("ice on")) == (std::vector<size_t>{0}));
    some[1].title = QStringLiteral("Cold ice on a plate");
    QVERIFY(paletteMatches(some, QStringLiteral("ice on")) == (std::vector<size_t>{0, 1}));
  }

  void thePaletteSaysThatNothingIsFound() {
    m_window->action(QStringLiteral("edit.search"))->trigger();
    CommandPalette* palette = m_window->palette();
    palette->field()->setText(QStringLiteral("x<y"));
    QCOMPARE(palette->shownCount(), 0);
    const auto labels = palette->findChildren<QLabel*>();
    const auto nothing =
        std::find_if(labels.begin(), labels.end(), [](const QLabel* label) { return label->isVisible(); });
    QVERIFY(nothing != labels.end());
    QVERIFY2((*nothing)->text().startsWith(QStringLiteral("Nothing called “x&lt;y”.")), qPrintable((*nothing)->text()));
    Q_EMIT(*nothing)->linkActivated(QStringLiteral("clear"));
    QVERIFY(palette->field()->text().isEmpty() && palette->shownCount() > 0 && !(*nothing)->isVisible());
    palette->hide();
  }

  void thePaletteFindsPinsAndMarkers() {
    m_window->selection().selectBody("ice");
    m_window->action(QStringLiteral("edit.pin"))->trigger();
    document().addMarker(0);
    m_window->selection().clear();
    const auto entries = m_window->paletteEntries();
    const auto run = [&](const QString& title) {
      const auto entry =
          std::find_if(entries.begin(), entries.end(), [&](const PaletteEntry& one) { return one.title == title; });
      if (entry == entries.end() || !entry->whyNot.isEmpty()) return false;
      entry->run();
      return true;
    };
    QVERIFY(run(QStringLiteral("Pin 1 of Ice block")));
    QCOMPARE(m_window->selection().items().size(), size_t{1});
    QCOMPARE(m_window->selection().kind(), OutlineKind::Pin);
    QCOMPARE(document().project().markers.size(), size_t{1});
    QVERIFY(run(QStringLiteral("Marker 1: Delete marker")));
    QVERIFY(document().project().markers.empty());
    m_window->selection().clear();
    for (int k = 0; k < 3; ++k) document().undoStack().undo();
    QVERIFY(document().body("ice")->pins.empty());
    m_window->viewport()->show(StandardView::Scene);
  }

  void thePaletteJumpsToARow() {
    QVERIFY(m_window->revealParameter({Owner::Solver, "", "substeps"}));
    QCOMPARE(m_window->inspectorDock()->currentPage(), QStringLiteral("Solver"));
    QVERIFY(m_window->revealParameter({Owner::Material, "water", "viscosity"}));
    QCOMPARE(m_window->inspectorDock()->currentPage(), QStringLiteral("Material"));
  }

  /// With their folders, and those alone that are still there. It is the last: another project is open then.
  void thePaletteOpensWhatWasOpenLately() {
    const QString path = m_directory.filePath(QStringLiteral("Ice of yesterday.json"));
    QVERIFY(QFile::copy(kSample, path));
    const QVariant before = QSettings().value(QStringLiteral("files/recent"));
    QSettings().setValue(QStringLiteral("files/recent"),
                         QStringList{path, m_directory.filePath(QStringLiteral("gone.json"))});
    const auto entries = m_window->paletteEntries();
    QSettings().setValue(QStringLiteral("files/recent"), before);
    const std::vector<size_t> found = paletteMatches(entries, QStringLiteral("ice of yesterday"));
    QVERIFY(!found.empty());
    const PaletteEntry& entry = entries[found.front()];
    QCOMPARE(entry.title, QStringLiteral("Open recent: Ice of yesterday"));
    QCOMPARE(entry.where, QDir::toNativeSeparators(m_directory.path()));
    QVERIFY(entry.replaces && entry.whyNot.isEmpty());
    QVERIFY(paletteMatches(entries, QStringLiteral("open recent: gone")).empty());
    entry.run();
    QTRY_COMPARE_WITH_TIMEOUT(document().path(), path, kLong);
  }

 private:
  QTemporaryDir m_directory;
  /// Without what menus are filled with when they are opened.
  std::set<QString> titlesInMenus() {
    const QStringList filledWhenOpened{QStringLiteral("Open recent"), QStringLiteral("Earlier versions"),
                                       QStringLiteral("Favourite brushes")};
    std::set<QString> titles;
    const std::function<void(const QList<QAction*>&)> walk = [&](const QList<QAction*>& all) {
      for (const QAction* action : all) {
        if (const QMenu* menu = action->menu()) {
          if (!filledWhenOpened.contains(menu->title())) walk(menu->actions());
        } else if (!action->isSeparator() && !qobject_cast<const QWidgetAction*>(action)) {
          titles.insert(cleanText(*action));
        }
      }
    };
    walk(m_window->findChild<QMenuBar*>()->actions());
    return titles;
  }
  /// Of all that the scene declares, and of what the panels show.
  std::set<std::string> addressesOfRows() {
    std::set<std::string> rows;
    const auto add = [&](const Address& address) {
      if (document().declaration(address)) rows.insert(address.text());
    };
    for (const Address& address : allAddresses(document().project(), session().plugins())) add(address);
    const Inspector& inspector = m_window->inspector();
    const std::vector<SelectedItem> selected{{OutlineKind::Body, "ice"}, {OutlineKind::Probe, "mean"}};
    for (const SelectedItem& item : selected) {
      m_window->selection().select(item.kind, item.id);
      for (const ParameterPanel* panel :
           {inspector.bodyPanel(), inspector.materialPanel(), inspector.scenePanel(), inspector.solverPanel()}) {
        for (const ParameterRow* row : panel->rows()) {
          if (const auto address = Address::parse(row->key().toStdString())) add(*address);
        }
      }
    }
    m_window->selection().clear();
    return rows;
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestCommandPalette test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_commandpalette.moc"
