// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/strokelistedits.h"

#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/sketch/cellset.h"
#include "ui/document/document.h"
#include "ui/document/redrawing.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/tools/brushcall.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QPointer>

#include <algorithm>
#include <thread>
#include <utility>

namespace ps {
namespace {

/// Cells of a sketch that none of its strokes explains. What cannot be drawn as it was explains nobody knows what: an
/// open hollow, or a brush that has gone.
size_t lostOf(const Project& project, const std::string& body, const VoxelShape& sketch,
              const PluginRegistry& plugins) {
  try {
    return cellsBeyond(sketch, redrawnIn(project, body, sketch, sketch.spacing, plugins));
  } catch (const InputError&) {
    return 0;
  }
}

}  // namespace

StrokeListEdits::StrokeListEdits(Session& session, QObject* parent) : QObject(parent), m_session(session) {}

StrokeListEdits::~StrokeListEdits() {
  if (m_work.valid()) m_work.wait_for(kBrushLooks * kBrushLook);
}

void StrokeListEdits::stay(const QString& why) { Q_EMIT told(QStringLiteral("The strokes stay as they are."), why); }

const Body* StrokeListEdits::sketched(const std::string& id, size_t stroke) {
  const Body* body = m_session.document().body(id);
  const auto* sketch = body ? std::get_if<VoxelShape>(&body->shape) : nullptr;
  if (!sketch || stroke >= sketch->strokes.size() || !m_session.plugins()) return nullptr;
  if (m_busy) {
    stay(QStringLiteral("They are still being drawn again."));
    return nullptr;
  }
  if (!body->locked) return body;
  stay(QStringLiteral("%1 is locked. Unlock it in the outliner.").arg(QString::fromStdString(body->name)));
  return nullptr;
}

void StrokeListEdits::remove(const std::string& id, size_t stroke) {
  const Body* body = sketched(id, stroke);
  if (!body) return;
  VoxelShape wanted = std::get<VoxelShape>(body->shape);
  if (wanted.strokes.size() == 1) {
    if (const QString problem = m_session.document().removeBody(id); !problem.isEmpty()) stay(problem);
    return;
  }
  wanted.strokes.erase(wanted.strokes.begin() + static_cast<ptrdiff_t>(stroke));
  redraw(*body, std::move(wanted), QStringLiteral("removal of a stroke of %1"), stroke);
}

void StrokeListEdits::move(const std::string& id, size_t stroke, size_t to) {
  const Body* body = sketched(id, stroke);
  if (!body) return;
  VoxelShape wanted = std::get<VoxelShape>(body->shape);
  if (to >= wanted.strokes.size() || to == stroke) return;
  const auto at = [&](size_t k) { return wanted.strokes.begin() + static_cast<ptrdiff_t>(k); };
  if (to > stroke)
    std::rotate(at(stroke), at(stroke + 1), at(to + 1));
  else
    std::rotate(at(to), at(stroke), at(stroke + 1));
  redraw(*body, std::move(wanted), QStringLiteral("order of the strokes of %1"), to);
}

void StrokeListEdits::setHidden(const std::string& id, size_t stroke, bool hidden) {
  const Body* body = sketched(id, stroke);
  if (!body) return;
  VoxelShape wanted = std::get<VoxelShape>(body->shape);
  if (wanted.strokes[stroke].hidden == hidden) return;
  wanted.strokes[stroke].hidden = hidden;
  const auto isHidden = [](const VoxelShape::Stroke& one) { return one.hidden; };
  if (std::all_of(wanted.strokes.begin(), wanted.strokes.end(), isHidden))
    return stay(QStringLiteral("It is the only one that is shown. Hide %1 in the outliner instead.")
                    .arg(QString::fromStdString(body->name)));
  redraw(*body, std::move(wanted),
         hidden ? QStringLiteral("hiding a stroke of %1") : QStringLiteral("showing a stroke of %1"), stroke);
}

void StrokeListEdits::setMaterial(const std::string& id, size_t stroke, const std::string& material) {
  const Body* body = sketched(id, stroke);
  if (!body) return;
  VoxelShape wanted = std::get<VoxelShape>(body->shape);
  const auto old = static_cast<size_t>(wanted.strokes[stroke].palette);
  if (old >= wanted.palette.size() || wanted.palette[old].material == material) return;
  const double temperature = wanted.palette[old].temperature;
  const auto found = std::find_if(wanted.palette.begin(), wanted.palette.end(), [&](const auto& entry) {
    return entry.material == material && entry.temperature == temperature && entry.colour.empty();
  });
  wanted.strokes[stroke].palette = static_cast<int>(found - wanted.palette.begin());
  if (found == wanted.palette.end()) wanted.palette.push_back({material, temperature, {}});
  redraw(*body, std::move(wanted), QStringLiteral("material of a stroke of %1"), stroke);
}

void StrokeListEdits::carry(const std::string& id, size_t stroke, const Vector3& way) {
  const Body* body = sketched(id, stroke);
  if (!body) return;
  VoxelShape wanted = std::get<VoxelShape>(body->shape);
  const Vector3 own = gridOf(wanted).pose.inverse().turn * way;
  for (auto& sample : wanted.strokes[stroke].samples)
    for (int k = 0; k < 3; ++k) sample[static_cast<size_t>(k)] += own[k];
  redraw(*body, std::move(wanted), QStringLiteral("moving a stroke of %1"), stroke);
}

void StrokeListEdits::replace(const std::string& id, size_t stroke, VoxelShape::Stroke other) {
  const Body* body = sketched(id, stroke);
  if (!body) return;
  VoxelShape wanted = std::get<VoxelShape>(body->shape);
  other.palette = wanted.strokes[stroke].palette;
  wanted.strokes[stroke] = std::move(other);
  redraw(*body, std::move(wanted), QStringLiteral("drawing a stroke of %1 anew"), stroke);
}

void StrokeListEdits::redraw(const Body& body, VoxelShape wanted, const QString& title, size_t stroke) {
  m_body = body.id;
  m_title = title.arg(QString::fromStdString(body.name));
  m_stroke = stroke;
  m_begun = m_session.document().changeCount();
  std::packaged_task<Drawn()> task([project = m_session.document().project(), plugins = m_session.plugins(),
                                    id = body.id, before = std::get<VoxelShape>(body.shape),
                                    wanted = std::move(wanted)] {
    Drawn drawn;
    try {
      drawn.sketch = redrawnIn(project, id, wanted, wanted.spacing, *plugins);
      drawn.lost = lostOf(project, id, before, *plugins);
    } catch (const std::exception& error) {
      drawn.problem = QString::fromUtf8(error.what());
    }
    return drawn;
  });
  m_work = task.get_future();
  m_busy = true;
  std::thread([task = std::move(task), self = QPointer<StrokeListEdits>(this)]() mutable {
    task();
    const auto take = [self = std::move(self)] {
      if (self) self->take();
    };
    QMetaObject::invokeMethod(QCoreApplication::instance(), take, Qt::QueuedConnection);
  }).detach();
  Q_EMIT busyChanged();
}

void StrokeListEdits::take() {
  const Drawn drawn = m_work.get();
  m_busy = false;
  Q_EMIT busyChanged();
  Document& document = m_session.document();
  const Body* body = document.body(m_body);
  if (!drawn.problem.isEmpty()) return stay(drawn.problem);
  if (!body || !document.had(m_begun) || document.changeCount() != m_begun)
    return stay(QStringLiteral("The scene has changed meanwhile. Edit them again."));
  const QString name = QString::fromStdString(body->name);
  if (drawn.sketch.runs.empty())
    return stay(QStringLiteral("Nothing of %1 would be left. Delete the body instead.").arg(name));
  document.setSketch(m_body, drawn.sketch, m_title);
  QStringList news;
  if (drawn.lost > 0)
    news << QStringLiteral("%1 particles that none of its strokes explains are gone. Undo brings them back.")
                .arg(formatFixed(static_cast<double>(drawn.lost)));
  if (!m_session.appliesAtOnce()) news << QStringLiteral("The matter follows once back at the start: press Home.");
  if (!news.isEmpty()) Q_EMIT told(QStringLiteral("%1 was drawn again.").arg(name), news.join(QLatin1Char(' ')));
  Q_EMIT edited(m_stroke);
}

}  // namespace ps
