// SPDX-License-Identifier: Apache-2.0
#include "ui/welcome/welcomepage.h"

#include "ui/library/flow.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/welcome/buttons.h"
#include "ui/welcome/cardgrid.h"
#include "ui/welcome/gallery.h"

#include <QtCore/QPointer>
#include <QtCore/QTimer>
#include <QtGui/QPainter>
#include <QtWidgets/QButtonGroup>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QScrollBar>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

constexpr int kWide = 1500;  // from here on the lists at both sides are broad
constexpr int kRecentShown = 6;

QLabel* words(const QString& text, TextRole role, const char* colour = nullptr) {
  auto* label = new QLabel(text);
  label->setFont(Theme::font(role));
  label->setWordWrap(true);
  QSizePolicy policy = label->sizePolicy();
  policy.setVerticalPolicy(QSizePolicy::Minimum);  // as high as its lines need at this width
  label->setSizePolicy(policy);
  if (colour) label->setProperty("role", colour);
  return label;
}

/// A switch with words beside it.
class SwitchRow : public PageButton {
 public:
  explicit SwitchRow(const QString& text) {
    setText(text);
    setCheckable(true);
    setAccessibleName(text);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  }
  QSize sizeHint() const override { return {180, 26}; }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintSwitch(painter, QRectF(2, (height() - 16) / 2.0, 28, 16), isChecked(), true);
    paintText(painter, QRectF(38, 0, width() - 38, height()), Qt::AlignLeft | Qt::AlignVCenter, text(),
              Theme::font(TextRole::Normal), Theme::current()[Token::Text2]);
    if (hasFocus()) paintFocusRing(painter, QRectF(rect()), 5);
  }
};

/// The ground of what can be restored: the accent's, with its edge.
class OfferCard : public QWidget {
 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintBox(painter, QRectF(rect()), Theme::current()[Token::Selection], Theme::current()[Token::SliderFill], 7);
  }
};

void clear(QLayout& layout) {
  while (QLayoutItem* item = layout.takeAt(0)) {
    if (QWidget* widget = item->widget()) {
      widget->hide();
      widget->deleteLater();  // it may be what was clicked
    }
    delete item;
  }
}

}  // namespace

WelcomePage::WelcomePage(Gallery& gallery, const std::vector<Entry>& above, const std::vector<Entry>& below,
                         QWidget* parent)
    : QWidget(parent), m_gallery(gallery), m_samples(new CardGrid), m_templates(new CardGrid) {
  setObjectName(QStringLiteral("psWelcome"));
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);  // no page makes the window wider while another shows
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  row->addWidget(m_list = makeList(above, below));
  row->addWidget(makeMiddle(), 1);
  row->addWidget(m_side = makeSide());
  connect(&gallery, &Gallery::loaded, this, &WelcomePage::showGallery);
  connect(m_samples, &CardGrid::chosen, this, &WelcomePage::projectChosen);
  connect(m_templates, &CardGrid::chosen, this, &WelcomePage::templateChosen);
  for (CardGrid* grid : {m_samples, m_templates})
    connect(grid, &CardGrid::focused, this, [this](QWidget* card) { m_scroll->ensureWidgetVisible(card, 0, 20); });
  showGallery();
  setOffer({}, {}, {});
}

QWidget* WelcomePage::makeList(const std::vector<Entry>& above, const std::vector<Entry>& below) {
  auto* list = new QWidget;
  auto* column = new QVBoxLayout(list);
  column->setContentsMargins(16, 28, 16, 16);
  column->setSpacing(4);
  auto* name = words(QStringLiteral("PhaseSketch"), TextRole::Title);
  name->setContentsMargins(12, 0, 0, 0);
  column->addWidget(name);
  auto* version = words(QStringLiteral("Version " PS_VERSION), TextRole::Small, "muted");
  version->setContentsMargins(12, 0, 0, 16);
  column->addWidget(version);
  auto* here = new NavigationButton(QStringLiteral("grid"), QStringLiteral("Samples"), nullptr);
  here->setCurrent(true);
  connect(here, &QAbstractButton::clicked, this, [this] { m_scroll->ensureVisible(0, 0); });
  column->addWidget(here);
  for (const auto* entries : {&above, &below}) {
    for (const Entry& entry : *entries) {
      if (entry.action) {
        column->addWidget(new NavigationButton(entry.icon, entry.text, entry.action));
        continue;
      }
      auto* heading = words(entry.text, TextRole::Small, "muted");
      heading->setContentsMargins(12, 16, 0, 4);
      column->addWidget(heading);
    }
    if (entries == &above) column->addStretch(1);
  }
  return list;
}

