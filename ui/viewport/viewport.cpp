// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/viewport.h"

#include "core/base/error.h"
#include "core/simulation/enginethread.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/film/hiddenbodies.h"
#include "ui/render/framing.h"
#include "ui/session/recordedview.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/transitions.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"
#include "ui/tools/heldplaces.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/viewport/gizmopainter.h"
#include "ui/viewport/portpainter.h"
#include "ui/viewport/propsevent.h"
#include "ui/viewport/viewportaccess.h"
#include "ui/viewport/wirepainter.h"

#include <QtGui/QAccessible>
#include <QtGui/QHelpEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QOpenGLContext>
#include <QtGui/QPainter>
#include <QtGui/QResizeEvent>
#include <QtGui/QSurfaceFormat>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kSlowSnapshots = 40;  // ms; only slower ones are interpolated, faster ones are shown as they come
constexpr int kMajor = 4, kMinor = 3;

}  // namespace

void requestViewFormat() {
  QSurfaceFormat format;
  format.setVersion(4, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  format.setSwapInterval(1);
  QSurfaceFormat::setDefaultFormat(format);
}

Viewport::Viewport(Session& session, Selection& selection, Toolbox& tools, QWidget* parent)
    : QOpenGLWidget(parent),
      m_session(session),
      m_document(session.document()),
      m_selection(selection),
      m_tools(tools) {
  installViewportAccessibility();
  setMouseTracking(true);
  setTabletTracking(true);  // which end of the pen hovers
  setAcceptDrops(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(480, 300);
  setAccessibleName(QStringLiteral("Scene"));
  setContextMenuPolicy(Qt::PreventContextMenu);
  m_clock.start();
  m_paintTimer.setSingleShot(true);
  m_paintTimer.setTimerType(Qt::PreciseTimer);
  connect(&m_paintTimer, &QTimer::timeout, this, qOverload<>(&QWidget::update));
  connect(&m_document, &Document::changed, this, &Viewport::onChanged);
  connect(&session, &Session::snapshotArrived, this, &Viewport::snapshotArrived);
  connect(&session, &Session::playingChanged, this, qOverload<>(&QWidget::update));  // a hint names what Space does
  connect(&session.recorded(), &RecordedView::ghostChanged, this, &Viewport::ghostChanged);
  connect(&session.transitions(), &Transitions::changed, this, qOverload<>(&QWidget::update));
  const auto show = [this] {
    update();
    announce();
  };
  connect(&selection, &Selection::changed, this, show);
  connect(&tools, &Toolbox::toolChanged, this, &Viewport::onTool);
  connect(&tools, &Toolbox::mouseChanged, this, qOverload<>(&QWidget::update));
  connect(&tools, &Toolbox::handlesChanged, this, show);
  connect(&tools, &Toolbox::strokeChosen, this, show);
  connect(&tools, &Toolbox::brushChanged, this, show);
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

void Viewport::onChanged(const ChangeEvent& event) {
  if (std::holds_alternative<ProjectOpened>(event)) {
    projectOpened();
  } else if (std::holds_alternative<BodyChanged>(event) || std::holds_alternative<StrokeChanged>(event) ||
             std::holds_alternative<WallsChanged>(event) || std::holds_alternative<TracksChanged>(event)) {
    const auto* body = std::get_if<BodyChanged>(&event);
    if (!body || !body->move) bodiesChanged();  // else the next snapshot shows it
    update();
  } else if (const auto* parameter = std::get_if<ParameterChanged>(&event)) {
    const Owner owner = parameter->address.owner;
    if (owner == Owner::Wall) bodiesChanged();
    if (owner == Owner::Emitter || owner == Owner::Sink) update();
  } else if (const auto* port = std::get_if<PortChanged>(&event)) {
    if (!port->moved) bodiesChanged();  // a tap that is hidden takes what it has poured with it
    update();
  } else if (std::holds_alternative<ProbesChanged>(event)) {
    update();
  } else if (std::holds_alternative<ViewChanged>(event)) {
    m_colour = m_document.project().view.colour;
    m_legendRange.reset();
    update();
  }
}

/// Another tool is in hand.
void Viewport::onTool() {
  if (m_drag == Drag::Tool) m_drag = Drag::None;
  const QPoint at = mapFromGlobal(QCursor::pos());
  if (rect().contains(at)) m_tools.tool().hover(pointerAt(at, {}));
  updatePointer(at);
  update();
  announce();
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
      m_shown.reset();
      m_problem.clear();
    } catch (const std::exception& error) {
      m_problem = QStringLiteral("The scene cannot be drawn: %1").arg(QString::fromUtf8(error.what()));
    }
  }
  if (m_problem.isEmpty()) {
    m_graphics = QStringLiteral("OpenGL %1.%2").arg(format.majorVersion()).arg(format.minorVersion());
    Q_EMIT glReady();
  } else {
    Q_EMIT glFailed(m_problem);
  }
}

void Viewport::snapshotArrived() {
  m_now = withoutBodies(m_session.snapshot(), m_hidden);
  m_previous = withoutBodies(m_session.previousSnapshot(), m_hidden);
  m_interval = m_sinceSnapshot.isValid() ? std::min<double>(200, static_cast<double>(m_sinceSnapshot.elapsed())) : 0;
  m_sinceSnapshot.start();
  if (!m_document.project().tracks.empty()) m_scene.environment = m_session.surroundings();
  m_box.reset();
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
      const Shown wanted{m_now, share < 1 ? m_previous : nullptr, share, look()};
      if (m_shown != wanted)
        m_renderer->prepare(m_now ? *m_now : kEmpty, wanted.previous.get(), share, m_scene, wanted.look);
      m_shown = wanted;
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
      m_tools.tool().see(m_now.get());
      paintPortsOver(painter);
      ToolPicture picture = m_tools.tool().picture();
      if (!m_dropNote.isEmpty() && picture.gizmo) picture.gizmo->note.clear();  // it would stand in the same place
      if (std::optional<Wire> stroke = m_tools.strokeWire()) picture.wires.push_back(std::move(*stroke));
      paintWires(painter, picture.wires, m_navigator.camera(), size());
      if (m_now && m_overlays.outlines)
        paintPins(painter, heldPlaces(m_session.document().project(), m_selection, *m_now), m_navigator.camera(),
                  size());
      if (picture.gizmo) paintGizmo(painter, *picture.gizmo, m_navigator.camera(), size(), m_covered);
      if (picture.frame) paintFrame(painter, *picture.frame, m_navigator.camera(), size());
      if (!m_dropNote.isEmpty()) paintNote(painter, m_dropNote, size(), m_covered);
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
  state.field = m_session.fields().find(m_colour);
  state.range = m_range;
  if (state.field && state.field->bodies) state.classes = bodyClasses();
  state.meltingPoint = meltingPoint();
  state.boilingPoint = m_session.transitions().boils();
  state.empty = !m_now;
  state.shown = m_overlays;
  state.top = m_covered;
  if (m_overlays.hints) state.hints = hints();
  if (m_session.recorded().isActive()) state.without = QStringLiteral("not recorded");
  const ToolPicture picture = m_tools.tool().picture();
  state.tag = picture.tag ? picture.tag : tag();
  state.invitation = invitation();
  state.section = sectionNote();
  if (m_drag != Drag::View) state.cursor = picture.cursor;
  return state;
}

/// Those that colours tell apart, by the index that particles carry.
std::vector<std::pair<QString, QString>> Viewport::bodyClasses() const {
  std::vector<std::pair<QString, QString>> classes;
  if (!m_now || !m_now->bodyIds) return classes;
  for (const std::string& id : *m_now->bodyIds) {
    const Body* body = m_document.body(id);
    const Emitter* emitter = m_document.emitter(id);
    const QString name = body ? nameOf(*body) : emitter ? nameOf(*emitter) : QString::fromStdString(id);
    classes.emplace_back(QString::number(classes.size() + 1), name);
  }
  return classes;
}

QString Viewport::invitation() const {
  const bool bare = m_now && m_now->bodyIds && m_now->id.empty() && m_hidden.empty();
  const bool pours = !m_document.project().emitters.empty();  // there will be matter
  return bare && !pours ? m_tools.tool().invitation() : QString();
}

/// The tool's gestures, and the keys that somebody new needs next.
std::vector<OverlayHint> Viewport::hints() const {
  std::vector<OverlayHint> list;
  const auto add = [&list](const std::vector<Gesture>& gestures, bool all) {
    for (const Gesture& gesture : gestures) {
      if (gesture.hint.isEmpty()) continue;
      list.push_back({gesture.keys, gesture.hint});
      if (!all) return;
    }
  };
  const Tool& tool = m_tools.tool();
  const ToolRow& first = toolTable().front();
  if (m_tools.active() == first.id) {
    add(viewGestures(tool), true);
    add(tool.gestures(), true);
    list.push_back({QStringLiteral("Space"), m_session.playing() ? QStringLiteral("pause") : QStringLiteral("play")});
    list.push_back({QStringLiteral("F"), QStringLiteral("frame")});
    list.push_back({QString::fromLatin1(toolRow(kBrushTool)->key), QStringLiteral("sketch")});
    list.push_back({QStringLiteral("F6"), QStringLiteral("panels")});
    return list;
  }
  add(tool.gestures(), true);
  if (!tool.turnsView()) add(viewGestures(tool), false);  // where a plain drag does not, what turns it
  if (tool.usesBrush()) list.push_back({QStringLiteral("[ ]"), QStringLiteral("size")});
  list.push_back({QString::fromLatin1(first.key), QStringLiteral("back to select")});
  return list;
}

std::optional<SceneTag> Viewport::tag() const {
  const auto& marked = m_selection.marked();
  if (!marked || !m_now || m_now->revision != marked->first) return std::nullopt;
  const auto found = std::find(m_now->id.begin(), m_now->id.end(), marked->second);
  if (found == m_now->id.end()) return std::nullopt;
  const auto row = static_cast<size_t>(found - m_now->id.begin());
  SceneTag tag;
  const api::Float4& p = m_now->position[row];
  tag.place = {p.x, p.y, p.z};
  if (const auto cut = section(); cut && !cut->shows(tag.place)) return std::nullopt;
  const uint32_t index = m_now->body[row];
  const Body* body =
      m_now->bodyIds && index < m_now->bodyIds->size() ? m_document.body((*m_now->bodyIds)[index]) : nullptr;
  if (body) tag.name = nameOf(*body);
  tag.value = temperatureText(static_cast<double>(m_now->temperature[row]), 1) + QStringLiteral("  ") +
              phaseName(m_now->phase[row]);
  return tag;
}

void Viewport::projectOpened() {
  if (m_drag == Drag::Section) m_drag = Drag::None;  // what it would go back to was of the former project
  cancelGesture();
  m_unframed.reset();
  const ViewState& view = m_document.project().view;
  if (const auto& camera = view.camera)
    m_navigator.setScene({camera->target, camera->distance, camera->azimuth, camera->elevation});
  else
    m_unframed = m_now ? m_now->revision : 0;  // framed when there is something of it to see
  m_section = view.section;
  Q_EMIT sectionChanged();
  m_colour = view.colour;
  m_legendRange.reset();
  bodiesChanged();
}

void Viewport::bodiesChanged() {
  m_scene.environment = m_session.surroundings();
  m_box.reset();
  m_shown.reset();
  m_hidden = ps::hiddenBodies(m_document.project());
  if (m_session.engine()) {
    m_now = withoutBodies(m_session.snapshot(), m_hidden);
    m_previous = nullptr;
  }
  ghostChanged();
}

void Viewport::show(StandardView view) {
  m_navigator.setSize(size());
  m_navigator.show(view);
  storeView();
  update();
}

void Viewport::paintPortsOver(QPainter& painter) const {
  painter.setRenderHint(QPainter::Antialiasing);
  const Project& project = m_document.project();
  const ToolPicture picture = m_tools.tool().picture();
  PortView view;
  view.ports = {&project.emitters, &project.sinks, m_selection.port(), section()};
  view.camera = m_navigator.camera();
  view.size = size();
  view.hovered = picture.hovered;
  paintPorts(painter, view);
  // What would be put there.
  view.ports = {&picture.emitters, &picture.sinks, {}};
  for (const Emitter& emitter : picture.emitters) view.hovered = Port{false, emitter.id};
  for (const Sink& sink : picture.sinks) view.hovered = Port{true, sink.id};
  paintPorts(painter, view);
}

QString Viewport::summary() const {
  QStringList parts{m_tools.tool().words()};
  if (const auto port = m_selection.port()) parts << m_document.portName(*port);
  if (const auto note = sectionNote()) parts << note->words();
  if (const auto marked = tag()) parts << marked->name + QLatin1Char(' ') + marked->value;
  return parts.join(QStringLiteral(", "));
}

void Viewport::announce() {
  if (!QAccessible::isActive()) return;
  QAccessibleValueChangeEvent event(this, summary());
  QAccessible::updateAccessibility(&event);
}

bool Viewport::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && typeToTool(*static_cast<QKeyEvent*>(event), true)) {
    event->accept();
    return true;
  }
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    if (!m_hits.legendBar.isEmpty() && m_hits.legend.contains(help->pos())) {
      showTip(help->globalPos(), QStringLiteral("Drag an end to set the range; double-click for the automatic one."),
              this, m_hits.legend.toRect());
      return true;
    }
  }
  if (event->type() == PropsEvent::kind()) {
    if (!m_renderer) return true;
    makeCurrent();
    m_renderer->show(static_cast<PropsEvent*>(event)->props());
    doneCurrent();
    requestPaint();
    return true;
  }
  return QOpenGLWidget::event(event);
}

void Viewport::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  m_navigator.setSize(event->size());
  // The pointer rests where another part of the scene is now.
  const QPoint at = mapFromGlobal(QCursor::pos());
  if (isVisible() && m_drag == Drag::None && rect().contains(at)) hover(at, {});
}

}  // namespace ps
