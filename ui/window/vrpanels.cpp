// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrpanels.h"

#include "ui/curves/curvetarget.h"
#include "ui/curves/responselist.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/session/session.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"
#include "ui/timeline/keyrows.h"
#include "ui/tools/toolbox.h"
#include "ui/window/paneltable.h"
#include "ui/window/vrlabels.h"
#include "ui/window/vrpalette.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtGui/QPointingDevice>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QAbstractScrollArea>
#include <QtWidgets/QApplication>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <chrono>
#include <cmath>
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
constexpr double kTwice = 0.4;                   // s within which a second press makes it a double click
constexpr double kTwiceReach = 8, kSticks = 15;  // px; the latter are 1.5 degrees
constexpr double kPushed = 0.7, kScroll = 0.1;   // of a stick's way; s between notches
constexpr int kNotch = 120;
constexpr int kHeader = 28, kNoteEdge = 8;
constexpr std::chrono::minutes kLabelled{2};
constexpr std::chrono::seconds kNoted{10};

/// Whose events widgets get: a hand is no more precise than a finger.
const QPointingDevice& handDevice() {
  static const QPointingDevice device(QStringLiteral("Hand in a headset"), 0, QInputDevice::DeviceType::TouchScreen,
                                      QPointingDevice::PointerType::Finger,
                                      QInputDevice::Capability::Position | QInputDevice::Capability::Hover, 1, 1);
  return device;
}

bool takesPresses(const QWidget& widget) {
  return widget.isEnabled() && (widget.focusPolicy() != Qt::NoFocus || widget.inherits("QAbstractButton"));
}

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
                                            std::vector<const char*>(std::begin(kPages), std::end(kPages)))),
      m_board(std::make_unique<QWidget>()) {
  m_board->setObjectName(QStringLiteral("psVrBoard"));
  auto* column = new QVBoxLayout(m_board.get());
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* header = new QHBoxLayout;
  header->setContentsMargins(12, 0, 2, 0);
  m_title = new QLabel;
  m_title->setFixedHeight(kHeader);
  auto* close = new QToolButton;
  close->setIcon(icon(QStringLiteral("close")));
  close->setAccessibleName(QStringLiteral("Put the board away"));
  connect(close, &QToolButton::clicked, this, [this] { m_boardShown = false; });
  header->addWidget(m_title, 1);
  header->addWidget(close);
  m_pages = new QStackedWidget;
  column->addLayout(header);
  column->addWidget(m_pages, 1);
  m_note = new QLabel;
  m_note->setTextFormat(Qt::PlainText);
  m_note->setWordWrap(true);
  m_note->setMargin(kNoteEdge);
  m_note->hide();
  column->addWidget(m_note);
  m_noteEnds.setSingleShot(true);
  connect(&m_noteEnds, &QTimer::timeout, this, [this] { note({}, {}); });
  connect(&parts.tools, &Toolbox::refused, this, &VrPanels::note);
  connect(m_palette.get(), &VrPalette::pageWanted, this, &VrPanels::showPage);
  showUnseen(*m_palette, kPaletteSize);
  showUnseen(*m_board, kBoardSize);
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
}

void VrPanels::showLabels(bool shown) {
  m_labelsEnd.stop();
  m_labelsShown = shown;
  m_palette->showLabelled(shown);
  m_touched = true;
}

VrPanels::~VrPanels() {
  letGo();
  m_board->hide();  // what is under way there ends
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
  m_pages->addWidget(page);
  connectPage(*page);
  return page;
}

void VrPanels::makeInspector() {
  m_inspector = std::make_unique<Inspector>(m_parts.session, m_parts.tools.selection());
  // Pages of it that nobody asks for go with the board.
  for (ParameterPanel* panel : {m_inspector->bodyPanel(), m_inspector->materialPanel(), m_inspector->scenePanel(),
                                m_inspector->solverPanel()}) {
    panel->setParent(m_board.get());
    panel->hide();
  }
  connect(m_inspector.get(), &Inspector::curveWanted, this, [this](const Address& address) {
    m_parts.curves.choose(address);
    showCurve();
  });
  connect(m_inspector.get(), &Inspector::wayOutWanted, this, &VrPanels::wayOutWanted);
  connect(m_inspector.get(), &Inspector::keyRefused, this, &VrPanels::refuse);
}

/// What leads from one page to another: there is one board for all of them.
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

/// Who wears the headset does not see what the window says.
void VrPanels::note(const QString& title, const QString& why) {
  m_note->setText(title + QLatin1Char(' ') + why);
  m_note->setVisible(!why.isEmpty());
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
  m_pages->setCurrentWidget(page);
  m_title->setText(title);
  if (m_boardShown) m_note->hide();
  if (!std::exchange(m_boardShown, true) || !m_boardAhead) ++m_brought;
  m_touched = true;
}

