// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/livetouch.h"

#include "core/base/digits.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/touch.h"
#include "core/sketch/matterbrush.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/scenelink.h"
#include "ui/tools/brushcall.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace ps {
namespace {

/// What a brush says within this is waited for: the hand feels it in the same picture.
constexpr std::chrono::milliseconds kAtOnce{4};
constexpr std::chrono::milliseconds kLook{20};

bool any(const std::vector<api::Touch>& touches, api::TouchKind kind) {
  return std::any_of(touches.begin(), touches.end(), [&](const api::Touch& touch) { return touch.kind == kind; });
}
bool keeps(const std::vector<api::Touch>& touches) {
  using enum api::TouchKind;
  return any(touches, Heat) || any(touches, Cut) || any(touches, Weld);
}

bool isPower(const api::ParameterDeclaration& declaration) {
  return declaration.kind == api::ParameterKind::Number && std::string_view(declaration.unit) == "W";
}

}  // namespace

bool hasPower(const PluginRegistry& plugins, const std::string& brush) {
  const api::ParameterList own = plugins.parameters(brush);
  for (size_t k = 0; k < own.count; ++k) {
    if (isPower(own[k])) return true;
  }
  return false;
}

ParameterSet standardValues(const Document& document, const std::string& brush) {
  ParameterSet standard;
  const PluginRegistry* plugins = document.plugins();
  const Value lapse = document.value({Owner::Solver, "", "thermal_time_scale"});
  const auto* times = std::get_if<double>(&lapse);
  if (!plugins || !plugins->needs(brush, api::kTouchesMatter) || !times || !(*times > 1)) return standard;
  const api::ParameterList own = plugins->parameters(brush);
  for (size_t k = 0; k < own.count; ++k) {
    if (!isPower(own[k]) || !(own[k].defaultValue > 0)) continue;
    standard.values[own[k].key] = std::max(own[k].hardMinimum, toDigits(own[k].defaultValue / *times, 2));
  }
  return standard;
}

LiveTouch::LiveTouch(Toolbox& box, std::function<void(const QString&)> onTrouble)
    : m_box(box), m_onTrouble(std::move(onTrouble)) {
  QObject::connect(&m_looks, &QTimer::timeout, &m_looks, [this] { watch(); });
}

QString LiveTouch::whyNot(const std::string& brush) const {
  const PluginRegistry* plugins = m_box.document().plugins();
  if (!plugins || !m_box.link()) return QStringLiteral("Plugins are still being loaded.");
  if (!plugins->brush(brush))
    return QStringLiteral("The brush “%1” is not installed. See Plugins.").arg(QString::fromStdString(brush));
  if (!m_box.link()->runs())
    return QStringLiteral("A hand in matter works while time passes. Press Space to let the scene run.");
  return {};
}

QString LiveTouch::begin(const BrushSettings& brush, bool opposite, const Vector3& point, const Vector3& up,
                         const Vector3& look, const Held& held) {
  if (const QString problem = whyNot(brush.shape); !problem.isEmpty()) return problem;
  const PluginRegistry& plugins = *m_box.document().plugins();
  m_brush = brush.shape;
  m_kind = opposite ? api::EditKind::Remove : api::EditKind::Add;
  m_setup = strokeSetup(brush, plugins, m_box.spacing(), up);
  ParameterSet values = standardValues(m_box.document(), brush.shape);
  for (const auto& [key, value] : brush.shapeParameters().values) values.values[key] = value;
  m_setup.parameters = numbersOf(values, plugins.parameters(brush.shape));
  m_setup.look = look;
  m_setup.matterWithin = m_sight.matterWithin();
  m_resampler = std::make_unique<StrokeResampler>(m_setup.grid.spacing);
  m_record = std::make_shared<StrokeRecord>();
  m_record->deed = pluginLabel(&plugins, m_brush).toStdString() + " matter";
  if (opposite) m_record->deed += ", the opposite";
  m_heats = m_holds = m_keeps = m_waits = false;
  m_way.clear();
  return move(point, 0, held);
}

QString LiveTouch::move(const Vector3& point, double seconds, const Held& held) {
  if (!m_record) return {};
  api::StrokeSample here{double3Of(point), held.pressure, seconds, {}};
  here.turn = double3Of(held.turn);
  if (m_box.link()) m_sight.show(m_box.link()->scene());
  return send(m_resampler->add(here), here);
}

QString LiveTouch::send(const std::vector<api::StrokeSample>& way, const std::optional<api::StrokeSample>& stays) {
  m_way.insert(m_way.end(), way.begin(), way.end());
  m_stays = stays;
  m_waits = true;
  return goOn(kAtOnce);
}

