// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/curvepanel.h"

#include "core/math/responseedit.h"
#include "core/simulation/snapshot.h"
#include "ui/curves/curveview.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QTimer>
#include <QtGui/QPainter>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr int kParticles = 100;  // ms: the histogram at 10 Hz
const QString kHint =
    QStringLiteral("Double-click adds a point · Del removes · Shift fine · Alt-drag moves all · F fits");

const QString kSlope = QStringLiteral("Stated on both sides of the point; empty: that of a monotone curve");
const QString kNoSlope =
    QStringLiteral("No smooth piece meets this point: choose Monotone or Stated slopes between points first.");

QLabel* label(TextRole role) {
  auto* text = new QLabel;
  text->setFont(Theme::font(role));
  text->setTextFormat(Qt::PlainText);
  return text;
}

/// What does not fit ends in dots.
class NoteLabel : public QLabel {
 public:
  explicit NoteLabel(Qt::Alignment side) {
    setAlignment(side | Qt::AlignVCenter);
    setFont(Theme::font(TextRole::Small));
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Expanding);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    paintText(painter, rect(), alignment(), text(), font(), Theme::current()[Token::Muted]);
  }
};

/// One whose parts, parted by commas and dots, stand whole or not at all.
class PartsLabel final : public NoteLabel {
 public:
  using NoteLabel::NoteLabel;

 protected:
  void paintEvent(QPaintEvent*) override {
    QString shown = text();
    while (!shown.isEmpty() && textWidth(shown, font()) > width())
      shown.truncate(std::max({shown.lastIndexOf(QStringLiteral(" · ")), shown.lastIndexOf(QStringLiteral(", ")),
                               decltype(shown.size()){0}}));
    QPainter painter(this);
    paintText(painter, rect(), alignment(), shown, font(), Theme::current()[Token::Muted]);
  }
};

QLineEdit* field(const QString& name) {
  auto* line = new QLineEdit;
  line->setMinimumWidth(76);  // where there is little room
  line->setMaximumWidth(108);
  line->setAlignment(Qt::AlignRight);
  line->setAccessibleName(name);
  return line;
}

}  // namespace

CurvePanel::CurvePanel(Session& session, CurveTarget& target, QWidget* parent)
    : QWidget(parent),
      m_target(target),
      m_title(label(TextRole::Heading)),
      m_source(new PartsLabel(Qt::AlignLeft)),
      m_which(label(TextRole::Normal)),
      m_slopeLabel(label(TextRole::Normal)),
      m_note(new NoteLabel(Qt::AlignRight)),
      m_between(new QComboBox),
      m_view(new CurveView(target)),
      m_kelvin(field(QStringLiteral("Temperature of the point"))),
      m_value(field(QStringLiteral("Value of the point"))),
      m_slope(field(QStringLiteral("Slope at the point"))) {
  m_slopeLabel->setText(QStringLiteral("Slope"));
  m_value->setMinimumWidth(98);
  m_slope->setMinimumWidth(72);
  m_slope->setMaximumWidth(132);
  m_slope->setPlaceholderText(QStringLiteral("–"));
  m_between->setAccessibleName(QStringLiteral("Between points"));
  m_between->setToolTip(QStringLiteral("How the curve goes between its points; the table has each by itself"));
  m_between->setPlaceholderText(QStringLiteral("Mixed"));
  for (const Between way : {Between::Step, Between::Linear, Between::Monotone, Between::Stated})
    m_between->addItem(labelOf(way));
  m_between->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  m_between->setMinimumContentsLength(14);
  layOut();
  connectParts(session);
  if (!target.isKnown()) return;
  showTitle();
  showPoint();
  showBetween();
  showOverlays();
}

