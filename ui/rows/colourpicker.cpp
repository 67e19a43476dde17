// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/colourpicker.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtGui/QScreen>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

constexpr int kWide = 208, kHigh = 140, kBar = 16, kHues = 12;
constexpr double kStep = 0.02, kFine = 0.002;

double share(double x) { return std::clamp(x, 0.0, 1.0); }

QColor hsv(double hue, double saturation, double brightness) {
  return QColor::fromHsvF(static_cast<float>(hue), static_cast<float>(saturation), static_cast<float>(brightness));
}

/// Where a colour is: a ring that shows on any ground.
void paintMark(QPainter& painter, const QPointF& at) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(Qt::black, 3));
  painter.drawEllipse(at, 5, 5);
  painter.setPen(QPen(Qt::white, 1.5));
  painter.drawEllipse(at, 5, 5);
}

}  // namespace

/// What is pressed and dragged in, with its keys: arrows, finer with Shift.
class ColourPicker::Plane : public QWidget {
 public:
  explicit Plane(ColourPicker& picker) : m_picker(picker) {
    setFixedSize(kWide, kHigh);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(QStringLiteral("Saturation and brightness"));
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QLinearGradient across(0, 0, width(), 0), down(0, 0, 0, height());
    across.setColorAt(0, Qt::white);
    across.setColorAt(1, hsv(m_picker.m_hue, 1, 1));
    down.setColorAt(0, Qt::transparent);
    down.setColorAt(1, Qt::black);
    painter.fillRect(rect(), across);
    painter.fillRect(rect(), down);
    paintMark(painter, {m_picker.m_saturation * width(), (1 - m_picker.m_brightness) * height()});
    if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 4);
  }
  void mousePressEvent(QMouseEvent* event) override { take(event->position()); }
  void mouseMoveEvent(QMouseEvent* event) override { take(event->position()); }
  void keyPressEvent(QKeyEvent* event) override {
    const double step = event->modifiers() & Qt::ShiftModifier ? kFine : kStep;
    double across = 0, up = 0;
    if (event->key() == Qt::Key_Left) across = -step;
    if (event->key() == Qt::Key_Right) across = step;
    if (event->key() == Qt::Key_Up) up = step;
    if (event->key() == Qt::Key_Down) up = -step;
    if (across == 0 && up == 0) return QWidget::keyPressEvent(event);
    m_picker.choose(m_picker.m_hue, m_picker.m_saturation + across, m_picker.m_brightness + up);
  }

 private:
  void take(const QPointF& at) { m_picker.choose(m_picker.m_hue, at.x() / width(), 1 - at.y() / height()); }
  ColourPicker& m_picker;
};

class ColourPicker::HueBar : public QWidget {
 public:
  explicit HueBar(ColourPicker& picker) : m_picker(picker) {
    setFixedSize(kWide, kBar);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(QStringLiteral("Hue"));
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QLinearGradient hues(0, 0, width(), 0);
    for (int k = 0; k <= kHues; ++k) {
      const double at = static_cast<double>(k) / kHues;
      hues.setColorAt(at, hsv(at, 1, 1));
    }
    painter.fillRect(rect(), hues);
    paintMark(painter, {m_picker.m_hue * width(), height() / 2.0});
    if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 4);
  }
  void mousePressEvent(QMouseEvent* event) override { take(event->position().x() / width()); }
  void mouseMoveEvent(QMouseEvent* event) override { take(event->position().x() / width()); }
  void keyPressEvent(QKeyEvent* event) override {
    const double step = event->modifiers() & Qt::ShiftModifier ? kFine : kStep;
    if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Down) return take(m_picker.m_hue - step);
    if (event->key() == Qt::Key_Right || event->key() == Qt::Key_Up) return take(m_picker.m_hue + step);
    QWidget::keyPressEvent(event);
  }

 private:
  void take(double hue) { m_picker.choose(hue, m_picker.m_saturation, m_picker.m_brightness); }
  ColourPicker& m_picker;
};

