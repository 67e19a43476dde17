// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/viewport.h"

#include "core/base/error.h"
#include "core/simulation/engine.h"
#include "ui/document/document.h"
#include "ui/render/framing.h"
#include "ui/theme/numbers.h"
#include "ui/theme/theme.h"
#include "ui/viewport/hiddenbodies.h"

#include <QtGui/QOpenGLContext>
#include <QtGui/QPainter>
#include <QtGui/QResizeEvent>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kSlowSnapshots = 40;  // ms; only slower ones are interpolated, faster ones are shown as they come
constexpr int kMajor = 4, kMinor = 3;

}  // namespace

Viewport::Viewport(QWidget* parent) : QOpenGLWidget(parent) {
  installAccessibility();
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(480, 300);
  setAccessibleName(QStringLiteral("Scene"));
  setContextMenuPolicy(Qt::PreventContextMenu);
  m_paintTimer.setSingleShot(true);
  m_paintTimer.setTimerType(Qt::PreciseTimer);
  connect(&m_paintTimer, &QTimer::timeout, this, qOverload<>(&QWidget::update));
}

Viewport::~Viewport() {
  // The context goes with the base class, after this: it must not call a member then.
  if (context()) disconnect(context(), nullptr, this, nullptr);
  releaseGl();
}

void Viewport::releaseGl() {
  if (!m_renderer) return;
  makeCurrent();
  m_renderer.reset();
  doneCurrent();
}

void Viewport::attach(Document* document, EngineThread* engine, SceneLink* link) {
  if (m_document) disconnect(&m_document->undoStack(), nullptr, this, nullptr);
  m_document = document;
  m_engine = engine;
  m_stroke.attach(document, link);
  // A stroke in the making builds on the document as it was when it began.
  if (document) {
    connect(&document->undoStack(), &QUndoStack::indexChanged, this, [this] {
      if (m_stroke.active()) cancelGesture();
    });
  }
  if (!engine) m_now = m_previous = nullptr;
}

void Viewport::initializeGL() {
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &Viewport::releaseGl, Qt::UniqueConnection);
  const QSurfaceFormat format = context()->format();
  if (std::pair(format.majorVersion(), format.minorVersion()) < std::pair(kMajor, kMinor)) {
    m_problem = QStringLiteral(
                    "The scene needs OpenGL 4.3; this graphics driver offers %1.%2. Everything else works. "
                    "A newer driver, or LIBGL_ALWAYS_SOFTWARE=1 in the environment, brings the picture.")
                    .arg(format.majorVersion())
                    .arg(format.minorVersion());
  } else {
    try {
      m_renderer = std::make_unique<Renderer>();
      m_problem.clear();
    } catch (const std::exception& error) {
      m_problem = QStringLiteral("The scene cannot be drawn: %1").arg(QString::fromUtf8(error.what()));
    }
  }
  if (m_problem.isEmpty()) {
    Q_EMIT glReady(QStringLiteral("OpenGL %1.%2").arg(format.majorVersion()).arg(format.minorVersion()));
  } else {
    Q_EMIT glFailed(m_problem);
  }
}

void Viewport::snapshotArrived() {
  if (!m_engine) return;
  m_now = withoutBodies(m_engine->snapshot(), m_hidden);
  m_previous = withoutBodies(m_engine->previousSnapshot(), m_hidden);
  m_interval = m_sinceSnapshot.isValid() ? std::min<double>(200, static_cast<double>(m_sinceSnapshot.elapsed())) : 0;
  m_sinceSnapshot.start();
  requestPaint();
}

/// Paints as often as pictures come, but leaves as long a pause after each as it took: on a machine that draws in
/// software the solver needs the other half.
void Viewport::requestPaint() {
  if (m_paintTimer.isActive()) return;
  const double since = m_sincePaint.isValid() ? static_cast<double>(m_sincePaint.elapsed()) : 1e9;
  const double pause = m_drawCost > 8 ? m_drawCost : 0;
  m_paintTimer.start(static_cast<int>(std::max(0.0, pause - since)));
}

double Viewport::blend() const {
  if (!m_previous || m_interval < kSlowSnapshots || m_drawCost * 3 > m_interval) return 1;
  return std::clamp(static_cast<double>(m_sinceSnapshot.elapsed()) / m_interval, 0.0, 1.0);
}

