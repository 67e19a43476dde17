// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrwithout.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/vr/livescene.h"

#include <QtGui/QCloseEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QOpenGLContext>
#include <QtGui/QPainter>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QApplication>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr int kFrame = 16;       // ms
constexpr double kWalk = 0.6;    // m/s
constexpr double kRoll = 1.5;    // rad/s
constexpr double kTurn = 0.004;  // rad for each pixel
constexpr double kReach = 0.03;  // m for each notch of the wheel
constexpr double kNotch = 120;
constexpr const char* kHints[] = {
    "Mouse: hand    Left button: trigger    Shift: grip    G: both grips    Tab: other hand    Wheel: reach    "
    "X C: roll it, both: level    Right-drag: look",
    "W A S D E Q: walk    F: go there    Arrows: size, turn    N: material    P: board    M: palette    U: undo    "
    "Space: play    R: make real    Esc: end"};

}  // namespace

VrWithout::VrWithout(std::shared_ptr<vr::HeadsetLink> link, QWidget* parent)
    : QOpenGLWidget(parent, Qt::Window), m_link(std::move(link)) {
  setWindowTitle(QStringLiteral("VR without a headset – PhaseSketch"));
  setAccessibleName(QStringLiteral("VR without a headset"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setCursor(Qt::BlankCursor);  // the hand is the pointer
  resize(960, 720);
  qApp->installEventFilter(this);
  m_next.setSingleShot(true);
  connect(&m_next, &QTimer::timeout, this, qOverload<>(&QWidget::update));
  m_clock.start();
}

VrWithout::~VrWithout() {
  if (context()) disconnect(context(), nullptr, this, nullptr);
  releaseGl();
}

void VrWithout::releaseGl() {
  if (!m_scene) return;
  makeCurrent();
  m_scene.reset();
  doneCurrent();
}

void VrWithout::fail(const QString& problem) {
  m_scene.reset();
  QMetaObject::invokeMethod(
      this, [this, problem] { Q_EMIT failed(problem); }, Qt::QueuedConnection);
}

void VrWithout::initializeGL() {
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &VrWithout::releaseGl, Qt::UniqueConnection);
  try {
    m_scene = std::make_unique<vr::LiveScene>(m_link);
  } catch (const std::exception& error) {
    fail(QString::fromUtf8(error.what()));
  }
}

double VrWithout::aspect() const { return std::max(1.0, double(width())) / std::max(1.0, double(height())); }

void VrWithout::paintGL() {
  if (!m_scene) return;
  const double before = m_time;
  m_time = static_cast<double>(m_clock.nsecsElapsed()) * 1e-9;
  m_room.give(m_link->shown()->roles);
  useKeys(std::min(m_time - before, 0.1));
  const auto pixels = [&](int side) { return std::max(1, static_cast<int>(std::lround(side * devicePixelRatioF()))); };
  try {
    // One that it carries stays as far away.
    if (!m_scene->carriesPanel(m_room.used())) m_room.keepBefore(m_scene->panelAhead(m_room.pointer(aspect())));
    m_scene->prepare(m_room.frame(m_time, aspect()));
    m_scene->draw(0, m_room.eye(aspect()), {defaultFramebufferObject(), 0, 0, {pixels(width()), pixels(height())}});
  } catch (const std::exception& error) {
    fail(QString::fromUtf8(error.what()));
    return;
  }
  ++m_frames;
  paintHints();
  // As long a pause as it took: where a processor draws, the solver needs the other half.
  const double cost = static_cast<double>(m_clock.nsecsElapsed()) * 1e-6 - m_time * 1e3;
  m_next.start(std::max(kFrame - static_cast<int>(cost), static_cast<int>(cost)));
}

/// What keys that are down do in a time, s.
void VrWithout::useKeys(double passed) {
  const auto down = [&](int key) { return m_keys.count(key) > 0; };
  const auto way = [&](int there, int back) { return kWalk * passed * (double(down(there)) - double(down(back))); };
  m_room.walk({way(Qt::Key_D, Qt::Key_A), way(Qt::Key_E, Qt::Key_Q), way(Qt::Key_W, Qt::Key_S)});
  if (down(Qt::Key_X) && down(Qt::Key_C))
    m_room.level();
  else
    m_room.roll(kRoll * passed * (double(down(Qt::Key_C)) - double(down(Qt::Key_X))));
  for (const size_t hand : {vr::kLeft, vr::kRight}) {
    vr::HandInput& input = m_room.input(hand);
    const bool used = hand == m_room.used();
    input.draw = used && m_pulls ? 1 : 0;
    input.hold = down(Qt::Key_G) || (used && down(Qt::Key_Shift)) ? 1 : 0;
  }
  const vr::HandRoles roles = m_room.roles();
  vr::HandInput &other = m_room.input(roles.other()), &main = m_room.input(roles.main);
  other.first = down(Qt::Key_Space);
  other.second = down(Qt::Key_R);
  other.steerY = double(down(Qt::Key_F));
  main.first = down(Qt::Key_U);
  main.second = down(Qt::Key_P);
  main.menu = down(Qt::Key_M);
  main.steerY = double(down(Qt::Key_Up)) - double(down(Qt::Key_Down));
  main.steerX = double(down(Qt::Key_Right)) - double(down(Qt::Key_Left));
  main.steerPressed = down(Qt::Key_N);
}

void VrWithout::paintHints() {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  double widest = 0;
  for (const char* line : kHints) widest = std::max(widest, textWidth(QString::fromUtf8(line), font));
  QRectF box(0, 0, std::min(widest + 24, width() - 16.0), 44);
  box.moveCenter(QPointF(width() / 2.0, height() - 34));
  paintBox(painter, box, theme[Token::Overlay], theme[Token::Line2], 5);
  for (int i = 0; i < 2; ++i)
    paintText(painter, QRectF(box.left() + 12, box.top() + 4 + 18 * i, box.width() - 24, 18), Qt::AlignCenter,
              QString::fromUtf8(kHints[i]), font, theme[Token::Text]);
}

/// A menu that is open has all events of the mouse; here they are the hand's, which points at the menu's picture.
bool VrWithout::eventFilter(QObject* watched, QEvent* event) {
  const bool mouse = event->type() == QEvent::MouseMove || event->type() == QEvent::MouseButtonPress ||
                     event->type() == QEvent::MouseButtonRelease;
  if (!mouse || !event->spontaneous() || watched == this || !watched->isWidgetType() ||
      !QApplication::activePopupWidget())
    return false;
  const auto* there = static_cast<QMouseEvent*>(event);
  const QPointF at = mapFromGlobal(there->globalPosition());
  if (!QRectF(rect()).contains(at)) return false;
  QMouseEvent own(there->type(), at, there->globalPosition(), there->button(), there->buttons(), there->modifiers());
  if (own.type() == QEvent::MouseMove)
    mouseMoveEvent(&own);
  else if (own.type() == QEvent::MouseButtonPress)
    mousePressEvent(&own);
  else
    mouseReleaseEvent(&own);
  return true;
}

void VrWithout::mouseMoveEvent(QMouseEvent* event) {
  const QPointF way = event->position() - m_at;
  m_at = event->position();
  if (event->buttons() & Qt::RightButton) {
    m_room.turn(kTurn * way.x(), -kTurn * way.y());
  } else {
    m_room.point(2 * m_at.x() / std::max(1, width()) - 1, 1 - 2 * m_at.y() / std::max(1, height()));
  }
}

void VrWithout::mousePressEvent(QMouseEvent* event) {
  m_at = event->position();
  if (event->button() == Qt::LeftButton) m_pulls = true;
}

void VrWithout::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) m_pulls = false;
}

void VrWithout::wheelEvent(QWheelEvent* event) {
  m_room.reach(kReach * event->angleDelta().y() / kNotch);
  event->accept();
}

/// Its keys are its own, whatever tools the main window has on them.
bool VrWithout::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const Qt::KeyboardModifiers modifiers = static_cast<QKeyEvent*>(event)->modifiers();
    if (!(modifiers & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier))) event->accept();
  }
  return QOpenGLWidget::event(event);
}

void VrWithout::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    close();
  } else if (event->key() == Qt::Key_Tab && !event->isAutoRepeat()) {
    m_pulls = false;
    m_room.useOther();
  } else {
    m_keys.insert(event->key());
  }
}

void VrWithout::keyReleaseEvent(QKeyEvent* event) {
  if (!event->isAutoRepeat()) m_keys.erase(event->key());
}

void VrWithout::focusOutEvent(QFocusEvent* event) {
  m_keys.clear();
  m_pulls = false;
  QOpenGLWidget::focusOutEvent(event);
}

void VrWithout::closeEvent(QCloseEvent* event) {
  QOpenGLWidget::closeEvent(event);
  Q_EMIT closed();
}

}  // namespace ps