ColourPicker::ColourPicker(QWidget* parent)
    : QFrame(parent), m_plane(new Plane(*this)), m_bar(new HueBar(*this)), m_text(new QLineEdit) {
  setObjectName(QStringLiteral("psColourPicker"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  column->addWidget(m_plane);
  column->addWidget(m_bar);
  auto* row = new QHBoxLayout;
  auto* label = new QLabel(QStringLiteral("As #rrggbb"));
  label->setProperty("role", "muted");
  row->addWidget(label);
  row->addStretch(1);
  m_text->setMaxLength(7);
  m_text->setFixedWidth(92);
  m_text->setAccessibleName(QStringLiteral("Colour as #rrggbb"));
  row->addWidget(m_text);
  column->addLayout(row);
  // What is half typed names no colour, or one of fewer digits.
  connect(m_text, &QLineEdit::textEdited, this, [this](const QString& text) {
    const QString digits = text.startsWith(QLatin1Char('#')) ? text : QLatin1Char('#') + text;
    const QColor typed(digits);
    if (digits.size() != 7 || !typed.isValid() || typed == colour()) return;
    setColour(typed);
    Q_EMIT picked(typed);
  });
  connect(m_text, &QLineEdit::editingFinished, this, [this] { m_text->setText(colour().name()); });
}

QColor ColourPicker::colour() const { return hsv(m_hue, m_saturation, m_brightness).toRgb(); }

void ColourPicker::setColour(const QColor& colour) {
  if (colour.rgb() == this->colour().rgb()) return show();  // rounding must not move the hue while somebody drags
  float hue = 0, saturation = 0, brightness = 0;
  colour.getHsvF(&hue, &saturation, &brightness);
  if (hue >= 0 && saturation > 0) m_hue = static_cast<double>(hue);
  m_saturation = static_cast<double>(saturation), m_brightness = static_cast<double>(brightness);
  show();
}

void ColourPicker::choose(double hue, double saturation, double brightness) {
  m_hue = share(hue), m_saturation = share(saturation), m_brightness = share(brightness);
  show();
  Q_EMIT picked(colour());
}

void ColourPicker::show() {
  if (!m_text->hasFocus()) m_text->setText(colour().name());
  m_plane->update();
  m_bar->update();
}

ColourRow::ColourRow(const QString& label, QWidget* parent)
    : QAbstractButton(parent), m_picker(new ColourPicker(this)) {
  setText(label);
  setAccessibleName(label);
  setFocusPolicy(Qt::TabFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  m_picker->setWindowFlag(Qt::Popup);
  m_picker->hide();
  connect(this, &QAbstractButton::clicked, this, &ColourRow::open);
  connect(m_picker, &ColourPicker::picked, this, [this](const QColor& colour) {
    setColour(colour);
    Q_EMIT picked(colour);
  });
}

void ColourRow::setColour(const QColor& colour) {
  m_colour = colour;
  m_picker->setColour(colour);
  setAccessibleDescription(colour.name());
  update();
}

QRectF ColourRow::swatchRect() const {
  const double y = (height() - 22) / 2.0;
  if (!m_row) return {width() - 145.0, y, 104, 22};
  const QRect field = m_row->fieldRect();
  const double left = m_row->mapTo(window(), field.topLeft()).x() - mapTo(window(), QPoint()).x();
  return {left, y, static_cast<double>(field.width()), 22};
}

/// Below the swatch, or above where the screen ends.
void ColourRow::open() {
  m_picker->adjustSize();
  const QRectF swatch = swatchRect();
  QPoint at = mapToGlobal(QPoint(static_cast<int>(swatch.right()) - m_picker->width(), height()));
  if (const QScreen* on = screen()) {
    const QRect all = on->availableGeometry();
    if (at.y() + m_picker->height() > all.bottom()) at.setY(mapToGlobal(QPoint()).y() - m_picker->height());
    at.setX(std::clamp(at.x(), all.left(), std::max(all.left(), all.right() - m_picker->width())));
  }
  m_picker->move(at);
  m_picker->QWidget::show();
  m_picker->plane()->setFocus(Qt::PopupFocusReason);
}

void ColourRow::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF swatch = swatchRect();
  paintText(painter, QRectF(12, 0, swatch.left() - 20, height()), Qt::AlignVCenter, text(),
            Theme::font(TextRole::Normal), theme[isEnabled() ? Token::Text : Token::Disabled]);
  QColor shown = m_colour;
  if (!isEnabled()) shown.setAlphaF(0.3F);
  paintBox(painter, swatch, shown, theme[underMouse() ? Token::FieldEdgeHover : Token::FieldEdge], 4);
  if (hasFocus()) paintFocusRing(painter, swatch.adjusted(-2, -2, 2, 2), 5);
}

}  // namespace ps