void VrPanels::toggleBoard() {
  m_touched = true;
  if (m_boardShown && m_boardAhead) {
    m_boardShown = false;
  } else {
    showPage(m_pages->count() > 0 ? m_title->text() : QString::fromLatin1(kPages[0]));
  }
}

QWidget* VrPanels::widget(size_t panel) const {
  if (panel == vr::kPalette) return m_palette.get();
  if (panel == vr::kBoard) return m_boardShown ? m_board.get() : nullptr;
  return m_popup && m_popup->isVisible() ? m_popup.data() : nullptr;
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
  for (size_t panel = 0; panel < vr::kPanels; ++panel) {
    vr::PanelView& view = m_painted[panel];
    QWidget* shown = widget(panel);
    const auto before = std::exchange(view.image, shown ? pictureOf(*shown, view.image) : nullptr);
    changed = changed || before != view.image;
    if (!shown) continue;
    const double pixel = panel == vr::kPalette ? kPalettePixel : kBoardPixel;
    view.width = pixel * shown->width();
    view.height = pixel * shown->height();
    if (panel != vr::kPopup) continue;
    QWidget* from = m_boardShown ? m_board.get() : m_palette.get();
    view.on = m_boardShown ? vr::kBoard : vr::kPalette;
    const QPoint way = shown->mapToGlobal(shown->rect().center()) - from->mapToGlobal(from->rect().center());
    view.right = pixel * way.x();
    view.down = pixel * way.y();
  }
  return changed;
}