Look Viewport::look() {
  Look look;
  look.colour = m_colour;
  if (m_now) m_range = m_legendRange.update(m_colour, colourRange(*m_now, m_colour));
  look.rangeMinimum = m_range.first;
  look.rangeMaximum = m_range.second;
  look.dark = Theme::current().dark();
  look.meltingPoint = m_meltingPoint;
  look.outline = outline();
  return look;
}

/// Around the selected body, two logical pixels wide.
std::optional<BodyOutline> Viewport::outline() const {
  if (m_selectedBody.empty() || !m_now || !m_now->bodyIds) return std::nullopt;
  const auto found = std::find(m_now->bodyIds->begin(), m_now->bodyIds->end(), m_selectedBody);
  if (found == m_now->bodyIds->end()) return std::nullopt;
  const auto channels = [](const QColor& c) { return std::array{c.redF(), c.greenF(), c.blueF()}; };
  BodyOutline outline;
  outline.body = static_cast<uint32_t>(found - m_now->bodyIds->begin());
  outline.colour = channels(Theme::current()[Token::Accent]);
  outline.halo = channels(Theme::current()[Token::Shadow]);
  outline.lineWidth *= static_cast<float>(devicePixelRatioF());
  outline.haloWidth *= static_cast<float>(devicePixelRatioF());
  return outline;
}

void Viewport::paintGL() {
  QElapsedTimer clock;
  clock.start();
  m_navigator.setSize(size());
  if (m_unframed && m_now && m_now->revision != *m_unframed) {
    m_unframed.reset();
    m_navigator.setScene(cameraShowing(*m_now, m_scene.environment, width(), height()));
  }
  static const Snapshot kEmpty;
  double share = 1;
  if (m_renderer) {
    share = blend();
    try {
      m_renderer->prepare(m_now ? *m_now : kEmpty, share < 1 ? m_previous.get() : nullptr, share, m_scene, look());
      const PictureSize pixels{std::max(1, static_cast<int>(std::lround(width() * devicePixelRatioF()))),
                               std::max(1, static_cast<int>(std::lround(height() * devicePixelRatioF())))};
      m_renderer->draw(eyeOf(m_navigator.camera(), pixels.width, pixels.height),
                       {defaultFramebufferObject(), 0, 0, pixels});
    } catch (const std::exception& error) {
      m_problem = QStringLiteral("The scene cannot be drawn: %1").arg(QString::fromUtf8(error.what()));
      m_renderer.reset();
      Q_EMIT glFailed(m_problem);
    }
  }
  {
    QPainter painter(this);
    if (m_renderer) {
      paintPortsOver(painter);
      m_hits = paintOverlays(painter, overlayState());
    } else {
      painter.fillRect(rect(), Theme::current()[Token::Panel]);
      paintMessage(painter, size(), QStringLiteral("No picture of the scene"), m_problem);
    }
  }
  m_drawCost += (static_cast<double>(clock.nsecsElapsed()) * 1e-6 - m_drawCost) * (m_drawCost > 0 ? 0.2 : 1);
  m_sincePaint.start();
  if (share < 1) requestPaint();
}

OverlayState Viewport::overlayState() const {
  OverlayState state;
  state.size = size();
  state.camera = m_navigator.camera();
  state.viewName = m_navigator.viewName();
  state.colour = m_colour;
  state.range = m_range;
  state.meltingPoint = m_meltingPoint;
  state.boilingPoint = m_boilingPoint;
  state.empty = !m_now;
  state.hint = m_hint;
  state.tool = m_tool;
  state.tag = tag();
  state.invitation = invitation();
  if (draws(m_tool) && m_drag != Drag::Orbit && m_drag != Drag::Pan) state.cursor = m_cursor;
  return state;
}

QString Viewport::invitation() const {
  const bool bare = m_now && m_now->bodyIds && m_now->id.empty() && m_hidden.empty();
  const bool pours = m_document && !m_document->project().emitters.empty();  // there will be matter
  if (!bare || pours || m_stroke.active() || m_tool == ViewTool::Erase) return {};
  return m_tool == ViewTool::Brush ? QStringLiteral("Draw with the left button")
                                   : QStringLiteral("Press B and draw, or choose a material at the left");
}

