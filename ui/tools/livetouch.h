// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/stroke.h"
#include "ui/document/strokerecord.h"
#include "ui/tools/brushsettings.h"
#include "ui/tools/held.h"
#include "ui/tools/sight.h"

#include <QtCore/QString>
#include <QtCore/QTimer>

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ps {

class Document;
class PluginRegistry;
class Toolbox;

/// Whether a brush that touches matter gives or takes heat: it declares a power.
bool hasPower(const PluginRegistry& plugins, const std::string& brush);
/// What holds in this scene of a brush's own parameters that nobody has set, in place of their declared defaults:
/// powers. They are declared for heat that is as fast as it really is, and a power counts on the thermal clock.
ParameterSet standardValues(const Document& document, const std::string& brush);

/// A hand that works on the matter that is there, by a brush that says so: takes places along its way, lets the brush
/// say on another thread what it does there, sends that straight to the engine, which does it as time passes in the
/// scene, and hands the document one command at the end where undo has heat to take back. What a brush says at once is
/// waited for; a slow one is asked for all the places that have come meanwhile.
class LiveTouch {
 public:
  /// `onTrouble` hears what went wrong with a brush that took its time; the hand has let go by then.
  LiveTouch(Toolbox& box, std::function<void(const QString&)> onTrouble);

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
  double effort(const Snapshot& scene) const;         ///< N, how hard it worked there

 private:
  /// What the brush does along a way, and where the hand is at its end.
  using Touches = std::pair<std::vector<api::Touch>, std::vector<api::Touch>>;
  QString whyNot(const std::string& brush) const;
  QString send(const std::vector<api::StrokeSample>& way, const std::optional<api::StrokeSample>& stays);
  void call();
  QString take();
  QString goOn(std::chrono::milliseconds patience);
  QString fail(const char* why);
  void watch();

  Toolbox& m_box;
  std::function<void(const QString&)> m_onTrouble;
  std::vector<api::StrokeSample> m_way;      ///< that the brush has not been asked for yet
  std::optional<api::StrokeSample> m_stays;  ///< likewise
  bool m_waits = false;                      ///< any of these
  std::future<Touches> m_call;               ///< valid while the brush is at it
  uint32_t m_called = 0;                     ///< places that it was asked for
  QTimer m_looks;                            ///< whether it has come back
  int m_looked = 0;                          ///< since it was asked
  std::string m_brush;
  api::EditKind m_kind = api::EditKind::Add;
  std::shared_ptr<StrokeRecord> m_record;
  StrokeSetup m_setup;
  std::unique_ptr<StrokeResampler> m_resampler;
  bool m_heats = false, m_holds = false;
  bool m_keeps = false;  ///< it does something that undo takes back
  Sight m_sight;
};

}  // namespace ps
