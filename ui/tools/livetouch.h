// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/stroke.h"
#include "ui/document/strokerecord.h"
#include "ui/tools/brushsettings.h"
#include "ui/tools/held.h"

#include <QtCore/QString>

#include <memory>
#include <optional>
#include <vector>

namespace ps {

class Toolbox;

/// A hand that works on the matter that is there, by a brush that says so: takes places along its way, lets the brush
/// say what it does there, sends that straight to the engine, which does it as time passes in the scene, and hands the
/// document one command at the end where undo has heat to take back.
class LiveTouch {
 public:
  explicit LiveTouch(Toolbox& box) : m_box(box) {}

  /// "" or why the hand does nothing. `brush`: that it has in hand; `opposite`: of what that is called; `up`: away from
  /// what it points at; `look`: unit vector along which one sees it.
  QString begin(const BrushSettings& brush, bool opposite, const Vector3& point, const Vector3& up, const Vector3& look,
                const Held& held);
  /// "" or what went wrong; the hand then lets go. `seconds` since it began.
  QString move(const Vector3& point, double seconds, const Held& held);
  /// The next place is not joined to the last one.
  void lift();
  QString finish();
  /// Lets go, and takes back what it gave.
  void cancel();
  bool active() const { return m_record != nullptr; }
  bool heats() const { return active() && m_heats; }  ///< or cools
  bool holds() const { return m_holds; }              ///< it carries what it has taken hold of

 private:
  QString whyNot(const std::string& brush) const;
  QString send(std::vector<api::StrokeSample> way, const std::optional<api::StrokeSample>& stays);
  Vector3 speedTo(const Vector3& point, double seconds);

  Toolbox& m_box;
  std::string m_brush;
  api::EditKind m_kind = api::EditKind::Add;
  std::shared_ptr<StrokeRecord> m_record;
  StrokeSetup m_setup;
  std::unique_ptr<StrokeResampler> m_resampler;
  bool m_heats = false, m_holds = false;
  bool m_keeps = false;            ///< it does something that undo takes back
  std::optional<Vector3> m_place;  ///< m, the last one
  double m_seconds = 0;            ///< when it was there
  Vector3 m_velocity{0, 0, 0};     ///< m/s, of the hand
};

}  // namespace ps