std::optional<SceneTag> Viewport::tag() const {
  if (!m_tagged || !m_now || m_now->revision != m_tagged->first || !m_document) return std::nullopt;
  const auto found = std::find(m_now->id.begin(), m_now->id.end(), m_tagged->second);
  if (found == m_now->id.end()) return std::nullopt;
  const auto row = static_cast<size_t>(found - m_now->id.begin());
  SceneTag tag;
  const api::Float4& p = m_now->position[row];
  tag.place = {p.x, p.y, p.z};
  const uint32_t index = m_now->body[row];
  const Body* body =
      m_now->bodyIds && index < m_now->bodyIds->size() ? m_document->body((*m_now->bodyIds)[index]) : nullptr;
  if (body) tag.name = QString::fromStdString(body->name);
  constexpr double kZero = 273.15;
  tag.value = formatFixed(static_cast<double>(m_now->temperature[row]) - kZero, 1) + QStringLiteral(" °C  ") +
              phaseName(m_now->phase[row]);
  return tag;
}

void Viewport::projectOpened() {
  if (!m_document) return;
  m_stroke.cancel();
  m_unframed.reset();
  if (const auto& camera = m_document->project().view.camera)
    m_navigator.setScene({camera->target, camera->distance, camera->azimuth, camera->elevation});
  else
    m_unframed = m_now ? m_now->revision : 0;  // framed when there is something of it to see
  m_legendRange.reset();
  m_tagged.reset();
  m_selectedBody.clear();
  m_selectedPort.reset();
  m_hoveredPort.reset();
  endPortDrag(true);
  setColour(colourByName(m_document->project().view.colour));
  bodiesChanged();
}

void Viewport::bodiesChanged() {
  if (!m_document) return;
  m_scene.environment = m_document->project().environment;
  m_hidden.clear();
  for (const Body& body : m_document->project().bodies) {
    if (!body.visible) m_hidden.insert(body.id);
  }
  if (m_engine) {
    m_now = withoutBodies(m_engine->snapshot(), m_hidden);
    m_previous = nullptr;
  }
  requestPaint();
}

void Viewport::setTool(ViewTool tool) {
  if (tool == m_tool) return;
  m_stroke.cancel();
  m_tool = tool;
  m_placing = {};
  m_cursor.reset();
  if (tool == ViewTool::Select) {
    unsetCursor();
  } else if (places(tool)) {
    setCursor(Qt::CrossCursor);
  } else {
    setCursor(Qt::BlankCursor);
    updateCursor(mapFromGlobal(QCursor::pos()), {});
  }
  update();
  announce();
  Q_EMIT toolChanged(tool);
}

void Viewport::setBrush(const BrushSettings& brush) {
  if (brush == m_brush) return;
  m_brush = brush;
  if (m_cursor) m_cursor->extent = brushExtent();
  update();
  announce();
  Q_EMIT brushChanged();
}

void Viewport::setColour(ColourBy colour) {
  m_colour = colour;
  m_legendRange.reset();
  update();
}

void Viewport::show(StandardView view) {
  m_navigator.setSize(size());
  m_navigator.show(view);
  storeView();
  update();
}

void Viewport::storeView() {
  if (m_document) m_document->setView(m_navigator.view());
}

std::optional<Box> Viewport::boxOfBody(const std::string& id) const {
  if (!m_now || !m_now->bodyIds) return std::nullopt;
  const auto found = std::find(m_now->bodyIds->begin(), m_now->bodyIds->end(), id);
  if (found == m_now->bodyIds->end()) return std::nullopt;
  return boxOf(*m_now, static_cast<uint32_t>(found - m_now->bodyIds->begin()));
}

void Viewport::frameSelection() {
  if (m_selectedBody.empty() && !m_selectedPort) {
    frameAll();
    return;
  }
  const auto box = m_selectedPort ? boxAround(*m_selectedPort) : boxOfBody(m_selectedBody);
  if (!box) return;
  m_navigator.setSize(size());
  m_navigator.frame(*box);
  storeView();
  update();
}

void Viewport::frameAll() {
  static const Snapshot kEmpty;
  m_navigator.setSize(size());
  m_navigator.frame(boxOf(m_now ? *m_now : kEmpty, m_scene.environment));
  storeView();
  update();
}

void Viewport::setSelectedBody(const std::string& id) {
  if (m_selectedBody != id) m_tagged.reset();
  m_selectedBody = id;
  update();
}

void Viewport::setHintShown(bool on) {
  m_hint = on;
  update();
}

void Viewport::setTransitions(double meltingPoint, double boilingPoint) {
  m_meltingPoint = meltingPoint;
  m_boilingPoint = boilingPoint;
  update();
}

void Viewport::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  m_navigator.setSize(event->size());
}

}  // namespace ps
