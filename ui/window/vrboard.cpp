// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrboard.h"

#include "ui/theme/icon.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

constexpr int kHeader = 28, kNoteEdge = 8;

QToolButton* button(const QString& name, const QString& iconName) {
  auto* one = new QToolButton;
  one->setIcon(icon(iconName));
  one->setAccessibleName(name);
  one->setToolTip(name);
  return one;
}

}  // namespace

VrBoard::VrBoard(Bears bears) : m_title(new QLabel), m_note(new QLabel), m_pages(new QStackedWidget) {
  setObjectName(QStringLiteral("psVrBoard"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* header = new QHBoxLayout;
  header->setContentsMargins(12, 0, 2, 0);
  m_title->setFixedHeight(kHeader);
  header->addWidget(m_title, 1);
  const bool all = bears == Bears::All;
  if (all) {
    QToolButton* beside = button(QStringLiteral("Set this page beside"), QStringLiteral("external"));
    connect(beside, &QToolButton::clicked, this, &VrBoard::besideWanted);
    header->addWidget(beside);
  }
  QToolButton* close = button(all ? QStringLiteral("Put the board away") : QStringLiteral("Put this panel away"),
                              QStringLiteral("close"));
  connect(close, &QToolButton::clicked, this, &VrBoard::closed);
  header->addWidget(close);
  column->addLayout(header);
  column->addWidget(m_pages, 1);
  m_note->setTextFormat(Qt::PlainText);
  m_note->setWordWrap(true);
  m_note->setMargin(kNoteEdge);
  m_note->hide();
  column->addWidget(m_note);
}

void VrBoard::add(QWidget& page, const QString& title) {
  for (QWidget* up = page.parentWidget(); up; up = up->parentWidget())
    if (auto* other = qobject_cast<VrBoard*>(up)) {
      other->m_pages->removeWidget(&page);
      other->m_title->setText(other->title());
    }
  m_titles[&page] = title;
  m_pages->addWidget(&page);
  m_title->setText(this->title());
}

void VrBoard::showPage(QWidget& page) {
  m_pages->setCurrentWidget(&page);
  m_title->setText(title());
}

bool VrBoard::bears(const QWidget& page) const { return m_pages->isAncestorOf(&page); }

QWidget* VrBoard::page() const { return m_pages->currentWidget(); }

QString VrBoard::title() const {
  const auto found = m_titles.find(page());
  return found == m_titles.end() ? QString() : found->second;
}

double VrBoard::header() const { return double(kHeader) / height(); }

void VrBoard::note(const QString& text) {
  m_note->setText(text);
  m_note->setVisible(!text.isEmpty());
}

}  // namespace ps