void CurvePanel::layOut() {
  auto* top = new QHBoxLayout;
  top->setContentsMargins(10, 4, 10, 0);
  top->setSpacing(12);
  top->addWidget(m_title);
  top->addWidget(m_source, 1);
  top->addWidget(new QLabel(QStringLiteral("Between points")));
  top->addWidget(m_between);
  auto* bottom = new QHBoxLayout;
  bottom->setContentsMargins(12, 0, 12, 6);
  bottom->setSpacing(6);
  bottom->addWidget(m_which);
  bottom->addWidget(m_kelvin);
  bottom->addWidget(m_value);
  bottom->addWidget(m_slopeLabel);
  bottom->addWidget(m_slope);
  bottom->addWidget(m_note, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addLayout(top);
  column->addWidget(m_view, 1);
  column->addLayout(bottom);
}

void CurvePanel::connectParts(Session& session) {
  for (QLineEdit* line : {m_kelvin, m_value}) {
    connect(line, &QLineEdit::editingFinished, this, [this, line] { enter(line); });
  }
  connect(m_slope, &QLineEdit::editingFinished, this, &CurvePanel::enterSlope);
  connect(m_between, qOverload<int>(&QComboBox::activated), this, &CurvePanel::chooseBetween);
  connect(&m_target, &CurveTarget::targetChanged, this, &CurvePanel::showTitle);
  connect(&m_target, &CurveTarget::responseChanged, this, [this] {
    showPoint();
    showBetween();
    showOverlays();
  });
  connect(&m_target, &CurveTarget::pointChanged, this, &CurvePanel::showPoint);
  connect(&m_target, &CurveTarget::comparedChanged, this, &CurvePanel::showOverlays);
  connect(&m_target, &CurveTarget::refused, this,
          [this](const QString& problem) { note(problem.isEmpty() ? kHint : problem); });
  const auto follow = [this] {
    if (m_view->isVisible()) m_view->showParticles();
  };
  auto* clock = new QTimer(this);
  connect(clock, &QTimer::timeout, this, [this, &session, shown = std::pair<uint64_t, uint64_t>()]() mutable {
    const SnapshotPtr snapshot = session.snapshot();
    if (!snapshot || !m_view->isVisible()) return;
    if (std::exchange(shown, {snapshot->revision, snapshot->stats.frame}) != shown) m_view->showParticles();
  });
  clock->start(kParticles);
  connect(&m_target, &CurveTarget::markChanged, m_view, follow);
  connect(&session, &Session::projectShown, m_view, &CurveView::fit);  // its matter is known only now
}

QString CurvePanel::noteText() const { return m_note->text(); }

void CurvePanel::showTitle() {
  m_title->setText(m_target.title());
  m_title->setMinimumWidth(static_cast<int>(std::ceil(textWidth(m_title->text(), m_title->font()))) + 2);
  m_source->setText(m_target.subtitle());
  m_source->setToolTip(m_target.subtitle());
  note(kHint);
}

void CurvePanel::note(const QString& text) {
  m_note->setText(text);
  m_note->setToolTip(text);
}

void CurvePanel::showPoint() {
  const Response response = m_target.response();
  const int index = m_target.point();
  const bool any = response.kind == Response::Kind::Curve && index >= 0;
  m_which->setText(any ? QStringLiteral("Point %1").arg(index + 1) : QStringLiteral("No point selected"));
  for (QLineEdit* line : {m_kelvin, m_value}) line->setVisible(any);
  const auto k = static_cast<size_t>(std::max(0, index));
  const bool after = hasSlope(response, k, true), sloped = any && (after || hasSlope(response, k, false));
  const bool between = any && m_target.declaration().kind != api::ParameterKind::Toggle;
  m_slopeLabel->setVisible(between);
  m_slope->setVisible(between);
  if (!any) return;
  const CurvePoint& p = response.points[k];
  m_slope->clear();
  if (sloped) {
    const double slope = after ? slopeAfter(response.points, k) : slopeBefore(response.points, k);
    m_slope->setText(formatShort(m_target.shownSlope(p.y, slope)) + QLatin1Char(' ') + m_target.slopeUnit());
  }
  m_slope->setToolTip(sloped ? kSlope : kNoSlope);
  m_slope->setModified(false);
  m_kelvin->setText(formatValue(m_target.axis(), p.x));
  m_value->setText(formatValue(m_target.declaration(), p.y));
  m_kelvin->setModified(false);
  m_value->setModified(false);
}

/// The number as typed, with any unit of its kind.
void CurvePanel::enter(QLineEdit* line) {
  Response next = m_target.response();
  const int index = m_target.point();
  if (!line->isModified() || index < 0 || next.kind != Response::Kind::Curve) return;
  line->setModified(false);
  CurvePoint p = next.points[static_cast<size_t>(index)];
  const bool kelvin = line == m_kelvin;
  const Typed typed = parseTyped(line->text(), kelvin ? m_target.axis() : m_target.declaration(), kelvin ? p.x : p.y);
  if (!typed.problem.isEmpty()) {
    showPoint();
    m_note->setText(typed.problem);
    return;
  }
  (kelvin ? p.x : p.y) = typed.value;
  movePoint(next, static_cast<size_t>(index), {p.x, p.y});
  if (!m_target.set(next, QStringLiteral("Move point of %1").arg(m_target.title()))) showPoint();
}

/// Without its unit; empty is no slope of its own.
void CurvePanel::enterSlope() {
  Response next = m_target.response();
  const auto index = static_cast<size_t>(std::max(0, m_target.point()));
  if (!m_slope->isModified() || m_target.point() < 0 || index >= next.points.size()) return;
  m_slope->setModified(false);
  const QString text = m_slope->text().remove(m_target.slopeUnit()).trimmed();
  const auto shown = parseNumber(text);
  if (!text.isEmpty() && !shown) {
    showPoint();
    m_note->setText(QStringLiteral("This is not a number."));
    return;
  }
  if (shown && !hasSlope(next, index, true) && !hasSlope(next, index, false)) {
    showPoint();
    m_note->setText(kNoSlope);
    return;
  }
  CurvePoint& p = next.points[index];
  if (text.isEmpty())
    p.slopeBefore = p.slopeAfter = std::nullopt;
  else
    stateSlope(next, index, m_target.storedSlope(p.y, *shown));
  if (!m_target.set(next, QStringLiteral("Slope of %1").arg(m_target.title()))) showPoint();
}

void CurvePanel::showBetween() {
  const Response response = m_target.response();
  const size_t pieces = response.kind == Response::Kind::Curve ? response.points.size() - 1 : 0;
  m_between->setEnabled(pieces > 0 && m_target.declaration().kind != api::ParameterKind::Toggle);
  int common = static_cast<int>(pieces > 0 ? betweenOf(response, 0) : Between::Monotone);
  for (size_t piece = 1; piece < pieces; ++piece) {
    if (static_cast<int>(betweenOf(response, piece)) != common) common = -1;
  }
  m_between->setCurrentIndex(common);
}

void CurvePanel::chooseBetween(int index) {
  Response next = m_target.response();
  const auto way = static_cast<Between>(index);
  for (size_t piece = 0; way == Between::Stated && piece + 1 < next.points.size(); ++piece)
    next.points[piece].toNext = ToNext::Smooth;  // a slope is of the pieces on both sides
  for (size_t piece = 0; piece + 1 < next.points.size(); ++piece) setBetween(next, piece, way);
  if (!m_target.set(next, QStringLiteral("Way between points of %1").arg(m_target.title()))) showBetween();
}

void CurvePanel::showOverlays() {
  std::vector<OverlayCurve> overlays;
  for (const OtherMaterial& other : m_target.others()) {
    if (m_target.track() || !m_target.compared().contains(other)) continue;
    overlays.push_back({other.id, m_target.otherLabel(other), m_target.otherResponse(other)});
  }
  m_view->setOverlays(std::move(overlays));
}

}  // namespace ps
