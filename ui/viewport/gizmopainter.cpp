// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/gizmopainter.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/tools/gizmo.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

using Part = GizmoPart::Kind;

constexpr double kLine = 1.5, kHalo = 2;  // px
constexpr double kHead = 11, kBox = 4;    // of an arrow, half of a cube at the end of an arm
constexpr double kMiddle = 5;             // radius of the handle in the middle
constexpr double kField = 22, kPadding = 8, kMargin = 10;

class GizmoPainter {
 public:
  GizmoPainter(QPainter& painter, const GizmoPicture& picture, const Camera& camera, const QSizeF& size)
      : m_painter(painter), m_picture(picture), m_camera(camera), m_size(size), m_frame(frameOf(camera)) {}

  void paint() {
    const Gizmo& gizmo = *m_picture.gizmo;
    const double depth = std::max(nearPlane(m_camera), (gizmo.centre - m_frame.eye).dot(m_frame.forward));
    m_arm = kGizmoArm * pixelSize(m_camera, static_cast<int>(m_size.height()), depth);
    for (const GizmoPart& part : partsOf(gizmo, m_frame.forward)) {
      if (!m_picture.active || *m_picture.active == part) paint(gizmo, part);
    }
  }

 private:
  std::optional<QPointF> at(const Vector3& place) const {
    const auto pixel = project(m_camera, static_cast<int>(m_size.width()), static_cast<int>(m_size.height()), place);
    return pixel ? std::optional(QPointF((*pixel)[0], (*pixel)[1])) : std::nullopt;
  }
  static QColor colourOf(const GizmoPart& part) {
    constexpr Token kAxes[] = {Token::AxisX, Token::AxisY, Token::AxisZ};
    return Theme::current()[part.kind == Part::Middle ? Token::AxisHover : kAxes[part.axis]];
  }

  void paint(const Gizmo& gizmo, const GizmoPart& part) {
    const Theme& theme = Theme::current();
    const bool warm = m_picture.hovered == part && !m_picture.active;
    const QColor colour = warm ? theme[Token::AxisHover] : colourOf(part);
    const double width = kLine + (warm || m_picture.active ? 1 : 0);
    const GizmoShape shape = shapeOf(gizmo, part, m_arm, m_frame.forward);
    QPainterPath path;
    for (const auto& [from, to] : shape.lines) {
      const auto a = at(from), b = at(to);
      if (!a || !b) continue;
      if (path.isEmpty() || path.currentPosition() != *a) path.moveTo(*a);
      path.lineTo(*b);
    }
    QColor fill = colour;
    if (!shape.face.empty()) {
      QPolygonF face;
      for (const Vector3& corner : shape.face) {
        if (const auto p = at(corner)) face << *p;
      }
      fill.setAlphaF(warm ? 0.45F : 0.22F);
      m_painter.setPen(Qt::NoPen);
      m_painter.setBrush(fill);
      m_painter.drawPolygon(face);
    }
    m_painter.setBrush(Qt::NoBrush);
    m_painter.setPen(QPen(theme[Token::Shadow], width + kHalo, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    m_painter.drawPath(path);
    m_painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    m_painter.drawPath(path);
    paintEnd(gizmo, part, shape, colour);
  }

  /// The arrow or the cube at the end of an arm, the handle in the middle.
  void paintEnd(const Gizmo& gizmo, const GizmoPart& part, const GizmoShape& shape, const QColor& colour) {
    const auto centre = at(gizmo.centre), tip = shape.tip ? at(*shape.tip) : std::nullopt;
    m_painter.setPen(QPen(Theme::current()[Token::Shadow], 1));
    m_painter.setBrush(colour);
    if (part.kind == Part::Middle && centre) {
      if (gizmo.kind == Gizmo::Kind::Scale)
        m_painter.drawRect(QRectF(centre->x() - kMiddle, centre->y() - kMiddle, 2 * kMiddle, 2 * kMiddle));
      else
        m_painter.drawEllipse(*centre, kMiddle, kMiddle);
    }
    if (!tip || !centre) return;
    if (gizmo.kind == Gizmo::Kind::Scale) {
      m_painter.drawRect(QRectF(tip->x() - kBox, tip->y() - kBox, 2 * kBox, 2 * kBox));
      return;
    }
    const QPointF way = *tip - *centre;
    const double length = std::hypot(way.x(), way.y());
    if (length < kHead) return;
    const QPointF back = way * (kHead / length), side(back.y() * 0.4, -back.x() * 0.4);
    m_painter.drawPolygon(QPolygonF({*tip, *tip - back + side, *tip - back - side}));
  }

  QPainter& m_painter;
  const GizmoPicture& m_picture;
  const Camera& m_camera;
  const QSizeF m_size;
  const CameraFrame m_frame;
  double m_arm = 1;
};

QString fieldText(const GizmoPicture& picture) {
  return picture.label.isEmpty() ? picture.value : picture.label + QStringLiteral("   ") + picture.value;
}

void paintField(QPainter& painter, const GizmoPicture& picture, const QRectF& rect) {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Normal);
  paintBox(painter, rect, theme[picture.wrong ? Token::ErrorGround : Token::Field],
           theme[picture.wrong    ? Token::Error
                 : picture.typing ? Token::Accent
                                  : Token::Line2],
           4, picture.typing ? 2 : 1);
  const QRectF inner = rect.adjusted(kPadding, 0, -kPadding, 0);
  paintText(painter, inner, Qt::AlignLeft | Qt::AlignVCenter, picture.label, font, theme[Token::Text2]);
  paintText(painter, inner, Qt::AlignRight | Qt::AlignVCenter, picture.value, font, theme[Token::Text]);
}

}  // namespace

