// SPDX-License-Identifier: Apache-2.0
// Rows of the outliner under hands: selected with others, searched, dragged to another place or group.
#include "core/scene/group.h"
#include "ui/document/document.h"
#include "ui/panels/outliner.h"
#include "ui/panels/outlinermodel.h"
#include "ui/rows/filterfield.h"
#include "ui/session/carriedmaterial.h"
#include "ui/theme/plaintext.h"

#include <QtGui/QDropEvent>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace ps {
namespace {

std::optional<Owner> ownerOf(OutlineKind kind) {
  switch (kind) {
    case OutlineKind::Body:
      return Owner::Body;
    case OutlineKind::Emitter:
      return Owner::Emitter;
    case OutlineKind::Sink:
      return Owner::Sink;
    case OutlineKind::Wall:
      return Owner::Wall;
    case OutlineKind::Probe:
      return Owner::Probe;
    default:
      return std::nullopt;
  }
}

std::vector<std::string>* listOf(SceneOrder& order, OutlineKind kind) {
  switch (kind) {
    case OutlineKind::Body:
      return &order.bodies;
    case OutlineKind::Emitter:
      return &order.emitters;
    case OutlineKind::Sink:
      return &order.sinks;
    case OutlineKind::Wall:
      return &order.walls;
    case OutlineKind::Probe:
      return &order.probes;
    default:
      return nullptr;
  }
}

/// Before another one, or last where that is none of them.
void moveBefore(std::vector<std::string>& ids, const std::string& id, const std::string& before) {
  std::erase(ids, id);
  ids.insert(std::find(ids.begin(), ids.end(), before), id);
}

}  // namespace

QStringList Outliner::folded() const {
  QStringList rows{m_document.path()};
  for (const auto& [kind, id] : m_folded) rows << QStringLiteral("%1/%2").arg(kind).arg(QString::fromStdString(id));
  return rows;
}

void Outliner::fold(const QStringList& left) {
  if (left.isEmpty() || left.front() != m_document.path()) return;
  for (const QString& row : left.mid(1))
    m_folded.emplace(row.section(QLatin1Char('/'), 0, 0).toInt(), row.section(QLatin1Char('/'), 1).toStdString());
  const bool before = std::exchange(m_building, true);
  foldAgain();
  m_building = before;
}

void Outliner::showSelection() {
  m_building = true;
  QItemSelection rows;
  QModelIndex last;
  for (const SelectedItem& selected : m_selection.items()) {
    const QStandardItem* item = find(selected.kind, selected.id);
    if (!item) continue;
    last = item->index();
    rows.select(last, last);
  }
  for (const SceneGroup& group : m_groups) {
    const QStandardItem* item = find(OutlineKind::Group, group.id);
    if (!item || !holdsAll(group)) continue;
    rows.select(item->index(), item->index());
    if (m_view->currentIndex() == item->index()) last = item->index();
  }
  QItemSelectionModel* model = m_view->selectionModel();
  const bool elsewhere = m_view->currentIndex() != last;
  if (elsewhere) model->setCurrentIndex(last, QItemSelectionModel::NoUpdate);
  model->select(rows, QItemSelectionModel::ClearAndSelect);
  if (elsewhere && last.isValid()) m_view->scrollTo(last);
  m_building = false;
}

/// What has been selected here: those that were keep their order, the current row comes last. A group that is clicked
/// stands for what is in it.
void Outliner::takeSelection() {
  std::vector<SelectedItem> rows;
  for (const QModelIndex& index : m_view->selectionModel()->selectedIndexes()) {
    const SelectedItem item = itemOf(index);
    if (item.kind != OutlineKind::Group) {
      if (std::find(rows.begin(), rows.end(), item) == rows.end()) rows.push_back(item);
    } else if (index == m_view->currentIndex()) {
      for (int row = 0; row < m_model->rowCount(index); ++row) {
        const SelectedItem member = itemOf(m_model->index(row, 0, index));
        if (std::find(rows.begin(), rows.end(), member) == rows.end()) rows.push_back(member);
      }
    }
  }
  const auto rank = [&](const SelectedItem& item) {
    if (item == itemOf(m_view->currentIndex())) return m_selection.items().size() + 1;
    const auto& known = m_selection.items();
    return static_cast<size_t>(std::find(known.begin(), known.end(), item) - known.begin());
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const SelectedItem& a, const SelectedItem& b) { return rank(a) < rank(b); });
  m_selection.selectAll(std::move(rows));
}

bool Outliner::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::DragMove) tellDrop(*static_cast<QDragMoveEvent*>(event));
  if (event->type() == QEvent::DragLeave || event->type() == QEvent::Drop) showTip({}, {}, m_view->viewport());
  return QWidget::eventFilter(watched, event);
}

/// Why the body of a row takes no material, while one is held over it.
void Outliner::tellDrop(const QDragMoveEvent& event) const {
  const QPoint place = event.position().toPoint();
  const SelectedItem item = itemOf(m_view->indexAt(place));
  const bool asks = event.source() != m_view && carriesMaterial(*event.mimeData()) && item.kind == OutlineKind::Body;
  const QString why = asks ? whyNoMaterial(m_document, item.id) : QString();
  if (why.isEmpty())
    showTip({}, {}, m_view->viewport());
  else
    showTip(m_view->viewport()->mapToGlobal(place), why, m_view->viewport());
}

SelectedItem Outliner::itemOf(const QModelIndex& index) const {
  return {static_cast<OutlineKind>(index.data(outline::kKind).toInt()),
          index.data(outline::kId).toString().toStdString()};
}

