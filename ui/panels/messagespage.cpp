// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/messagespage.h"

#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/messagelog.h"
#include "ui/session/session.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

#include <QtCore/QEvent>
#include <QtGui/QClipboard>
#include <QtGui/QFontMetrics>
#include <QtGui/QGuiApplication>
#include <QtGui/QShowEvent>
#include <QtGui/QStandardItemModel>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QScrollBar>
#include <QtWidgets/QStyledItemDelegate>
#include <QtWidgets/QTreeView>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <utility>

namespace ps {
namespace {

constexpr int kTimeWidth = 96, kWhereWidth = 170, kLeastText = 160, kLinksEdge = 24, kWordsEdge = 20;
constexpr qint64 kOpening = 1000;  ///< ms

Token tokenOf(MessageLevel level) {
  switch (level) {
    case MessageLevel::Ok:
      return Token::Ok;
    case MessageLevel::Info:
      return Token::Info;
    case MessageLevel::Warning:
      return Token::Warning;
    case MessageLevel::Error:
      return Token::Error;
  }
  return Token::Text2;
}

/// Whether a message is of the program and what it has, whatever project is open.
bool isOfProgram(const QString& where) {
  static const QStringList kNames{QStringLiteral("Program"), QStringLiteral("Scene view"), QStringLiteral("VR"),
                                  QStringLiteral("Materials"), QStringLiteral("Favourite brushes")};
  static const QStringList kBeginnings{QStringLiteral("Plugin "), QStringLiteral("The plugin "),
                                       QStringLiteral("PhaseSketch ")};
  return kNames.contains(where) || std::any_of(kBeginnings.begin(), kBeginnings.end(),
                                               [&](const QString& text) { return where.startsWith(text); });
}

/// As high as all words of a message, in the width of its column.
class WrappedText : public QStyledItemDelegate {
 public:
  explicit WrappedText(QTreeView& view) : QStyledItemDelegate(&view), m_view(view) {}
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QStyleOptionViewItem oneLine(option);
    oneLine.rect = {};
    QSize size = QStyledItemDelegate::sizeHint(oneLine, index);
    const int width = m_view.columnWidth(index.column()) - kWordsEdge;
    const QFontMetrics metrics(option.font);
    const QRect words =
        metrics.boundingRect(0, 0, std::max(width, 1), 10000, Qt::TextWordWrap, index.data().toString());
    size.setHeight(size.height() + std::max(0, words.height() - metrics.height()));
    return size;
  }

 private:
  QTreeView& m_view;
};

}  // namespace

MessagesPage::MessagesPage(Session& session, QWidget* parent)
    : QWidget(parent),
      m_log(session.log()),
      m_model(new QStandardItemModel(this)),
      m_view(new QTreeView),
      m_empty(new QLabel(QStringLiteral("All quiet"))) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  m_empty->setAlignment(Qt::AlignCenter);
  m_empty->setProperty("role", "muted");
  column->addWidget(m_empty);
  column->addWidget(m_view);
  m_view->setModel(m_model);
  m_view->setHeaderHidden(true);
  m_view->setRootIsDecorated(false);
  m_view->setWordWrap(true);
  m_view->setItemDelegateForColumn(2, new WrappedText(*m_view));
  m_view->setAllColumnsShowFocus(true);
  m_view->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_view->setAccessibleName(QStringLiteral("Messages"));
  m_view->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(m_view, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
    QMenu menu;
    menu.addAction(QStringLiteral("Copy all"), this,
                   [this] { QGuiApplication::clipboard()->setText(m_log.allText()); });
    menu.exec(m_view->viewport()->mapToGlobal(at));
  });
  connect(&m_log, &MessageLog::changed, this, &MessagesPage::refresh);
  m_path = session.document().path();
  connect(&session.files(), &DocumentFiles::saved, this, [this, &session] { m_path = session.document().path(); });
  connect(&session.document(), &Document::changed, this, [this, &session](const ChangeEvent& event) {
    if (!std::holds_alternative<ProjectOpened>(event)) return;
    const QString before = std::exchange(m_path, session.document().path());
    if (!m_path.isEmpty() && m_path == before) return;  // read again
    m_opened = QDateTime::currentDateTime();
    refresh();
  });
  refresh();
}

