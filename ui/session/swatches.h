// SPDX-License-Identifier: Apache-2.0
// Pictures are drawn by a thread and a context of its own, one after the other: what is asked for last comes first, so
// that cards in sight do not wait for those that were scrolled past. The context lasts as long as there is something to
// draw. At close the picture that has begun is waited for, the others are given up.
#pragma once
#include "ui/film/swatch.h"
#include "ui/session/worker.h"

#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtGui/QImage>

#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

class QPainter;
class QRectF;

namespace ps {

class PluginRegistry;
struct Project;

/// Where the picture of a sample is kept, `side` pixels wide and high, in the user's cache.
QString swatchPath(const Swatch& swatch, int side);

/// Pictures of materials on nothing, for any ground.
class Swatches : public QObject {
  Q_OBJECT
 public:
  /// Pictures of before that nobody asks for any more go: see tidyCache().
  explicit Swatches(QObject* parent = nullptr);
  ~Swatches() override;
  /// `side` in device pixels. Null while it is not there: it is read or drawn, and arrived() follows.
  QImage of(const Swatch& swatch, int side);
  /// Paints a sample by paintSwatch(), as long as this lasts.
  std::function<void(QPainter&, const QRectF&)> painterOf(const Swatch& swatch);
  /// False from when it turned out that there is no OpenGL: no more pictures come, which is no error.
  bool canDraw() const { return m_canDraw; }

 Q_SIGNALS:
  void arrived();

 private:
  struct Wanted {
    QString path;
    Swatch swatch;
    int side = 0;
  };
  void drawAll();
  std::optional<Wanted> next();
  std::map<QString, QImage> m_pictures;  ///< by path; null: asked for
  bool m_canDraw = true;
  std::mutex m_mutex;
  std::deque<Wanted> m_wanted;  ///< the next one comes first
  bool m_drawing = false;       ///< the thread looks into `m_wanted` once more
  Worker m_worker;              // ends first
};

/// The picture of a sample in a square, or, as long as there is none, a ball of its colour.
void paintSwatch(QPainter& painter, const QRectF& square, const Swatch& swatch, Swatches& swatches);

/// A material of the scene, with the values that it has there. One whose plugin is missing is as the catalogue says.
Material materialAsShown(const Project& project, const PluginRegistry* plugins, const std::string& material);
/// How it looks.
Swatch swatchOf(const Project& project, const PluginRegistry* plugins, const std::string& material);

}  // namespace ps