bool Outliner::holdsAll(const SceneGroup& group) const {
  return std::all_of(group.members.begin(), group.members.end(), [&](const std::string& member) {
    return std::any_of(m_selection.items().begin(), m_selection.items().end(), [&](const SelectedItem& item) {
      const auto owner = ownerOf(item.kind);
      return owner && memberOf(*owner, item.id) == member;
    });
  });
}

/// A click on the eye of one of those that are selected is meant for all of them, on that of a group for its members.
std::vector<Address> Outliner::thingsOf(int kind, const std::string& id) const {
  const SelectedItem item{static_cast<OutlineKind>(kind), id};
  std::vector<Address> things;
  if (item.kind != OutlineKind::Group) {
    if (m_selection.has(item.kind, id)) return selectedThings();
    if (const auto thing = thingOf(item)) things.push_back(*thing);
    return things;
  }
  const auto group =
      std::find_if(m_groups.begin(), m_groups.end(), [&](const SceneGroup& one) { return one.id == id; });
  if (group == m_groups.end()) return things;
  for (const std::string& member : group->members) {
    for (const Owner owner : kMembers) {
      const std::string prefix = memberOf(owner, "");
      if (member.starts_with(prefix)) things.push_back({owner, member.substr(prefix.size()), ""});
    }
  }
  return things;
}

QLayout* Outliner::makeSearch() {
  m_filter->setPlaceholderText(QStringLiteral("Search"));
  m_filter->setAccessibleName(QStringLiteral("Search the outliner"));
  m_filter->setClearButtonEnabled(false);
  for (QLabel* label : {m_bare, static_cast<QLabel*>(m_nothing)}) {
    label->setContentsMargins(10, 4, 10, 4);
    label->setWordWrap(true);
    label->hide();
  }
  connect(m_filter, &QLineEdit::textChanged, this, &Outliner::filter);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(6, 0, 6, 0);
  row->addWidget(m_filter);
  return row;
}

/// Shows what is called so, with what it is in and what is in it.
void Outliner::filter() {
  const QString wanted = m_filter->text().trimmed();
  const std::function<bool(const QModelIndex&, bool)> show = [&](const QModelIndex& parent, bool all) {
    bool any = false;
    for (int row = 0; row < m_model->rowCount(parent); ++row) {
      const QModelIndex index = m_model->index(row, 0, parent);
      const bool root = !parent.isValid();
      const bool named = all || (!root && index.data().toString().contains(wanted, Qt::CaseInsensitive));
      const bool within = show(index, named);
      m_view->setRowHidden(row, parent, !root && !named && !within);
      any = any || named || within;
    }
    return any;
  };
  const bool any = show({}, wanted.isEmpty());
  // What is found is in sight; what somebody has folded is so again after the search.
  const bool before = std::exchange(m_building, true);
  m_view->expandAll();
  if (wanted.isEmpty()) foldAgain();
  m_building = before;
  const Project& project = m_document.project();
  m_bare->setVisible(project.bodies.empty() && project.emitters.empty() && wanted.isEmpty());
  m_nothing->standFor(*m_view, any);
}

/// To another place in its list, into a group or out of it.
void Outliner::moveRows(std::vector<SelectedItem> rows, const QModelIndex& parent, int row) {
  SceneOrder order = m_document.order();
  const SelectedItem target = itemOf(parent);
  // A group goes with all that is in it.
  const std::vector<SelectedItem> all = rows;
  const auto goesWithItsGroup = [&](const SelectedItem& item) {
    const auto owner = ownerOf(item.kind);
    return owner && std::any_of(order.groups.begin(), order.groups.end(), [&](const SceneGroup& group) {
             const auto& members = group.members;
             return std::find(all.begin(), all.end(), SelectedItem{OutlineKind::Group, group.id}) != all.end() &&
                    std::find(members.begin(), members.end(), memberOf(*owner, item.id)) != members.end();
           });
  };
  if (target.kind != OutlineKind::Group) std::erase_if(rows, goesWithItsGroup);
  for (const SelectedItem& item : rows) {
    std::string before;
    for (int k = std::max(0, row); row >= 0 && k < m_model->rowCount(parent) && before.empty(); ++k) {
      const SelectedItem next = itemOf(m_model->index(k, 0, parent));
      const bool moves = std::find(rows.begin(), rows.end(), next) != rows.end();
      if (next.kind == item.kind && !moves) before = next.id;
    }
    if (item.kind == OutlineKind::Group) {
      moveGroup(order, item.id, before);
      continue;
    }
    std::vector<std::string>* list = listOf(order, item.kind);
    if (list && row >= 0) moveBefore(*list, item.id, before);
    const auto owner = ownerOf(item.kind);
    if (!owner) continue;
    const std::string member = memberOf(*owner, item.id);
    for (SceneGroup& group : order.groups) {
      std::erase(group.members, member);
      if (target.kind == OutlineKind::Group && group.id == target.id) group.members.push_back(member);
    }
  }
  std::erase_if(order.groups, [](const SceneGroup& group) { return group.members.empty(); });
  m_document.setOrder(std::move(order),
                      rows.size() > 1 ? QStringLiteral("moving rows") : QStringLiteral("moving a row"));
}

void Outliner::moveGroup(SceneOrder& order, const std::string& id, const std::string& before) {
  const auto place = [&](const std::string& wanted) {
    return std::find_if(order.groups.begin(), order.groups.end(),
                        [&](const SceneGroup& group) { return group.id == wanted; });
  };
  const auto from = place(id);
  if (from == order.groups.end()) return;
  SceneGroup group = std::move(*from);
  order.groups.erase(from);
  order.groups.insert(place(before), std::move(group));
}

}  // namespace ps
