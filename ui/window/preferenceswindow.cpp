// SPDX-License-Identifier: Apache-2.0
#include "ui/window/preferenceswindow.h"

#include "core/base/memory.h"
#include "core/simulation/enginethread.h"
#include "ui/curves/curvetarget.h"
#include "ui/document/document.h"
#include "ui/graphs/graphspanel.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/session/preferences.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/units.h"
#include "ui/tools/toolbox.h"
#include "ui/window/dialogrow.h"
#include "ui/window/filenames.h"
#include "ui/window/libraryactions.h"
#include "ui/window/mainwindow.h"

#include <QtCore/QDir>
#include <QtCore/QStandardPaths>
#include <QtCore/QTimer>
#include <QtGui/QAction>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDialog>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>

#include <algorithm>
#include <utility>
#include <vector>

namespace ps {
namespace {

const QString kName = QStringLiteral("psPreferences");
constexpr int kRefresh = 500;  // ms
constexpr int kGap = 8, kEdge = 16, kLabelWidth = 190, kWidth = 540, kPlaceWidth = 180;

QString bytesText(double bytes) { return QString::fromStdString(memoryText(bytes)); }
QString mebibytes(int count) {
  return count >= 1024 && count % 1024 == 0 ? QStringLiteral("%1 GiB").arg(count / 1024)
                                            : QStringLiteral("%1 MiB").arg(count);
}

/// From now on, in all sessions.
void showTemperatures(MainWindow& window, TemperatureUnit unit) {
  preferences::setTemperatures(unit);
  setTemperatureUnit(unit);
  window.inspector().rebuild();
  window.outliner()->rebuild();
  window.graphs()->remake();
  window.library().page()->refresh();
  Q_EMIT window.curves().responseChanged();
  for (QWidget* widget : window.findChildren<QWidget*>()) widget->update();
}

/// The rows of the dialog, one below the other.
class Preferences : public QDialog {
 public:
  explicit Preferences(MainWindow& window);

 private:
  using Choices = std::vector<std::pair<QString, int>>;
  void heading(const QString& text);
  /// One of `choices`; a value that is none of them is shown as `text` has it.
  QComboBox* choice(const QString& label, const QString& tip, Choices choices, int value,
                    const std::function<QString(int)>& text, const std::function<void(int)>& set);
  void addTheme();
  void addHeadset();
  void addSketch();
  void addAutosave();
  void addUndo();
  void addRecording();
  void addFolders();
  void addFolder(preferences::Folder which, const QString& label, const QString& tip, const QString& usual);
  void apply(preferences::Folder which);
  void chooseFolder();
  void refresh();

