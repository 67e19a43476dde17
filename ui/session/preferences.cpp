// SPDX-License-Identifier: Apache-2.0
#include "ui/session/preferences.h"

#include <QtCore/QFileInfo>
#include <QtCore/QSettings>
#include <QtCore/QStandardPaths>
#include <QtCore/QStorageInfo>

#include <algorithm>
#include <utility>

namespace ps::preferences {
namespace {

constexpr const char *kMemory = "recording/memory", *kUndo = "undo/memory", *kDisk = "recording/disk",
                     *kFolder = "recording/folder", *kAutosave = "autosave/interval", *kWelcome = "welcome/atStart",
                     *kWindow = "window/geometry", *kTour = "welcome/tourDone", *kTemperatures = "look/temperatures",
                     *kMouse = "look/mouse", *kPivot = "handles/pivot", *kSnap = "handles/snap",
                     *kSurfaces = "handles/surfaces", *kMoveStep = "handles/moveStep", *kTurnStep = "handles/turnStep",
                     *kScaleStep = "handles/scaleStep", *kBrushes = "sketch/favouriteBrushes",
                     *kPieces = "sketch/piecesBecomeBodies", *kVibration = "vr/vibration", *kShowsEye = "vr/showsEye",
                     *kLeftHanded = "vr/leftHanded", *kOneHanded = "vr/oneHanded", *kSeated = "vr/seatedHeight";
constexpr const char* kFolders[] = {"folders/projects", "folders/presets", "folders/plugins"};
constexpr int kUsualUndo = 512, kUsualDisk = 8192, kMost = 1 << 24;  // MiB
constexpr double kMostStep = 1e4;
constexpr int kMostSeated = 100;  // cm
constexpr int kUsualAutosave = 30, kLeastAutosave = 5, kMostAutosave = 3600;

/// Whatever stands in the file.
int number(const char* key, int usual, int least, int most) {
  bool known = false;
  const int value = QSettings().value(QLatin1String(key), usual).toInt(&known);
  return known ? std::clamp(value, least, most) : usual;
}
void set(const char* key, const QVariant& value) { QSettings().setValue(QLatin1String(key), value); }

/// Half of what the disk would have without that: others need it too.
size_t roomOnDisk(const QString& folder, size_t ours) {
  QFileInfo place(folder);
  while (!place.exists() && place.absolutePath() != place.absoluteFilePath()) place = QFileInfo(place.absolutePath());
  const QStorageInfo disk(place.absoluteFilePath());
  return disk.isValid() && disk.bytesAvailable() > 0 ? (static_cast<size_t>(disk.bytesAvailable()) + ours) / 2
                                                     : ours / 2;
}

}  // namespace

int recordMemory() { return number(kMemory, 0, 0, kMost); }
void setRecordMemory(int mebibytes) { set(kMemory, mebibytes); }
int undoMemory() { return number(kUndo, kUsualUndo, 0, kMost); }
void setUndoMemory(int mebibytes) { set(kUndo, mebibytes); }
int recordDisk() { return number(kDisk, kUsualDisk, 0, kMost); }
void setRecordDisk(int mebibytes) { set(kDisk, mebibytes); }

QString recordFolder() {
  const QString usual = QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + QStringLiteral("/recordings");
  const QString folder = QSettings().value(QLatin1String(kFolder)).toString();
  return folder.isEmpty() ? usual : folder;
}
void setRecordFolder(const QString& folder) { set(kFolder, folder); }

size_t usualRecordMemory() {
  static const size_t bytes = RunRecord::usualBudget();
  return bytes;
}

RecordBudget recordBudget(size_t onDisk) {
  const size_t usual = usualRecordMemory();
  const size_t memory = static_cast<size_t>(recordMemory()) * kMiB, disk = static_cast<size_t>(recordDisk()) * kMiB;
  const QString folder = recordFolder();
  return {memory > 0 ? memory : usual, std::min(disk, roomOnDisk(folder, onDisk)), folder.toStdString()};
}

QString folder(Folder which) {
  return QSettings().value(QLatin1String(kFolders[static_cast<size_t>(which)])).toString();
}
void setFolder(Folder which, const QString& path) { set(kFolders[static_cast<size_t>(which)], path); }

QString projectFolder() {
  const QString chosen = folder(Folder::Projects);
  return chosen.isEmpty() ? QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) : chosen;
}

