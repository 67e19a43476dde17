// SPDX-License-Identifier: Apache-2.0
#include "ui/window/viewportpane.h"

#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/window/noticebar.h"

#include <QtGui/QGuiApplication>
#include <QtGui/QOpenGLContext>
#include <QtGui/QPainter>
#include <QtWidgets/QButtonGroup>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

constexpr int kBar = 34;
const char* const kShapes[] = {"sphere", "cube"};

bool canHaveContext() {
  // These platforms may offer contexts, but no widget can show what is drawn in them.
  for (const char* platform : {"offscreen", "minimal", "linuxfb", "vnc"}) {
    if (QGuiApplication::platformName() == QLatin1String(platform)) return false;
  }
  QOpenGLContext context;
  context.setFormat(QSurfaceFormat::defaultFormat());
  return context.create();
}

QToolButton* checkable(const QString& iconName, const QString& tip) {
  auto* button = new QToolButton;
  button->setIcon(icon(iconName));
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setCheckable(true);
  button->setFocusPolicy(Qt::TabFocus);
  return button;
}

}  // namespace

ViewportPane::ViewportPane(QWidget* parent)
    : QWidget(parent),
      m_notice(new NoticeBar),
      m_tools(new QButtonGroup(this)),
      m_shapes(new QButtonGroup(this)),
      m_brushBar(new QWidget),
      m_radius(new QLabel),
      m_colour(new QComboBox) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(makeBar());
  column->addWidget(m_notice);
  if (canHaveContext()) {
    m_viewport = new Viewport;
    column->addWidget(m_viewport, 1);
  } else {
    auto* none = new QLabel(QStringLiteral(
        "<b>No picture of the scene</b><br>This display offers no OpenGL. The simulation, the graphs and all values "
        "work; start on a display with OpenGL 4.3 to see the scene."));
    none->setObjectName(QStringLiteral("psNoOpenGL"));
    none->setWordWrap(true);
    none->setAlignment(Qt::AlignCenter);
    none->setMargin(40);
    column->addWidget(none, 1);
  }
}

QWidget* ViewportPane::makeBar() {
  auto* bar = new QWidget;
  bar->setFixedHeight(kBar);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(8, 0, 8, 0);
  row->setSpacing(4);
  struct Tool {
    ViewTool tool;
    const char *icon, *tip;
  };
  for (const Tool& t :
       {Tool{ViewTool::Select, "select", "Select and orbit (Q)"}, Tool{ViewTool::Brush, "brush", "Draw matter (B)"},
        Tool{ViewTool::Erase, "erase", "Erase matter (E)"},
        Tool{ViewTool::Tap, "tap", "Place a tap that pours matter (T)"},
        Tool{ViewTool::Drain, "drain", "Place a drain that takes matter away (D)"}}) {
    QToolButton* button = checkable(QString::fromLatin1(t.icon), QString::fromLatin1(t.tip));
    m_tools->addButton(button, static_cast<int>(t.tool));
    row->addWidget(button);
  }
  m_tools->button(0)->setChecked(true);
  connect(m_tools, &QButtonGroup::idClicked, this, [this](int id) { Q_EMIT toolPicked(static_cast<ViewTool>(id)); });
  auto* brush = new QHBoxLayout(m_brushBar);
  brush->setContentsMargins(10, 0, 0, 0);
  brush->setSpacing(4);
  for (int i = 0; i < 2; ++i) {
    QToolButton* button =
        checkable(QString::fromLatin1(kShapes[i]), i == 0 ? QStringLiteral("Sphere") : QStringLiteral("Cube"));
    m_shapes->addButton(button, i);
    brush->addWidget(button);
  }
  connect(m_shapes, &QButtonGroup::idClicked, this, [this](int id) { Q_EMIT shapePicked(kShapes[id]); });
  auto* label = new QLabel(QStringLiteral("Radius"));
  label->setProperty("role", "muted");
  brush->addSpacing(8);
  brush->addWidget(label);
  for (const int direction : {-1, 1}) {
    auto* step = new QToolButton;
    step->setIcon(icon(direction < 0 ? QStringLiteral("minus") : QStringLiteral("plus")));
    step->setToolTip(direction < 0 ? QStringLiteral("Smaller ([)") : QStringLiteral("Larger (])"));
    step->setAccessibleName(step->toolTip());
    step->setAutoRepeat(true);
    step->setFocusPolicy(Qt::TabFocus);
    connect(step, &QToolButton::clicked, this, [this, direction] { Q_EMIT radiusStepped(direction); });
    brush->addWidget(step);
    if (direction < 0) brush->addWidget(m_radius);
  }
  m_radius->setMinimumWidth(56);
  m_radius->setAlignment(Qt::AlignCenter);
  m_brushBar->hide();
  row->addWidget(m_brushBar);
  row->addStretch(1);
  auto* colourLabel = new QLabel(QStringLiteral("Colour"));
  colourLabel->setProperty("role", "muted");
  row->addWidget(colourLabel);
  m_colour->addItems({QStringLiteral("Matter"), QStringLiteral("Temperature"), QStringLiteral("Phase"),
                      QStringLiteral("Speed"), QStringLiteral("Density error")});
  m_colour->setMinimumWidth(128);
  m_colour->setToolTip(QStringLiteral("What colour means (Ctrl+1 to 5)"));
  m_colour->setAccessibleName(QStringLiteral("Colour"));
  m_colour->setFocusPolicy(Qt::TabFocus);
  connect(m_colour, &QComboBox::activated, this,
          [this](int index) { Q_EMIT colourPicked(static_cast<ColourBy>(index)); });
  row->addWidget(m_colour);
  auto* frame = new QToolButton;
  frame->setIcon(icon(QStringLiteral("frame")));
  frame->setToolTip(QStringLiteral("Frame everything (Shift+F)"));
  frame->setAccessibleName(frame->toolTip());
  frame->setFocusPolicy(Qt::TabFocus);
  connect(frame, &QToolButton::clicked, this, &ViewportPane::frameRequested);
  row->addWidget(frame);
  return bar;
}

void ViewportPane::setColour(ColourBy colour) {
  m_colour->setCurrentIndex(static_cast<int>(colour));
  if (m_viewport) m_viewport->setColour(colour);
}

void ViewportPane::setTool(ViewTool tool) {
  m_tools->button(static_cast<int>(tool))->setChecked(true);
  m_brushBar->setVisible(draws(tool));
}

void ViewportPane::setBrush(const BrushSettings& brush) {
  for (int i = 0; i < 2; ++i) {
    if (brush.shape == kShapes[i]) m_shapes->button(i)->setChecked(true);
  }
  m_radius->setText(lengthText(brush.radius));
}

void ViewportPane::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Theme::current()[Token::Panel]);
}

}  // namespace ps
