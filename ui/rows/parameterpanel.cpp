// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/parameterpanel.h"

#include "core/parameters/wording.h"
#include "ui/rows/filterfield.h"
#include "ui/rows/groupheading.h"
#include "ui/rows/parameterrow_p.h"
#include "ui/rows/steadyrows.h"
#include "ui/theme/theme.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QEvent>
#include <QtCore/QMetaMethod>
#include <QtCore/QSet>
#include <QtCore/QVariant>
#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QScrollBar>
#include <QtWidgets/QStyle>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <utility>

namespace ps {
namespace {

constexpr int kMostPinnedLabel = 150;
constexpr int kSymbolsFrom = 360;  ///< narrower panels hide the symbols
const QString kPinnedGroup = QStringLiteral("Try these");

struct Group {
  GroupHeading* heading = nullptr;
  std::vector<ParameterRow*> rows;
};

/// "16", "6 of 16" while not all are shown.
QString countText(const Group& group, size_t shown) {
  const size_t all = group.rows.size();
  const QString count = shown < all ? QStringLiteral("%1 of %2").arg(shown).arg(all) : QString::number(all);
  return group.heading->title() == kPinnedGroup ? count + QStringLiteral(" pinned") : count;
}

bool matches(const ParameterRow& row, const QString& filter) {
  if (filter.isEmpty()) return true;
  const api::ParameterDeclaration& p = row.model().declaration;
  for (const char* text : {p.label, p.key, p.symbol, p.group, p.help}) {
    if (text && QString::fromUtf8(text).contains(filter, Qt::CaseInsensitive)) return true;
  }
  return false;
}

/// In this order, and so for those too that take no focus until later: Qt puts none of these in line.
void chainForTab(const std::vector<QWidget*>& parts) {
  std::vector<Qt::FocusPolicy> policies;
  for (QWidget* part : parts) {
    policies.push_back(part->focusPolicy());
    part->setFocusPolicy(Qt::StrongFocus);
  }
  for (size_t i = 1; i < parts.size(); ++i) QWidget::setTabOrder(parts[i - 1], parts[i]);
  for (size_t i = 0; i < parts.size(); ++i) parts[i]->setFocusPolicy(policies[i]);
}

}  // namespace

std::vector<RowModel> rowModels(api::ParameterList list, const ParameterSet& set, const ParameterSet& defaults,
                                const QString& keyPrefix) {
  std::vector<RowModel> rows;
  const DeclarationOfKey find = [&](std::string_view key) { return findDeclaration(list, key); };
  const ValueOfKey values = [&](std::string_view key) -> std::optional<Value> {
    const api::ParameterDeclaration* declaration = find(key);
    return declaration ? std::optional(valueOf(set, *declaration)) : std::nullopt;
  };
  for (size_t i = 0; i < list.count; ++i) {
    RowModel row;
    for (const std::string& rule : ruleTexts(list[i], find)) row.rules << QString::fromStdString(rule);
    if (!holds(parseCondition(list[i].enabledWhen), values))
      row.disabledReason = QString::fromStdString(actsWhenText(list[i], find));
    row.key = keyPrefix + QString::fromUtf8(list[i].key);
    row.declaration = list[i];
    row.defaultValue = valueOf(defaults, list[i]);
    const auto own = set.values.find(list[i].key);
    row.value = own != set.values.end() ? own->second : row.defaultValue;
    rows.push_back(std::move(row));
  }
  return rows;
}

struct ParameterPanel::Private {
  ParameterPanel* q;
  PanelHeader* header;
  QLabel* note;
  QLineEdit* filter;
  QPushButton* changed;
  QScrollArea* scroll;
  QWidget* content = nullptr;
  QLabel* empty;
  QString emptyText = QStringLiteral("Select something, or press Ctrl+K");
  std::vector<Group> groups;
  QSet<QString> folded, pinned;

