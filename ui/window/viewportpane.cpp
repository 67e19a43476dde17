// SPDX-License-Identifier: Apache-2.0
#include "ui/window/viewportpane.h"

#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/tools/gizmotool.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/window/handleactions.h"
#include "ui/window/noticebar.h"

#include <QtGui/QCursor>
#include <QtGui/QGuiApplication>
#include <QtGui/QOpenGLContext>
#include <QtGui/QPainter>
#include <QtWidgets/QButtonGroup>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <array>
#include <string_view>

namespace ps {
namespace {

constexpr int kBar = 34;
constexpr int kGap = 6;  // px, at most, between parts of the bar

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

/// While a menu is open its button is not told that the pointer leaves it, and would stay lit.
void goOutWith(QMenu* menu, QToolButton* button) {
  const auto look = [button] {
    button->setDown(false);
    button->setAttribute(Qt::WA_UnderMouse, button->rect().contains(button->mapFromGlobal(QCursor::pos())));
    button->update();
  };
  QObject::connect(menu, &QMenu::aboutToHide, button, look, Qt::QueuedConnection);
}

}  // namespace

ViewportPane::ViewportPane(Session& session, Selection& selection, Toolbox& tools, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_tools(tools),
      m_notice(new NoticeBar),
      m_buttons(new QButtonGroup(this)),
      m_brushBar(new QWidget),
      m_handleBar(new QWidget),
      m_rareTools(new QWidget),
      m_lookBar(new QWidget),
      m_radius(new QLabel),
      m_sizeLabel(new QLabel),
      m_colourLabel(new QLabel(QStringLiteral("Colour"))),
      m_colour(new QComboBox) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(m_bar = makeBar());
  if (canHaveContext()) {
    m_viewport = new Viewport(session, selection, tools);
    column->addWidget(m_viewport, 1);
  } else {
    auto* none = new QLabel(QStringLiteral(
        "<b>No picture of the scene</b><br>This display offers no OpenGL. The simulation, the graphs and all values "
        "work; start on a display with OpenGL 4.3 to see the scene."));
    none->setTextFormat(Qt::RichText);
    none->setObjectName(QStringLiteral("psNoOpenGL"));
    none->setWordWrap(true);
    none->setAlignment(Qt::AlignCenter);
    none->setMargin(40);
    column->addWidget(none, 1);
  }
  m_notice->setParent(this);
  m_notice->hide();
  m_notice->installEventFilter(this);
  connect(&tools, &Toolbox::toolChanged, this, &ViewportPane::showTool);
  connect(&tools, &Toolbox::brushChanged, this, &ViewportPane::showBrush);
  connect(&session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event) || std::holds_alternative<ViewChanged>(event)) showColour();
  });
  connect(&session, &Session::ready, this, &ViewportPane::addColours);
  addColours();
  showTool();
  showBrush();
}

