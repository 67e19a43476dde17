// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/runlines.h"

#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/timeline/nameinplace.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QHelpEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QMenu>

#include <algorithm>

namespace ps {
namespace {

constexpr double kLine = 2, kGap = 6;  ///< px: of a line, and between it and its name

}  // namespace

RunLines::RunLines(Session& session, QWidget* parent) : QWidget(parent), m_session(session) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(QStringLiteral("Earlier runs"));
  connect(&session.recorded(), &RecordedView::runsChanged, this, qOverload<>(&QWidget::update));
  connect(&session.recorded(), &RecordedView::comparedChanged, this, qOverload<>(&QWidget::update));
  hide();
}

void RunLines::setSpan(double seconds) {
  m_span = seconds;
  update();
}

int RunLines::wantedHeight() const {
  return kPitch * std::min(static_cast<int>(m_session.recorded().earlier().size()), kMost);
}

/// The name stands after its line, else before it, else over it.
std::vector<RunLines::Row> RunLines::rows() const {
  std::vector<RunRecord::EarlierRun> runs = m_session.recorded().earlier();
  if (runs.size() > static_cast<size_t>(kMost)) runs.erase(runs.begin(), runs.end() - kMost);
  std::vector<Row> rows;
  const double perSecond = width() / m_span;
  for (const RunRecord::EarlierRun& run : runs) {
    const double top = kPitch * static_cast<double>(rows.size());
    Row row{run.number, m_session.recorded().runName(run.number), {}, {}, {}};
    row.tip = QStringLiteral("%1, %2 to %3").arg(row.name, clockText(run.apart), clockText(run.to));
    row.line = QRectF(run.apart * perSecond, top + (kPitch - kLine) / 2,
                      std::max(2.0, (run.to - run.apart) * perSecond), kLine);
    const double wide = std::min(textWidth(row.name, Theme::font(TextRole::Small)) + 2, width() / 2.0);
    double left = row.line.right() + kGap;
    if (left + wide > width() - kGap) left = row.line.left() - kGap - wide;
    if (left < kGap) left = kGap;
    row.text = QRectF(left, top, wide, kPitch);
    rows.push_back(std::move(row));
  }
  return rows;
}

QRect RunLines::rowOf(uint64_t run) const {
  for (const Row& row : rows()) {
    if (row.run == run) return row.line.united(row.text).toAlignedRect();
  }
  return {};
}

std::optional<uint64_t> RunLines::runAt(const QPoint& at) const {
  const std::vector<Row> all = rows();
  const auto row = static_cast<size_t>(std::max(0, at.y()) / kPitch);
  return row < all.size() ? std::optional(all[row].run) : std::nullopt;
}

void RunLines::fillMenu(QMenu& menu, uint64_t run) {
  RecordedView& recorded = m_session.recorded();
  const auto add = [&](const char* text, auto act) {
    QAction* action = menu.addAction(QString::fromLatin1(text));
    connect(action, &QAction::triggered, this, act);
    return action;
  };
  const bool compared = recorded.compared() == run;
  add("Go on with it", [&recorded, run] { recorded.goOnWith(run); });
  QAction* compare =
      add("Compare in graphs", [&recorded, run](bool on) { recorded.compare(on ? std::optional(run) : std::nullopt); });
  QAction* ghost = add("Show as a ghost", [&recorded, run](bool on) {
    if (on) recorded.compare(run);
    recorded.setGhost(on);
  });
  for (QAction* toggle : {compare, ghost}) toggle->setCheckable(true);
  compare->setChecked(compared);
  ghost->setChecked(compared && recorded.hasGhost());
  add("Rename", [this, run] { editName(run); });
  add("Delete", [&recorded, run] { recorded.forgetRun(run); });
}

