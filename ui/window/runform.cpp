// SPDX-License-Identifier: Apache-2.0
#include "ui/window/runform.h"

#include "core/experiments/run.h"
#include "core/simulation/enginethread.h"
#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/recordedview.h"
#include "ui/session/runwork.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/window/dialogrow.h"
#include "ui/window/filenames.h"

#include <QtCore/QDir>
#include <QtCore/QDirIterator>
#include <QtCore/QFileInfo>
#include <QtCore/QSignalBlocker>
#include <QtCore/QTimer>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {
constexpr int kGap = 8, kEdge = 16, kLabelWidth = 80, kWidth = 520;
constexpr int kSteps[] = {1, 2, 3, 6, 12, 30, 60};
constexpr int kFollow = 500;  // ms
}  // namespace

RunForm::RunForm(Session& session)
    : m_session(session),
      m_grid(new QGridLayout(this)),
      m_buttons(new QHBoxLayout),
      m_where(new QPushButton),
      m_begin(new QPushButton(QStringLiteral("Export"))) {
  m_grid->setContentsMargins(kEdge, kEdge, kEdge, kEdge);
  m_grid->setSpacing(kGap);
  m_grid->setColumnMinimumWidth(0, kLabelWidth);
  m_grid->setColumnStretch(1, 1);
  m_buttons->addStretch(1);
  m_buttons->addWidget(m_begin);
  m_begin->setProperty("primary", true);
  m_where->setAutoDefault(false);
  m_where->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // a place is as long as it likes
  connect(m_where, &QPushButton::clicked, this, [this] {
    if (const QString chosen = choosePlace(); !chosen.isEmpty()) setPlace(chosen);
  });
  connect(m_begin, &QPushButton::clicked, this, [this] {
    m_looked.clear();
    refresh();  // the run, the folder or other work may have gone on since
    if (!m_begin->isEnabled()) return;
    begin();
    refresh();
    Q_EMIT begun();
  });
}

QComboBox* RunForm::addChoice(const QString& label, const QString& tip) {
  auto* box = new QComboBox;
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  addDialogRow(*m_grid, label, box, tip);
  connect(box, &QComboBox::currentIndexChanged, this, &RunForm::refresh);
  return box;
}

QLineEdit* RunForm::addTime(const QString& label, const QString& tip) {
  auto* line = new QLineEdit;
  addDialogRow(*m_grid, label, line, tip);
  connect(line, &QLineEdit::textChanged, this, &RunForm::refresh);
  connect(line, &QLineEdit::textEdited, this, [this] { m_rangeTyped = true; });
  return line;
}

void RunForm::addRange() {
  m_from = addTime(QStringLiteral("From, in s"), QStringLiteral("Time of the run. It goes on meanwhile."));
  m_to = addTime(QStringLiteral("To, in s"), QStringLiteral("What was recorded until now, at most."));
  m_every = addChoice(QStringLiteral("Frames"), QStringLiteral("Of those that were recorded."));
  addDialogRow(*m_grid, QStringLiteral("Where"), m_where, QStringLiteral("A click chooses another place."));
  m_summary = new QLabel;
  m_summary->setTextFormat(Qt::PlainText);
  m_summary->setWordWrap(true);
  m_grid->addWidget(m_summary, m_grid->rowCount(), 0, 1, 2);
  m_grid->addLayout(m_buttons, m_grid->rowCount(), 0, 1, 2);
  m_grid->setRowStretch(m_grid->rowCount(), 1);
  addRates();
  showAll();
  refresh();
  followRun();
}

void RunForm::addRates() {
  const QSignalBlocker quiet(m_every);
  const int before = std::max(0, m_every->currentIndex());
  m_shownLength = frameLength(m_session.document().project());
  m_every->clear();
  for (const int step : kSteps) {
    const QString rate = formatShort(1 / (step * m_shownLength), 3);
    m_every->addItem(step == 1 ? QStringLiteral("Every one, %1 a second").arg(rate)
                               : QStringLiteral("One in %1, %2 a second").arg(QString::number(step), rate),
                     step);
  }
  m_every->setCurrentIndex(before);
}

void RunForm::showAll() {
  const RunRecord::Extent extent = m_session.recorded().extent();
  const auto show = [](QLineEdit& field, ShownTime& shown, double seconds) {
    shown = {formatShort(seconds), seconds};
    field.setText(shown.text);
  };
  show(*m_from, m_shownFrom, extent.from);
  show(*m_to, m_shownTo, extent.to);
}

/// A field that stands as it was filled in means the time that it was filled in with, whose digits it rounds.
std::optional<double> RunForm::timeIn(const QLineEdit& field, const ShownTime& shown) {
  return field.text() == shown.text ? shown.seconds : parseNumber(field.text());
}