/// On a thread of its own, which owns all that it needs: one that does not come back must not take the window along.
void LiveTouch::call() {
  const api::BrushPlugin* plugin = m_box.document().plugins()->brush(m_brush);
  if (!plugin) throw BrushFault("it is not installed any more");
  m_called = static_cast<uint32_t>(std::max<size_t>(1, m_way.size()));
  auto work = [plugin, brush = m_brush, setup = m_setup, kind = m_kind, way = std::exchange(m_way, {}),
               stays = std::exchange(m_stays, {})] {
    const CalleeScope callee(brush.c_str());
    const auto touches = [&](std::span<const api::StrokeSample> places) {
      return places.empty() ? std::vector<api::Touch>{} : touchesOf(*plugin, setup, kind, places);
    };
    const std::span<const api::StrokeSample> at = stays ? std::span(&*stays, 1) : std::span<const api::StrokeSample>();
    return Touches(touches(way), touches(at));
  };
  m_waits = false;
  m_looked = 0;
  std::packaged_task<Touches()> task(std::move(work));
  m_call = task.get_future();
  runDetached(std::move(task));
}

/// What the brush has said goes to the engine.
QString LiveTouch::take() {
  auto [path, still] = m_call.get();
  m_heats = m_heats || any(path, api::TouchKind::Heat) || any(still, api::TouchKind::Heat);
  m_holds = m_holds || any(still, api::TouchKind::Hold);
  m_keeps = m_keeps || keeps(path) || keeps(still);
  if (m_heats && m_box.document().project().solver.thermalModel.empty()) {
    cancel();
    return QStringLiteral("The scene has no thermal model, so nothing can be heated. Choose one under Solver.");
  }
  m_box.link()->touch(*m_record, TouchMatter{std::move(path), m_called, std::move(still), {}, 0});
  return {};
}

/// Asks for what waits, and takes what comes, as long as each call takes no longer than that.
QString LiveTouch::goOn(std::chrono::milliseconds patience) {
  try {
    while (m_record) {
      if (!m_call.valid() && !m_waits) break;
      if (!m_call.valid()) call();
      if (m_call.wait_for(patience) != std::future_status::ready) {
        if (!m_looks.isActive()) m_looks.start(kLook);  // a hand that moves must not keep it from looking
        return {};
      }
      if (const QString problem = take(); !problem.isEmpty()) return problem;
    }
    m_looks.stop();
    return {};
  } catch (const BrushFault& fault) {
    return fail(fault.what());
  } catch (const std::exception& error) {
    cancel();
    return QString::fromUtf8(error.what());
  }
}

QString LiveTouch::fail(const char* why) {
  cancel();
  m_box.putAside(m_brush, why);
  return QStringLiteral("The brush “%1” failed: %2. It is put aside until the program starts again; see Plugins.")
      .arg(QString::fromStdString(m_brush), QString::fromUtf8(why));
}

/// Counted in looks, so that a program that was stopped accuses nobody.
void LiveTouch::watch() {
  const bool isLost = m_call.valid() && ++m_looked > kBrushLooks * (kBrushLook / kLook);
  const QString problem = isLost ? fail(kNotBack) : goOn(std::chrono::milliseconds(0));
  if (!problem.isEmpty()) m_onTrouble(problem);
}

double LiveTouch::effort(const Snapshot& scene) const {
  if (!m_record) return 0;
  const std::string name = contactOf(*m_record->matter);
  const auto found =
      std::find_if(scene.tools.begin(), scene.tools.end(), [&](const ToolContact& one) { return one.body == name; });
  return found == scene.tools.end() ? 0 : found->force.norm();
}

void LiveTouch::lift() {
  if (!m_record) return;
  m_resampler = std::make_unique<StrokeResampler>(m_setup.grid.spacing);
}

QString LiveTouch::finish() {
  if (!m_record) return {};
  QString problem = send(m_resampler->finish(), std::nullopt);
  // Looks are counted anew for each call.
  for (m_looked = 0; m_looked < kBrushLooks && m_record && (m_call.valid() || m_waits); ++m_looked)
    problem = goOn(kBrushLook);
  if (m_record && m_call.valid()) return fail(kNotBack);
  if (!m_record) return problem;  // the brush failed
  m_sight.show(nullptr);          // which keeps a whole scene
  const std::shared_ptr<StrokeRecord> record = std::exchange(m_record, nullptr);
  if (m_keeps) m_box.document().addStroke(record);
  return problem;
}

void LiveTouch::cancel() {
  if (!m_record) return;
  const std::shared_ptr<StrokeRecord> record = std::exchange(m_record, nullptr);
  m_looks.stop();
  m_call = {};  // it goes on, and what it gives is dropped
  m_way.clear();
  m_waits = false;
  m_sight.show(nullptr);
  if (m_box.link()) m_box.link()->cancel(record);
}

}  // namespace ps