QWidget* WelcomePage::makeMiddle() {
  auto* page = new QWidget;
  page->setObjectName(QStringLiteral("psPanel"));
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(26, 26, 26, 26);
  column->setSpacing(4);
  auto* head = new QHBoxLayout;
  head->setSpacing(8);
  head->addWidget(words(QStringLiteral("Samples"), TextRole::Title), 0, Qt::AlignTop);
  head->addSpacing(12);
  m_chips = new Flow(8);
  head->addLayout(m_chips, 1);
  column->addLayout(head);
  column->addWidget(words(QStringLiteral("Each opens running and has a few values marked “Try these”. Nothing "
                                         "that you change touches the sample."),
                          TextRole::Normal, "text2"));
  column->addSpacing(12);
  column->addWidget(m_samples);
  auto* begin = words(QStringLiteral("Begin with"), TextRole::Heading);
  begin->setContentsMargins(0, 20, 0, 6);
  column->addWidget(begin);
  column->addWidget(m_templates);
  column->addStretch(1);
  m_scroll = new QScrollArea;
  m_scroll->setFrameShape(QFrame::NoFrame);
  m_scroll->setWidgetResizable(true);
  m_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  m_scroll->setFocusPolicy(Qt::NoFocus);
  m_scroll->setWidget(page);
  return m_scroll;
}

QWidget* WelcomePage::makeSide() {
  auto* side = new QWidget;
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(18, 26, 18, 16);
  column->setSpacing(6);
  m_offer = new OfferCard;
  auto* inside = new QVBoxLayout(m_offer);
  inside->setContentsMargins(14, 12, 14, 12);
  inside->setSpacing(6);
  inside->addWidget(m_offerTitle = words({}, TextRole::Medium));
  inside->addWidget(m_offerText = words({}, TextRole::Normal));
  inside->addLayout(m_offerButtons = new QHBoxLayout);
  m_offerButtons->setSpacing(6);
  column->addWidget(m_offer);
  column->addSpacing(12);
  column->addWidget(words(QStringLiteral("Open now"), TextRole::Heading));
  column->addWidget(m_present = words({}, TextRole::Normal, "text2"));
  auto* back = new QPushButton(QStringLiteral("Back to the scene"));
  connect(back, &QPushButton::clicked, this, &WelcomePage::closeRequested);
  column->addWidget(back, 0, Qt::AlignLeft);
  column->addSpacing(14);
  column->addWidget(words(QStringLiteral("Recent"), TextRole::Heading));
  column->addWidget(m_noRecent = words(QStringLiteral("What you save is listed here."), TextRole::Normal, "muted"));
  column->addLayout(m_recent = new QVBoxLayout);
  m_recent->setSpacing(2);
  column->addSpacing(14);
  column->addWidget(words(QStringLiteral("Good to know"), TextRole::Heading));
  column->addWidget(words(QStringLiteral("Double-click any slider to put it back. Ctrl+Z undoes everything, drags of "
                                         "sliders and strokes too. Closing never asks and never loses work."),
                          TextRole::Normal, "text2"));
  column->addStretch(1);
  auto* atStart = new SwitchRow(QStringLiteral("Show this page at the start"));
  connect(atStart, &QAbstractButton::toggled, this, &WelcomePage::atStartChanged);
  column->addWidget(m_atStart = atStart);
  return side;
}