int autosaveInterval() { return number(kAutosave, kUsualAutosave, kLeastAutosave, kMostAutosave); }
void setAutosaveInterval(int seconds) { set(kAutosave, seconds); }

TemperatureUnit temperatures() { return static_cast<TemperatureUnit>(number(kTemperatures, 0, 0, 2)); }
void setTemperatures(TemperatureUnit unit) { set(kTemperatures, static_cast<int>(unit)); }

MousePreset mouse() { return static_cast<MousePreset>(number(kMouse, 0, 0, static_cast<int>(MousePreset::Cad))); }
void setMouse(MousePreset preset) { set(kMouse, static_cast<int>(preset)); }

HandleSettings handles() {
  HandleSettings settings;
  settings.pivot = static_cast<Pivot>(number(kPivot, 0, 0, static_cast<int>(Pivot::Origin)));
  Snapping& snap = settings.snap;
  snap.on = QSettings().value(QLatin1String(kSnap), snap.on).toBool();
  snap.surfaces = QSettings().value(QLatin1String(kSurfaces), snap.surfaces).toBool();
  for (const auto& [key, step] :
       {std::pair(kMoveStep, &snap.move), {kTurnStep, &snap.turn}, {kScaleStep, &snap.scale}}) {
    bool known = false;
    const double value = QSettings().value(QLatin1String(key), *step).toDouble(&known);
    if (known && value > 0 && value < kMostStep) *step = value;
  }
  return settings;
}
void setHandles(const HandleSettings& settings) {
  const Snapping& snap = settings.snap;
  set(kPivot, static_cast<int>(settings.pivot));
  set(kSnap, snap.on);
  set(kSurfaces, snap.surfaces);
  set(kMoveStep, snap.move);
  set(kTurnStep, snap.turn);
  set(kScaleStep, snap.scale);
}

int vibration() { return number(kVibration, 60, 0, 100); }
void setVibration(int percent) { set(kVibration, percent); }

bool leftHanded() { return QSettings().value(QLatin1String(kLeftHanded), false).toBool(); }
void setLeftHanded(bool on) { set(kLeftHanded, on); }
bool oneHanded() { return QSettings().value(QLatin1String(kOneHanded), false).toBool(); }
void setOneHanded(bool on) { set(kOneHanded, on); }
int seatedHeight() { return number(kSeated, 0, 0, kMostSeated); }
void setSeatedHeight(int centimetres) { set(kSeated, centimetres); }

bool showsEye() { return QSettings().value(QLatin1String(kShowsEye), false).toBool(); }
void setShowsEye(bool on) { set(kShowsEye, on); }

bool piecesBecomeBodies() { return QSettings().value(QLatin1String(kPieces), true).toBool(); }
void setPiecesBecomeBodies(bool on) { set(kPieces, on); }

QByteArray favouriteBrushes() { return QSettings().value(QLatin1String(kBrushes)).toByteArray(); }
void setFavouriteBrushes(const QByteArray& text) { set(kBrushes, text); }

bool isFirstStart() { return !QSettings().contains(QLatin1String(kWindow)); }
bool welcomeAtStart() { return QSettings().value(QLatin1String(kWelcome), true).toBool(); }
void setWelcomeAtStart(bool on) { set(kWelcome, on); }
bool tourDone() { return QSettings().value(QLatin1String(kTour), false).toBool(); }
void setTourDone() { set(kTour, true); }

}  // namespace ps::preferences