void RunLines::addMenus(QMenu& menu, bool older) {
  RecordedView& recorded = m_session.recorded();
  std::vector<RunRecord::EarlierRun> runs = recorded.earlier();
  if (older) runs.resize(runs.size() - std::min(runs.size(), static_cast<size_t>(kMost)));
  for (const RunRecord::EarlierRun& run : runs) {
    const QString title =
        QStringLiteral("%1, %2 to %3").arg(recorded.runName(run.number), clockText(run.apart), clockText(run.to));
    fillMenu(*menu.addMenu(asButtonText(title)), run.number);
  }
}

/// An empty one is none.
void RunLines::editName(uint64_t run) {
  QRect place(0, 0, 0, kPitch);
  for (const Row& one : rows()) {
    if (one.run == run) place = one.text.toAlignedRect();
  }
  nameInPlace(*this, place, m_session.recorded().runName(run), QStringLiteral("Name of the run"),
              [this, run](const QString& name) { m_session.recorded().renameRun(run, name); });
}

/// The window renames what is selected by the same key.
bool RunLines::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && m_chosen) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_F2 || key == Qt::Key_Up || key == Qt::Key_Down) event->accept();
  }
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const auto run = runAt(help->pos());
    for (const Row& row : rows()) {
      if (row.run == run) showTip(help->globalPos(), row.tip, this, row.line.united(row.text).toAlignedRect());
    }
    return true;
  }
  return QWidget::event(event);
}

void RunLines::mousePressEvent(QMouseEvent* event) {
  m_chosen = runAt(event->position().toPoint());
  update();
}

void RunLines::mouseDoubleClickEvent(QMouseEvent* event) {
  if (const auto run = runAt(event->position().toPoint())) editName(*run);
}

void RunLines::keyPressEvent(QKeyEvent* event) {
  const std::vector<Row> all = rows();
  const auto at = std::find_if(all.begin(), all.end(), [this](const Row& row) { return row.run == m_chosen; });
  if (at == all.end() && !all.empty() && (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down))
    m_chosen = all.front().run;
  else if (event->key() == Qt::Key_F2 && m_chosen)
    editName(*m_chosen);
  else if (event->key() == Qt::Key_Up && at != all.end() && at != all.begin())
    m_chosen = std::prev(at)->run;
  else if (event->key() == Qt::Key_Down && at != all.end() && std::next(at) != all.end())
    m_chosen = std::next(at)->run;
  else
    QWidget::keyPressEvent(event);
  update();
}

void RunLines::contextMenuEvent(QContextMenuEvent* event) {
  m_chosen = runAt(event->pos());
  update();
  if (!m_chosen) return;
  QMenu menu(this);
  fillMenu(menu, *m_chosen);
  if (m_session.recorded().earlier().size() > static_cast<size_t>(kMost)) {
    menu.addSeparator();
    addMenus(*menu.addMenu(QStringLiteral("Older runs")), true);
  }
  menu.exec(event->globalPos());
}

void RunLines::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  const RecordedView& recorded = m_session.recorded();
  for (const Row& row : rows()) {
    const bool compared = recorded.compared() == row.run, chosen = hasFocus() && m_chosen == row.run;
    const QColor colour = theme[compared && recorded.hasGhost() ? Token::Curve
                                : compared                      ? Token::Text2
                                                                : Token::Muted];
    if (chosen) paintBox(painter, row.text.adjusted(-3, 0, 3, 0), theme[Token::Selection], QColor(), 3);
    constexpr double kDash = 3;
    for (double x = row.line.left(); x < row.line.right(); x += compared ? 2 * kDash : row.line.width())
      painter.fillRect(
          QRectF(x, row.line.top(), compared ? std::min(kDash, row.line.right() - x) : row.line.width(), kLine),
          colour);
    painter.fillRect(QRectF(row.line.left(), row.line.top() - 3, 2, kLine + 6), colour);  // where it left
    paintText(painter, row.text, Qt::AlignLeft | Qt::AlignVCenter, row.name, Theme::font(TextRole::Small),
              theme[chosen ? Token::Text : Token::Text2]);
  }
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 2);
}

}  // namespace ps