  MainWindow& m_window;
  QGridLayout* m_grid;
  QPushButton *m_folder = nullptr, *m_empty = nullptr;
  QLabel *m_used = nullptr, *m_undoUsed = nullptr, *m_restart = nullptr;
  QTimer m_clock;
};

Preferences::Preferences(MainWindow& window) : QDialog(&window), m_window(window), m_grid(new QGridLayout(this)) {
  setWindowTitle(QStringLiteral("Preferences"));
  setAttribute(Qt::WA_DeleteOnClose);
  m_grid->setContentsMargins(kEdge, kEdge, kEdge, kEdge);
  m_grid->setSpacing(kGap);
  m_grid->setColumnMinimumWidth(0, kLabelWidth);
  m_grid->setColumnStretch(1, 1);
  addTheme();
  addHeadset();
  addSketch();
  addAutosave();
  addUndo();
  addRecording();
  addFolders();
  m_grid->setRowStretch(m_grid->rowCount(), 1);
  m_clock.setInterval(kRefresh);
  connect(&m_clock, &QTimer::timeout, this, &Preferences::refresh);
  m_clock.start();
  refresh();
  setMinimumWidth(kWidth);
}

void Preferences::heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setTextFormat(Qt::PlainText);
  QFont font = label->font();
  font.setWeight(QFont::DemiBold);
  label->setFont(font);
  m_grid->addWidget(label, m_grid->rowCount(), 0, 1, 2);
}

QComboBox* Preferences::choice(const QString& label, const QString& tip, Choices choices, int value,
                               const std::function<QString(int)>& text, const std::function<void(int)>& set) {
  auto* box = new QComboBox;
  const auto is = [value](const auto& entry) { return entry.second == value; };
  if (std::none_of(choices.begin(), choices.end(), is)) choices.emplace_back(text(value), value);
  for (const auto& [words, number] : choices) box->addItem(words, number);
  box->setCurrentIndex(box->findData(value));
  connect(box, &QComboBox::activated, this, [box, set] { set(box->currentData().toInt()); });
  addDialogRow(*m_grid, label, box, tip);
  return box;
}

void Preferences::addTheme() {
  heading(QStringLiteral("Window"));
  const bool dark = m_window.isDark();
  choice(
      QStringLiteral("Theme"), QStringLiteral("Colours of the window; the scene's stay."),
      {{QStringLiteral("Dark"), 1}, {QStringLiteral("Light"), 0}}, dark ? 1 : 0, [](int) { return QString(); },
      [this](int isDark) {
        m_window.action(isDark ? QStringLiteral("view.dark") : QStringLiteral("view.light"))->trigger();
      });
  using enum TemperatureUnit;
  choice(
      QStringLiteral("Temperatures"),
      QStringLiteral("How they are shown and typed without a unit; files and exports of particles have kelvin."),
      {{QStringLiteral("Degrees Celsius, °C"), static_cast<int>(Celsius)},
       {QStringLiteral("Kelvin, K"), static_cast<int>(Kelvin)},
       {QStringLiteral("Degrees Fahrenheit, °F"), static_cast<int>(Fahrenheit)}},
      static_cast<int>(temperatureUnit()), [](int) { return QString(); },
      [this](int unit) { showTemperatures(m_window, static_cast<TemperatureUnit>(unit)); });
  Choices presets;
  for (int k = 0; k <= static_cast<int>(MousePreset::Cad); ++k)
    presets.emplace_back(nameOf(static_cast<MousePreset>(k)), k);
  choice(
      QStringLiteral("Mouse"),
      QStringLiteral("Whose buttons and keys turn, move and near the view. The hints in the view show them."),
      std::move(presets), static_cast<int>(m_window.tools().mouse()), [](int) { return QString(); },
      [this](int preset) {
        preferences::setMouse(static_cast<MousePreset>(preset));
        m_window.tools().setMouse(static_cast<MousePreset>(preset));
      });
  choice(
      QStringLiteral("At the start"), QStringLiteral("What the window begins with."),
      {{QStringLiteral("Welcome page"), 1}, {QStringLiteral("Last scene"), 0}}, preferences::welcomeAtStart() ? 1 : 0,
      [](int) { return QString(); }, [](int shown) { preferences::setWelcomeAtStart(shown == 1); });
}

void Preferences::addHeadset() {
  heading(QStringLiteral("Headset"));
  const auto text = [](int percent) { return QStringLiteral("%1 %").arg(percent); };
  choice(
      QStringLiteral("Vibration"),
      QStringLiteral(
          "How strongly hands feel what presses on a body that they lead, how steep temperature is there and under a "
          "brush that heats or cools, and what melts or boils. Ticks of panels and strokes stay."),
      {{QStringLiteral("None"), 0}, {text(30), 30}, {text(60), 60}, {text(100), 100}}, preferences::vibration(), text,
      [](int percent) { preferences::setVibration(percent); });
  choice(
      QStringLiteral("Main hand"),
      QStringLiteral("It draws, undoes and chooses; the other one erases, holds the palette, plays and goes."),
      {{QStringLiteral("Right"), 0}, {QStringLiteral("Left"), 1}}, preferences::leftHanded() ? 1 : 0,
      [](int) { return QString(); }, [](int left) { preferences::setLeftHanded(left == 1); });
  choice(
      QStringLiteral("Hands in use"),
      QStringLiteral(
          "With one alone the palette comes where its palm has faced you, and stays there to be pointed at."),
      {{QStringLiteral("Both"), 0}, {QStringLiteral("The main one alone"), 1}}, preferences::oneHanded() ? 1 : 0,
      [](int) { return QString(); }, [](int alone) { preferences::setOneHanded(alone == 1); });
  const auto higher = [](int centimetres) { return QStringLiteral("%1 cm higher").arg(centimetres); };
  choice(QStringLiteral("Seated height"), QStringLiteral("Raises you over the scene while you sit, as if you stood."),
         {{QStringLiteral("As you sit"), 0}, {higher(15), 15}, {higher(30), 30}, {higher(45), 45}},
         preferences::seatedHeight(), higher, [](int centimetres) { preferences::setSeatedHeight(centimetres); });
  QAction* mirror = m_window.action(QStringLiteral("simulation.mirror"));
  choice(
      QStringLiteral("In the window"), QStringLiteral("What it shows while the headset is on."),
      {{QStringLiteral("The view, as without"), 0}, {QStringLiteral("What the left eye sees"), 1}}, mirror->isChecked(),
      [](int) { return QString(); }, [mirror](int eye) { mirror->setChecked(eye == 1); });
}

void Preferences::addSketch() {
  heading(QStringLiteral("Sketch"));
  choice(
      QStringLiteral("Pieces that are cut off"),
      QStringLiteral("What a hand parts of a sketched body by erasing or cutting, also in a headset. Crumbs of fewer "
                     "than 8 cells stay with it, and what breaks or melts apart by itself does until Sketch > Separate "
                     "pieces."),
      {{QStringLiteral("Become bodies"), 1}, {QStringLiteral("Stay with their body"), 0}},
      preferences::piecesBecomeBodies() ? 1 : 0, [](int) { return QString(); },
      [](int become) { preferences::setPiecesBecomeBodies(become == 1); });
}

void Preferences::addAutosave() {
  heading(QStringLiteral("Unsaved work"));
  const auto text = [](int seconds) { return QStringLiteral("Every %1 s").arg(seconds); };
  choice(
      QStringLiteral("Copy it"), QStringLiteral("It comes back after a crash, and when you close without saving."),
      {{text(15), 15}, {text(30), 30}, {QStringLiteral("Every minute"), 60}, {QStringLiteral("Every 5 minutes"), 300}},
      preferences::autosaveInterval(), text, [this](int seconds) {
        preferences::setAutosaveInterval(seconds);
        m_window.session().applyAutosave();
      });
}

void Preferences::addUndo() {
  heading(QStringLiteral("Undo"));
  choice(QStringLiteral("Keeps at most"),
         QStringLiteral("When it is more, the oldest steps are let go; the last one never is."),
         {{mebibytes(128), 128},
          {mebibytes(512), 512},
          {mebibytes(2048), 2048},
          {mebibytes(8192), 8192},
          {QStringLiteral("Everything"), 0}},
         preferences::undoMemory(), mebibytes, [this](int size) {
           preferences::setUndoMemory(size);
           m_window.session().applyUndoMemory();
           refresh();
         });
  m_undoUsed = new QLabel;
  m_undoUsed->setObjectName(QStringLiteral("psUndoUsed"));
  m_undoUsed->setTextFormat(Qt::PlainText);
  addDialogRow(*m_grid, QStringLiteral("Keeps now"), m_undoUsed,
               QStringLiteral("By what can be undone and redone in this window, and no longer stands in its scene."));
}

void Preferences::addRecording() {
  heading(QStringLiteral("Recording of a run"));
  choice(QStringLiteral("In memory, at most"), QStringLiteral("When it is full, what is oldest goes to the disk."),
         {{QStringLiteral("A quarter of what is free (%1)")
               .arg(bytesText(static_cast<double>(preferences::usualRecordMemory()))),
           0},
          {mebibytes(512), 512},
          {mebibytes(2048), 2048},
          {mebibytes(8192), 8192},
          {mebibytes(32768), 32768}},
         preferences::recordMemory(), mebibytes, [this](int size) {
           preferences::setRecordMemory(size);
           m_window.session().applyRecordBudget();
         });
  choice(QStringLiteral("On the disk, at most"),
         QStringLiteral("When that is full too, old frames are thinned: every second one goes."),
         {{QStringLiteral("Nothing"), 0},
          {mebibytes(2048), 2048},
          {mebibytes(8192), 8192},
          {mebibytes(32768), 32768},
          {mebibytes(131072), 131072}},
         preferences::recordDisk(), mebibytes, [this](int size) {
           preferences::setRecordDisk(size);
           m_window.session().applyRecordBudget();
         });
  m_folder = new QPushButton;
  connect(m_folder, &QPushButton::clicked, this, &Preferences::chooseFolder);
  addDialogRow(
      *m_grid, QStringLiteral("Folder"), m_folder,
      QStringLiteral(
          "Where it lies on the disk, from the next start on. It goes when the program ends, also by a crash."));
  m_used = new QLabel;
  m_used->setTextFormat(Qt::PlainText);
  addDialogRow(*m_grid, QStringLiteral("Used now"), m_used, QStringLiteral("By the run of this window."));
  m_empty = new QPushButton(QStringLiteral("Empty the disk"));
  m_empty->setAutoDefault(false);
  m_empty->setToolTip(QStringLiteral(
      "What was recorded there can no longer be shown. What is in memory stays, and so do the ends of each run."));
  connect(m_empty, &QPushButton::clicked, this, [this] {
    m_window.session().recorded().forgetDisk();
    refresh();
  });
  m_grid->addWidget(m_empty, m_grid->rowCount(), 1, Qt::AlignLeft);
}

void Preferences::addFolders() {
  using enum preferences::Folder;
  heading(QStringLiteral("Folders"));
  addFolder(Projects, QStringLiteral("Projects"),
            QStringLiteral("Where files are looked for and written, unless the open project lies elsewhere."),
            QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
  addFolder(Presets, QStringLiteral("Presets"), QStringLiteral("Your own materials in the library."),
            MaterialLibrary::usualFolder());
  addFolder(Plugins, QStringLiteral("Plugins"),
            QStringLiteral("Looked into beside the usual places, from the next start on. Its plugins go before those."),
            {});
  m_restart = new QLabel(QStringLiteral("Start the program again to have its plugins."));
  m_restart->setProperty("role", "muted");
  m_restart->hide();
  m_grid->addWidget(m_restart, m_grid->rowCount(), 1);
}

/// `usual`: what holds while none is chosen; "": nothing does.
void Preferences::addFolder(preferences::Folder which, const QString& label, const QString& tip, const QString& usual) {
  auto* line = new QWidget;
  auto* row = new QHBoxLayout(line);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kGap);
  auto* place = new QLabel;
  row->addWidget(place, 1);
  const auto button = [&](const QString& text) {
    auto* push = new QPushButton(text);
    push->setAutoDefault(false);
    push->setAccessibleName(label + QStringLiteral(": ") + text);
    row->addWidget(push);
    return push;
  };
  auto* choose = button(QStringLiteral("Choose…"));
  auto* reset = button(QStringLiteral("Reset"));
  const auto show = [which, usual, place, reset] {
    const QString chosen = preferences::folder(which);
    const QString path = QDir::toNativeSeparators(chosen.isEmpty() ? usual : chosen);
    place->setText(path.isEmpty() ? QStringLiteral("The usual ones alone")
                                  : place->fontMetrics().elidedText(path, Qt::ElideMiddle, kPlaceWidth));
    place->setToolTip(path);
    reset->setEnabled(!chosen.isEmpty());
  };
  const auto set = [this, which, show](const QString& path) {
    preferences::setFolder(which, path);
    show();
    apply(which);
  };
  connect(choose, &QPushButton::clicked, this, [this, which, label, usual, set] {
    const QString chosen = preferences::folder(which);
    const QString path =
        folderToUse(this, QStringLiteral("Folder for %1").arg(label.toLower()), chosen.isEmpty() ? usual : chosen);
    if (!path.isEmpty()) set(path);
  });
  connect(reset, &QPushButton::clicked, this, [set] { set({}); });
  show();
  addDialogRow(*m_grid, label, line, tip);
}

void Preferences::apply(preferences::Folder which) {
  if (which == preferences::Folder::Presets) m_window.library().library().setFolder({});
  if (which == preferences::Folder::Plugins) m_restart->show();
}

void Preferences::chooseFolder() {
  const QString folder = folderToUse(this, QStringLiteral("Folder for recordings"), preferences::recordFolder());
  if (folder.isEmpty()) return;
  preferences::setRecordFolder(folder);
  m_window.session().applyRecordBudget();
  refresh();
}

void Preferences::refresh() {
  const QString folder = QDir::toNativeSeparators(preferences::recordFolder());
  m_folder->setText(
      asButtonText(m_folder->fontMetrics().elidedText(folder, Qt::ElideMiddle, kWidth - kLabelWidth - 80)));
  const EngineThread* engine = m_window.session().engine();
  const RunRecord::Cost cost = engine ? engine->recording().cost() : RunRecord::Cost();
  const QString disk = cost.disk > 0 ? bytesText(static_cast<double>(cost.disk)) : QStringLiteral("nothing");
  const History& history = m_window.session().document().undoStack();
  m_undoUsed->setText(QStringLiteral("%1 of memory").arg(bytesText(static_cast<double>(history.bytes()))));
  m_used->setText(QStringLiteral("%1 of memory, %2 of the disk").arg(bytesText(static_cast<double>(cost.bytes)), disk));
  m_empty->setEnabled(cost.disk > 0);
}

}  // namespace