QWidget* ViewportPane::makeBar() {
  auto* bar = new QWidget;
  bar->setFixedHeight(kBar);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(8, 0, 8, 0);
  row->setSpacing(2);
  auto* rare = new QHBoxLayout(m_rareTools);
  rare->setContentsMargins(0, 0, 0, 0);
  rare->setSpacing(2);
  m_rareTools->setMinimumWidth(1);  // see share()
  bool past = false;                // those that draw; what comes after them is used rarely
  for (const ToolRow& tool : toolTable()) {
    QToolButton* button =
        checkable(QString::fromLatin1(tool.icon),
                  QStringLiteral("%1 (%2)").arg(QString::fromLatin1(tool.tip), QString::fromLatin1(tool.key)));
    m_buttons->addButton(button, m_buttons->buttons().size());
    const bool draws = tool.id == std::string_view(kBrushTool) || tool.id == std::string_view(kEraseTool);
    past = past || draws;
    (past && !draws ? rare : row)->addWidget(button);
  }
  row->addWidget(m_rareTools);
  connect(m_buttons, &QButtonGroup::idClicked, this, [this](int id) {
    // What a click takes in hand is for the view, and so are the keys that follow.
    if (m_viewport && !m_buttons->button(id)->hasFocus()) m_viewport->setFocus(Qt::OtherFocusReason);
    m_tools.activate(toolTable()[static_cast<size_t>(id)].id);
  });
  makeBrushBar();
  row->addWidget(m_brushBar);
  row->addWidget(m_handleBar);
  row->addStretch(1);
  m_colourLabel->setProperty("role", "muted");
  m_colourLabel->setMinimumWidth(1);  // see share()
  row->addWidget(m_colourLabel);
  row->addSpacing(4);
  m_colour->setMinimumWidth(68);
  m_colour->setMaximumWidth(220);  // of labels that plugins bring
  m_colour->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  m_colour->setToolTip(QStringLiteral("What colour means (Ctrl+1 to 9)"));
  m_colour->setAccessibleName(QStringLiteral("Colour"));
  m_colour->setFocusPolicy(Qt::TabFocus);
  connect(m_colour, &QComboBox::activated, this,
          [this](int index) { m_session.document().setColour(m_colour->itemData(index).toString().toStdString()); });
  row->addWidget(m_colour);
  m_lookBar->setMinimumWidth(1);  // see share()
  row->addWidget(m_lookBar);
  auto* frame = new QToolButton;
  frame->setIcon(icon(QStringLiteral("frame")));
  frame->setToolTip(QStringLiteral("Frame everything (Shift+F)"));
  frame->setAccessibleName(frame->toolTip());
  frame->setFocusPolicy(Qt::TabFocus);
  connect(frame, &QToolButton::clicked, this, [this] {
    if (m_viewport) m_viewport->frameAll();
  });
  row->addWidget(frame);
  return bar;
}

void ViewportPane::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  share();
  layout()->activate();  // at once: what is in hand stands under the pointer
  placeNotice();
}

/// Over the view's upper edge, so that the picture of the scene stays where it is.
void ViewportPane::placeNotice() {
  const int tall = m_notice->hasHeightForWidth() ? m_notice->heightForWidth(width()) : m_notice->sizeHint().height();
  m_notice->setGeometry(0, m_bar->height(), width(), tall);
  m_notice->raise();
  if (m_viewport) m_viewport->setCovered(m_notice->isVisible() ? tall : 0);
}

bool ViewportPane::eventFilter(QObject* watched, QEvent* event) {
  if (watched == m_notice &&
      (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Show || event->type() == QEvent::Hide))
    placeNotice();
  return QWidget::eventFilter(watched, event);
}

/// What there is not always room for comes as far as it does: tools that keys and menus have too, the label of the
/// colours, what the view shows.
void ViewportPane::share() {
  // What shows counts as if it did not, and is not hidden for that: it may have the focus.
  int room = width() - m_bar->sizeHint().width();
  const std::array<QWidget*, 3> parts{m_rareTools, m_colourLabel, m_lookBar};
  for (const QWidget* part : parts) room += part->isVisibleTo(m_bar) ? part->sizeHint().width() : 0;
  for (QWidget* part : parts) {
    const int needs = part->sizeHint().width() + kGap;
    const bool has = room >= needs;
    part->setVisible(has);
    if (has) room -= needs;
  }
}

void ViewportPane::makeBrushBar() {
  auto* brush = new QHBoxLayout(m_brushBar);
  brush->setContentsMargins(10, 0, 0, 0);
  brush->setSpacing(4);
  m_sizeLabel->setProperty("role", "muted");
  brush->addWidget(m_sizeLabel);
  for (const int direction : {-1, 1}) {
    auto* step = new QToolButton;
    step->setIcon(icon(direction < 0 ? QStringLiteral("minus") : QStringLiteral("plus")));
    step->setToolTip(direction < 0 ? QStringLiteral("Smaller ([)") : QStringLiteral("Larger (])"));
    step->setAccessibleName(step->toolTip());
    step->setAutoRepeat(true);
    step->setFocusPolicy(Qt::TabFocus);
    connect(step, &QToolButton::clicked, this, [this, direction] { m_tools.stepBrush(direction); });
    brush->addWidget(step);
    if (direction < 0) brush->addWidget(m_radius);
  }
  m_radius->setMinimumWidth(56);
  m_radius->setAlignment(Qt::AlignCenter);
}

