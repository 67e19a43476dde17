// SPDX-License-Identifier: Apache-2.0
#include "ui/window/topbar.h"

#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QAction>
#include <QtGui/QPainter>
#include <QtGui/QPainterPath>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolButton>

#include <cmath>

namespace ps {
namespace {

constexpr int kHeight = 36, kGap = 3;  // px; the gap to the docks below is part of it
constexpr int kWide = 1280;            // px, from which on there is room for words beside the menus
constexpr int kIconButton = 26;        // px

/// The mark of the program: a hexagon, cold on the left and hot on the right, with a peak inside.
class Logo : public QWidget {
 public:
  Logo() { setFixedSize(30, kHeight); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const Theme& theme = Theme::current();
    const QPointF centre(16, kHeight / 2.0);
    QPolygonF hexagon;
    for (int k = 0; k < 6; ++k) {
      const double a = (30 + 60 * k) * 3.14159265358979 / 180;
      hexagon << centre + QPointF(std::cos(a), std::sin(a)) * 8.5;
    }
    QLinearGradient gradient(7, 0, 25, 0);
    gradient.setColorAt(0, theme.series(0));
    gradient.setColorAt(1, theme.series(1));
    painter.setPen(QPen(QBrush(gradient), 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolygon(hexagon);
    painter.setPen(QPen(theme[Token::Text], 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(QPolygonF({centre + QPointF(-4, 3), centre + QPointF(-0.5, -2.5), centre + QPointF(4, 2.5)}));
  }
};

/// Looks like a search field, opens the palette.
class SearchField : public QAbstractButton {
 public:
  explicit SearchField(QAction* action) : m_action(action) {
    setFixedSize(226, 26);
    setCursor(Qt::PointingHandCursor);
    setFocusPolicy(Qt::TabFocus);
    setAccessibleName(action->text());
    connect(this, &QAbstractButton::clicked, action, &QAction::trigger);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const Theme& theme = Theme::current();
    paintBox(painter, QRectF(rect()), theme[Token::Field], theme[underMouse() ? Token::Line2 : Token::Line], 5);
    paintIcon(painter, QRectF(8, 5, 16, 16), QStringLiteral("search"), theme[Token::Muted]);
    paintText(painter, QRectF(31, 0, 130, height()), Qt::AlignVCenter | Qt::AlignLeft,
              QStringLiteral("Search or command"), Theme::font(TextRole::Normal), theme[Token::Muted]);
    const QRectF keys(width() - 49, 4, 43, 18);
    paintBox(painter, keys, theme[Token::Panel], theme[Token::Line2], 3);
    paintText(painter, keys, Qt::AlignCenter, QStringLiteral("Ctrl K"), Theme::font(TextRole::Small),
              theme[Token::Text2]);
    if (hasFocus()) paintFocusRing(painter, QRectF(rect()), 5);
  }

 private:
  QAction* m_action;
};

QToolButton* buttonFor(QAction* action, const QString& iconName) {
  auto* button = new QToolButton;
  button->setDefaultAction(action);
  button->setIcon(icon(iconName));
  QObject::connect(action, &QAction::changed, button, [button, iconName] { button->setIcon(icon(iconName)); });
  button->setFocusPolicy(Qt::TabFocus);
  return button;
}

/// It never asks for more room than its picture takes: a window with words can be made as small as one without.
class HeadsetButton : public QToolButton {
 public:
  explicit HeadsetButton(QAction* action) {
    setDefaultAction(action);
    setFocusPolicy(Qt::TabFocus);
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
    const auto follow = [this, action] {
      setIcon(ps::icon(QStringLiteral("headset")));
      setText(action->isChecked() ? QStringLiteral("Leave VR") : QStringLiteral("Enter VR"));
    };
    connect(action, &QAction::changed, this, follow);
    follow();
  }
  QSize minimumSizeHint() const override { return {kIconButton, QToolButton::sizeHint().height()}; }
};

}  // namespace

TopBar::TopBar(QAction* undo, QAction* redo, QAction* search, QAction* headset, QWidget* parent)
    : QWidget(parent), m_menus(new QMenuBar), m_workspaces(new QTabBar) {
  setFixedHeight(kHeight + kGap);
  m_menus->setNativeMenuBar(false);
  m_workspaces->setObjectName(QStringLiteral("psWorkspaces"));
  m_workspaces->setDrawBase(false);
  m_workspaces->setExpanding(false);
  m_workspaces->setFocusPolicy(Qt::TabFocus);
  m_workspaces->setAccessibleName(QStringLiteral("Workspace"));
  auto* left = new QHBoxLayout;
  left->addWidget(new Logo);
  left->addWidget(m_menus, 0, Qt::AlignVCenter);
  left->addStretch(1);
  auto* right = new QHBoxLayout;
  right->setSpacing(4);
  right->addStretch(1);
  right->addWidget(buttonFor(undo, QStringLiteral("undo")));
  right->addWidget(buttonFor(redo, QStringLiteral("redo")));
  right->addSpacing(6);
  right->addWidget(m_search = new SearchField(search));
  right->addWidget(m_headset = new HeadsetButton(headset));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(4, 0, 8, kGap);
  row->addLayout(left, 1);
  row->addWidget(m_workspaces, 0, Qt::AlignVCenter);
  row->addLayout(right, 1);
}

void TopBar::resizeEvent(QResizeEvent*) {
  m_headset->setToolButtonStyle(width() >= kWide ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
}

void TopBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Theme::current()[Token::Window]);
  painter.fillRect(rect().adjusted(0, 0, 0, -kGap), Theme::current()[Token::Header]);
}

}  // namespace ps