/// Cards, and a chip for each word that samples are chosen by.
void WelcomePage::showGallery() {
  m_samples->setSamples(m_gallery.samples());
  m_templates->setSamples(m_gallery.templates());
  if (const auto cards = m_samples->cards(); !cards.empty()) cards.front()->setBadge(QStringLiteral("Start here"));
  clear(*m_chips);
  delete m_tags;
  m_tags = new QButtonGroup(this);
  const QString all = QStringLiteral("All %1").arg(m_gallery.samples().size());
  for (const QString& tag : QStringList(all) + m_gallery.tags()) {
    auto* chip = new QPushButton(asButtonText(tag));
    chip->setObjectName(QStringLiteral("psChip"));
    chip->setCheckable(true);
    chip->setChecked(tag == all);
    m_tags->addButton(chip);
    connect(chip, &QPushButton::clicked, this, [this, tag, all] { m_samples->setTag(tag == all ? QString() : tag); });
    m_chips->addWidget(chip);
  }
}

void WelcomePage::setPresent(const QString& title) { m_present->setText(title); }

void WelcomePage::setOffer(const QString& title, const QString& text, const std::vector<Choice>& choices) {
  m_offer->setVisible(!title.isEmpty());
  m_offerTitle->setText(title);
  m_offerText->setText(text);
  clear(*m_offerButtons);
  for (const Choice& choice : choices) {
    auto* button = new QPushButton(choice.text);
    button->setProperty("primary", &choice == &choices.front());
    connect(button, &QPushButton::clicked, this, [act = choice.act] { act(); });
    m_offerButtons->addWidget(button);
  }
  m_offerButtons->addStretch(1);
  fitOffer();
}

/// Its words need as much height as they are long; the layouts around it learn of them too late where the page was
/// hidden.
void WelcomePage::fitOffer() {
  const QMargins around = m_side->layout()->contentsMargins(), inside = m_offer->layout()->contentsMargins();
  const int width = m_side->maximumWidth() - around.left() - around.right() - inside.left() - inside.right();
  for (QLabel* label : {m_offerTitle, m_offerText}) {
    label->ensurePolished();
    label->setMinimumHeight(std::max(0, label->heightForWidth(width)));  // -1 without words
  }
  // Side by side where they have room, else one below the other: none is cut.
  int wide = -m_offerButtons->spacing();
  for (int i = 0; i < m_offerButtons->count(); ++i) {
    QWidget* button = m_offerButtons->itemAt(i)->widget();
    if (!button) continue;
    button->ensurePolished();
    wide += button->sizeHint().width() + m_offerButtons->spacing();
  }
  m_offerButtons->setDirection(wide > width ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
}

void WelcomePage::setAtStart(bool on) { static_cast<QAbstractButton*>(m_atStart)->setChecked(on); }

void WelcomePage::readRecent() {
  m_gallery.readRecent([page = QPointer<WelcomePage>(this)](const std::vector<RecentProject>& recent) {
    if (page) page->showRecent(recent);
  });
}

void WelcomePage::showRecent(const std::vector<RecentProject>& recent) {
  clear(*m_recent);
  m_noRecent->setVisible(recent.empty());
  for (size_t i = 0; i < std::min(recent.size(), size_t{kRecentShown}); ++i) {
    auto* row = new RecentRow(recent[i]);
    connect(row, &QAbstractButton::clicked, this, [this, path = recent[i].path, gone = recent[i].gone] {
      Q_EMIT gone ? projectSought(path) : projectChosen(path);
    });
    m_recent->addWidget(row);
  }
}

void WelcomePage::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Theme::current()[Token::Panel]);
  for (const double x : {m_list->geometry().right() + 0.5, m_side->geometry().left() - 0.5})
    paintVerticalLine(painter, x, 0, height(), Theme::current()[Token::Line]);
}

void WelcomePage::resizeEvent(QResizeEvent*) {
  m_list->setFixedWidth(width() >= kWide ? 250 : 204);
  m_side->setFixedWidth(width() >= kWide ? 320 : 280);
  fitOffer();
}

void WelcomePage::showEvent(QShowEvent*) {
  fitOffer();
  readRecent();
  // once it is laid out: the focus that it gets on the way may have scrolled it
  QTimer::singleShot(0, this, [this] { m_scroll->verticalScrollBar()->setValue(0); });
}

}  // namespace ps
