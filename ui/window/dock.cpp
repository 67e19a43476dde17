// SPDX-License-Identifier: Apache-2.0
#include "ui/window/dock.h"

#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

constexpr int kHeader = 28, kRadius = 5;  // px

/// The header's ground: panel colour with a hairline below.
class Header : public QWidget {
 public:
  using QWidget::QWidget;
  QSize sizeHint() const override { return {120, kHeader}; }  // the dock's layout asks for nothing else

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.fillRect(rect(), Theme::current()[Token::Panel]);
    paintHorizontalLine(painter, 0, width(), height() - 1, Theme::current()[Token::Line]);
  }
};

/// Rounds a corner of what it stands on, whatever is painted there: the window's ground shows.
class Corner : public QWidget {
 public:
  Corner(QWidget* on, bool right, bool bottom) : QWidget(on), m_right(right), m_bottom(bottom) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    resize(kRadius, kRadius);
    on->installEventFilter(this);
    place();
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Resize || event->type() == QEvent::ChildAdded || event->type() == QEvent::Show)
      place();
    return QWidget::eventFilter(watched, event);
  }
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QPainterPath outside;
    outside.addRect(rect());
    outside.addEllipse(QPointF(m_right ? 0 : kRadius, m_bottom ? 0 : kRadius), kRadius, kRadius);
    painter.fillPath(outside, Theme::current()[Token::Window]);  // odd and even: a quarter of the circle is left out
  }

 private:
  void place() {
    const QSize room = parentWidget()->size();
    move(m_right ? room.width() - kRadius : 0, m_bottom ? room.height() - kRadius : 0);
    raise();
  }
  const bool m_right, m_bottom;
};

}  // namespace

void roundCorners(QWidget& panel) {
  for (const bool right : {false, true}) {
    for (const bool bottom : {false, true}) {
      auto* corner = new Corner(&panel, right, bottom);
      // A page that comes is raised above all.
      if (const auto* stack = qobject_cast<QStackedWidget*>(&panel))
        QObject::connect(stack, &QStackedWidget::currentChanged, corner, &QWidget::raise);
    }
  }
}

Dock::Dock(const QString& name, const QString& title, QWidget* parent)
    : QDockWidget(title, parent),
      m_header(new Header),
      m_actions(new QHBoxLayout),
      m_tabs(new QTabBar),
      m_pages(new QStackedWidget) {
  setObjectName(name);
  setFeatures(QDockWidget::DockWidgetClosable | QDockWidget::DockWidgetMovable);
  auto* row = new QHBoxLayout(m_header);
  row->setContentsMargins(6, 0, 6, 0);  // and 6 of the first tab, for its ring
  row->setSpacing(2);
  m_tabs->setDrawBase(false);
  m_tabs->setExpanding(false);
  m_tabs->setElideMode(Qt::ElideNone);
  m_tabs->setFocusPolicy(Qt::TabFocus);
  m_tabs->setAccessibleName(title);
  row->addWidget(m_tabs, 0, Qt::AlignBottom);
  row->addStretch(1);
  row->addLayout(m_actions);
  setTitleBarWidget(m_header);
  setWidget(m_pages);
  m_pages->setAutoFillBackground(true);
  roundCorners(*this);
  connect(m_tabs, &QTabBar::currentChanged, this, [this] {
    QWidget* page = m_pageOf.value(currentPage());
    if (page && page != m_pages->currentWidget()) {  // else its tab has moved
      // Else what is next takes the keys, which is the filter of the page that comes.
      if (m_pages->isAncestorOf(window()->focusWidget())) m_tabs->setFocus(Qt::OtherFocusReason);
      m_pages->setCurrentWidget(page);
    }
    Q_EMIT pageChanged(currentPage());
  });
}

int Dock::addPage(const QString& title, QWidget* page) {
  m_pages->addWidget(page);
  m_pageOf[title] = page;
  const int index = m_tabs->addTab(title);
  m_tabs->setTabData(index, title);
  return index;
}

int Dock::indexOf(const QString& title) const {
  for (int i = 0; i < m_tabs->count(); ++i) {
    if (m_tabs->tabData(i).toString() == title) return i;
  }
  return -1;
}

QWidget* Dock::takePage(const QString& title) {
  const int index = indexOf(title);
  if (index < 0) return nullptr;
  QWidget* page = m_pageOf.take(title);
  m_pages->removeWidget(page);
  m_tabs->removeTab(index);
  return page;
}

void Dock::choosePage(const QString& title) {
  if (const int index = indexOf(title); index >= 0) m_tabs->setCurrentIndex(index);
}

void Dock::showPage(const QString& title) {
  choosePage(title);
  setVisible(true);
  raise();
}

QString Dock::currentPage() const { return m_tabs->tabData(m_tabs->currentIndex()).toString(); }

QWidget* Dock::firstStop() const {
  QWidget* page = m_pages->currentWidget();
  const auto takes = [page](const QWidget* widget) {
    return widget && page->isAncestorOf(widget) && widget->isVisible() && widget->isEnabled() &&
           (widget->focusPolicy() & Qt::TabFocus);
  };
  if (!page) return nullptr;
  if (takes(page->focusWidget())) return page->focusWidget();
  // Once around the chain that Tab goes along.
  for (QWidget* next = page->nextInFocusChain(); next != page; next = next->nextInFocusChain()) {
    if (takes(next)) return next;
  }
  return m_tabs->isVisible() ? m_tabs : nullptr;
}

void Dock::setPageTitle(const QString& title, const QString& shown) {
  if (const int index = indexOf(title); index >= 0) m_tabs->setTabText(index, shown);
}

void Dock::movePage(const QString& title, int place) {
  if (const int index = indexOf(title); index >= 0) m_tabs->moveTab(index, place < 0 ? m_tabs->count() - 1 : place);
}

void Dock::showEvent(QShowEvent* event) {
  QDockWidget::showEvent(event);
  // The tab bar measured its tabs before the style sheet reached it; a text set anew makes it measure again.
  for (int i = 0; i < m_tabs->count(); ++i) m_tabs->setTabText(i, m_tabs->tabText(i));
}

QToolButton* Dock::addAction(const QString& iconName, const QString& tip, const QString& page) {
  auto* button = new QToolButton;
  button->setIcon(icon(iconName));
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setFocusPolicy(Qt::TabFocus);
  QWidget* before = m_tabs;
  if (m_actions->count() > 0) before = m_actions->itemAt(m_actions->count() - 1)->widget();
  m_actions->addWidget(button);
  setTabOrder(before, button);  // as it is read, and not behind the pages, which were made first
  if (!page.isEmpty()) {
    button->setProperty(kForPage, page);
    const auto show = [this, button, page] { button->setVisible(currentPage() == page); };
    connect(this, &Dock::pageChanged, button, show);
    show();
  }
  return button;
}

}  // namespace ps
