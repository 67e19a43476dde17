// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/theme/plaintext.h"

#include <QtWidgets/QProxyStyle>

namespace ps {

/// Fusion with our measures and our drawing where a style sheet cannot reach: combo boxes, check marks, tree arrows,
/// focus rings. Colours come from Theme::current(). Draws no icons in menus and no dotted frames. Keeps texts plain
/// (plaintext.h).
class PsStyle : public QProxyStyle {
  Q_OBJECT
 public:
  PsStyle();
  using QProxyStyle::polish;
  void polish(QApplication* application) override;
  void polish(QWidget* widget) override;
  int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override;
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* returnData) const override;
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override;
  void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                   const QWidget* widget) const override;
  void drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                          const QWidget* widget) const override;
  /// What Qt's own dialogs show: as few pictures as ours, and in the theme's colours.
  QIcon standardIcon(StandardPixmap what, const QStyleOption* option, const QWidget* widget) const override;
  QPixmap standardPixmap(StandardPixmap what, const QStyleOption* option, const QWidget* widget) const override;
  QSize sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& size,
                         const QWidget* widget) const override;

 private:
  PlainTips m_tips;
};

}  // namespace ps