  void build(std::vector<RowModel> models);
  Group& group(const QString& title, QVBoxLayout* layout);
  void connectRow(ParameterRow* row);
  void mirror(const ParameterRow* from);  ///< rows of the same key follow
  void measure();
  void settle();
  void show();  ///< by filter and folding
  void showCount();
  template <class F>
  void each(const QString& key, F action) {
    for (const Group& group : groups) {
      for (ParameterRow* row : group.rows) {
        if (row->key() == key) action(row);
      }
    }
  }
};

ParameterPanel::ParameterPanel(QWidget* parent) : QWidget(parent), d(new Private) {
  d->q = this;
  d->header = new PanelHeader(this);
  d->header->hide();
  d->note = new QLabel(this);
  d->note->setObjectName(QStringLiteral("psHeaderNote"));
  d->note->setWordWrap(true);
  d->note->setTextFormat(Qt::RichText);
  d->note->setFont(Theme::font(TextRole::Small));
  d->note->setTextInteractionFlags(Qt::TextBrowserInteraction);
  d->note->hide();
  d->filter = new FilterField(this);
  d->changed = new QPushButton(this);
  d->changed->setObjectName(QStringLiteral("psChanged"));
  d->changed->setCheckable(true);
  d->changed->setToolTip(QStringLiteral("Show only what differs from its default"));
  d->scroll = new QScrollArea(this);
  d->scroll->setFrameShape(QFrame::NoFrame);
  d->scroll->setWidgetResizable(true);
  d->scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  d->scroll->setFocusPolicy(Qt::NoFocus);
  d->empty = new QLabel(this);
  d->empty->setTextFormat(Qt::RichText);
  d->empty->setAlignment(Qt::AlignCenter);
  d->empty->setWordWrap(true);
  d->empty->setProperty("role", "muted");

  auto* tools = new QHBoxLayout;
  tools->setContentsMargins(10, 8, 10, 8);
  tools->setSpacing(6);
  tools->addWidget(d->filter, 1);
  tools->addWidget(d->changed);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  auto* noted = new QHBoxLayout;
  noted->setContentsMargins(12, 0, 12, 0);
  noted->addWidget(d->note);
  layout->addWidget(d->header);
  layout->addLayout(noted);
  layout->addLayout(tools);
  layout->addWidget(d->scroll, 1);
  layout->addWidget(d->empty, 1);
  connect(d->filter, &QLineEdit::textChanged, this, [this] { d->show(); });
  connect(d->changed, &QPushButton::toggled, this, [this] { d->show(); });
  connect(d->empty, &QLabel::linkActivated, d->filter, &QLineEdit::clear);
  connect(d->note, &QLabel::linkActivated, this, [this](const QString& link) { Q_EMIT linkActivated({}, link); });
  d->scroll->viewport()->installEventFilter(this);
  setMinimumWidth(240);
  d->show();
}

ParameterPanel::~ParameterPanel() = default;

void ParameterPanel::setHeader(const QString& name, const QString& subtitle, const QString& detail,
                               SwatchPainter swatch) {
  d->header->setTexts(name, subtitle, detail);
  d->header->setSwatch(std::move(swatch));
  d->header->setVisible(!name.isEmpty());
}

void ParameterPanel::setHeaderNote(const QString& note) {
  d->note->setText(noteAsRichText(note));
  d->note->setVisible(!note.isEmpty());
}

void ParameterPanel::setHeaderDetail(const QString& detail) { d->header->setDetail(detail); }

void ParameterPanel::updateHeader() { d->header->update(); }

void ParameterPanel::setEmptyText(const QString& text) {
  d->emptyText = text;
  d->show();
}

void ParameterPanel::setModel(std::vector<RowModel> rows) {
  const int position = d->scroll->verticalScrollBar()->value();
  for (ParameterRow* row : this->rows()) row->finishEditing();
  d->build(std::move(rows));
  d->measure();
  d->show();
  d->content->layout()->activate();
  d->scroll->verticalScrollBar()->setValue(position);
}

void ParameterPanel::Private::build(std::vector<RowModel> models) {
  groups.clear();
  content = new QWidget;
  content->setObjectName(QStringLiteral("psPanel"));
  auto* layout = new QVBoxLayout(content);
  layout->setContentsMargins(0, 0, 0, 12);
  layout->setSpacing(0);
  std::stable_partition(models.begin(), models.end(), [](const RowModel& row) { return row.pinned; });
  // Groups in the order in which they first appear, although a group's rows may be scattered.
  std::vector<QString> titles;
  const auto titleOf = [](const RowModel& row) {
    return row.pinned ? kPinnedGroup : QString::fromUtf8(row.declaration.group ? row.declaration.group : "");
  };
  for (const RowModel& row : models) {
    if (std::find(titles.begin(), titles.end(), titleOf(row)) == titles.end()) titles.push_back(titleOf(row));
  }
  for (const QString& title : titles) {
    Group& into = group(title, layout);
    for (const RowModel& model : models) {
      if (titleOf(model) != title) continue;
      auto* row = new ParameterRow(model, content);
      row->setIsPinned(pinned.contains(model.key));
      into.rows.push_back(row);
      layout->addWidget(row);
      connectRow(row);
    }
  }
  layout->addStretch(1);
  if (QWidget* old = scroll->takeWidget()) {
    old->hide();
    old->deleteLater();  // one of its rows may be what asked for this
  }
  scroll->setWidget(content);
  // Rows come after the rest of the window, and Tab would come to them after all of it.
  std::vector<QWidget*> parts{changed};
  for (const Group& group : groups) {
    parts.push_back(group.heading);
    parts.insert(parts.end(), group.rows.begin(), group.rows.end());
  }
  chainForTab(parts);
}

Group& ParameterPanel::Private::group(const QString& title, QVBoxLayout* layout) {
  auto* heading = new GroupHeading(title.isEmpty() ? QStringLiteral("General") : title, content);
  heading->setFolded(folded.contains(heading->title()));
  layout->addWidget(heading);
  QObject::connect(heading, &GroupHeading::foldedChanged, q, [this, heading](bool fold) {
    if (fold)
      folded.insert(heading->title());
    else
      folded.remove(heading->title());
    show();
  });
  return groups.emplace_back(Group{heading, {}});
}

void ParameterPanel::Private::connectRow(ParameterRow* row) {
  const auto forward = [this, row](const QString& key, const Value& value, Edit edit) {
    mirror(row);
    Q_EMIT q->edited(key, value, edit);
  };
  connect(row, &ParameterRow::editingStarted, q,
          [forward](const QString& key, const Value& v) { forward(key, v, Edit::Begin); });
  connect(row, &ParameterRow::valueEdited, q,
          [forward](const QString& key, const Value& v) { forward(key, v, Edit::Live); });
  connect(row, &ParameterRow::editingFinished, q,
          [forward](const QString& key, const Value& v) { forward(key, v, Edit::End); });
  connect(row, &ParameterRow::scaled, q, &ParameterPanel::scaled);
  connect(row, &ParameterRow::resetAsked, q, &ParameterPanel::resetAsked);
  connect(row, &ParameterRow::takenBack, q, &ParameterPanel::takenBack);
  connect(row, &ParameterRow::linkActivated, q, &ParameterPanel::linkActivated);
  connect(row, &ParameterRow::changedChanged, q, [this] { showCount(); });
  // A row offers, by its menu and its pointer, what somebody listens to.
  const auto pass = [this, row](auto from, auto to) {
    if (q->isSignalConnected(QMetaMethod::fromSignal(to))) connect(row, from, q, to);
  };
  pass(&ParameterRow::curveRequested, &ParameterPanel::curveRequested);
  pass(&ParameterRow::sourceRequested, &ParameterPanel::sourceRequested);
  pass(&ParameterRow::pinToggled, &ParameterPanel::pinToggled);
  pass(&ParameterRow::plotRequested, &ParameterPanel::plotRequested);
  pass(&ParameterRow::keyToggled, &ParameterPanel::keyToggled);
  pass(&ParameterRow::wayChosen, &ParameterPanel::wayChosen);
  pass(&ParameterRow::keysRemoved, &ParameterPanel::keysRemoved);
}

void ParameterPanel::Private::mirror(const ParameterRow* from) {
  each(from->key(), [from](ParameterRow* row) {
    if (row == from) return;
    row->setMixed(from->model().mixed);
    row->setValue(from->model().value);
  });
}

/// The label's column is as wide as the labels, up to a point: past it, a label takes the room of its row's symbol.
/// Fields stand at one place whether the scroll bar shows or not.
void ParameterPanel::Private::measure() {
  const bool symbols = q->width() >= kSymbolsFrom;
  int label = kMinimumLabel, longest = 0;
  for (const Group& group : groups) {
    for (const ParameterRow* row : group.rows) {
      // Toggles and choices have no slider to align and may use its room.
      const auto kind = row->model().declaration.kind;
      if (kind == api::ParameterKind::Toggle || kind == api::ParameterKind::Choice) continue;
      // A pinned row has its owner's name in it, which may be of any length and must not take every row's slider.
      const int most = row->model().pinned ? kMostPinnedLabel : std::numeric_limits<int>::max();
      const int wanted = std::min(row->wantedLabelWidth(), most);
      if (wanted <= kMinimumLabel + 14) label = std::max(label, wanted);
      longest = std::max(longest, wanted);
    }
  }
  label = std::max(label, longest + kLabelGap - (symbols ? kSymbolWidth : 0));
  const int bar = q->width() - scroll->viewport()->width();
  for (const Group& group : groups) {
    for (ParameterRow* row : group.rows) {
      row->setLabelWidth(label);
      row->setShowSymbol(symbols);
      row->setRightMargin((symbols ? kRowRight : kRowRightNarrow) - std::clamp(bar, 0, 8));
    }
  }
}

/// A row's note may become higher by the width that the row is given, while the layout is at work: a page that came up
/// with its rows made while it was hidden would go on with the heights from before.
void ParameterPanel::Private::settle() {
  for (int pass = 0; content && pass < 2; ++pass) {
    content->layout()->invalidate();
    content->layout()->activate();
  }
}

void ParameterPanel::Private::show() {
  const QString text = filter->text().trimmed();
  const bool searching = !text.isEmpty() || changed->isChecked();
  size_t total = 0, shown = 0;
  for (const Group& group : groups) {
    size_t matching = 0;
    for (ParameterRow* row : group.rows) {
      const bool match = matches(*row, text) && (!changed->isChecked() || row->isChanged());
      matching += match ? 1 : 0;
      row->setVisible(match && (searching || !group.heading->isFolded()));
    }
    group.heading->setVisible(matching > 0);
    group.heading->setCount(countText(group, matching));
    total += group.rows.size();
    shown += matching;
  }
  filter->setPlaceholderText(
      (total == 1 ? QStringLiteral("Filter %1 parameter") : QStringLiteral("Filter %1 parameters")).arg(total));
  filter->setVisible(total > 0);
  changed->setVisible(total > 0);
  scroll->setVisible(shown > 0);
  empty->setVisible(shown == 0);
  if (total == 0)
    empty->setText(emptyText.toHtmlEscaped());
  else if (!text.isEmpty())
    empty->setText(nothingCalled(text));
  else
    empty->setText(QStringLiteral("Nothing is changed."));
  showCount();
}

void ParameterPanel::Private::showCount() {
  const int count = q->changedCount();
  changed->setText(QStringLiteral("Changed %1").arg(count));
  if (changed->property("some").toBool() == (count > 0)) return;
  changed->setProperty("some", count > 0);
  changed->style()->unpolish(changed);
  changed->style()->polish(changed);
}

void ParameterPanel::setValue(const QString& key, const Value& value) {
  d->each(key, [&](ParameterRow* row) { row->setValue(value); });
}
void ParameterPanel::setDefaultValue(const QString& key, const Value& value) {
  d->each(key, [&](ParameterRow* row) { row->setDefaultValue(value); });
}
void ParameterPanel::setDisabledReason(const QString& key, const QString& reason) {
  d->each(key, [&](ParameterRow* row) { row->setDisabledReason(reason); });
}
void ParameterPanel::setChoiceLabels(const QString& key, const QStringList& labels) {
  d->each(key, [&](ParameterRow* row) { row->setChoiceLabels(labels); });
}
void ParameterPanel::setMixed(const QString& key, bool mixed) {
  d->each(key, [&](ParameterRow* row) { row->setMixed(mixed); });
}
void ParameterPanel::setKeyMark(const QString& key, KeyMark mark, ToNext way) {
  d->each(key, [&](ParameterRow* row) { row->setKeyMark(mark, way); });
}
void ParameterPanel::setPinned(const QStringList& keys) {
  d->pinned = QSet<QString>(keys.begin(), keys.end());
  for (ParameterRow* row : rows()) row->setIsPinned(d->pinned.contains(row->key()));
}
void ParameterPanel::setLimit(const QString& key, const QString& text, double delivered) {
  changeSteadily(*d->scroll, [&] { d->each(key, [&](ParameterRow* row) { row->setLimit(text, delivered); }); });
}
void ParameterPanel::setError(const QString& key, const QString& text) {
  changeSteadily(*d->scroll, [&] { d->each(key, [&](ParameterRow* row) { row->setError(text); }); });
}

ParameterRow* ParameterPanel::row(const QString& key) const {
  ParameterRow* found = nullptr;
  d->each(key, [&found](ParameterRow* row) { found = found ? found : row; });
  return found;
}

std::vector<ParameterRow*> ParameterPanel::rows() const {
  std::vector<ParameterRow*> all;
  for (const Group& group : d->groups) all.insert(all.end(), group.rows.begin(), group.rows.end());
  return all;
}

int ParameterPanel::changedCount() const {
  QSet<QString> keys;  // a pinned row and its original count once
  for (const ParameterRow* row : rows()) {
    if (row->isChanged()) keys.insert(row->key());
  }
  return static_cast<int>(keys.size());
}

void ParameterPanel::setFilter(const QString& text) { d->filter->setText(text); }
void ParameterPanel::setChangedOnly(bool on) { d->changed->setChecked(on); }

QStringList ParameterPanel::foldedGroups() const {
  QStringList groups(d->folded.begin(), d->folded.end());
  groups.sort();
  return groups;
}

void ParameterPanel::setGroupFolded(const QString& group, bool folded) {
  if (folded)
    d->folded.insert(group);
  else
    d->folded.remove(group);
  for (const Group& each : d->groups) {
    if (each.heading->title() == group) each.heading->setFolded(folded);
  }
  d->show();
}

bool ParameterPanel::isRowShown(const ParameterRow* row) const { return row && !row->isHidden(); }

bool ParameterPanel::reveal(const QString& key, bool focus) {
  ParameterRow* found = row(key);
  if (!found) return false;
  const GroupHeading* heading = nullptr;
  for (const Group& group : d->groups) {
    if (std::find(group.rows.begin(), group.rows.end(), found) != group.rows.end()) heading = group.heading;
  }
  setGroupFolded(heading->title(), false);
  if (found->isHidden()) {
    setFilter({});
    setChangedOnly(false);
  }
  d->settle();
  QEvent request(QEvent::LayoutRequest);
  QCoreApplication::sendEvent(d->scroll, &request);  // the scroll bar knows the present height now
  d->scroll->verticalScrollBar()->setValue(heading->y());
  d->scroll->ensureWidgetVisible(found);
  if (focus) found->setFocus(Qt::TabFocusReason);
  return true;
}

void ParameterPanel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Theme::current()[Token::Panel]);
}

void ParameterPanel::resizeEvent(QResizeEvent*) { d->measure(); }

void ParameterPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  QMetaObject::invokeMethod(
      this, [this] { d->settle(); }, Qt::QueuedConnection);
}

bool ParameterPanel::eventFilter(QObject* watched, QEvent* event) {
  // The scroll bar came or went.
  if (event->type() == QEvent::Resize && watched == d->scroll->viewport()) d->measure();
  return QWidget::eventFilter(watched, event);
}

}  // namespace ps
