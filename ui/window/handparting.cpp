// SPDX-License-Identifier: Apache-2.0
#include "ui/window/handparting.h"

#include "core/scene/shownname.h"
#include "core/simulation/enginethread.h"
#include "ui/document/document.h"
#include "ui/session/preferences.h"
#include "ui/session/scenelink.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/worker.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QPointer>
#include <QtCore/QTimer>
#include <QtGui/QAction>

#include <algorithm>
#include <utility>
#include <variant>

namespace ps {
namespace {

constexpr size_t kCrumb = 8;     // cells, that are no crumb
constexpr size_t kMost = 20;     // pieces of a body, that it becomes without being asked
constexpr int kAgain = 20;       // ms
constexpr int kMostLooks = 50;   // for frames of a scene that has stopped
constexpr uint64_t kFrames = 4;  // after the end of a cut: see isEarly()
const QString kTopic = QStringLiteral("pieces");

size_t countOf(const Snapshot& scene, const std::string& body, const std::function<bool(const Vector3&)>& counts) {
  const std::vector<std::string>& ids = *scene.bodyIds;
  const auto index = static_cast<uint32_t>(std::find(ids.begin(), ids.end(), body) - ids.begin());
  size_t count = 0;
  for (size_t i = 0; i < scene.id.size(); ++i)
    count += scene.body[i] == index && counts(vectorOf(scene.position[i])) ? 1 : 0;
  return count;
}

}  // namespace

HandParting::HandParting(Session& session, Selection& selection, Notices& notices, QAction& separate,
                         Test hasOtherCells, QObject* parent)
    : QObject(parent),
      m_session(session),
      m_selection(selection),
      m_notices(notices),
      m_separate(separate),
      m_hasOtherCells(std::move(hasOtherCells)) {
  connect(&session.document(), &Document::changed, this, &HandParting::onChanged);
  connect(&session, &Session::ready, this, &HandParting::listen);
  if (session.isReady()) listen();
}

void HandParting::listen() { connect(m_session.link(), &SceneLink::parting, this, &HandParting::begin); }

/// What the scene is before the first of it; the engine gives that without much ado.
void HandParting::begin(const MatterRef& matter, const std::vector<api::Touch>& cuts) {
  dropGivenUp();
  auto found =
      std::find_if(m_strokes.begin(), m_strokes.end(), [&](const auto& one) { return one->matter.lock() == matter; });
  if (found == m_strokes.end()) {
    if (!preferences::piecesBecomeBodies() || m_session.isBroken()) return;
    auto stroke = std::make_shared<Stroke>();
    stroke->matter = matter;
    m_session.engine()->ask([before = stroke->before](const Engine& engine) { *before = tiedScene(engine); });
    found = m_strokes.insert(m_strokes.end(), std::move(stroke));
  }
  Stroke& stroke = **found;
  for (const api::Touch& cut : cuts) {
    const Vector3 centre(cut.centre.x, cut.centre.y, cut.centre.z), reach = Vector3::Constant(cut.radius);
    stroke.low = stroke.cuts ? stroke.low.cwiseMin(centre - reach).eval() : Vector3(centre - reach);
    stroke.high = stroke.cuts ? stroke.high.cwiseMax(centre + reach).eval() : Vector3(centre + reach);
    stroke.cuts = true;
  }
}

/// With the scenes that were kept for them: strokes that were cancelled, or that took nothing.
void HandParting::dropGivenUp() {
  std::erase_if(m_strokes, [](const StrokePtr& one) { return one->matter.expired(); });
}

void HandParting::onChanged(const ChangeEvent& event) {
  dropGivenUp();
  if (std::holds_alternative<ProjectOpened>(event)) {
    for (const StrokePtr& stroke : m_strokes) stroke->undone = true;
    m_strokes.clear();
    m_notices.bar().close(kTopic);
  }
  const auto* made = std::get_if<StrokeChanged>(&event);
  if (!made) return;
  if (!made->done) m_notices.bar().close(kTopic);
  for (const StrokePtr& stroke : m_strokes) {
    if (stroke->matter.lock() != made->stroke->matter) continue;
    stroke->undone = !made->done;
    if (!made->live || !made->done) continue;
    stroke->record = made->stroke;
    lookIn(0, stroke);
  }
}

std::vector<Body> HandParting::candidates() const {
  std::vector<Body> bodies;
  for (const Body& body : m_session.document().project().bodies) {
    if (mayComeApart(body) && !m_hasOtherCells(body.id)) bodies.push_back(body);
  }
  return bodies;
}

/// A step that could be redone is not given up for this.
bool HandParting::mayPart(const Stroke& stroke) const {
  return !stroke.undone && !stroke.record.expired() && m_session.engine() && !m_session.isBroken() &&
         !m_session.document().undoStack().canRedo();
}

/// The frame that is being computed may not have the cut yet; the next one makes it, and what it parts is known in
/// those after it, however long they take. Back at the start there are none to wait for.
bool HandParting::isEarly(Stroke& stroke) const {
  const SnapshotPtr now = m_session.newest();
  if (!stroke.cuts || !now || stroke.looks == kMostLooks) return false;
  const uint64_t frame = now->stats.frame;
  if (stroke.due == 0) stroke.due = frame + kFrames;
  if (!m_session.link()->runs()) ++stroke.looks;
  return frame < stroke.due && frame + kFrames >= stroke.due;
}

void HandParting::lookIn(int milliseconds, const StrokePtr& stroke) {
  QTimer::singleShot(milliseconds, this, [this, stroke] { look(stroke); });
}

/// Not while another hand draws on a body that might become two.
void HandParting::look(const StrokePtr& stroke) {
  const bool goesOn = mayPart(*stroke);
  if (goesOn && (m_session.link()->isDrawing() || isEarly(*stroke))) return lookIn(kAgain, stroke);
  const std::vector<Body> bodies = goesOn ? candidates() : std::vector<Body>();
  if (bodies.empty()) {
    std::erase(m_strokes, stroke);
    return;
  }
  // The engine's thread may come to it when the window has gone.
  m_session.engine()->ask([self = QPointer(this), stroke, bodies](const Engine& engine) {
    auto after = std::make_shared<const TiedScene>(tiedScene(engine));
    QMetaObject::invokeMethod(QCoreApplication::instance(), [self, stroke, bodies, after = std::move(after)] {
      if (self) self->take(stroke, after, bodies);
    });
  });
}

void HandParting::take(const StrokePtr& stroke, const std::shared_ptr<const TiedScene>& after,
                       const std::vector<Body>& bodies) {
  m_session.worker().run([self = QPointer(this), stroke, after, bodies] {
    auto found = partedBy(*stroke, *after, bodies);
    QMetaObject::invokeMethod(QCoreApplication::instance(), [self, stroke, found = std::move(found)] {
      if (self) self->part(stroke, found);
    });
  });
}

/// Matter of a body that an erasing stroke went through is less by then, that of one that was cut lies where the hand
/// was, or did.
bool HandParting::reaches(const Stroke& stroke, const TiedScene& after, const std::string& body) {
  const Snapshot &then = *stroke.before->scene, &now = *after.scene;
  const auto any = [](const Vector3&) { return true; };
  const auto isNear = [&](const Vector3& p) {
    return (p.array() >= stroke.low.array()).all() && (p.array() <= stroke.high.array()).all();
  };
  if (!stroke.cuts) return countOf(now, body, any) < countOf(then, body, any);
  return countOf(then, body, isNear) > 0 || countOf(now, body, isNear) > 0;
}

/// On a thread that may take its time.
std::vector<HandParting::Parted> HandParting::partedBy(const Stroke& stroke, const TiedScene& after,
                                                       const std::vector<Body>& bodies) {
  const TiedScene& before = *stroke.before;
  std::vector<Parted> found;
  if (!before.scene) return found;
  for (const Body& body : bodies) {
    if (!reaches(stroke, after, body.id) || !isSolid(after, body.id)) continue;
    std::vector<CellIndices> pieces = cutOff(piecesOf(before, body), piecesOf(after, body), kCrumb);
    if (!pieces.empty()) found.push_back({body, std::move(pieces)});
  }
  return found;
}

/// A body that has been drawn on, locked or fixed meanwhile stays whole.
void HandParting::part(const StrokePtr& stroke, const std::vector<Parted>& found) {
  if (mayPart(*stroke) && m_session.link()->isDrawing()) return lookIn(kAgain, stroke);
  std::erase(m_strokes, stroke);
  if (!mayPart(*stroke)) return;
  Document& document = m_session.document();
  std::vector<Parted> parted;
  for (const Parted& one : found) {
    const Body* now = document.body(one.body.id);
    if (!now || !mayComeApart(*now) || now->shape != one.body.shape || m_hasOtherCells(one.body.id)) continue;
    if (one.pieces.size() < kMost)
      parted.push_back(one);
    else
      tell(*now, one.pieces.size() + 1);
  }
  if (parted.size() > 1) document.undoStack().beginMacro(QStringLiteral("separating pieces"));
  for (const Parted& one : parted) document.partBody(one.body.id, one.pieces);
  if (parted.size() > 1) document.undoStack().endMacro();
}

void HandParting::tell(const Body& body, size_t pieces) {
  m_notices.bar().show(kTopic, MessageLevel::Info,
                       QStringLiteral("“%1” is in %2 pieces.").arg(QString::fromStdString(shownName(body))).arg(pieces),
                       QStringLiteral("They are one body still, as they are so many."),
                       {{m_separate.text(), [this, id = body.id] {
                           m_selection.selectBody(id);
                           m_separate.trigger();
                           m_notices.bar().close(kTopic);
                         }}});
}

}  // namespace ps