void ViewportPane::showFavourites(QMenu* favourites) {
  auto* button = new QToolButton;
  button->setIcon(icon(QStringLiteral("star")));
  button->setToolTip(QStringLiteral("Favourite brushes, and to keep this one"));
  button->setAccessibleName(button->toolTip());
  button->setPopupMode(QToolButton::InstantPopup);
  button->setFocusPolicy(Qt::TabFocus);
  button->setMenu(favourites);
  goOutWith(favourites, button);
  m_brushBar->layout()->addWidget(button);
}

void ViewportPane::showLook(QMenu* look) {
  auto* row = new QHBoxLayout(m_lookBar);
  row->setContentsMargins(2, 0, 0, 0);
  auto* button = new QToolButton;
  button->setIcon(icon(QStringLiteral("eye")));
  button->setToolTip(QStringLiteral("What stands over the picture, and its light"));
  button->setAccessibleName(button->toolTip());
  button->setPopupMode(QToolButton::InstantPopup);
  button->setFocusPolicy(Qt::TabFocus);
  button->setMenu(look);
  row->addWidget(button);
  setTabOrder(m_colour, button);
  share();
}

void ViewportPane::showHandles(const HandleActions& handles) {
  auto* row = new QHBoxLayout(m_handleBar);
  row->setContentsMargins(10, 0, 0, 0);
  row->setSpacing(4);
  auto* pivot = new QToolButton;
  pivot->setIcon(icon(QStringLiteral("pivot")));
  pivot->setToolTip(QStringLiteral("What the handles turn and scale about (%1)").arg(QString::fromLatin1(kPivotKey)));
  pivot->setAccessibleName(pivot->toolTip());
  pivot->setPopupMode(QToolButton::InstantPopup);
  pivot->setMenu(handles.pivots());
  auto* snap = new QToolButton;
  snap->setDefaultAction(handles.snap());
  snap->setAccessibleName(snap->toolTip());
  auto* steps = new QToolButton;
  steps->setIcon(icon(QStringLiteral("chevron-down")));
  steps->setToolTip(QStringLiteral("By which steps the handles go, and whether onto surfaces"));
  steps->setAccessibleName(steps->toolTip());
  steps->setPopupMode(QToolButton::InstantPopup);
  steps->setMenu(handles.snapping());
  goOutWith(handles.pivots(), pivot);
  goOutWith(handles.snapping(), steps);
  for (QToolButton* button : {pivot, snap, steps}) {
    button->setFocusPolicy(Qt::TabFocus);
    row->addWidget(button);
  }
}

/// Matter itself, and the fields that particles have; those of plugins once they are known.
void ViewportPane::addColours() {
  m_colour->clear();
  m_colour->addItem(QStringLiteral("Matter"), QString::fromLatin1(kMatterColour));
  for (const FieldPtr& field : m_session.fields().all()) {
    m_colour->addItem(QString::fromStdString(field->label), QString::fromStdString(field->name));
    m_colour->setItemData(m_colour->count() - 1, QString::fromStdString(field->help), Qt::ToolTipRole);
  }
  showColour();
}

/// Of a field that nobody here has, matter's own.
void ViewportPane::showColour() {
  const int index = m_colour->findData(QString::fromStdString(m_session.document().project().view.colour));
  m_colour->setCurrentIndex(std::max(0, index));
}

void ViewportPane::showTool() {
  for (size_t i = 0; i < toolTable().size(); ++i) {
    if (m_tools.active() == toolTable()[i].id) m_buttons->button(static_cast<int>(i))->setChecked(true);
  }
  m_brushBar->setVisible(m_tools.tool().usesBrush());
  m_handleBar->setVisible(m_tools.tool().usesHandles());
  share();
  layout()->activate();  // at once: what is in hand stands under the pointer
  placeNotice();
}

void ViewportPane::showBrush() {
  m_sizeLabel->setText(m_tools.brushSizeName());
  m_radius->setText(m_tools.brushSizeText());
}

void ViewportPane::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Theme::current()[Token::Panel]);
}

}  // namespace ps
