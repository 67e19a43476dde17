// SPDX-License-Identifier: Apache-2.0
#include "ui/theme/psstyle.h"

#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtWidgets/QApplication>
#include <QtWidgets/QDialog>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QStyleFactory>
#include <QtWidgets/QStyleOption>
#include <QtWidgets/QTabBar>

#include <algorithm>

namespace ps {
namespace {

void drawCheckBox(QPainter& painter, const QStyleOption& option) {
  const Theme& theme = Theme::current();
  const bool enabled = option.state & QStyle::State_Enabled, on = option.state & QStyle::State_On;
  const QColor edge = !enabled ? theme[Token::Disabled] : on ? theme[Token::Accent] : theme[Token::ControlEdge];
  const QRectF box = QRectF(option.rect).adjusted(1, 1, -1, -1);
  paintBox(painter, box, on && enabled ? theme[Token::Accent] : theme[Token::Field], edge, 3);
  if (on) paintIcon(painter, box, QStringLiteral("check"), enabled ? theme[Token::OnAccent] : theme[Token::Disabled]);
}

void drawRadio(QPainter& painter, const QStyleOption& option) {
  const Theme& theme = Theme::current();
  const bool on = option.state & QStyle::State_On;
  const QRectF circle = QRectF(option.rect).adjusted(1, 1, -1, -1);
  paintBox(painter, circle, theme[Token::Field], theme[on ? Token::Accent : Token::ControlEdge], circle.width() / 2);
  if (on) paintBox(painter, circle.adjusted(3.5, 3.5, -3.5, -3.5), theme[Token::Accent], QColor(), circle.width() / 2);
}

void drawArrow(QPainter& painter, const QStyleOption& option, const char* name) {
  const Theme& theme = Theme::current();
  const bool enabled = option.state & QStyle::State_Enabled;
  QRectF square(0, 0, 16, 16);
  square.moveCenter(QRectF(option.rect).center());
  paintIcon(painter, square, QLatin1String(name), theme[enabled ? Token::Text2 : Token::Disabled]);
}

/// "": as Qt has it.
QString iconOf(QStyle::StandardPixmap what) {
  switch (what) {
    case QStyle::SP_DirIcon:
    case QStyle::SP_DirOpenIcon:
    case QStyle::SP_DirClosedIcon:
    case QStyle::SP_DirLinkIcon:
    case QStyle::SP_DirHomeIcon:
    case QStyle::SP_DesktopIcon:
    case QStyle::SP_ComputerIcon:
    case QStyle::SP_DriveHDIcon:
    case QStyle::SP_DriveCDIcon:
    case QStyle::SP_DriveNetIcon:
      return QStringLiteral("folder");
    case QStyle::SP_FileIcon:
    case QStyle::SP_FileLinkIcon:
      return QStringLiteral("new");
    case QStyle::SP_FileDialogNewFolder:
      return QStringLiteral("plus");
    case QStyle::SP_FileDialogToParent:
      return QStringLiteral("chevron-up");
    case QStyle::SP_FileDialogBack:
    case QStyle::SP_ArrowBack:
      return QStringLiteral("chevron-left");
    case QStyle::SP_ArrowForward:
      return QStringLiteral("chevron-right");
    case QStyle::SP_FileDialogListView:
      return QStringLiteral("grid");
    case QStyle::SP_FileDialogDetailedView:
      return QStringLiteral("list");
    case QStyle::SP_MessageBoxWarning:
    case QStyle::SP_MessageBoxQuestion:
      return QStringLiteral("warning");
    case QStyle::SP_MessageBoxCritical:
      return QStringLiteral("error");
    case QStyle::SP_MessageBoxInformation:
      return QStringLiteral("info");
    default:
      return {};
  }
}

}  // namespace

PsStyle::PsStyle() : QProxyStyle(QStyleFactory::create(QStringLiteral("Fusion"))) {}

void PsStyle::polish(QApplication* application) {
  QProxyStyle::polish(application);
  application->installEventFilter(&m_tips);
}

void PsStyle::polish(QWidget* widget) {
  QProxyStyle::polish(widget);
  showPlainly(*widget);
}

int PsStyle::pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const {
  switch (metric) {
    case PM_LayoutLeftMargin:
    case PM_LayoutTopMargin:
    case PM_LayoutRightMargin:
    case PM_LayoutBottomMargin:
      return qobject_cast<const QDialog*>(widget) ? 12 : 0;  // Qt's own dialogs ask nobody else
    case PM_LayoutHorizontalSpacing:
    case PM_LayoutVerticalSpacing:
      return 6;
    case PM_SmallIconSize:
    case PM_ToolBarIconSize:
    case PM_ButtonIconSize:
    case PM_TabBarIconSize:
    case PM_IndicatorWidth:
    case PM_IndicatorHeight:
    case PM_ExclusiveIndicatorWidth:
    case PM_ExclusiveIndicatorHeight:
      return 16;
    case PM_ScrollBarExtent:
      return 8;
    case PM_SplitterWidth:
    case PM_DockWidgetSeparatorExtent:
      return 3;
    case PM_DockWidgetFrameWidth:
    case PM_DefaultFrameWidth:
    case PM_ToolBarFrameWidth:
    case PM_ToolBarItemMargin:
    case PM_ButtonShiftHorizontal:
    case PM_ButtonShiftVertical:
      return 0;
    case PM_TreeViewIndentation:
      return 16;
    case PM_ToolBarItemSpacing:
      return 2;
    default:
      return QProxyStyle::pixelMetric(metric, option, widget);
  }
}

int PsStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                       QStyleHintReturn* returnData) const {
  switch (hint) {
    case SH_ToolTip_WakeUpDelay:
      return 500;
    case SH_EtchDisabledText:
    case SH_DitherDisabledText:
    case SH_UnderlineShortcut:
    case SH_Widget_Animate:
    case SH_Widget_Animation_Duration:
    case SH_ComboBox_Popup:
    case SH_DialogButtonBox_ButtonsHaveIcons:
    case SH_ScrollView_FrameOnlyAroundContents:
      return 0;
    case SH_Slider_AbsoluteSetButtons:
      return Qt::LeftButton;
    default:
      return QProxyStyle::styleHint(hint, option, widget, returnData);
  }
}

void PsStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                            const QWidget* widget) const {
  switch (element) {
    case PE_FrameFocusRect: {
      if (qobject_cast<const QPushButton*>(widget)) return;   // its border says so: no second frame around its words
      const bool tab = qobject_cast<const QTabBar*>(widget);  // a tab ends with its text, which the ring stands around
      paintFocusRing(*painter, tab ? option->rect.adjusted(-7, -3, 7, 3) : option->rect, 4);
      return;
    }
    case PE_IndicatorCheckBox:
      drawCheckBox(*painter, *option);
      return;
    case PE_IndicatorRadioButton:
      drawRadio(*painter, *option);
      return;
    case PE_IndicatorArrowDown:
      drawArrow(*painter, *option, "chevron-down");
      return;
    case PE_IndicatorArrowUp:
      drawArrow(*painter, *option, "chevron-up");
      return;
    case PE_IndicatorArrowRight:
      drawArrow(*painter, *option, "chevron-right");
      return;
    case PE_IndicatorArrowLeft:
      drawArrow(*painter, *option, "chevron-left");
      return;
    case PE_IndicatorBranch:
      if (option->state & State_Children) {
        drawArrow(*painter, *option, option->state & State_Open ? "chevron-down" : "chevron-right");
      }
      return;
    case PE_FrameDockWidget:
    case PE_FrameStatusBarItem:
    case PE_FrameMenu:
    case PE_PanelMenuBar:
    case PE_FrameTabBarBase:
      return;
    default:
      QProxyStyle::drawPrimitive(element, option, painter, widget);
  }
}

void PsStyle::drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                          const QWidget* widget) const {
  if (element == CE_ComboBoxLabel) {
    if (const auto* box = qstyleoption_cast<const QStyleOptionComboBox*>(option)) {
      const Theme& theme = Theme::current();
      const Token token = box->state & State_Enabled ? Token::Text : Token::Disabled;
      paintText(*painter, QRectF(box->rect).adjusted(9, 0, -22, 0), Qt::AlignLeft | Qt::AlignVCenter, box->currentText,
                Theme::font(TextRole::Normal), theme[token]);
      return;
    }
  }
  QProxyStyle::drawControl(element, option, painter, widget);
}

void PsStyle::drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                                 const QWidget* widget) const {
  if (control != CC_ComboBox) {
    QProxyStyle::drawComplexControl(control, option, painter, widget);
    return;
  }
  const Theme& theme = Theme::current();
  const bool enabled = option->state & State_Enabled;
  const bool hover = enabled && (option->state & State_MouseOver);
  paintBox(*painter, option->rect, theme[hover ? Token::Hover : Token::Raised],
           theme[hover ? Token::Hover : Token::RaisedEdge], 5);
  if (option->state & State_HasFocus) paintFocusRing(*painter, option->rect, 5);
  const QRectF rect = option->rect;
  paintIcon(*painter, QRectF(rect.right() - 20, rect.center().y() - 7, 14, 14), QStringLiteral("chevron-down"),
            theme[enabled ? Token::Text2 : Token::Disabled]);
}

QIcon PsStyle::standardIcon(StandardPixmap what, const QStyleOption* option, const QWidget* widget) const {
  const QString name = iconOf(what);
  return name.isEmpty() ? QProxyStyle::standardIcon(what, option, widget) : icon(name, false);
}

QPixmap PsStyle::standardPixmap(StandardPixmap what, const QStyleOption* option, const QWidget* widget) const {
  const QString name = iconOf(what);
  if (name.isEmpty()) return QProxyStyle::standardPixmap(what, option, widget);
  return iconPixmap(name, Theme::current()[Token::Text2]);
}

QSize PsStyle::sizeFromContents(ContentsType type, const QStyleOption* option, const QSize& size,
                                const QWidget* widget) const {
  QSize result = QProxyStyle::sizeFromContents(type, option, size, widget);
  if (type == CT_ItemViewItem) result.setHeight(std::max(result.height(), 24));
  if (type == CT_ComboBox) {
    result.setHeight(26);
    constexpr int kAround = 34;  // the text that is shown, and the widest
    result.setWidth(std::max(result.width(), size.width() + kAround));
    if (const auto* box = qstyleoption_cast<const QStyleOptionComboBox*>(option)) {
      const int shown = static_cast<int>(textWidth(box->currentText, Theme::font(TextRole::Normal)));
      result.setWidth(std::max(result.width(), shown + kAround));
    }
  }
  return result;
}

}  // namespace ps