void RunForm::followRun() {
  auto* clock = new QTimer(this);
  clock->setInterval(kFollow);
  connect(clock, &QTimer::timeout, this, [this] {
    if (!isVisible()) return;
    if (!m_rangeTyped && !m_from->hasFocus() && !m_to->hasFocus()) showAll();
    if (m_shownLength != frameLength(m_session.document().project())) addRates();
    refresh();
  });
  clock->start();
  connect(&m_session.work(), &RunWork::ended, this, [this] { m_looked.clear(); });
  // Until a project's first frame has come, the run that is recorded is that of the one before.
  connect(&m_session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event)) refresh();
  });
  connect(&m_session, &Session::projectShown, this, [this] {
    m_rangeTyped = m_chosen = false;
    addRates();
    showAll();
    refresh();
  });
}

void RunForm::setPlace(const QString& place) {
  m_place = place;
  m_chosen = true;
  refresh();
}

FrameRange RunForm::range() const {
  if (!m_session.isReady()) return {1, 0, 1};
  const auto from = timeIn(*m_from, m_shownFrom), to = timeIn(*m_to, m_shownTo);
  const RunRecord& record = m_session.engine()->recording();
  // A time has the frame next to it: one that is far off has none.
  const RunRecord::Extent extent = m_session.recorded().extent();
  const double slack = frameLength(m_session.document().project());
  if ((from && *from > extent.to + slack) || (to && *to < extent.from - slack)) return {1, 0, 1};
  const auto first = from ? record.frameAt(*from) : std::nullopt, last = to ? record.frameAt(*to) : std::nullopt;
  if (!first || !last || *to < *from) return {1, 0, 1};
  return {*first, *last, static_cast<uint64_t>(m_every->currentData().toInt())};
}

size_t RunForm::frames() const {
  const FrameRange asked = range();
  return asked.last < asked.first ? 0 : static_cast<size_t>((asked.last - asked.first) / asked.every + 1);
}

QString RunForm::limits() const {
  const auto from = timeIn(*m_from, m_shownFrom), to = timeIn(*m_to, m_shownTo);
  const RunRecord::Extent extent = m_session.recorded().extent();
  const double slack = frameLength(m_session.document().project());
  if (!from || !to || (*from >= extent.from - slack && *to <= extent.to + slack)) return {};
  return QStringLiteral("Only %1 to %2 s are recorded.").arg(formatShort(extent.from), formatShort(extent.to));
}

double RunForm::framesPerSecond() const {
  return 1 / (m_every->currentData().toInt() * frameLength(m_session.document().project()));
}

QString RunForm::besideProject(const QString& ending) const {
  const Document& document = m_session.document();
  const QString& path = document.path();
  if (!path.isEmpty() && !m_session.files().isSample(path))
    return QFileInfo(path).absolutePath() + QLatin1Char('/') + QFileInfo(path).completeBaseName() + ending;
  return preferences::projectFolder() + QLatin1Char('/') + fileNameFor(document.title()) + ending;
}

QString RunForm::writtenText(size_t frames, const QString& where) {
  return QStringLiteral("%1 written to %2.")
      .arg(countText(frames, QStringLiteral("frame"), QStringLiteral("frames")), QDir::toNativeSeparators(where));
}

void RunForm::refresh() {
  if (!m_summary) return;  // not whole yet
  if (!m_chosen) m_place = suggestedPlace();
  showPlace();
  lookAtPlace();
  const size_t count = frames();
  const bool busy = m_session.work().isBusy();
  const bool opens = m_session.isOpening();
  const QString limited = opens       ? QStringLiteral("The project is still being opened.")
                          : busy      ? QStringLiteral("Other work is still going on.")
                          : count > 0 ? limits()
                                      : QString();
  m_summary->setText(count == 0 ? QStringLiteral("Nothing was recorded then: both times are numbers of seconds, the "
                                                 "second not before the first.")
                     : limited.isEmpty() ? summary()
                                         : summary() + QLatin1Char(' ') + limited);
  m_begin->setEnabled(count > 0 && isPossible() && !busy && !opens);
}

void RunForm::showPlace() {
  const QString shown = QDir::toNativeSeparators(m_place);
  const int room = std::max(0, m_where->width() - 2 * kEdge);
  m_where->setText(asButtonText(m_where->fontMetrics().elidedText(shown, Qt::ElideMiddle, room)));
  m_where->setToolTip(shown + QStringLiteral("\nA click chooses another place."));
}

/// Once for each place, for the clock asks again and again.
void RunForm::lookAtPlace() {
  const QString names = fileNames(), asked = m_place + QLatin1Char('/') + names;
  if (asked == m_looked) return;
  m_looked = asked;
  m_replaces = names.isEmpty() ? QFileInfo::exists(m_place) : QDirIterator(m_place, {names}, QDir::Files).hasNext();
}

void RunForm::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  m_grid->activate();
  showPlace();
}

RunDialog::RunDialog(RunForm* form, const QString& title, QWidget* window) : QDialog(window) {
  setWindowTitle(title);
  setAttribute(Qt::WA_DeleteOnClose);
  setMinimumWidth(kWidth);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(form);
  auto* close = new QPushButton(QStringLiteral("Cancel"));
  close->setAutoDefault(false);
  form->buttons().insertWidget(1, close);
  form->exportButton().setDefault(true);
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  connect(form, &RunForm::begun, this, &QDialog::accept);
  connect(&form->session().document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event)) reject();
  });
}

}  // namespace ps