void openPreferences(MainWindow& window, const QString& row) {
  focusDialogRow(*bringUp(window, kName, [&window] { return new Preferences(window); }), row);
}

std::vector<DialogRow> preferenceRows() {
  return {{QStringLiteral("Theme"), QStringLiteral("dark light colours window")},
          {QStringLiteral("Temperatures"), QStringLiteral("unit Celsius kelvin Fahrenheit")},
          {QStringLiteral("Mouse"), QStringLiteral("buttons preset Blender Maya")},
          {QStringLiteral("At the start"), QStringLiteral("welcome page last scene")},
          {QStringLiteral("Vibration"), QStringLiteral("headset VR hands haptics force")},
          {QStringLiteral("Main hand"), QStringLiteral("headset VR left right handed")},
          {QStringLiteral("Hands in use"), QStringLiteral("headset VR one-handed palette wrist")},
          {QStringLiteral("Seated height"), QStringLiteral("headset VR sitting chair offset")},
          {QStringLiteral("In the window"), QStringLiteral("headset VR mirror eye")},
          {QStringLiteral("Pieces that are cut off"), QStringLiteral("sketch erase cut parts bodies separate")},
          {QStringLiteral("Copy it"), QStringLiteral("unsaved work autosave crash")},
          {QStringLiteral("Keeps at most"), QStringLiteral("undo memory steps")},
          {QStringLiteral("In memory, at most"), QStringLiteral("recording of a run")},
          {QStringLiteral("On the disk, at most"), QStringLiteral("recording of a run, empty the disk")},
          {QStringLiteral("Folder"), QStringLiteral("recording of a run disk")},
          {QStringLiteral("Projects"), QStringLiteral("folder files")},
          {QStringLiteral("Presets"), QStringLiteral("folder materials library")},
          {QStringLiteral("Plugins"), QStringLiteral("folder")}};
}

}  // namespace ps
