// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrmirror.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/viewport/viewport.h"
#include "ui/vr/mirror.h"

#include <QtCore/QEvent>
#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr int kFrame = 16;  // ms
constexpr int kEdge = 12, kHeight = 22;
const QString kCaption = QStringLiteral("What the left eye sees; Simulation shows the view again");
const QString kNothing = QStringLiteral("The headset shows nothing yet.");

}  // namespace

VrMirror::VrMirror(std::shared_ptr<vr::Mirror> mirror, Viewport& view)
    : QOpenGLWidget(view.parentWidget()), m_mirror(std::move(mirror)), m_view(view) {
  setUpdateBehavior(QOpenGLWidget::PartialUpdate);  // no newer picture: the one before stays
  setAccessibleName(QStringLiteral("Picture of the headset"));
  view.installEventFilter(this);
  view.setUpdatesEnabled(false);
  connect(&m_next, &QTimer::timeout, this, [this] {
    m_mirror->want();
    update();
  });
  m_next.start(kFrame);
  follow();
}

VrMirror::~VrMirror() { m_view.setUpdatesEnabled(true); }

uint64_t VrMirror::pictures() const { return m_mirror->drawn(); }

void VrMirror::follow() {
  setGeometry(m_view.geometry());
  setVisible(!m_view.isHidden());
  raise();
}

bool VrMirror::eventFilter(QObject* watched, QEvent* event) {
  const QEvent::Type type = event->type();
  if (watched == &m_view &&
      (type == QEvent::Resize || type == QEvent::Move || type == QEvent::ShowToParent || type == QEvent::HideToParent))
    follow();
  return QOpenGLWidget::eventFilter(watched, event);
}

void VrMirror::resizeGL(int, int) { m_again = true; }

void VrMirror::paintGL() {
  const auto pixels = [this](int side) {
    return std::max(1, static_cast<int>(std::lround(side * devicePixelRatioF())));
  };
  const bool none = m_mirror->drawn() == 0;
  const bool drawn = m_mirror->draw(defaultFramebufferObject(), {pixels(width()), pixels(height())}, m_again);
  if (!drawn && !none && !m_again) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  const QString text = drawn ? kCaption : kNothing;
  if (!drawn) painter.fillRect(rect(), theme[Token::Panel]);
  const QFont font = Theme::font(TextRole::Small);
  QRectF box(kEdge, height() - kEdge - kHeight, textWidth(text, font) + 2 * kEdge, kHeight);
  paintBox(painter, box, theme[Token::Overlay], theme[Token::Line2], 5);
  paintText(painter, box, Qt::AlignCenter, text, font, theme[Token::Text]);
  m_again = m_again && !drawn;
}

}  // namespace ps
