// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QPointF>
#include <QtCore/QRectF>
#include <QtCore/QString>

#include <string>
#include <utility>
#include <vector>

class QPainter;

namespace ps {

/// What is said of a section while one is shown.
struct SectionNote {
  std::string across;  ///< ViewSection::across
  bool flipped = false;
  double share = 0;       ///< 0..1 of the scene that is cut away
  QString place;          ///< where it cuts: "12 mm"
  QString words() const;  ///< "Section across x at 12 mm"
};

/// What the pointer can hit of its strip; empty where there is none.
struct SectionHits {
  QRectF strip, slider, flip, end;
  std::vector<std::pair<std::string, QRectF>> ways;  ///< by ViewSection::across
};

/// A strip that tells of the section and moves, turns and ends it, with its upper left corner at `corner`; logical
/// pixels.
SectionHits paintSection(QPainter& painter, const SectionNote& note, const QPointF& corner);

}  // namespace ps
