// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrpanels.h"

#include "ui/curves/curvetarget.h"
#include "ui/curves/responselist.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/session/session.h"
#include "ui/theme/theme.h"
#include "ui/timeline/keyrows.h"
#include "ui/tools/toolbox.h"
#include "ui/window/paneltable.h"
#include "ui/window/vrboard.h"
#include "ui/window/vrlabels.h"
#include "ui/window/vrpalette.h"

#include <QtGui/QPainter>
#include <QtWidgets/QApplication>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

namespace ps {
namespace {

/// Pages that the board can show, as their docks call them.
constexpr const char* kPages[] = {"Brush",  "Body",      "Material", "Scene",    "Outliner",
                                  "Graphs", "Responses", "Curve",    "Transport"};
/// m of the room for each logical pixel: rows of 26 are 34 mm on the board, where the eyes are 0.75 m away, and letters
/// of 12 are 16 mm; the palette is held at half that.
constexpr double kBoardPixel = 1.3e-3, kPalettePixel = 0.85e-3;
constexpr QSize kBoardSize{385, 308}, kPaletteSize{360, 332};
constexpr double kSharpness = 2.5;               // pixels painted for each logical one
constexpr int kOpacity = 237;                    // 93 % of 255
constexpr int kPaint = 100, kPaintTouched = 30;  // ms between pictures
constexpr std::chrono::minutes kLabelled{2};
constexpr std::chrono::seconds kNoted{10};

/// Shown to nobody, so that it is laid out and follows what it shows.
void showUnseen(QWidget& widget, const QSize& size) {
  widget.setAttribute(Qt::WA_DontShowOnScreen);
  widget.setAttribute(Qt::WA_QuitOnClose, false);
  widget.setWindowFlag(Qt::Tool);
  widget.setFixedSize(size);
  widget.show();
}

std::shared_ptr<const PanelImage> pictureOf(QWidget& widget, const std::shared_ptr<const PanelImage>& before) {
  const QSize size = (QSizeF(widget.size()) * kSharpness).toSize();
  QImage image(size, QImage::Format_RGBA8888_Premultiplied);
  image.setDevicePixelRatio(kSharpness);
  image.fill(Qt::transparent);
  widget.render(&image, {}, {}, QWidget::DrawChildren | QWidget::DrawWindowBackground);
  QPainter painter(&image);
  painter.setCompositionMode(QPainter::CompositionMode_DestinationIn);
  painter.fillRect(widget.rect(), QColor(0, 0, 0, kOpacity));
  painter.end();
  const auto bytes = static_cast<size_t>(image.sizeInBytes());
  const bool same = before && before->width == size.width() && before->height == size.height() &&
                    std::memcmp(before->pixels.data(), image.constBits(), bytes) == 0;
  if (same) return before;
  auto made = std::make_shared<PanelImage>();
  made->width = size.width();
  made->height = size.height();
  made->pixels.assign(image.constBits(), image.constBits() + bytes);
  return made;
}

}  // namespace

VrPanels::VrPanels(const Parts& parts)
    : m_parts(parts),
      m_palette(std::make_unique<VrPalette>(parts.session, parts.tools, parts.actions,
                                            std::vector<const char*>(std::begin(kPages), std::end(kPages)))) {
  makeBoards();
  m_noteEnds.setSingleShot(true);
  connect(&m_noteEnds, &QTimer::timeout, this, [this] { note({}, {}); });
  connect(&parts.tools, &Toolbox::refused, this, &VrPanels::note);
  connect(m_palette.get(), &VrPalette::pageWanted, this, &VrPanels::showPage);
  showUnseen(*m_palette, kPaletteSize);
  for (std::unique_ptr<VrLabels>& labels : m_labels) {
    labels = std::make_unique<VrLabels>();
    showUnseen(*labels, {1, 1});
  }
  connect(m_palette.get(), &VrPalette::labelsWanted, this, &VrPanels::showLabels);
  connect(m_palette.get(), &VrPalette::turnWanted, this, [this](int steps) { m_turns += steps; });
  connect(&m_labelsEnd, &QTimer::timeout, this, [this] { showLabels(false); });
  m_labelsEnd.setSingleShot(true);
  m_labelsEnd.start(kLabelled);
  m_sincePaint.start();
  m_sinceRest.start();
}

void VrPanels::makeBoards() {
  for (size_t board = 0; board < vr::kBoards; ++board) {
    m_boards[board] = std::make_unique<VrBoard>(board == 0 ? VrBoard::Bears::All : VrBoard::Bears::OneBeside);
    connect(m_boards[board].get(), &VrBoard::closed, this, [this, board] { putBack(board); });
    connect(m_boards[board].get(), &VrBoard::besideWanted, this, &VrPanels::setBeside);
    showUnseen(*m_boards[board], kBoardSize);
  }
}

void VrPanels::showLabels(bool shown) {
  m_labelsEnd.stop();
  m_labelsShown = shown;
  m_palette->showLabelled(shown);
  m_touched = true;
}

VrPanels::~VrPanels() {
  letGo();
  for (const auto& board : m_boards) board->hide();  // what is under way there ends
}

QWidget* VrPanels::makePage(const QString& title) {
  QWidget*& page = m_made[title];
  if (page) return page;
  if (!m_inspector) makeInspector();
  const PanelContext context{
      m_parts.session, m_parts.tools.selection(), m_parts.tools, *m_inspector, m_parts.curves, m_parts.view,
      PointedBy::Hand};
  for (const PanelRow& row : panelTable()) {
    if (title == QLatin1String(row.title)) page = row.make(context);
  }
  if (!page) return nullptr;
  m_boards[0]->add(*page, title);
  connectPage(*page);
  return page;
}

void VrPanels::makeInspector() {
  m_inspector = std::make_unique<Inspector>(m_parts.session, m_parts.tools.selection());
  // Pages of it that nobody asks for go with the board.
  for (ParameterPanel* panel : {m_inspector->bodyPanel(), m_inspector->materialPanel(), m_inspector->scenePanel(),
                                m_inspector->solverPanel()}) {
    panel->setParent(m_boards[0].get());
    panel->hide();
  }
  connect(m_inspector.get(), &Inspector::curveWanted, this, [this](const Address& address) {
    m_parts.curves.choose(address);
    showCurve();
  });
  connect(m_inspector.get(), &Inspector::wayOutWanted, this, &VrPanels::wayOutWanted);
  connect(m_inspector.get(), &Inspector::keyRefused, this, &VrPanels::refuse);
}

/// What leads from one page to another.
void VrPanels::connectPage(QWidget& page) {
  for (const KeyRows* keys : page.findChildren<KeyRows*>()) {
    connect(keys, &KeyRows::refused, this, &VrPanels::refuse);
    connect(keys, &KeyRows::curveWanted, this, [this](const Address& address) {
      m_parts.curves.chooseTrack(address);
      showCurve();
    });
  }
  if (const auto* brush = page.findChild<BrushPanel*>()) {
    const auto follow = [this](const QString&, const QString& row) {
      showPage(QStringLiteral("Solver"));
      m_inspector->solverPanel()->reveal(row, false);
    };
    connect(brush, &ParameterPanel::linkActivated, this, follow, Qt::QueuedConnection);
  }
  if (const auto* list = qobject_cast<ResponseList*>(&page))
    connect(list, &ResponseList::chosen, this, &VrPanels::showCurve, Qt::QueuedConnection);
}

/// Who wears the headset does not see what the window says: each board does, they may look at any.
void VrPanels::note(const QString& title, const QString& why) {
  for (const auto& board : m_boards) board->note(why.isEmpty() ? QString() : title + QLatin1Char(' ') + why);
  if (why.isEmpty())
    m_noteEnds.stop();
  else
    m_noteEnds.start(kNoted);
  m_touched = true;
}

void VrPanels::refuse(const QString& title, const QString& why) {
  note(title, why);
  Q_EMIT refused(title, why);
}

void VrPanels::showCurve() { showPage(QStringLiteral("Curve")); }

/// Where it is in sight already it stays.
void VrPanels::showPage(const QString& title) {
  QWidget* page = makePage(title);
  if (!page) return;
  const size_t board = boardOf(*page);
  if (const QWidget* before = m_boards[board]->page(); before && before != page) letGoOf(*before);
  m_boards[board]->showPage(*page);
  if (m_shown[board]) note({}, {});
  if (!std::exchange(m_shown[board], true) || !m_ahead[board]) ++m_brought[board];
  m_touched = true;
}

size_t VrPanels::boardOf(const QWidget& page) const {
  const auto found = std::find_if(m_boards.begin(), m_boards.end(), [&](const auto& one) { return one->bears(page); });
  return found == m_boards.end() ? 0 : static_cast<size_t>(found - m_boards.begin());
}

/// The first page of all where the board has none.
void VrPanels::toggleBoard() {
  m_touched = true;
  if (m_shown[0] && m_ahead[0]) return putAway(0);
  const auto isBeside = [&](const QString& title) {
    const auto made = m_made.find(title);
    return made != m_made.end() && made->second && boardOf(*made->second) > 0;
  };
  QString title = m_boards[0]->title();
  for (size_t page = 0; title.isEmpty() || isBeside(title); ++page) title = QString::fromLatin1(kPages[page]);
  showPage(title);
}

/// A menu that opened there goes along: nobody would see it, and it would wait for a press.
void VrPanels::putAway(size_t board) {
  m_shown[board] = false;
  m_touched = true;
  if (m_popup && m_popup->isVisible() && m_popupOn == vr::kBoard + board) m_popup->close();
}

/// The page of the board gets a panel of its own, and the board goes until another page is asked for.
void VrPanels::setBeside() {
  QWidget* page = m_boards[0]->page();
  const auto free = std::find(m_shown.begin() + 1, m_shown.end(), false);
  if (!page) return;
  if (free == m_shown.end())
    return note(QStringLiteral("The page stays here."),
                QStringLiteral("Two pages have panels of their own already; put one of them away."));
  const auto board = static_cast<size_t>(free - m_shown.begin());
  note({}, {});
  move(*page, board);
  putAway(0);
  m_shown[board] = true;
  ++m_brought[board];
}

/// What has a panel of its own is a page of the board again, which goes on with the page that it shows.
void VrPanels::putBack(size_t board) {
  putAway(board);
  QWidget* page = m_boards[board]->page();
  if (board > 0 && page) move(*page, 0);
}

/// What another hand presses of it is let go first.
void VrPanels::move(QWidget& page, size_t board) {
  for (Pointer& pointer : m_pointers) {
    const auto isOf = [&](const QPointer<QWidget>& one) { return one && (one == &page || page.isAncestorOf(one)); };
    if (isOf(pointer.grabs) || isOf(pointer.under)) leave(pointer);
  }
  m_boards[board]->add(page, m_boards[boardOf(page)]->title());
  if (!m_shown[board]) m_boards[board]->showPage(page);
  m_touched = true;
}

QWidget* VrPanels::widget(size_t panel) const {
  if (panel == vr::kPalette) return m_palette.get();
  if (panel < vr::kPopup) return m_shown[panel - vr::kBoard] ? m_boards[panel - vr::kBoard].get() : nullptr;
  return m_popup && m_popup->isVisible() ? m_popup.data() : nullptr;
}

/// vr::kPanels: of none that opens popups.
size_t VrPanels::panelOf(const QWidget& widget) const {
  if (widget.window() == m_palette.get()) return vr::kPalette;
  for (size_t board = 0; board < vr::kBoards; ++board)
    if (widget.window() == m_boards[board].get()) return vr::kBoard + board;
  return vr::kPanels;
}

/// Menus that the mouse opens in the window are not for the headset.
void VrPanels::findPopup() {
  if (m_delivering > 0) m_popup = QApplication::activePopupWidget();
}

bool VrPanels::paint() {
  const bool ticked = std::exchange(m_ticked, false);
  if (!m_sincePaint.hasExpired(m_touched ? kPaintTouched : kPaint)) return ticked;
  m_sincePaint.start();
  m_touched = false;
  m_palette->follow();
  findPopup();
  bool changed = paintLabels() || ticked;
  const bool rests = !m_sinceRest.hasExpired(kPaint);
  if (!rests) m_sinceRest.start();
  for (size_t panel = 0; panel < vr::kPanels; ++panel) {
    vr::PanelView& view = m_painted[panel];
    QWidget* shown = widget(panel);
    if (rests && shown && view.image && mayWait(panel)) continue;
    const auto before = std::exchange(view.image, shown ? pictureOf(*shown, view.image) : nullptr);
    changed = changed || before != view.image;
    if (shown) measure(panel, *shown);
  }
  return changed;
}

/// A panel beside the board that nobody points at: it may be seen a little later.
bool VrPanels::mayWait(size_t panel) const {
  return panel > vr::kBoard && panel < vr::kPopup &&
         std::none_of(m_pointers.begin(), m_pointers.end(),
                      [&](const Pointer& one) { return one.on == widget(panel); });
}

void VrPanels::measure(size_t panel, const QWidget& shown) {
  vr::PanelView& view = m_painted[panel];
  const double pixel = panel == vr::kPalette ? kPalettePixel : kBoardPixel;
  view.width = pixel * shown.width();
  view.height = pixel * shown.height();
  if (const auto* board = qobject_cast<const VrBoard*>(&shown)) view.header = board->header();
  if (panel != vr::kPopup) return;
  const QWidget* from = m_palette.get();
  if (m_popupOn != vr::kPalette) from = m_boards[m_popupOn - vr::kBoard].get();
  view.on = m_popupOn;
  const QPoint way = shown.mapToGlobal(shown.rect().center()) - from->mapToGlobal(from->rect().center());
  view.right = pixel * way.x();
  view.down = pixel * way.y();
}

bool VrPanels::paintLabels() {
  bool changed = false;
  for (size_t hand = 0; hand < m_labels.size(); ++hand) {
    VrLabels& labels = *m_labels[hand];
    vr::PanelView& view = m_paintedLabels[hand];
    const bool shown = labels.any() && (m_labelsShown || labels.showsScale());
    const auto before = std::exchange(view.image, shown ? pictureOf(labels, view.image) : nullptr);
    changed = changed || before != view.image;
    view.width = kPalettePixel * labels.width();
    view.height = kPalettePixel * labels.height();
  }
  return changed;
}

void VrPanels::describe(vr::HeadsetView& view) const {
  view.panels = m_painted;
  view.labels = m_paintedLabels;
  view.brought = m_brought;
  view.turns = m_turns;
  const QColor accent = Theme::current()[Token::Accent];
  view.accent = {accent.redF(), accent.greenF(), accent.blueF()};
  for (size_t hand = 0; hand < m_pointers.size(); ++hand) view.ticks[hand] += m_pointers[hand].ticks;
}

}  // namespace ps
