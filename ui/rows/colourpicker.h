// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/rows/parameterrow.h"

#include <QtCore/QPointer>
#include <QtGui/QColor>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QFrame>

class QLineEdit;

namespace ps {

/// A colour (sRGB) chosen by hue, saturation and brightness, or typed as "#rrggbb". Grey keeps the hue that it had.
class ColourPicker : public QFrame {
  Q_OBJECT
 public:
  explicit ColourPicker(QWidget* parent = nullptr);
  QColor colour() const;
  void setColour(const QColor& colour);  ///< from outside: emits nothing

  double hue() const { return m_hue; }  ///< 0 .. 1
  double saturation() const { return m_saturation; }
  double brightness() const { return m_brightness; }
  void choose(double hue, double saturation, double brightness);  ///< as by hand; each is kept within 0 .. 1
  QWidget* plane() const { return m_plane; }                      ///< saturation along it, brightness up
  QWidget* hueBar() const { return m_bar; }
  QLineEdit* text() const { return m_text; }

 Q_SIGNALS:
  void picked(const QColor& colour);

 private:
  class Plane;
  class HueBar;
  void show();
  double m_hue = 0, m_saturation = 0, m_brightness = 0;
  QWidget *m_plane, *m_bar;
  QLineEdit* m_text;
};

/// A row of a panel with a swatch where other rows have their field; it opens a picker below itself.
class ColourRow : public QAbstractButton {
  Q_OBJECT
 public:
  explicit ColourRow(const QString& label, QWidget* parent = nullptr);
  QColor colour() const { return m_colour; }
  void setColour(const QColor& colour);
  void alignTo(const ParameterRow* row) { m_row = row; }  ///< whose field the swatch stands above; borrowed
  ColourPicker* picker() const { return m_picker; }
  QSize sizeHint() const override { return {200, 26}; }

 Q_SIGNALS:
  void picked(const QColor& colour);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QRectF swatchRect() const;
  void open();
  QColor m_colour;
  QPointer<const ParameterRow> m_row;
  ColourPicker* m_picker;
};

}  // namespace ps
