// SPDX-License-Identifier: Apache-2.0
#include "ui/theme/icon.h"

#include "core/base/error.h"
#include "core/base/log.h"
#include "ui/theme/paint.h"
#include "ui/theme/resources.h"
#include "ui/theme/theme.h"

#include <QtCore/QDir>
#include <QtGui/QIconEngine>
#include <QtGui/QPainter>
#include <QtGui/QPixmapCache>
#include <QtSvg/QSvgRenderer>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// The icon's SVG with its strokes in a colour; empty when there is no such icon.
QByteArray tinted(const QString& name, const QColor& colour) {
  try {
    QByteArray svg = themeResource(QStringLiteral("icons/") + name + QStringLiteral(".svg"));
    svg.replace("currentColor", colour.name().toLatin1());
    return svg;
  } catch (const Error& error) {
    log(LogLevel::Warning, error.what());
    return {};
  }
}

/// `pixels` device pixels wide, drawn at that size rather than scaled. Null when there is no such icon.
QPixmap rendered(const QString& name, const QColor& colour, int pixels) {
  const QString key = QStringLiteral("ps-icon/%1/%2/%3").arg(name, colour.name(QColor::HexArgb)).arg(pixels);
  QPixmap pixmap;
  if (QPixmapCache::find(key, &pixmap)) return pixmap;
  const QByteArray svg = tinted(name, colour);
  if (svg.isEmpty()) return {};
  QSvgRenderer renderer(svg);
  pixmap = QPixmap(pixels, pixels);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setOpacity(colour.alphaF());
  renderer.render(&painter, QRectF(0, 0, pixels, pixels));
  painter.end();
  QPixmapCache::insert(key, pixmap);
  return pixmap;
}

class Engine final : public QIconEngine {
 public:
  Engine(QString name, bool accentWhenOn) : m_name(std::move(name)), m_accentWhenOn(accentWhenOn) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
    paintIcon(*painter, rect, m_name, colour(mode, state));
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    return scaledPixmap(size, mode, state, 1);
  }
  QPixmap scaledPixmap(const QSize& size, QIcon::Mode mode, QIcon::State state, qreal) override {
    return rendered(m_name, colour(mode, state), std::min(size.width(), size.height()));  // device pixels in Qt 6
  }
  bool isNull() override { return false; }
  QIconEngine* clone() const override { return new Engine(m_name, m_accentWhenOn); }
  QString key() const override { return QStringLiteral("PhaseSketch"); }
  QString iconName() override { return m_name; }

 private:
  QColor colour(QIcon::Mode mode, QIcon::State state) const {
    const Theme& theme = Theme::current();
    if (mode == QIcon::Disabled) return theme[Token::Disabled];
    if (state == QIcon::On && m_accentWhenOn) return theme[Token::Accent];
    return theme[mode == QIcon::Normal ? Token::Text2 : Token::Text];
  }
  QString m_name;
  bool m_accentWhenOn;
};

}  // namespace

QIcon icon(const QString& name, bool accentWhenOn) {
  if (!iconNames().contains(name)) {
    log(LogLevel::Warning, "The program has no icon '" + name.toStdString() + "'");
    return {};
  }
  return QIcon(new Engine(name, accentWhenOn));
}

QPixmap iconPixmap(const QString& name, const QColor& colour, int size, double devicePixelRatio) {
  QPixmap pixmap = rendered(name, colour, static_cast<int>(std::lround(size * devicePixelRatio)));
  pixmap.setDevicePixelRatio(devicePixelRatio);
  return pixmap;
}

void paintIcon(QPainter& painter, const QRectF& square, const QString& name, const QColor& colour) {
  const double scale = painter.device()->devicePixelRatioF();
  const QRectF target = snapped(painter, square);
  QPixmap pixmap = rendered(name, colour, static_cast<int>(std::lround(square.width() * scale)));
  if (pixmap.isNull()) return;
  pixmap.setDevicePixelRatio(scale);
  painter.drawPixmap(target.topLeft(), pixmap);
}

QStringList iconNames() {
  static const QStringList names = [] {
    themeResource(QStringLiteral("theme/tokens.json"));  // the resources are there from now on
    QStringList list = QDir(QStringLiteral(":/icons")).entryList({QStringLiteral("*.svg")}, QDir::Files, QDir::Name);
    for (QString& entry : list) entry.chop(4);
    return list;
  }();
  return names;
}

}  // namespace ps
