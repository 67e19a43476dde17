// SPDX-License-Identifier: Apache-2.0
// The dialog of preferences: each choice acts at once, and stands there the next time.
#include "core/io/projectio.h"
#include "core/simulation/runrecord.h"
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/film/thumbnail.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/help/helpwindow.h"
#include "ui/library/materiallibrary.h"
#include "ui/panels/inspector.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/preferences.h"
#include "ui/session/selection.h"
#include "ui/timeline/transport.h"
#include "ui/tools/navigation.h"
#include "ui/window/filenames.h"
#include "ui/window/help.h"
#include "ui/window/libraryactions.h"
#include "ui/window/preferenceswindow.h"
#include "ui/window/projectwindow.h"
#include "ui/window/shortcutswindow.h"

#include <QtCore/QDir>
#include <QtCore/QPointer>
#include <QtCore/QSettings>
#include <QtCore/QStorageInfo>
#include <QtCore/QTemporaryDir>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPlainTextEdit>
#include <QtWidgets/QPushButton>

#include <algorithm>

using namespace ps;

Q_DECLARE_METATYPE(ps::MousePreset)

class TestPreferences : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QSettings().clear();
    open();
    QVERIFY(m_window);
  }
  void cleanup() { delete dialog(); }
  void cleanupTestCase() { QSettings().clear(); }

  void everyChoiceActsAndStays() {
    openDialog();
    pick("Theme", "Light");
    QVERIFY(!Theme::current().dark());
    pick("Theme", "Dark");
    QVERIFY(Theme::current().dark());
    pick("Copy it", "Every minute");
    QCOMPARE(preferences::autosaveInterval(), 60);
    QVERIFY(preferences::vibration() > 0);
    pick("Vibration", "None");
    QCOMPARE(preferences::vibration(), 0);
    pick("Main hand", "Left");
    QVERIFY(preferences::leftHanded());
    pick("Hands in use", "The main one alone");
    QVERIFY(preferences::oneHanded());
    pick("Seated height", "30 cm higher");
    QCOMPARE(preferences::seatedHeight(), 30);
    pick("In memory, at most", "512 MiB");
    QCOMPARE(preferences::recordBudget().memory, size_t{512} << 20);
    pick("On the disk, at most", "Nothing");
    QCOMPARE(preferences::recordBudget().disk, size_t{0});
    delete dialog();
    openDialog();
    QCOMPARE(field<QComboBox>("Copy it")->currentText(), QStringLiteral("Every minute"));
    QCOMPARE(field<QComboBox>("Vibration")->currentText(), QStringLiteral("None"));
    QCOMPARE(field<QComboBox>("Main hand")->currentText(), QStringLiteral("Left"));
    QCOMPARE(field<QComboBox>("Hands in use")->currentText(), QStringLiteral("The main one alone"));
    QCOMPARE(field<QComboBox>("Seated height")->currentText(), QStringLiteral("30 cm higher"));
    QCOMPARE(field<QComboBox>("In memory, at most")->currentText(), QStringLiteral("512 MiB"));
    QCOMPARE(field<QComboBox>("On the disk, at most")->currentText(), QStringLiteral("Nothing"));
  }

  /// By their menus; what is typed for a step is taken as a number with a unit, or told of.
  void handlesAreKept() {
    Toolbox& tools = m_window->tools();
    tools.activate("move");
    m_window->action(QStringLiteral("edit.snap"))->trigger();
    m_window->action(QStringLiteral("edit.snap.surfaces"))->trigger();
    m_window->action(QStringLiteral("edit.pivot.each"))->trigger();
    QVERIFY(tools.handles().snap.on && tools.handles().snap.surfaces && tools.handles().pivot == Pivot::Each);
    QVERIFY(m_window->action(QStringLiteral("edit.snap"))->isChecked());
    const auto type = [this](const char* label, const char* text) {
      for (QLineEdit* line : m_window->findChildren<QLineEdit*>()) {
        if (line->accessibleName() != QLatin1String(label)) continue;
        line->setText(QString::fromUtf8(text));
        line->setModified(true);
        Q_EMIT line->editingFinished();
        return line->text();
      }
      return QString();
    };
    QCOMPARE(type("Moves by", "5 mm"), QStringLiteral("5 mm"));
    QCOMPARE(type("Turns by", "30"), QStringLiteral("30 °"));
    QCOMPARE(type("Scales by", "0"), QStringLiteral("0.1"));
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("Must be at least")),
             qPrintable(m_window->notice()->text()));
    QCOMPARE(tools.handles().snap.move, 0.005);
    QCOMPARE(tools.handles().snap.turn, 30.0);
    QCOMPARE(tools.handles().snap.scale, 0.1);
    QCOMPARE(preferences::handles(), tools.handles());
    const auto gestures = tools.tool().gestures();
    QVERIFY(std::any_of(gestures.begin(), gestures.end(), [](const Gesture& gesture) {
      return gesture.does.contains(QStringLiteral("freely, not by steps of 5 mm"));
    }));
    QCOMPARE(type("Moves by", "spacing"), QStringLiteral("spacing"));
    QCOMPARE(preferences::handles().snap.move, 0.0);
    tools.setHandles({});
    preferences::setHandles({});
    tools.activate("select");
  }

  /// In rows, graphs, legend and outliner, and typed values; the document stays in kelvin.
  void temperaturesAreShownAsPreferred() {
    const Address floor{Owner::Wall, "floor", "temperature"};
    QVERIFY(m_window->revealParameter(floor));
    const auto row = [this, &floor] {
      return m_window->inspector().panelFor(floor)->row(QString::fromStdString(floor.text()));
    };
    QCOMPARE(row()->valueText(), QStringLiteral("146.9 °C"));
    openDialog();
    pick("Temperatures", "Degrees Fahrenheit, °F");
    QCOMPARE(row()->valueText(), QStringLiteral("296.3 °F"));
    QVERIFY(row()->enter(QStringLiteral("212")));
    QVERIFY(std::abs(std::get<double>(document().value(floor)) - 373.15) < 1e-9);
    QVERIFY(row()->enter(QStringLiteral("100 °C")));
    QCOMPARE(row()->valueText(), QStringLiteral("212.0 °F"));
    QVERIFY(m_window->graphs()->valuesIn("K"));
    QCOMPARE(m_window->graphs()->valuesIn("K")->axes().front().unit, QStringLiteral("°F"));
    picture(QStringLiteral("tst_preferences_fahrenheit.png"));
    pick("Temperatures", "Kelvin, K");
    QCOMPARE(row()->valueText(), QStringLiteral("373.2 K"));
    QCOMPARE(temperatureText(300, 1), QStringLiteral("300.0 K"));
    QCOMPARE(preferences::temperatures(), TemperatureUnit::Kelvin);
    pick("Temperatures", "Degrees Celsius, °C");
    QCOMPARE(row()->valueText(), QStringLiteral("100.0 °C"));
    while (document().undoStack().canUndo()) document().undoStack().undo();
  }

  void piecesMayStayWithTheirBody() {
    QVERIFY(preferences::piecesBecomeBodies());
    openDialog();
    pick("Pieces that are cut off", "Stay with their body");
    QVERIFY(!preferences::piecesBecomeBodies());
    pick("Pieces that are cut off", "Become bodies");
    QVERIFY(preferences::piecesBecomeBodies());
  }

  /// A value that is none of those offered is shown, and stays.
  void otherValuesAreShown() {
    preferences::setAutosaveInterval(45);
    QSettings().setValue(QStringLiteral("recording/disk"), QStringLiteral("much"));
    openDialog();
    QCOMPARE(field<QComboBox>("Copy it")->currentText(), QStringLiteral("Every 45 s"));
    QCOMPARE(preferences::recordDisk(), 8192);
    preferences::setRecordDisk(1 << 24);  // more than there is
    const QStorageInfo disk(QDir::tempPath());
    preferences::setRecordFolder(QDir::tempPath() + QStringLiteral("/not/there/yet"));
    QVERIFY(preferences::recordBudget().disk <= static_cast<size_t>(disk.bytesTotal()));
    QVERIFY(preferences::recordBudget().disk > 0);
    preferences::setRecordFolder({});
    preferences::setRecordDisk(8192);
  }

  /// Each is chosen in the dialog, acts, and goes back to the usual one.
  void foldersAreChosen() {
    const QTemporaryDir folder;
    openDialog();
    const auto button = [this](const char* which, const char* act) {
      const QString name = QString::fromLatin1(which) + QStringLiteral(": ") + QString::fromUtf8(act);
      return field<QPushButton>(name.toUtf8().constData());
    };
    for (const char* which : {"Projects", "Presets", "Plugins"}) {
      QPushButton* reset = button(which, "Reset");
      QVERIFY2(reset && !reset->isEnabled(), which);
      hands::answerDialog(folder.path());
      button(which, "Choose…")->click();
      QVERIFY2(reset->isEnabled(), which);
    }
    const QString pictures = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!pictures.isEmpty()) dialog()->grab().save(pictures + QStringLiteral("/tst_preferences_folders.png"));
    QCOMPARE(preferences::projectFolder(), folder.path());
    QCOMPARE(folderBeside(session()), folder.path());  // a sample has none of its own
    QCOMPARE(m_window->library().library().folder(), folder.path());
    QCOMPARE(preferences::folder(preferences::Folder::Plugins), folder.path());
    const auto labels = dialog()->findChildren<QLabel*>();
    QVERIFY(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
      return label->isVisible() && label->text().startsWith(QStringLiteral("Start the program again"));
    }));
    for (const char* which : {"Projects", "Presets", "Plugins"}) button(which, "Reset")->click();
    QVERIFY(preferences::projectFolder() != folder.path());
    QCOMPARE(m_window->library().library().folder(), MaterialLibrary::usualFolder());
    QCOMPARE(preferences::folder(preferences::Folder::Plugins), QString());
  }

  /// The memory is soon full; what is on the disk is counted, and forgotten by the button.
  void theDiskIsFilledAndEmptied() {
    session().engine()->setRecordBudget({size_t{3} << 20, size_t{1} << 30, preferences::recordFolder().toStdString()});
    session().play();
    const auto disk = [this] { return session().engine()->recording().cost().disk; };
    QTRY_VERIFY_WITH_TIMEOUT(disk() > size_t{1} << 20, kLong);
    session().pause();
    session().engine()->recording().settle();
    QVERIFY(session().engine()->recording().cost().bytes <= size_t{3} << 20);
    openDialog();
    QVERIFY(QDir(preferences::recordFolder()).isEmpty());
    QVERIFY2(field<QLabel>("Used now")->text().endsWith(QStringLiteral(" of the disk")),
             qPrintable(field<QLabel>("Used now")->text()));
    picture(QStringLiteral("tst_preferences_window.png"));
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) dialog()->grab().save(folder + QStringLiteral("/tst_preferences_dark.png"));
    pick("Theme", "Light");
    if (!folder.isEmpty()) dialog()->grab().save(folder + QStringLiteral("/tst_preferences_light.png"));
    pick("Theme", "Dark");
    const size_t before = disk();
    for (auto* button : dialog()->findChildren<QPushButton*>()) {
      if (button->text() == QStringLiteral("Empty the disk")) QTest::mouseClick(button, Qt::LeftButton);
    }
    session().engine()->recording().settle();
    QVERIFY(disk() < before / 2);
    QVERIFY(session().engine()->recording().extent().frames > 1);
  }

  void presets_data() {
    QTest::addColumn<MousePreset>("preset");
    QTest::addColumn<QString>("choice");
    QTest::addColumn<QString>("tool");
    QTest::addColumn<Qt::MouseButton>("button");
    QTest::addColumn<int>("keys");
    QTest::addColumn<QString>("moves");
    QTest::addColumn<QString>("hint");
    const auto row = [](MousePreset preset, const char* tool, Qt::MouseButton button, Qt::KeyboardModifiers keys,
                        const char* moves, const char* hint) {
      const QString choice = nameOf(preset);
      const QString name = QStringLiteral("%1 %2 %3").arg(choice, QLatin1String(tool), QLatin1String(hint));
      QTest::newRow(qPrintable(name + QLatin1Char(' ') + QLatin1String(moves)))
          << preset << choice << QString::fromLatin1(tool) << button << static_cast<int>(keys)
          << QString::fromLatin1(moves) << QString::fromLatin1(hint);
    };
    using enum MousePreset;
    constexpr auto kLeft = Qt::LeftButton, kMiddle = Qt::MiddleButton, kRight = Qt::RightButton;
    constexpr auto kShift = Qt::ShiftModifier, kControl = Qt::ControlModifier, kAlt = Qt::AltModifier;
    row(PhaseSketch, "select", kLeft, {}, "turns", "Drag");
    row(PhaseSketch, "select", kLeft, kShift, "shifts", "Shift+Drag");
    row(PhaseSketch, "select", kMiddle, {}, "shifts", "Middle-drag");
    row(PhaseSketch, "brush", kLeft, kAlt, "turns", "Alt+Drag");
    row(PhaseSketch, "brush", kMiddle, {}, "turns", "Middle-drag");
    row(PhaseSketch, "brush", kMiddle, kShift, "shifts", "Shift+Middle-drag");
    row(PhaseSketch, "select", kRight, {}, "nears", "Right-drag");
    for (const char* tool : {"select", "brush"}) {
      row(Blender, tool, kMiddle, {}, "turns", "Middle-drag");
      row(Blender, tool, kLeft, kAlt, "turns", "Alt+Drag");
      row(Blender, tool, kMiddle, kShift, "shifts", "Shift+Middle-drag");
      row(Blender, tool, kMiddle, kControl, "nears", "Ctrl+Middle-drag");
      row(Maya, tool, kLeft, kAlt, "turns", "Alt+Drag");
      row(Maya, tool, kMiddle, kAlt, "shifts", "Alt+Middle-drag");
      row(Maya, tool, kRight, kAlt, "nears", "Alt+Right-drag");
      row(Maya, tool, kMiddle, {}, "nothing", "");
      row(Cad, tool, kMiddle, {}, "turns", "Middle-drag");
      row(Cad, tool, kMiddle, kControl, "shifts", "Ctrl+Middle-drag");
      row(Cad, tool, kMiddle, kShift, "nears", "Shift+Middle-drag");
      row(Cad, tool, kRight, {}, "nothing", "");
    }
  }
  /// By the mouse in the view; and what it does is what the list of a tool's gestures says.
  void presets() {
    QFETCH(MousePreset, preset);
    QFETCH(QString, choice);
    QFETCH(QString, tool);
    QFETCH(Qt::MouseButton, button);
    QFETCH(int, keys);
    QFETCH(QString, moves);
    QFETCH(QString, hint);
    chooseMouse(choice);
    QCOMPARE(preferences::mouse(), preset);
    m_window->tools().activate(tool.toStdString());
    QCOMPARE(movedBy(button, Qt::KeyboardModifiers(keys)), moves);
    QVERIFY(!QApplication::activePopupWidget());
    QVERIFY(!document().undoStack().canUndo());
    if (hint.isEmpty()) return;
    const auto said = viewGestures(m_window->tools().tool());
    const QString words = moves == QStringLiteral("turns")    ? QStringLiteral("Turn the view")
                          : moves == QStringLiteral("shifts") ? QStringLiteral("Move the view sideways")
                                                              : QStringLiteral("Nearer or farther");
    QVERIFY(std::any_of(said.begin(), said.end(), [&](const Gesture& g) { return g.keys == hint && g.does == words; }));
  }

  /// Where a drag does not turn the view it frames what is to be selected, and the right button has the menu.
  void theLeftButtonIsFreeToSelect() {
    chooseMouse(QStringLiteral("Blender"));
    m_window->tools().activate("select");
    view()->show(StandardView::Scene);
    m_window->selection().clear();
    const QPoint corner(20, 60), across(view()->width() - 40, view()->height() - 130);
    stroke(corner, across, true);
    QVERIFY(m_window->selection().bodies().size() > 0);
    QTest::mouseClick(view(), Qt::RightButton, {}, QPoint(view()->width() / 2, view()->height() / 3));
    QVERIFY(QApplication::activePopupWidget());
    QApplication::activePopupWidget()->close();
    chooseMouse(QStringLiteral("PhaseSketch"));
    m_window->selection().clear();
    stroke(corner, across, true);
    QVERIFY(m_window->selection().bodies().empty());
    view()->show(StandardView::Scene);
  }

  /// Hints, the page of help that is open, and the list of shortcuts.
  void thePresetIsTold() {
    chooseMouse(QStringLiteral("PhaseSketch"));
    m_window->tools().activate("select");
    const auto hinted = [this] {
      QStringList texts;
      for (const OverlayHint& hint : view()->hints()) texts << hint.keys + QLatin1Char(' ') + hint.does;
      return texts.join(QLatin1Char('\n'));
    };
    QVERIFY2(hinted().startsWith(QStringLiteral("Drag orbit\nShift+Drag pan\nWheel zoom")), qPrintable(hinted()));
    m_window->help().open(QStringLiteral("first-steps"));
    HelpWindow* help = m_window->help().dialog();
    QVERIFY(help->text().contains(QStringLiteral("Drag in the view to turn it, Shift+Drag to move it")));
    chooseMouse(QStringLiteral("Maya"));
    QVERIFY2(help->text().contains(QStringLiteral("Alt+Drag in the view to turn it, Alt+Middle-drag to move it")),
             qPrintable(help->text()));
    QVERIFY2(hinted().startsWith(QStringLiteral("Alt+Drag orbit\nAlt+Middle-drag pan\nWheel zoom")),
             qPrintable(hinted()));
    picture(QStringLiteral("tst_preferences_maya.png"));
    for (const HelpPage& page : writtenHelp()) {
      m_window->help().open(page.id);
      QVERIFY2(!help->text().contains(QLatin1Char('{')), qPrintable(page.id));
    }
    m_window->tools().activate("brush");
    chooseMouse(QStringLiteral("PhaseSketch"));
    QVERIFY2(hinted().contains(QStringLiteral("Middle-drag orbit")), qPrintable(hinted()));
    m_window->help().open(QStringLiteral("sketching"));
    QVERIFY(help->text().contains(QStringLiteral("Middle-drag or Alt+Drag turns the view")));
    chooseMouse(QStringLiteral("CAD, like SolidWorks"));
    QVERIFY2(hinted().contains(QStringLiteral("Middle-drag orbit")), qPrintable(hinted()));
    bool listed = false;
    for (const ShortcutGroup& group : shortcutGroups(*m_window)) {
      for (const auto& [keys, does] : group.lines) listed = listed || keys == QStringLiteral("Ctrl+Middle-drag");
    }
    QVERIFY(listed);
    delete help;
    m_window->tools().activate("select");
    chooseMouse(QStringLiteral("PhaseSketch"));
  }

  /// What the project says of itself: typed, taken when the field is left, one step each, and undone.
  void theProjectIsDescribed() {
    m_window->action(QStringLiteral("edit.project"))->trigger();
    auto* about = m_window->findChild<QDialog*>(QStringLiteral("psProject"));
    QVERIFY(about && QTest::qWaitForWindowExposed(about));
    auto* title = about->findChild<QLineEdit*>();
    // The window behind may get an earlier request to become active only now.
    QTRY_VERIFY_WITH_TIMEOUT((about->activateWindow(), title->setFocus(), title->hasFocus()), kLong);
    auto* text = about->findChild<QPlainTextEdit*>();
    const ProjectAbout before = document().about();
    QCOMPARE(title->text().toStdString(), before.title);
    QCOMPARE(text->toPlainText().toStdString(), before.description);
    title->setText(QStringLiteral("Puddle"));
    QTest::keyClick(title, Qt::Key_Tab);
    QCOMPARE(document().about().title, std::string("Puddle"));
    QVERIFY(m_window->windowTitle().contains(QStringLiteral("Puddle")));
    text->setPlainText(QStringLiteral("It melts.\nTry it."));
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) about->grab().save(folder + QStringLiteral("/tst_project_properties.png"));
    QLineEdit* toTry = nullptr;
    for (QLineEdit* line : about->findChildren<QLineEdit*>()) {
      if (line->accessibleName() == QStringLiteral("To try")) toTry = line;
    }
    QVERIFY(toTry && toTry != title);
    toTry->setText(QStringLiteral("Warm the plate."));
    about->close();
    QCOMPARE(document().about().description, std::string("It melts.\nTry it."));
    QCOMPARE(document().project().toTry, std::string("Warm the plate."));
    QCOMPARE(document().undoStack().count(), 3);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("what to try"));
    document().undoStack().undo();
    QCOMPARE(document().about().toTry, before.toTry);
    document().undoStack().redo();
    QCOMPARE(document().about().toTry, std::string("Warm the plate."));
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(document().about().description, before.description);
    document().undoStack().undo();
    QVERIFY(document().about() == before);
    QVERIFY(m_window->windowTitle().contains(QString::fromStdString(before.title)));
  }

  /// Drawn beside the interface, one step each, and shown in the dialog.
  void theProjectHasAPicture() {
    const std::string before = writeProject(document().project());
    m_window->action(QStringLiteral("edit.project"))->trigger();
    auto* about = m_window->findChild<QDialog*>(QStringLiteral("psProject"));
    QVERIFY(about && QTest::qWaitForWindowExposed(about));
    const auto button = [about](const QString& text) {
      const auto all = about->findChildren<QPushButton*>();
      const auto it = std::find_if(all.begin(), all.end(), [&](const QPushButton* one) { return one->text() == text; });
      return it == all.end() ? nullptr : *it;
    };
    QPushButton* remove = button(QStringLiteral("Remove"));
    QPushButton* take = button(QStringLiteral("Take from view"));
    QVERIFY(take && remove && !remove->isEnabled());
    const auto shown = [about] {
      const auto labels = about->findChildren<QLabel*>();
      return std::any_of(labels.begin(), labels.end(), [](const QLabel* label) { return !label->pixmap().isNull(); });
    };
    QVERIFY(!shown());
    const int steps = document().undoStack().index();
    QTest::mouseClick(take, Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(!document().project().thumbnail.empty(), kLong);
    QCOMPARE(pictureOf(document().project().thumbnail).size(), QSize(320, 180));
    QVERIFY(shown() && remove->isEnabled());
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("picture"));
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) about->grab().save(folder + QStringLiteral("/tst_project_picture.png"));
    QTest::mouseClick(remove, Qt::LeftButton);
    QVERIFY(document().project().thumbnail.empty() && !shown());
    document().undoStack().undo();
    QVERIFY(!document().project().thumbnail.empty() && shown());
    document().undoStack().undo();
    QCOMPARE(document().undoStack().index(), steps);
    QCOMPARE(writeProject(document().project()), before);
    about->close();
  }

  /// With a unit; what is no duration is told of, and the one before stays.
  void theProjectsDurationIsTyped() {
    const std::string before = writeProject(document().project());
    m_window->action(QStringLiteral("edit.project"))->trigger();
    auto* about = m_window->findChild<QDialog*>(QStringLiteral("psProject"));
    QVERIFY(about && QTest::qWaitForWindowActive(about));
    QApplication::setActiveWindow(about);
    QLineEdit* field = nullptr;
    for (QLineEdit* line : about->findChildren<QLineEdit*>()) {
      if (line->accessibleName() == QStringLiteral("Duration")) field = line;
    }
    QVERIFY(field);
    const auto type = [&](const QString& text) {
      field->setFocus();
      field->selectAll();
      QTest::keyClicks(field, text);
      QTest::keyClick(field, Qt::Key_Tab);
    };
    type(QStringLiteral("1500 ms"));
    QCOMPARE(document().project().duration, 1.5);
    QCOMPARE(field->text(), QStringLiteral("1.500 s"));
    QVERIFY2(m_window->transport()->durationText().startsWith(QStringLiteral("/ 00:01")),
             qPrintable(m_window->transport()->durationText()));
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("duration"));
    for (const char* wrong : {"-1", "a while", "3 kg"}) {
      type(QString::fromLatin1(wrong));
      QCOMPARE(document().project().duration, 1.5);
      const auto labels = about->findChildren<QLabel*>();
      QVERIFY(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
        return label->isVisible() && label->property("role") == QStringLiteral("error") && !label->text().isEmpty();
      }));
    }
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) about->grab().save(folder + QStringLiteral("/tst_project_duration.png"));
    type(QStringLiteral("2"));
    about->close();
    QCOMPARE(document().project().duration, 2.0);
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
  }

  /// Asked for at once after it was closed: the one that is going does not come back.
  void aClosedDialogIsOpenedAgain() {
    openDialog();
    const QPointer<QDialog> first = dialog();
    m_window->action(QStringLiteral("edit.preferences"))->trigger();
    QVERIFY(dialog() == first);
    first->close();
    m_window->action(QStringLiteral("edit.preferences"))->trigger();
    QTRY_VERIFY(!first);
    QVERIFY(dialog() && dialog()->isVisible());
  }

  /// A dialog that is open, with something typed, goes with its window.
  void aWindowClosesWithItsDialogs() {
    auto other = sampleWindow({1280, 800});
    QVERIFY(other);
    other->action(QStringLiteral("edit.project"))->trigger();
    auto* about = other->findChild<QDialog*>(QStringLiteral("psProject"));
    QVERIFY(about && QTest::qWaitForWindowActive(about));
    about->findChild<QLineEdit*>()->setText(QStringLiteral("Puddle"));
    other.reset();
    QApplication::setActiveWindow(m_window.get());
  }

  /// What Ctrl+K names is there, and gets the focus.
  void rowsAreFoundByTheirNames() {
    for (const DialogRow& row : preferenceRows()) {
      openPreferences(*m_window, row.label);
      QVERIFY2(dialog()->focusWidget() && dialog()->focusWidget()->accessibleName().startsWith(row.label),
               qPrintable(row.label));
    }
    for (const DialogRow& row : projectRows()) {
      openProjectProperties(*m_window, row.label);
      const auto* about = m_window->findChild<QDialog*>(QStringLiteral("psProject"));
      QVERIFY2(about && about->focusWidget() && about->focusWidget()->accessibleName().startsWith(row.label),
               qPrintable(row.label));
    }
    delete m_window->findChild<QDialog*>(QStringLiteral("psProject"));
  }

  /// From field to field by Tab, to the next choice by an arrow.
  void theKeyboardReachesAll() {
    openDialog();
    QSet<QWidget*> reached;
    for (int k = 0; k < 24; ++k) {
      QTest::keyClick(dialog()->focusWidget() ? dialog()->focusWidget() : dialog(), Qt::Key_Tab);
      reached << dialog()->focusWidget();
    }
    for (const char* label : {"Theme", "Copy it", "In memory, at most", "On the disk, at most"})
      QVERIFY2(reached.contains(field<QComboBox>(label)), label);
    QVERIFY(reached.contains(field<QPushButton>("Folder")));
    for (const char* which : {"Projects", "Presets", "Plugins"}) {
      const QString name = QString::fromLatin1(which) + QStringLiteral(": Choose…");
      auto* choose = field<QPushButton>(name.toUtf8().constData());
      QVERIFY2(choose && reached.contains(choose), which);
    }
    QTest::keyClick(dialog(), Qt::Key_Escape);
    QTRY_VERIFY(!dialog() || !dialog()->isVisible());
  }

 private:
  void chooseMouse(const QString& name) {
    openDialog();
    pick("Mouse", qPrintable(name));
    delete dialog();
    m_window->activateWindow();
  }
  /// What a drag of so many pixels did to the view.
  QString movedBy(Qt::MouseButton button, Qt::KeyboardModifiers keys) {
    view()->show(StandardView::Scene);
    const Camera before = view()->navigator().camera();
    const QPoint from(view()->width() / 2, 40 + view()->height() / 2), way(40, 30);
    QTest::mousePress(view(), button, keys, from);
    for (int k = 1; k <= 4; ++k) QTest::mouseMove(view(), from + way * k / 4);
    QTest::mouseRelease(view(), button, keys, from + way);
    const Camera after = view()->navigator().camera();
    view()->show(StandardView::Scene);
    QStringList did;
    if (after.azimuth != before.azimuth || after.elevation != before.elevation) did << QStringLiteral("turns");
    if (after.distance != before.distance)
      did << QStringLiteral("nears");
    else if (after.target != before.target)
      did << QStringLiteral("shifts");
    return did.isEmpty() ? QStringLiteral("nothing") : did.join(QLatin1Char(' '));
  }
  QDialog* dialog() { return m_window->findChild<QDialog*>(QStringLiteral("psPreferences")); }
  void openDialog() {
    m_window->action(QStringLiteral("edit.preferences"))->trigger();
    QVERIFY(dialog() && QTest::qWaitForWindowExposed(dialog()));
  }
  template <class Field>
  Field* field(const char* label) {
    for (Field* one : dialog()->findChildren<Field*>()) {
      if (one->accessibleName() == QString::fromUtf8(label)) return one;
    }
    return nullptr;
  }
  void pick(const char* label, const char* text) {
    auto* box = field<QComboBox>(label);
    const int index = box->findText(QString::fromUtf8(text));
    QVERIFY2(index >= 0, text);
    box->setCurrentIndex(index);
    Q_EMIT box->activated(index);
  }
};

QTEST_MAIN(TestPreferences)
#include "tst_preferences.moc"