/// What was said just before a project came is of its opening; what the program says of itself is of none.
bool MessagesPage::isOfFormer(const Message& message) const {
  return m_opened.isValid() && message.time < m_opened.addMSecs(-kOpening) && !isOfProgram(message.where);
}

void MessagesPage::addLinks(int row, const Message& message) {
  QStringList links;
  for (const MessageLink& link : message.links) {
    links << QStringLiteral("<a href=\"%1\" style=\"color:%2;text-decoration:none\">%3</a>")
                 .arg(link.target.toHtmlEscaped(), Theme::current()[Token::Accent].name(), link.text.toHtmlEscaped());
  }
  auto* label = new QLabel(links.join(QStringLiteral("&nbsp;&nbsp;·&nbsp;&nbsp;")));
  label->setTextFormat(Qt::RichText);
  label->setTextInteractionFlags(Qt::TextBrowserInteraction);
  label->setContentsMargins(6, 0, 6, 0);
  // What it leads to may say something itself, which makes all rows anew.
  connect(label, &QLabel::linkActivated, this, &MessagesPage::linkActivated, Qt::QueuedConnection);
  m_linksWidth = std::max(m_linksWidth, label->sizeHint().width() + kLinksEdge);
  m_view->setIndexWidget(m_model->index(row, 3), label);
}

/// Links stand at the right edge, whatever there is to read.
void MessagesPage::setWidths() {
  // Rows that get higher may need the scroll bar, which must not push the links away.
  const int bar = m_view->verticalScrollBar()->sizeHint().width();
  const int width = std::min(m_view->viewport()->width(), m_view->width() - bar);
  const int rest = width - kTimeWidth - kWhereWidth - m_linksWidth;
  m_view->setColumnWidth(0, kTimeWidth);
  m_view->setColumnWidth(1, kWhereWidth);
  m_view->setColumnWidth(2, std::max(kLeastText, rest));
  m_view->setColumnHidden(3, m_linksWidth == 0);
  m_view->doItemsLayout();  // rows are as high as their words need in this width
}

void MessagesPage::refresh() {
  if (!isVisible() && m_model->rowCount() > 0) return;  // shown anew in showEvent
  m_model->clear();
  m_linksWidth = 0;
  const auto& messages = m_log.messages();
  for (auto it = messages.rbegin(); it != messages.rend(); ++it) {
    auto* time = new QStandardItem(it->time.toString(QStringLiteral("HH:mm:ss")));
    const QColor colour = Theme::current()[tokenOf(it->level)];
    time->setIcon(QIcon(iconPixmap(QString::fromLatin1(messageIcon(it->level)), colour, 16, devicePixelRatioF())));
    time->setForeground(Theme::current()[Token::Muted]);
    const bool former = isOfFormer(*it);
    auto* where = new QStandardItem(it->where);
    where->setForeground(Theme::current()[former ? Token::Muted : Token::Text2]);
    QString text = former ? QStringLiteral("Of the project before: ") + it->text : it->text;
    if (it->count > 1) text += QStringLiteral("  (%1 times)").arg(it->count);
    auto* what = new QStandardItem(text);
    what->setToolTip(it->text);
    if (former) what->setForeground(Theme::current()[Token::Muted]);
    m_model->appendRow({time, where, what, new QStandardItem});
    if (!it->links.empty() && !former) addLinks(m_model->rowCount() - 1, *it);
  }
  setWidths();
  m_empty->setVisible(messages.empty());
  m_view->setVisible(!messages.empty());
  if (isVisible()) m_log.markSeen();
}

void MessagesPage::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout()->activate();
  setWidths();
}

void MessagesPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
  m_log.markSeen();
}

void MessagesPage::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::StyleChange || event->type() == QEvent::PaletteChange) refresh();
}

}  // namespace ps
