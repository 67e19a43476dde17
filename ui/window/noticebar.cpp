// SPDX-License-Identifier: Apache-2.0
#include "ui/window/noticebar.h"

#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <chrono>

namespace ps {
namespace {

constexpr auto kRead = std::chrono::seconds(8);

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
    : QWidget(parent), m_title(new QLabel), m_text(new QLabel), m_more(new QLabel), m_buttons(new QHBoxLayout) {
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
  m_more->setProperty("role", "muted");
  row->addWidget(m_more);
  auto* dismiss = new QToolButton;
  dismiss->setIcon(icon(QStringLiteral("close")));
  dismiss->setAccessibleName(QStringLiteral("Dismiss"));
  dismiss->setFocusPolicy(Qt::TabFocus);
  connect(dismiss, &QToolButton::clicked, this, [this] { close(topic()); });
  row->addWidget(dismiss);
  m_leaves.setSingleShot(true);
  connect(&m_leaves, &QTimer::timeout, this, [this] {
    if (underMouse())  // somebody reads or copies it
      m_leaves.start(kRead);
    else
      close(topic());
  });
  hide();
}

NoticeBar::Button NoticeBar::cancelButton(std::function<void()> act) {
  return {QStringLiteral("Cancel"), std::move(act), QStringLiteral("Cancel (Esc)")};
}

void NoticeBar::show(const QString& topic, MessageLevel level, const QString& title, const QString& text,
                     std::vector<Button> buttons) {
  remove(topic);
  if (!m_notices.empty() && m_notices.back().buttons.empty()) m_notices.pop_back();
  m_notices.push_back({topic, level, title, text, std::move(buttons)});
  refresh();
}

void NoticeBar::setText(const QString& topic, const QString& text) {
  for (Notice& notice : m_notices) {
    if (notice.topic == topic) notice.text = text;
  }
  if (topic != this->topic()) return;
  m_text->setText(text);
  setAccessibleName(this->text());
}

void NoticeBar::close(const QString& topic) {
  const bool shown = topic == this->topic();
  remove(topic);
  if (shown || m_notices.empty())
    refresh();
  else
    showWaiting();
}

void NoticeBar::remove(const QString& topic) {
  m_notices.erase(
      std::remove_if(m_notices.begin(), m_notices.end(), [&](const Notice& notice) { return notice.topic == topic; }),
      m_notices.end());
}

void NoticeBar::refresh() {
  while (QLayoutItem* item = m_buttons->takeAt(0)) {
    if (item->widget()) {
      item->widget()->setParent(nullptr);
      item->widget()->deleteLater();  // it may be what asked for this
    }
    delete item;
  }
  setVisible(!m_notices.empty());
  m_leaves.stop();
  if (m_notices.empty()) {
    m_title->clear();
    m_text->clear();
    return;
  }
  const Notice& notice = m_notices.back();
  m_title->setText(notice.title);
  m_text->setText(notice.text);
  m_text->setVisible(!notice.text.isEmpty());
  if (notice.level == MessageLevel::Ok && notice.buttons.empty()) m_leaves.start(kRead);
  for (const Button& button : notice.buttons) {
    auto* push = new QPushButton(asButtonText(button.text));
    push->setFocusPolicy(Qt::TabFocus);
    push->setToolTip(button.tip);
    connect(push, &QPushButton::clicked, this, [act = button.act] { act(); });
    m_buttons->addWidget(push, 0, Qt::AlignVCenter);
  }
  setAccessibleName(text());
  showWaiting();
  update();
}

void NoticeBar::showWaiting() {
  m_more->setText(QStringLiteral("%1 more").arg(m_notices.size() - 1));
  m_more->setVisible(m_notices.size() > 1);
}

QString NoticeBar::topic() const { return m_notices.empty() ? QString() : m_notices.back().topic; }

QString NoticeBar::text() const { return m_title->text() + QLatin1Char(' ') + m_text->text(); }

void NoticeBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  const MessageLevel level = m_notices.empty() ? MessageLevel::Info : m_notices.back().level;
  painter.fillRect(rect(), theme[groundOf(level)]);
  painter.fillRect(QRect(0, 0, 3, height()), theme[markOf(level)]);
  paintIcon(painter, QRectF(14, height() / 2.0 - 8, 16, 16), QString::fromLatin1(messageIcon(level)),
            theme[markOf(level)]);
}

}  // namespace ps
