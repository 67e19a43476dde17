// SPDX-License-Identifier: Apache-2.0
#include "ui/session/swatches.h"

#include "core/base/error.h"
#include "core/io/outputfile.h"
#include "core/matter/material.h"
#include "core/scene/project.h"
#include "core/simulation/declared.h"
#include "ui/film/sceneshot.h"
#include "ui/session/cachefolder.h"
#include "ui/theme/paint.h"

#include <QtCore/QBuffer>
#include <QtCore/QCoreApplication>
#include <QtCore/QCryptographicHash>
#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtCore/QStandardPaths>
#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace ps {
namespace {

constexpr int kRecipe = 1;      // rises when the same sample is to look otherwise
constexpr float kShades = 100;  // of a colour: one that is dragged asks for few pictures

/// What is not kept is drawn again: no loss.
void keep(const QImage& picture, const QString& path) {
  try {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    picture.save(&buffer, "PNG");
    QDir().mkpath(QFileInfo(path).path());
    writeFileAtomically(path.toStdString(), {bytes.constData(), static_cast<size_t>(bytes.size())});
  } catch (const Error&) {
    return;
  }
}

QImage kept(const QString& path, int side) {
  const QImage picture(path);
  if (!picture.isNull()) useCached(path);
  return picture.size() == QSize(side, side) ? picture.convertToFormat(QImage::Format_ARGB32_Premultiplied) : QImage();
}

QString swatchFolder() {
  return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + QStringLiteral("/swatches");
}

}  // namespace

QString swatchPath(const Swatch& swatch, int side) {
  QString content = QStringLiteral("%1 %2 %3 %4")
                        .arg(QCoreApplication::applicationVersion())
                        .arg(kRecipe)
                        .arg(side)
                        .arg(static_cast<int>(swatch.phase));
  for (const float value : swatch.look) content += QStringLiteral(" %1").arg(static_cast<double>(value), 0, 'g', 9);
  const QByteArray hash = QCryptographicHash::hash(content.toUtf8(), QCryptographicHash::Sha1).toHex();
  return swatchFolder() + QLatin1Char('/') + QString::fromLatin1(hash) + QStringLiteral(".png");
}

Swatches::Swatches(QObject* parent) : QObject(parent) {
  m_worker.run([folder = swatchFolder()] { tidyCache(folder); });
}

Swatches::~Swatches() {
  const std::lock_guard lock(m_mutex);
  m_wanted.clear();
}

QImage Swatches::of(const Swatch& swatch, int side) {
  const QString path = swatchPath(swatch, side);
  const auto [known, isNew] = m_pictures.try_emplace(path);
  if (!known->second.isNull() || !m_canDraw) return known->second;
  const std::lock_guard lock(m_mutex);
  const auto waits = std::find_if(m_wanted.begin(), m_wanted.end(), [&](const Wanted& w) { return w.path == path; });
  if (waits != m_wanted.end()) {
    std::rotate(m_wanted.begin(), waits, waits + 1);
  } else if (isNew) {
    m_wanted.push_front({path, swatch, side});
    if (!std::exchange(m_drawing, true)) m_worker.run([this] { drawAll(); });
  }
  return {};
}

std::optional<Swatches::Wanted> Swatches::next() {
  const std::lock_guard lock(m_mutex);
  m_drawing = !m_wanted.empty();
  if (!m_drawing) return std::nullopt;
  Wanted first = std::move(m_wanted.front());
  m_wanted.pop_front();
  return first;
}

/// On the worker's thread.
void Swatches::drawAll() {
  std::unique_ptr<ShotPainter> painter;
  while (const std::optional<Wanted> wanted = next()) {
    const auto& [path, swatch, side] = *wanted;
    QImage picture = kept(path, side);
    try {
      if (picture.isNull()) {
        if (!painter) painter = std::make_unique<ShotPainter>();
        picture = painter->cutOut(shotOf(swatch), {side, side});
        keep(picture, path);
      }
    } catch (const std::exception&) {
      QMetaObject::invokeMethod(this, [this] { m_canDraw = false; });
      const std::lock_guard lock(m_mutex);
      m_wanted.clear();
      m_drawing = false;
      return;
    }
    QMetaObject::invokeMethod(this, [this, path = path, picture] {
      m_pictures[path] = picture;
      Q_EMIT arrived();
    });
  }
}

std::function<void(QPainter&, const QRectF&)> Swatches::painterOf(const Swatch& swatch) {
  return [this, swatch](QPainter& painter, const QRectF& square) { paintSwatch(painter, square, swatch, *this); };
}

void paintSwatch(QPainter& painter, const QRectF& square, const Swatch& swatch, Swatches& swatches) {
  const QImage picture =
      swatches.of(swatch, static_cast<int>(std::lround(square.width() * painter.device()->devicePixelRatio())));
  if (picture.isNull()) {
    const double edge = square.width() / 11;  // as far as pictures have
    const auto [red, green, blue, clearness] = swatch.look;
    return paintBall(painter, square.adjusted(edge, edge, -edge, -edge), QColor::fromRgbF(red, green, blue));
  }
  painter.setRenderHint(QPainter::SmoothPixmapTransform);  // of scales that are no whole number
  painter.drawImage(snapped(painter, square), picture);
}

Material materialAsShown(const Project& project, const PluginRegistry* plugins, const std::string& material) {
  Material values;
  const auto take = [&](const ParameterSet& set) {
    for (const auto& [key, value] : set.values) values.properties[key] = responseOf(value);
  };
  take(materialDefaults(project, plugins, material));
  for (const SceneMaterial& each : project.materials) {
    if (each.id == material) take(each.properties);
  }
  return values;
}

Swatch swatchOf(const Project& project, const PluginRegistry* plugins, const std::string& material) {
  Swatch swatch = swatchOf(materialAsShown(project, plugins, material));
  for (float& part : swatch.look) part = std::round(part * kShades) / kShades;
  return swatch;
}

}  // namespace ps