bool VrPanels::paintLabels() {
  bool changed = false;
  for (size_t hand = 0; hand < m_labels.size(); ++hand) {
    VrLabels& labels = *m_labels[hand];
    vr::PanelView& view = m_paintedLabels[hand];
    const bool shown = m_labelsShown && labels.any();
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

void VrPanels::act(const vr::HandsSeen& seen) {
  const uint64_t act = ++m_acts;
  m_boardAhead = seen.boardAhead;
  for (size_t hand = 0; hand < m_pointers.size(); ++hand) {
    const std::optional<vr::PanelPoint>& point = seen.hands[hand].panel;
    m_labels[hand]->setProfile(seen.hands[hand].input.profile, hand, seen.roles);
    follow(m_pointers[hand], point, seen.seconds);
    if (act != m_acts) return;  // a menu was open meanwhile: these hands are old
    const vr::HandInput& input = seen.hands[hand].input;
    const bool asked = std::exchange(m_pointers[hand].asks, input.steerPressed);
    if (point && input.steerPressed && !asked && std::hypot(input.steerX, input.steerY) < kPushed)
      openMenu(m_pointers[hand]);
    if (act != m_acts) return;
    if (point && std::abs(seen.hands[hand].input.steerY) > kPushed)
      scroll(m_pointers[hand], seen.hands[hand].input.steerY, seen.seconds);
  }
}

void VrPanels::letGo() {
  for (Pointer& pointer : m_pointers) leave(pointer);
}

/// What it presses is let go, and not clicked.
void VrPanels::leave(Pointer& pointer) {
  if (pointer.pressed) {
    const auto* button = qobject_cast<QAbstractButton*>(pointer.grabs.data());
    if (button && pointer.on && pointer.on->isAncestorOf(button))
      pointer.at = button->mapTo(pointer.on, QPoint(-1, -1));
    release(pointer);
  }
  if (pointer.on) enter(pointer, nullptr);
  pointer.on = nullptr;
}

/// What is there. Where that takes no press, a button that the hand has just left is meant still, at its edge; so is
/// one that it presses.
QWidget* VrPanels::aimedAt(Pointer& pointer) {
  QWidget* child = pointer.on->childAt(pointer.at.toPoint());
  if (!child) child = pointer.on;
  auto* last = qobject_cast<QAbstractButton*>(pointer.grabs ? pointer.grabs.data() : pointer.under.data());
  const bool elsewhere = pointer.grabs
                             ? child != last
                             : !takesPresses(*child) && !qobject_cast<QAbstractScrollArea*>(child->parentWidget());
  if (last && elsewhere && pointer.on->isAncestorOf(last)) {
    const QRectF own(last->mapTo(pointer.on, QPoint(0, 0)), last->size());
    if (own.adjusted(-kSticks, -kSticks, kSticks, kSticks).contains(pointer.at)) {
      pointer.at = {std::clamp(pointer.at.x(), own.left(), own.right() - 1),
                    std::clamp(pointer.at.y(), own.top(), own.bottom() - 1)};
      return last;
    }
  }
  return pointer.grabs ? pointer.grabs.data() : child;
}

void VrPanels::follow(Pointer& pointer, const std::optional<vr::PanelPoint>& point, double seconds) {
  QWidget* on = point ? widget(point->panel) : nullptr;
  if (on != pointer.on) leave(pointer);
  if (!on) return;
  const QPointF at(point->x * on->width(), point->y * on->height());
  const bool moved = on != pointer.on || (at - pointer.at).manhattanLength() > 0.01;
  pointer.on = on;
  pointer.at = at;
  enter(pointer, aimedAt(pointer));
  if (moved && pointer.under) send(pointer, *pointer.under, QEvent::MouseMove, Qt::NoButton);
  if (!pointer.on || point->pressed == pointer.pressed) return;
  point->pressed ? press(pointer, seconds) : release(pointer);
}

/// What can be used is felt as one comes upon it.
void VrPanels::enter(Pointer& pointer, QWidget* under) {
  if (pointer.under == under) return;
  m_touched = true;
  if (pointer.under) {
    pointer.under->setAttribute(Qt::WA_UnderMouse, false);
    QEvent leave(QEvent::Leave);
    deliver(*pointer.under, leave);
  }
  pointer.under = under;
  if (!under) return;
  under->setAttribute(Qt::WA_UnderMouse, true);
  const QPointF local = under->mapFrom(pointer.on, pointer.at.toPoint());
  QEnterEvent event(local, pointer.at, pointer.on->mapToGlobal(pointer.at));
  deliver(*under, event);
  if (takesPresses(*under)) {
    ++pointer.ticks;
    m_ticked = true;
  }
}

/// By the headset's clock: on a busy machine the window hears of two presses later, and later apart.
void VrPanels::press(Pointer& pointer, double seconds) {
  const bool twice = pointer.pressedSince && std::abs(seconds - *pointer.pressedSince) < kTwice &&
                     (pointer.at - pointer.pressedAt).manhattanLength() < kTwiceReach;
  pointer.pressed = m_touched = true;
  if (m_popup && m_popup->isVisible() && pointer.on != m_popup) {
    m_popup->close();  // as a press beside a menu does
    return;
  }
  pointer.grabs = pointer.under;
  pointer.pressedAt = pointer.at;
  pointer.pressedSince = twice ? std::nullopt : std::optional(seconds);
  if (pointer.grabs)
    send(pointer, *pointer.grabs, twice ? QEvent::MouseButtonDblClick : QEvent::MouseButtonPress, Qt::LeftButton);
}

void VrPanels::release(Pointer& pointer) {
  pointer.pressed = false;
  m_touched = true;
  const QPointer<QWidget> held = std::exchange(pointer.grabs, nullptr);
  if (held) send(pointer, *held, QEvent::MouseButtonRelease, Qt::LeftButton);
}

/// As the mouse's right button does: of what is there, or of what that lies on.
void VrPanels::openMenu(Pointer& pointer) {
  if (!pointer.under || pointer.pressed) return;
  m_touched = true;
  QContextMenuEvent event(QContextMenuEvent::Mouse, pointer.under->mapFrom(pointer.on, pointer.at.toPoint()),
                          pointer.on->mapToGlobal(pointer.at).toPoint());
  deliver(*pointer.under, event);
}

/// As a wheel: a notch forward where the stick is pushed forward.
void VrPanels::scroll(Pointer& pointer, double way, double seconds) {
  if (!pointer.under || (seconds < pointer.scrolled + kScroll && seconds >= pointer.scrolled)) return;
  pointer.scrolled = seconds;
  m_touched = true;
  // To whoever takes it: Qt hands on only what the system sends.
  const QPointer<QWidget> on = pointer.on;
  for (QPointer<QWidget> one = pointer.under; one && on; one = one == on ? nullptr : one->parentWidget()) {
    QWheelEvent wheel(one->mapFrom(on, pointer.at.toPoint()), on->mapToGlobal(pointer.at), {},
                      {0, way > 0 ? kNotch : -kNotch}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    wheel.ignore();
    deliver(*one, wheel);
    if (wheel.isAccepted()) return;
  }
}

void VrPanels::send(const Pointer& pointer, QWidget& target, int type, Qt::MouseButton button) {
  if (!pointer.on || (&target != pointer.on && !pointer.on->isAncestorOf(&target))) return;
  const QPointF origin = target.mapTo(pointer.on, QPoint(0, 0));
  const Qt::MouseButtons held = pointer.pressed ? Qt::LeftButton : Qt::NoButton;
  QMouseEvent event(static_cast<QEvent::Type>(type), pointer.at - origin, pointer.at,
                    pointer.on->mapToGlobal(pointer.at), button, held, Qt::NoModifier, &handDevice());
  deliver(target, event);
}

void VrPanels::deliver(QWidget& target, QEvent& event) {
  QWidget* before = QApplication::activePopupWidget();
  ++m_delivering;
  QApplication::sendEvent(&target, &event);
  --m_delivering;
  if (QWidget* popup = QApplication::activePopupWidget(); popup && popup != before) m_popup = popup;
}

}  // namespace ps
