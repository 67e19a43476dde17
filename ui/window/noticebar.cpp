// SPDX-License-Identifier: Apache-2.0
#include "ui/window/noticebar.h"

#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

Token groundOf(MessageLevel level) {
  if (level == MessageLevel::Error) return Token::ErrorGround;
  return level == MessageLevel::Warning ? Token::WarningGround : Token::Selection;
}
Token markOf(MessageLevel level) {
  if (level == MessageLevel::Error) return Token::Error;
  return level == MessageLevel::Warning ? Token::Warning : Token::Accent;
}

}  // namespace

NoticeBar::NoticeBar(QWidget* parent)
    : QWidget(parent), m_title(new QLabel), m_text(new QLabel), m_buttons(new QHBoxLayout) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(40, 8, 8, 8);
  row->setSpacing(8);
  auto* words = new QVBoxLayout;
  words->setSpacing(0);
  m_title->setFont(Theme::font(TextRole::Medium));
  m_text->setWordWrap(true);
  m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  words->addWidget(m_title);
  words->addWidget(m_text);
  row->addLayout(words, 1);
  m_buttons->setSpacing(6);
  row->addLayout(m_buttons);
  auto* dismiss = new QToolButton;
  dismiss->setIcon(icon(QStringLiteral("close")));
  dismiss->setAccessibleName(QStringLiteral("Dismiss"));
  dismiss->setFocusPolicy(Qt::TabFocus);
  connect(dismiss, &QToolButton::clicked, this, [this] { close(m_topic); });
  row->addWidget(dismiss);
  hide();
}

void NoticeBar::show(const QString& topic, MessageLevel level, const QString& title, const QString& text,
                     std::vector<Button> buttons) {
  m_topic = topic;
  m_level = level;
  m_title->setText(title);
  m_text->setText(text);
  m_text->setVisible(!text.isEmpty());
  while (QLayoutItem* item = m_buttons->takeAt(0)) {
    if (item->widget()) item->widget()->deleteLater();
    delete item;
  }
  for (Button& button : buttons) {
    auto* push = new QPushButton(button.text);
    push->setFocusPolicy(Qt::TabFocus);
    connect(push, &QPushButton::clicked, this, [act = std::move(button.act)] { act(); });
    m_buttons->addWidget(push, 0, Qt::AlignVCenter);
  }
  setAccessibleName(title + QStringLiteral(" ") + text);
  setVisible(true);
  update();
}

void NoticeBar::close(const QString& topic) {
  if (topic == m_topic) hide();
}

QString NoticeBar::text() const { return m_title->text() + QLatin1Char(' ') + m_text->text(); }

void NoticeBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[groundOf(m_level)]);
  painter.fillRect(QRect(0, 0, 3, height()), theme[markOf(m_level)]);
  paintIcon(painter, QRectF(14, height() / 2.0 - 8, 16, 16), QString::fromLatin1(messageIcon(m_level)),
            theme[markOf(m_level)]);
}

}  // namespace ps
