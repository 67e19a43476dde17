// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/library/materiallibrary.h"

#include <QtWidgets/QStyledItemDelegate>

namespace ps {

class Swatches;
struct Swatch;

inline constexpr double kColdest = 50, kHottest = 4000;  ///< K, ends of the bar
inline constexpr int kEntryRole = Qt::UserRole + 1;      ///< index into MaterialLibrary::entries()

/// Paints an entry of the library: its swatch, its name, when it melts and boils, and a bar of its phases over
/// temperature, which has one scale for all.
class MaterialCard : public QStyledItemDelegate {
  Q_OBJECT
 public:
  MaterialCard(const MaterialLibrary& library, Swatches& swatches, QObject* parent);
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;

 private:
  const MaterialLibrary& m_library;
  Swatches& m_swatches;
};

Swatch swatchOf(const LibraryEntry& entry);

/// The one of the theme's inks that is read better on a ground.
QColor inkOn(const QColor& ground);

/// A bar of phases over temperature, of the one scale for all, with a line where rooms are.
void paintBands(QPainter& painter, const QRectF& bar, const std::vector<PhaseBand>& bands);

/// "melts at 0 °C, boils at 100 °C"
QString transitionsText(const LibraryEntry& entry);

}  // namespace ps
