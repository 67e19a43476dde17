// SPDX-License-Identifier: Apache-2.0
#include "ui/help/helpwindow.h"

#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

#include <QtCore/QEvent>
#include <QtCore/QRegularExpression>
#include <QtCore/QUrl>
#include <QtGui/QTextBlock>
#include <QtGui/QTextCursor>
#include <QtGui/QTextDocument>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QTextBrowser>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

constexpr int kMargin = 12, kIndent = 16;  // px around the text, of lists

/// Names in pages are others' words: none of them makes it read a file.
class Browser : public QTextBrowser {
 public:
  QVariant loadResource(int, const QUrl&) override { return {}; }
};

QString pageOf(const QString& id) { return id.section(QLatin1Char('#'), 0, 0); }
QString sectionOf(const QString& id) { return id.section(QLatin1Char('#'), 1); }

/// Markdown as HTML that follows the sheet: without the margins that Qt writes into each paragraph, and as bold as the
/// interface's font is.
QString htmlOf(const QString& markdown) {
  QTextDocument written;
  written.setMarkdown(markdown);
  static const QRegularExpression margins(QStringLiteral(" ?margin-(top|bottom|left|right):[^;\"]*;?"));
  return written.toHtml().remove(margins).replace(QStringLiteral("font-weight:700"), QStringLiteral("font-weight:600"));
}

QString sheet() {
  const Theme& theme = Theme::current();
  return QStringLiteral(
             "p,li{margin-top:6px;margin-bottom:6px;} h1{font-size:18px;font-weight:600;} "
             "h2,h3{font-size:14px;font-weight:600;} a{color:%1;} "
             ".name{color:%2;} .here{color:%1;font-weight:600;} td{padding:2px 0;}")
      .arg(theme[Token::Accent].name(), theme[Token::Text2].name());
}

}  // namespace

HelpWindow::HelpWindow(Library library, QWidget* parent)
    : QDialog(parent),
      m_library(std::move(library)),
      m_text(new Browser),
      m_back(new QToolButton),
      m_forward(new QToolButton) {
  setObjectName(QStringLiteral("psHelp"));
  auto* contents = new QToolButton;
  const auto place = [this](QToolButton* button, const char* iconName, const QString& name) {
    button->setIcon(icon(QLatin1String(iconName)));
    button->setToolTip(name);
    button->setAccessibleName(name);
    button->setAutoRaise(true);
    return button;
  };
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  row->addWidget(place(m_back, "chevron-left", QStringLiteral("Back")));
  row->addWidget(place(m_forward, "chevron-right", QStringLiteral("Forward")));
  row->addWidget(place(contents, "book", QStringLiteral("First steps, and all pages")));
  row->addStretch(1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(6);
  column->addLayout(row);
  column->addWidget(m_text);
  m_text->setOpenLinks(false);
  m_text->document()->setDocumentMargin(kMargin);
  m_text->document()->setIndentWidth(kIndent);
  m_text->setAccessibleName(QStringLiteral("Help"));
  connect(m_back, &QToolButton::clicked, this, [this] { go(m_place - 1); });
  connect(m_forward, &QToolButton::clicked, this, [this] { go(m_place + 1); });
  connect(contents, &QToolButton::clicked, this, [this] { open(QStringLiteral("first-steps")); });
  connect(m_text, &QTextBrowser::anchorClicked, this, [this](const QUrl& link) {
    const QString section = link.hasFragment() ? QLatin1Char('#') + link.fragment() : QString();
    if (link.scheme() == QLatin1String("help")) open(link.path() + section);
    if (link.scheme() == QLatin1String("action")) Q_EMIT actionWanted(link.path());
  });
  resize(460, 620);
}

void HelpWindow::open(const QString& id) {
  if (!m_library(pageOf(id))) return;
  m_way = m_way.mid(0, m_place + 1);
  if (m_way.isEmpty() || m_way.back() != id) m_way << id;
  go(static_cast<int>(m_way.size()) - 1);
}

void HelpWindow::go(int place) {
  if (place < 0 || place >= m_way.size()) return;
  m_place = place;
  m_back->setEnabled(place > 0);
  m_forward->setEnabled(place + 1 < m_way.size());
  if (const auto page = m_library(pageOf(m_way[place]))) showPage(*page, sectionOf(m_way[place]));
}

/// The line of the section stands on top: it is given an anchor, which markdown has none of.
void HelpWindow::showPage(const HelpPage& page, const QString& section) {
  setWindowTitle(page.title + QStringLiteral(" – Help"));
  m_text->document()->setDefaultStyleSheet(sheet());
  m_text->setHtml(page.html ? page.text : htmlOf(page.text));
  const QString words = page.sections.value(section);
  if (words.isEmpty()) return;
  // Qt lays a long page out bit by bit, and what is changed meanwhile keeps it from ever coming to the end.
  m_text->document()->pageCount();
  for (QTextBlock line = m_text->document()->begin(); line.isValid(); line = line.next()) {
    if (!line.text().startsWith(words)) continue;
    QTextCursor first(line);
    first.movePosition(QTextCursor::NextCharacter, QTextCursor::KeepAnchor);
    QTextCharFormat anchor;
    anchor.setAnchor(true);
    anchor.setAnchorNames({section});
    first.mergeCharFormat(anchor);
    return m_text->scrollToAnchor(section);
  }
}

void HelpWindow::refresh() { go(m_place); }

QString HelpWindow::current() const { return m_place < 0 ? QString() : pageOf(m_way[m_place]); }
QString HelpWindow::text() const { return m_text->toPlainText(); }

void HelpWindow::changeEvent(QEvent* event) {
  QDialog::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) refresh();
}

}  // namespace ps