QRectF gizmoField(const GizmoPicture& picture, const Camera& camera, const QSizeF& size, double top) {
  if (!picture.gizmo || !picture.active) return {};
  const auto pixel =
      project(camera, static_cast<int>(size.width()), static_cast<int>(size.height()), picture.gizmo->centre);
  if (!pixel) return {};
  const double width = std::max(96.0, textWidth(fieldText(picture), Theme::font(TextRole::Normal)) + 2 * kPadding);
  QRectF rect((*pixel)[0] - width / 2, (*pixel)[1] + kGizmoArm + kPadding, width, kField);  // below all handles
  rect.moveLeft(std::clamp(rect.left(), kMargin, std::max(kMargin, size.width() - width - kMargin)));
  const double highest = top + kMargin;
  rect.moveTop(std::clamp(rect.top(), highest, std::max(highest, size.height() - kField - kMargin)));
  return rect;
}

void paintGizmo(QPainter& painter, const GizmoPicture& picture, const Camera& camera, const QSizeF& size, double top) {
  painter.setRenderHint(QPainter::Antialiasing);
  if (picture.gizmo) GizmoPainter(painter, picture, camera, size).paint();
  if (const QRectF field = gizmoField(picture, camera, size, top); !field.isEmpty())
    paintField(painter, picture, field);
  if (!picture.note.isEmpty()) paintNote(painter, picture.note, size, top);
}

void paintNote(QPainter& painter, const QString& note, const QSizeF& size, double top) {
  const QFont font = Theme::font(TextRole::Normal);
  const double width = std::min(textWidth(note, font) + 2 * kPadding, size.width() - 2 * kMargin);
  const QRectF rect((size.width() - width) / 2, top + kMargin, width, kField);
  const Theme& theme = Theme::current();
  paintBox(painter, rect, theme[Token::Overlay], theme[Token::Line], 4);
  paintText(painter, rect.adjusted(kPadding, 0, -kPadding, 0), Qt::AlignCenter, note, font, theme[Token::Text]);
}

void paintFrame(QPainter& painter, const std::pair<Vector3, Vector3>& corners, const Camera& camera,
                const QSizeF& size) {
  const int width = static_cast<int>(size.width()), height = static_cast<int>(size.height());
  const auto a = project(camera, width, height, corners.first), b = project(camera, width, height, corners.second);
  if (!a || !b) return;
  const QColor edge = Theme::current()[Token::Accent];
  QColor fill = edge;
  fill.setAlphaF(0.12F);
  painter.setPen(QPen(edge, 1));
  painter.setBrush(fill);
  painter.drawRect(QRectF(QPointF((*a)[0], (*a)[1]), QPointF((*b)[0], (*b)[1])).normalized());
}

}  // namespace ps
