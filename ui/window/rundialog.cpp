// SPDX-License-Identifier: Apache-2.0
#include "ui/window/rundialog.h"

#include "core/experiments/run.h"
#include "core/simulation/enginethread.h"
#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/window/dialogrow.h"
#include "ui/window/filenames.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>

#include <algorithm>

namespace ps {
namespace {
constexpr int kGap = 8, kEdge = 16, kLabelWidth = 120, kWidth = 520;
constexpr int kSteps[] = {1, 2, 3, 6, 12, 30, 60};
}  // namespace

RunDialog::RunDialog(Session& session, const QString& title, QWidget* window)
    : QDialog(window), m_session(session), m_grid(new QGridLayout(this)) {
  setWindowTitle(title);
  setAttribute(Qt::WA_DeleteOnClose);
  m_grid->setContentsMargins(kEdge, kEdge, kEdge, kEdge);
  m_grid->setSpacing(kGap);
  m_grid->setColumnMinimumWidth(0, kLabelWidth);
  m_grid->setColumnStretch(1, 1);
  setMinimumWidth(kWidth);
}

QComboBox* RunDialog::addChoice(const QString& label, const QString& tip) {
  auto* box = new QComboBox;
  addDialogRow(*m_grid, label, box, tip);
  connect(box, &QComboBox::currentIndexChanged, this, &RunDialog::refresh);
  return box;
}

QLineEdit* RunDialog::addTime(const QString& label, const QString& tip, double seconds) {
  auto* line = new QLineEdit(formatShort(seconds, 6));
  addDialogRow(*m_grid, label, line, tip);
  connect(line, &QLineEdit::textChanged, this, &RunDialog::refresh);
  return line;
}

void RunDialog::addRange() {
  const RunRecord::Extent extent = m_session.recorded().extent();
  m_from = addTime(QStringLiteral("From, in s"), QStringLiteral("Time of the run. It goes on meanwhile."), extent.from);
  m_to = addTime(QStringLiteral("To, in s"), QStringLiteral("What was recorded until now, at most."), extent.to);
  m_every = addChoice(QStringLiteral("Frames"), QStringLiteral("Of those that were recorded."));
  for (const int step : kSteps) {
    const QString rate = formatShort(1 / (step * frameLength(m_session.document().project())), 3);
    m_every->addItem(step == 1 ? QStringLiteral("Every one, %1 a second").arg(rate)
                               : QStringLiteral("One in %1, %2 a second").arg(QString::number(step), rate),
                     step);
  }
  m_where = new QPushButton;
  m_where->setAutoDefault(false);
  addDialogRow(*m_grid, QStringLiteral("Where"), m_where, QStringLiteral("A click chooses another place."));
  connect(m_where, &QPushButton::clicked, this, [this] {
    if (const QString chosen = choosePlace(); !chosen.isEmpty()) setPlace(chosen);
  });
  m_summary = new QLabel;
  m_summary->setTextFormat(Qt::PlainText);
  m_summary->setWordWrap(true);
  m_grid->addWidget(m_summary, m_grid->rowCount(), 0, 1, 2);
  auto* buttons = new QHBoxLayout;
  auto* close = new QPushButton(QStringLiteral("Cancel"));
  close->setAutoDefault(false);
  m_begin = new QPushButton(QStringLiteral("Export"));
  m_begin->setProperty("primary", true);
  m_begin->setDefault(true);
  buttons->addStretch(1);
  buttons->addWidget(close);
  buttons->addWidget(m_begin);
  m_grid->addLayout(buttons, m_grid->rowCount(), 0, 1, 2);
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  connect(m_begin, &QPushButton::clicked, this, [this] {
    begin();
    accept();
  });
  refresh();
}

void RunDialog::setPlace(const QString& place) {
  m_place = place;
  m_chosen = true;
  refresh();
}

FrameRange RunDialog::range() const {
  const auto from = parseNumber(m_from->text()), to = parseNumber(m_to->text());
  const RunRecord& record = m_session.engine()->recording();
  const auto first = from ? record.frameAt(*from) : std::nullopt, last = to ? record.frameAt(*to) : std::nullopt;
  if (!first || !last || *to < *from) return {1, 0, 1};
  return {*first, *last, static_cast<uint64_t>(m_every->currentData().toInt())};
}

size_t RunDialog::frames() const {
  const FrameRange asked = range();
  return asked.last < asked.first ? 0 : static_cast<size_t>((asked.last - asked.first) / asked.every + 1);
}

double RunDialog::framesPerSecond() const {
  return 1 / (m_every->currentData().toInt() * frameLength(m_session.document().project()));
}

QString RunDialog::besideProject(const QString& ending) const {
  const Document& document = m_session.document();
  const QString& path = document.path();
  if (!path.isEmpty() && !m_session.files().isSample(path))
    return QFileInfo(path).absolutePath() + QLatin1Char('/') + QFileInfo(path).completeBaseName() + ending;
  return preferences::projectFolder() + QLatin1Char('/') + fileNameFor(document.title()) + ending;
}

QString RunDialog::writtenText(size_t frames, const QString& where) {
  return QStringLiteral("%1 written to %2.")
      .arg(countText(frames, QStringLiteral("frame"), QStringLiteral("frames")), QDir::toNativeSeparators(where));
}

void RunDialog::refresh() {
  if (!m_begin) return;  // not whole yet
  if (!m_chosen) m_place = suggestedPlace();
  const QString shown = QDir::toNativeSeparators(m_place);
  m_where->setText(
      asButtonText(m_where->fontMetrics().elidedText(shown, Qt::ElideMiddle, kWidth - kLabelWidth - 4 * kEdge)));
  const size_t count = frames();
  m_summary->setText(count > 0 ? summary()
                               : QStringLiteral("Nothing was recorded then: both times are numbers of seconds, the "
                                                "second not before the first."));
  m_begin->setEnabled(count > 0 && isPossible());
}

}  // namespace ps
