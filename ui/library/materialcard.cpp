// SPDX-License-Identifier: Apache-2.0
#include "ui/library/materialcard.h"

#include "ui/session/swatches.h"
#include "ui/theme/legend.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr QSize kCard{222, 84};
constexpr double kSwatch = 44;

/// Place on the bar, 0 to 1: its ways are factors of the absolute temperature.
double placeOf(double kelvin) {
  return std::clamp(std::log(std::max(kelvin, kColdest) / kColdest) / std::log(kHottest / kColdest), 0.0, 1.0);
}

}  // namespace

QColor inkOn(const QColor& ground) {
  const Theme& theme = Theme::current();
  return theme[contrast(theme[Token::Field], ground) > contrast(theme[Token::Text], ground) ? Token::Field
                                                                                            : Token::Text];
}

void paintBands(QPainter& painter, const QRectF& bar, const std::vector<PhaseBand>& bands) {
  const Theme& theme = Theme::current();
  const ColourMap map = colourMap(QStringLiteral("phase"));
  for (const PhaseBand& band : bands) {
    const double left = bar.left() + bar.width() * placeOf(band.from);
    const double right = bar.left() + bar.width() * placeOf(band.to);
    const QRectF part(left, bar.top(), right - left, bar.height());
    const QColor colour = map.stops[static_cast<size_t>(band.phase)].second;
    painter.fillRect(part, colour);
    if (part.width() > 14)
      paintText(painter, part, Qt::AlignCenter, phaseLetter(band.phase), Theme::font(TextRole::Small), inkOn(colour));
  }
  // Where rooms are.
  paintVerticalLine(painter, bar.left() + bar.width() * placeOf(kRoom), bar.top() - 3, bar.bottom() + 3,
                    theme[Token::Text]);
}

QString transitionsText(const LibraryEntry& entry) {
  QStringList parts;
  // Wood and rubber have no liquid: what they come to when they are too hot stands for char, which nobody says flows.
  const bool flows = entry.values.properties.contains("viscosity");
  for (size_t i = 1; i < entry.bands.size(); ++i) {
    const bool gas = entry.bands[i].phase == api::Phase::Gas, solid = entry.bands[i - 1].phase == api::Phase::Solid;
    const QString verb = !gas    ? flows ? QStringLiteral("melts at ") : QStringLiteral("decomposes at ")
                            : solid ? QStringLiteral("turns to gas at ")
                                 : QStringLiteral("boils at ");
    parts << verb + temperatureText(entry.bands[i].from, 0);
  }
  if (!parts.isEmpty()) return parts.join(QStringLiteral(", "));
  return entry.bands.front().phase == api::Phase::Liquid ? QStringLiteral("never freezes")
                                                         : QStringLiteral("never melts");
}

Swatch swatchOf(const LibraryEntry& entry) { return swatchOf(entry.values, entry.bands); }

MaterialCard::MaterialCard(const MaterialLibrary& library, Swatches& swatches, QObject* parent)
    : QStyledItemDelegate(parent), m_library(library), m_swatches(swatches) {}

QSize MaterialCard::sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const { return kCard; }

void MaterialCard::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const auto at = static_cast<size_t>(index.data(kEntryRole).toInt());
  if (at >= m_library.entries().size()) return;
  const LibraryEntry& entry = m_library.entries()[at];
  const Theme& theme = Theme::current();
  const bool selected = option.state & QStyle::State_Selected, hover = option.state & QStyle::State_MouseOver;
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  const QRectF card = QRectF(option.rect).adjusted(3, 3, -3, -3);
  paintBox(*painter, card,
           theme[selected ? Token::Selection
                 : hover  ? Token::Hover
                          : Token::Header],
           selected ? theme[Token::Accent] : QColor(), 7);
  paintSwatch(*painter, QRectF(card.left() + 6, card.top() + 5, kSwatch, kSwatch), swatchOf(entry), m_swatches);
  QFont bold = Theme::font(TextRole::Normal);
  bold.setWeight(QFont::DemiBold);
  const QRectF words(card.left() + 54, card.top() + 8, card.width() - 58, 18);
  paintText(*painter, words, Qt::AlignLeft | Qt::AlignVCenter, entry.label, bold, theme[Token::Text]);
  paintText(*painter, words.translated(0, 18), Qt::AlignLeft | Qt::AlignVCenter,
            transitionsText(entry).replace(QStringLiteral(" at "), QStringLiteral(" ")), Theme::font(TextRole::Small),
            theme[Token::Text2]);
  paintBands(*painter, QRectF(card.left() + 10, card.bottom() - 22, card.width() - 20, 13), entry.bands);
  if (option.state & QStyle::State_HasFocus) paintFocusRing(*painter, card, 7);
  painter->restore();
}

}  // namespace ps
