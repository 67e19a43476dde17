// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/energypanel.h"

#include "ui/document/document.h"
#include "ui/graphs/seeking.h"
#include "ui/graphs/stackview.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/theme/theme.h"

#include <QtCore/QTimer>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QStyle>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

QString joules(double value) { return formatPrefixed(value, QStringLiteral("J")); }

}  // namespace

EnergyPanel::EnergyPanel(Session& session, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_history(session),
      m_graph(new EnergyStackView),
      m_ledger(new QLabel),
      m_room(new QScrollArea) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 4, 12, 4);
  row->setSpacing(12);
  m_graph->setEmptyText(QStringLiteral("No matter yet"));
  m_ledger->setTextFormat(Qt::RichText);
  m_ledger->setMinimumWidth(230);
  m_ledger->setAlignment(Qt::AlignVCenter | Qt::AlignLeft);
  row->addWidget(m_graph, 1);
  seekByClicks(*m_graph, m_session.recorded());
  m_room->setFrameShape(QFrame::NoFrame);
  m_room->setWidgetResizable(true);
  m_room->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  m_room->setFocusPolicy(Qt::NoFocus);
  m_room->setWidget(m_ledger);
  m_ledger->setAutoFillBackground(false);
  row->addWidget(m_room);
  fitRoom();
  connect(&session, &Session::valuesDue, this, &EnergyPanel::readHistory);
  connect(&session.document(), &Document::changed, this, [this, &session](const ChangeEvent& event) {
    const bool opened = std::holds_alternative<ProjectOpened>(event);
    if (opened) clear();
    if (opened || std::holds_alternative<AboutChanged>(event)) setDuration(session.document().project().duration);
  });
}

void EnergyPanel::readHistory() {
  const HistoryReader::Piece piece = m_history.read();
  if (piece.begins) clear();
  for (const FrameStats& stats : piece.frames) take(stats);
  if (piece.more) QTimer::singleShot(0, this, &EnergyPanel::readHistory);
  showLedger();
  m_graph->setPresentTime(m_session.now());
}

void EnergyPanel::setDuration(double seconds) { m_graph->setDuration(seconds); }

void EnergyPanel::append(const FrameStats& stats) {
  take(stats);
  showLedger();
}

void EnergyPanel::showLedger() {
  if (!m_shown) return;
  m_ledger->setText(ledgerText());
  m_ledger->setMinimumWidth(std::max(m_ledger->minimumWidth(), m_ledger->sizeHint().width()));  // it does not breathe
  fitRoom();
}

/// With that for a bar beside it.
void EnergyPanel::fitRoom() {
  m_room->setFixedWidth(m_ledger->minimumWidth() + style()->pixelMetric(QStyle::PM_ScrollBarExtent));
}

void EnergyPanel::take(const FrameStats& stats) {
  const SnapshotPtr snapshot = m_session.snapshot();
  const bool held = snapshot && !snapshot->id.empty();  // it has heat too, though no phase counts it
  if (!m_shown && !held && !hasMatter(stats)) return;   // a flat line of nothing
  m_shown = true;
  // Matter drawn before the first step belongs to the start.
  if (!m_started) m_start = stats.thermalEnergy - stats.heat.net();
  m_started = stats.frame > 0;
  const HeatLedger& heat = stats.heat;
  m_graph->append(stats.time, {heat.walls, heat.air, heat.radiation, heat.heaters, heat.sources},
                  stats.thermalEnergy - m_start);
  m_graph->setPresentTime(stats.time);
  m_last = stats;
}

QString EnergyPanel::ledgerText() const {
  const FrameStats& stats = m_last;
  const auto line = [](const QString& name, const QString& value) {
    return QStringLiteral("<tr><td>%1&nbsp;&nbsp;&nbsp;</td><td align='right'>%2</td></tr>")
        .arg(name, value.toHtmlEscaped());
  };
  const auto matter = [&](const QString& name, const FlowAmount& amount) {
    return amount.count == 0 ? QString() : line(name, formatPrefixed(1000 * amount.mass, QStringLiteral("g")));
  };
  return QStringLiteral("<table>") + line(QStringLiteral("Heat in matter"), joules(stats.thermalEnergy - m_start)) +
         line(QStringLiteral("Through walls"), joules(stats.heat.walls)) +
         line(QStringLiteral("Through air"), joules(stats.heat.air)) +
         line(QStringLiteral("Through radiation"), joules(stats.heat.radiation)) +
         (stats.heat.airWarming == 0
              ? QString()
              : line(QStringLiteral("Air warmed by"), formatFixed(stats.heat.airWarming, 1) + QStringLiteral(" K"))) +
         line(QStringLiteral("By heaters"), joules(stats.heat.heaters)) +
         line(QStringLiteral("Came with matter"), joules(stats.heat.sources)) +
         matter(QStringLiteral("Matter from taps"), stats.flow.poured) +
         matter(QStringLiteral("Matter into drains"), stats.flow.drained) +
         line(QStringLiteral("Motion"), joules(stats.kineticEnergy)) +
         line(QStringLiteral("Balance open by"), balanceText()) + QStringLiteral("</table>");
}

QString EnergyPanel::balanceText() const {
  const double open = m_last.thermalEnergy - m_start - m_last.heat.net();
  const double share = m_last.heat.exchanged > 0 ? open / m_last.heat.exchanged : 0;
  return formatPrefixed(std::abs(open), QStringLiteral("J"), 2) + QStringLiteral(" (") + formatError(share) +
         QStringLiteral(")");
}

void EnergyPanel::clear() {
  m_graph->clear();
  m_ledger->clear();
  m_last = {};
  m_started = m_shown = false;
}

}  // namespace ps
