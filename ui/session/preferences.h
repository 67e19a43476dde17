// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/runrecord.h"
#include "ui/session/handlesettings.h"
#include "ui/theme/units.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>

namespace ps {
/// Whose buttons and keys move the view.
enum class MousePreset { PhaseSketch, Blender, Maya, Cad };
}  // namespace ps

// What people prefer in all their projects, as QSettings keep it.
namespace ps::preferences {

inline constexpr size_t kMiB = size_t{1} << 20;

/// MiB of memory that the record of a run may take; 0: a quarter of what the machine has for the program.
int recordMemory();
void setRecordMemory(int mebibytes);
/// MiB of the disk beside that; 0: none.
int recordDisk();
void setRecordDisk(int mebibytes);
/// MiB of memory that undo may keep; 0: no end.
int undoMemory();
void setUndoMemory(int mebibytes);
/// Where that part lies.
QString recordFolder();
void setRecordFolder(const QString& folder);
/// Bytes: that quarter, as it was when the program began to record; what it records then takes of it.
size_t usualRecordMemory();
/// All of these; of the disk no more than half of what would be free there without the bytes that the record has there.
RecordBudget recordBudget(size_t onDisk = 0);

/// A folder that somebody chose in place of the usual one, or, of plugins, beside those; "" where nobody did.
enum class Folder { Projects, Presets, Plugins };
QString folder(Folder which);
void setFolder(Folder which, const QString& path);
/// Where projects lie while nothing else says so: the folder chosen for them, or else the user's documents.
QString projectFolder();

/// s between copies of unsaved work.
int autosaveInterval();
void setAutosaveInterval(int seconds);

TemperatureUnit temperatures();
void setTemperatures(TemperatureUnit unit);

MousePreset mouse();
void setMouse(MousePreset preset);

HandleSettings handles();
void setHandles(const HandleSettings& settings);

/// %, of the strongest that hands in a headset may feel from what they lead, heat and cool; 0: nothing but ticks.
int vibration();
void setVibration(int percent);

/// Which hand is the main one in a headset, and whether it is alone.
bool leftHanded();
void setLeftHanded(bool on);
bool oneHanded();
void setOneHanded(bool on);
/// cm, by which the scene stands lower than before one who sits.
int seatedHeight();
void setSeatedHeight(int centimetres);

/// Whether the window shows what the left eye sees while a headset is on; else it shows its view.
bool showsEye();
void setShowsEye(bool on);

/// Whether what a hand cuts off a sketched body becomes a body of its own.
bool piecesBecomeBodies();
void setPiecesBecomeBodies(bool on);

/// As textOf() of ui/tools/favouritebrush.h has them; "": none.
QByteArray favouriteBrushes();
void setFavouriteBrushes(const QByteArray& text);

/// Whether no window has been closed in order yet.
bool isFirstStart();
/// Whether the welcome page shows when the program starts.
bool welcomeAtStart();
void setWelcomeAtStart(bool on);
/// Whether the tour has been gone through or skipped.
bool tourDone();
void setTourDone();

}  // namespace ps::preferences
