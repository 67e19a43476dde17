// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "core/sketch/cellset.h"
#include "core/sketch/stroke.h"
#include "ui/document/strokerecord.h"
#include "ui/tools/brushsettings.h"
#include "ui/tools/held.h"
#include "ui/tools/sight.h"

#include <QtCore/QString>
#include <QtCore/QTimer>

#include <functional>
#include <map>
#include <memory>

namespace ps {

class PluginRegistry;
class StrokeThread;
class Toolbox;

/// Cells that the box around one stamp of a brush may hold: what can be stamped at every movement of the pointer.
inline constexpr double kMaximumStamp = 32768;

/// How a brush of these settings draws on a scene of `spacing` m, and on what lies across `up`: its own parameters in
/// the order of its declarations.
StrokeSetup strokeSetup(const BrushSettings& brush, const PluginRegistry& plugins, double spacing,
                        const Vector3& up = {0, 1, 0});

/// A stroke in the making: takes places along it, lets the brush plugin turn them into cells on another thread, sends
/// new cells to the engine as they come, and hands the document one command at the end.
class LiveStroke {
 public:
  explicit LiveStroke(Toolbox& box);

  /// "" or why no stroke can begin ("The brush “x” is not installed…"). `now`: the scene as it is drawn on; `up`: away
  /// from what it is drawn on. What is drawn goes on with the sketched body of the same matter that it begins on, or of
  /// any where the brush joins them, else it is a body of its own. A body that has moved, turned, bent or melted in
  /// part is gone on with as it stands there: its cells come where the hand is, and the stroke is kept where they are
  /// at the start.
  QString begin(bool erase, const Snapshot& now, const Vector3& point, const Vector3& up, const Held& held);
  /// `seconds` since it began.
  void move(const Vector3& point, double seconds, const Held& held);
  /// The next place is not joined to the last one.
  void lift();
  /// Nothing more is drawn. True: finish() has little to wait for. False: hollows are still running full, which takes
  /// long; onEnd() is called when it is over, or cancel() gives the stroke up.
  bool end();
  bool ending() const { return m_ends; }  ///< end() was called, and it is not over
  void onEnd(std::function<void()> call) { m_onEnd = std::move(call); }
  /// Waits for what the brush still gives. "" or what went wrong: the stroke then ends as far as it came, or is given
  /// up where the brush failed.
  QString finish();
  /// "" or why what is being drawn flows, though the brush is to hold it together.
  QString whatFlows() const;
  bool kept() const { return m_kept; }  ///< finish() has left something of it
  /// finish() has left nothing of a stroke that erases, as it took nothing.
  bool erasedNothing() const { return m_erasedNothing; }
  /// Something has gone wrong since, and nothing more is drawn: finish() says what. `call` is called when it does.
  bool troubled() const { return !m_problem.isEmpty(); }
  void onTrouble(std::function<void()> call) { m_onTrouble = std::move(call); }
  void cancel();
  bool active() const { return m_record != nullptr; }
  /// Whether the document still has what it goes on with, and the material that it is of. Without them nothing can be
  /// kept of it.
  bool stands() const;
  const Vector3& up() const { return m_up; }  ///< away from what it is drawn on
  size_t cellCount() const { return m_cells.size(); }

 private:
  void drawOn(const VoxelShape& sketch, const RigidMove& way = {});
  Vector3 ownTurn(const Vector3& turn) const;
  void keep();
  QString whyNoSmoothing(const Snapshot& now, const Vector3& point);
  std::function<bool(const Vector3&)> freePlaces() const;
  void smooth(const std::vector<api::Cell>& fresh);
  void keepSmoothing(const std::shared_ptr<StrokeRecord>& emptied);
  QString whyNot(bool erase, const Snapshot& now, const Vector3& up) const;
  Body paintedBody(const Snapshot& now, const Vector3& point, const std::string& material);
  std::vector<std::array<int, 3>> cellsAtStart(const StrokeRecord& record) const;
  void start();
  void take();
  void watch();
  void tellOfEnd();
  void stopEnding();
  QString guarded(const std::function<void()>& work);  ///< "" or what went wrong; a brush that failed is put aside
  void note(const QString& problem);
  void forgetBeyond(size_t places);
  QString putAside(const char* why);
  std::vector<VoxelShape::Stroke> pieces() const;
  std::string groupOfSelection() const;
  void meet(const std::vector<api::Cell>& fresh);
  QString whyNothingErased();
  void collectErasure(StrokeRecord& record) const;
  void collectPaint(StrokeRecord& record) const;

  Toolbox& m_box;
  BrushSettings m_brush;  ///< as it was when the stroke began
  std::shared_ptr<StrokeRecord> m_record;
  std::shared_ptr<const Body> m_body;  ///< that an adding or smoothing stroke changes, as it was before
  bool m_atStart = false, m_smooths = false;
  bool m_goesOn = false;  ///< that body was there already
  api::EditKind m_kind = api::EditKind::Add;
  QTimer m_looks;                          ///< whether the brush comes back
  std::shared_ptr<StrokeThread> m_thread;  ///< goes before what it tells
  int m_idleLooks = 0;
  size_t m_waits = 0;  ///< places that had been drawn by then
  QString m_problem;
  std::function<void()> m_onTrouble, m_onEnd;
  bool m_ends = false;
  bool m_kept = false, m_erasedNothing = false;
  enum class Met { Nothing, Locked, Matter };
  Met m_met = Met::Nothing;  ///< where an erasing stroke went
  StrokeSetup m_setup;
  Sight m_sight;
  Vector3 m_up{0, 1, 0};  ///< in the scene, away from what is drawn on
  CellSet m_cells;
  VoxelCanvas m_canvas;                                   ///< that a smoothing stroke rounds, as it was before
  std::map<int, std::shared_ptr<StrokeRecord>> m_filled;  ///< what it fills, by palette entry
  VoxelShape::Stroke m_stroke;
  std::vector<VoxelShape::Stroke> m_pieces;  ///< before it was lifted
};

}  // namespace ps
