// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/outliner.h"

#include "core/plugin_host/registry.h"
#include "core/scene/group.h"
#include "core/simulation/compile.h"
#include "core/simulation/graphsource.h"
#include "core/simulation/particlefield.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/pinaddress.h"
#include "ui/panels/bodykind.h"
#include "ui/panels/outlinerdelegate.h"
#include "ui/panels/outlinermodel.h"
#include "ui/rows/filterfield.h"
#include "ui/session/carriedmaterial.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/theme/units.h"

#include <QtGui/QColor>
#include <QtWidgets/QLabel>
#include <QtWidgets/QTreeView>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// "20.5 °C", "1.540 g", "76.40 MJ", "334.0 kJ/kg", "24 594".
QString probeText(double value, const Quantity* quantity) {
  if (!std::isfinite(value) || !quantity) return QStringLiteral("—");
  const std::string& unit = quantity->unit;
  if (unit == "K") return temperatureText(value, 1);
  if (unit == "kg") return formatPrefixed(value * 1e3, QStringLiteral("g"));
  if (unit == "J") return formatPrefixed(value, QStringLiteral("J"));
  // Particles are counted; shares keep their digits when they happen to be whole.
  if (unit == "1") return formatFixed(value, !quantity->mean && value == std::round(value) ? 0 : 3);
  const QString shown = QString::fromStdString(unit);
  if (std::abs(value) < 1000) return formatFixed(value, 3) + QLatin1Char(' ') + shown;
  const UnitPrefix prefix = prefixFor(value, shown);
  return formatNumber(value / prefix.factor) + QLatin1Char(' ') + prefix.symbol + shown;
}

}  // namespace

Outliner::Outliner(Session& session, Selection& selection, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_document(session.document()),
      m_selection(selection),
      m_model(new OutlinerModel(this)),
      m_view(new QTreeView),
      m_filter(new FilterField(this, QStringLiteral("search"))),
      m_bare(new QLabel(QStringLiteral("Add a body or press B to sketch"))),
      m_nothing(new NothingFound(*m_filter)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->setSpacing(4);
  column->addLayout(makeSearch());
  column->addWidget(m_bare);
  column->addWidget(m_nothing, 1);
  column->addWidget(m_view, 1);
  m_view->setModel(m_model);
  m_view->setHeaderHidden(true);
  m_view->setIndentation(12);
  m_view->setUniformRowHeights(true);
  m_view->setExpandsOnDoubleClick(false);
  m_view->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
  m_view->setMouseTracking(true);
  m_view->setDragDropMode(QAbstractItemView::DragDrop);
  m_view->setDropIndicatorShown(true);
  m_view->setSelectionMode(QAbstractItemView::ExtendedSelection);
  m_view->setAccessibleName(QStringLiteral("Outliner"));
  auto* delegate = new OutlinerDelegate(m_view);
  m_view->setItemDelegate(delegate);
  connect(delegate, &OutlinerDelegate::visibleToggled, this,
          [this](int kind, const std::string& id, bool on) { m_document.setVisible(thingsOf(kind, id), on); });
  connect(delegate, &OutlinerDelegate::lockToggled, this,
          [this](int kind, const std::string& id, bool on) { m_document.setLocked(thingsOf(kind, id), on); });
  // The rows are made anew: not below the field that is typed into, which the view closes first.
  connect(
      delegate, &OutlinerDelegate::renamed, this,
      [this](int kind, const std::string& id, const QString& name) { rename(kind, id, name); }, Qt::QueuedConnection);
  m_view->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(m_view, &QTreeView::customContextMenuRequested, this, [this](const QPoint& at) {
    if (selected().first != OutlineKind::Environment && m_view->currentIndex().isValid())
      Q_EMIT menuRequested(m_view->viewport()->mapToGlobal(at));
  });
  connect(m_model, &OutlinerModel::dropped, this, &Outliner::moveRows);
  connect(m_model, &OutlinerModel::materialDropped, this, [this](const QMimeData& carried, const std::string& body) {
    giveMaterial(m_document, takersOf(m_document, m_selection, body), carried);
  });
  connect(m_view, &QTreeView::collapsed, this, [this](const QModelIndex& row) { noteFolded(row, true); });
  connect(m_view, &QTreeView::expanded, this, [this](const QModelIndex& row) { noteFolded(row, false); });
  m_view->viewport()->installEventFilter(this);
  connect(m_view->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    if (!m_building) takeSelection();
  });
  connect(&selection, &Selection::changed, this, &Outliner::showSelection);
  connect(&m_document, &Document::changed, this, &Outliner::onChanged);
  connect(&session, &Session::totalsDue, this, &Outliner::readValues);
  rebuild();  // on the headset's board it is made when there is a scene already
}

/// A board in a headset has larger rows, which it knows from then on.
void Outliner::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  m_view->doItemsLayout();
}

QStandardItem* Outliner::add(QStandardItem* parent, OutlineKind kind, const std::string& id, const QString& name,
                             const QString& icon) {
  auto* item = new QStandardItem(name);
  item->setToolTip(name);  // there may be no room for it
  item->setData(static_cast<int>(kind), outline::kKind);
  item->setData(QString::fromStdString(id), outline::kId);
  item->setData(icon, outline::kIcon);
  const bool fixed = kind == OutlineKind::Scene || kind == OutlineKind::Environment || kind == OutlineKind::Probes ||
                     kind == OutlineKind::Pin;
  item->setEditable(!fixed);
  item->setDragEnabled(!fixed);
  item->setDropEnabled(kind == OutlineKind::Scene || kind == OutlineKind::Group || kind == OutlineKind::Probes ||
                       kind == OutlineKind::Body);
  if (parent) {
    parent->appendRow(item);
  } else {
    m_model->appendRow(item);
  }
  return item;
}

/// Its group's row, or `scene`.
QStandardItem* Outliner::parentOf(QStandardItem* scene, Owner owner, const std::string& id) const {
  const std::string member = memberOf(owner, id);
  for (const SceneGroup& group : m_groups) {
    if (std::find(group.members.begin(), group.members.end(), member) != group.members.end())
      return find(OutlineKind::Group, group.id);
  }
  return scene;
}

void Outliner::addGroups(QStandardItem* scene) {
  m_groups = livingGroups(m_document.project());
  for (const SceneGroup& group : m_groups) {
    QStandardItem* item =
        add(scene, OutlineKind::Group, group.id, QString::fromStdString(group.name), QStringLiteral("folder"));
    item->setData(QString::number(group.members.size()), outline::kDetail);
    const std::vector<Address> things = thingsOf(static_cast<int>(OutlineKind::Group), group.id);
    const auto is = [&](bool ThingMarks::*mark) {
      return [this, mark](const Address& thing) { return (*m_document.marks(thing)).*mark; };
    };
    // Of what is shown in part the eye is open, of what is locked in part the lock is.
    mark(item, std::any_of(things.begin(), things.end(), is(&ThingMarks::visible)),
         std::all_of(things.begin(), things.end(), is(&ThingMarks::locked)));
  }
}

/// Eye and lock.
void Outliner::mark(QStandardItem* item, bool visible, bool locked) {
  item->setData(visible, outline::kVisible);
  item->setData(locked, outline::kLocked);
  QStringList tip{item->text()};
  if (!visible) tip << QStringLiteral("Hidden: the view does not draw it. It acts all the same.");
  if (locked) tip << QStringLiteral("Locked: hands neither move nor delete it.");
  item->setToolTip(tip.join(QLatin1Char('\n')));
}

void Outliner::addBodies(QStandardItem* scene) {
  const Project& project = m_document.project();
  const PluginRegistry* plugins = m_document.plugins();
  for (const Body& body : project.bodies) {
    QStandardItem* item = add(parentOf(scene, Owner::Body, body.id), OutlineKind::Body, body.id, nameOf(body), {});
    item->setData(colourOf(project, plugins, body.material), outline::kSwatch);
    item->setData(QString::fromStdString(body.material), outline::kMaterial);
    showKind(item, body);
    addPins(item, body);
  }
}

/// By its icon, and in words in the tip.
void Outliner::showKind(QStandardItem* row, const Body& body) const {
  const PluginRegistry* plugins = m_document.plugins();
  const bool placeholder = plugins && isPlaceholder(m_document.project(), body, *plugins);
  const BodyKind kind = placeholder
                            ? BodyKind{QStringLiteral("plugin"), QStringLiteral("Stands still: a plugin is missing")}
                            : kindOf(body, m_document.project(), plugins);
  row->setData(kind.icon, outline::kIcon);
  row->setData(placeholder, outline::kPlaceholder);
  mark(row, body.visible, body.locked);
  QStringList tip = row->toolTip().split(QLatin1Char('\n'));
  if (!kind.name.isEmpty()) tip.insert(1, kind.name);
  if (std::holds_alternative<VoxelShape>(body.shape)) tip.insert(1, QStringLiteral("Sketched"));
  row->setToolTip(tip.join(QLatin1Char('\n')));
  row->setAccessibleDescription(kind.name);
}

void Outliner::addPins(QStandardItem* row, const Body& body) {
  for (size_t k = 0; k < body.pins.size(); ++k) {
    const std::string address = PinAddress{body.id, k}.text();
    add(row, OutlineKind::Pin, address, QStringLiteral("Pin %1").arg(k + 1), QStringLiteral("pin"));
  }
}

void Outliner::addPorts(QStandardItem* scene) {
  const Project& project = m_document.project();
  for (const Emitter& emitter : project.emitters) {
    QStandardItem* item = add(parentOf(scene, Owner::Emitter, emitter.id), OutlineKind::Emitter, emitter.id,
                              nameOf(emitter), QStringLiteral("tap"));
    item->setData(colourOf(project, m_document.plugins(), emitter.material), outline::kSwatch);
    item->setData(QString::fromStdString(emitter.material), outline::kMaterial);
    mark(item, emitter.visible, emitter.locked);
  }
  for (const Sink& sink : project.sinks) {
    mark(add(parentOf(scene, Owner::Sink, sink.id), OutlineKind::Sink, sink.id, nameOf(sink), QStringLiteral("drain")),
         sink.visible, sink.locked);
  }
}

void Outliner::addProbes(QStandardItem* scene) {
  const Project& project = m_document.project();
  QStandardItem* others = nullptr;
  for (const Probe& probe : project.probes) {
    QStandardItem* row = parentOf(nullptr, Owner::Probe, probe.id);
    if (!row && !others)
      others = add(scene, OutlineKind::Probes, "", QStringLiteral("Probes"), QStringLiteral("folder"));
    mark(add(row ? row : others, OutlineKind::Probe, probe.id, nameOf(probe), QStringLiteral("probe")), probe.visible,
         probe.locked);
  }
}

void Outliner::rebuild() {
  m_building = true;
  m_model->clear();
  const Project& project = m_document.project();
  QStandardItem* scene = add(nullptr, OutlineKind::Scene, "", m_document.title(), QStringLiteral("folder"));
  addGroups(scene);
  addBodies(scene);
  addPorts(scene);
  for (const SceneWall& wall : project.environment.walls) {
    mark(add(parentOf(scene, Owner::Wall, wall.id), OutlineKind::Wall, wall.id, nameOf(wall),
             hasTemperature(wall) ? QStringLiteral("plate") : QStringLiteral("wall")),
         wall.visible, wall.locked);
  }
  add(scene, OutlineKind::Environment, "", QStringLiteral("Air and gravity"), QStringLiteral("air"));
  addProbes(scene);
  filter();
  refreshSurroundings();
  refreshCounts();
  m_building = false;
  showSelection();
  m_building = true;
  foldAgain();  // what is selected may lie in there
  m_building = false;
}

void Outliner::noteFolded(const QModelIndex& row, bool folded) {
  if (m_building) return;
  const std::pair<int, std::string> key{row.data(outline::kKind).toInt(),
                                        row.data(outline::kId).toString().toStdString()};
  folded ? static_cast<void>(m_folded.insert(key)) : static_cast<void>(m_folded.erase(key));
}

/// Rows are made anew at each edit; what somebody has folded stays so.
void Outliner::foldAgain(const QModelIndex& under) {
  for (int k = 0; k < m_model->rowCount(under); ++k) {
    const QModelIndex row = m_model->index(k, 0, under);
    foldAgain(row);
    if (m_folded.contains({row.data(outline::kKind).toInt(), row.data(outline::kId).toString().toStdString()}))
      m_view->collapse(row);
  }
}

void Outliner::onChanged(const ChangeEvent& event) {
  if (std::holds_alternative<ProjectOpened>(event)) m_folded.clear();
  const auto* parameter = std::get_if<ParameterChanged>(&event);
  const auto* port = std::get_if<PortChanged>(&event);
  const auto* body = std::get_if<BodyChanged>(&event);
  const auto* walls = std::get_if<WallsChanged>(&event);
  const auto* materials = std::get_if<MaterialsChanged>(&event);
  const bool shows =
      std::holds_alternative<ProjectOpened>(event) || (body && !body->move) ||
      std::holds_alternative<StrokeChanged>(event) || (walls && !walls->moved) || (materials && materials->other) ||
      (port && !port->moved) || std::holds_alternative<ProbesChanged>(event) ||
      std::holds_alternative<TracksChanged>(event) || std::holds_alternative<OrderChanged>(event) ||
      (parameter && (parameter->address.owner == Owner::Wall || parameter->address.owner == Owner::Environment));
  if (shows) return rebuild();
  // What a row of values says of a body, too.
  const Body* changed =
      parameter && parameter->address.owner == Owner::Body ? m_document.body(parameter->address.id) : nullptr;
  QStandardItem* row = changed ? find(OutlineKind::Body, changed->id) : nullptr;
  if (row) showKind(row, *changed);
}

void Outliner::readValues() {
  m_snapshot = m_session.snapshot();
  countMatter();
  if (!m_document.project().tracks.empty()) refreshSurroundings();
  refreshCounts();
}

/// Temperatures of walls and air, as their tracks have them now.
void Outliner::refreshSurroundings() {
  const Environment now = m_session.surroundings();
  const auto show = [](QStandardItem* item, const ParameterSet& set, api::ParameterList list, const char* key) {
    const double shown = toDisplay(*findDeclaration(list, key), numberOf(set, list, key));
    if (item) item->setData(formatQuantity(shown, temperatureSymbol(), 3), outline::kDetail);
  };
  for (const SceneWall& wall : now.walls) {
    if (hasTemperature(wall)) show(find(OutlineKind::Wall, wall.id), wall.parameters, wallParameters(), "temperature");
  }
  show(find(OutlineKind::Environment, ""), now.parameters, environmentParameters(), "ambient_temperature");
}

/// Once for each picture of the matter: rows are made anew more often.
void Outliner::countMatter() {
  m_counts.clear();
  if (!m_snapshot || !m_snapshot->bodyIds) return;
  std::vector<size_t> byIndex(m_snapshot->bodyIds->size(), 0);
  for (const uint32_t body : m_snapshot->body) {
    if (body < byIndex.size()) ++byIndex[body];
  }
  for (size_t i = 0; i < byIndex.size(); ++i) m_counts[(*m_snapshot->bodyIds)[i]] = byIndex[i];
}

void Outliner::refreshCounts() {
  if (!m_snapshot || m_model->rowCount() == 0) return;
  const Project& project = m_document.project();
  for (const Body& body : project.bodies) {
    if (QStandardItem* item = find(OutlineKind::Body, body.id)) {
      item->setData(formatFixed(static_cast<double>(m_counts[body.id])), outline::kDetail);
    }
  }
  for (const Emitter& emitter : project.emitters) {
    if (QStandardItem* item = find(OutlineKind::Emitter, emitter.id)) {
      item->setData(formatFixed(static_cast<double>(m_counts[emitter.id])), outline::kDetail);
    }
  }
  const bool held = !m_snapshot->id.empty() && !hasMatter(m_snapshot->stats);
  for (const Probe& probe : project.probes) {
    QStandardItem* item = find(OutlineKind::Probe, probe.id);
    if (!item) continue;
    // No amount counts what is held: a 0 would say that there is none.
    const double value = GraphSource(probeSource(probe.id), project, m_session.fields())(m_snapshot->stats);
    item->setData(probeText(held && value == 0 ? std::nan("") : value, m_session.fields().quantity(probe.quantity)),
                  outline::kDetail);
  }
}

QStandardItem* Outliner::find(OutlineKind kind, const std::string& id) const {
  const QString wanted = QString::fromStdString(id);
  std::vector<QStandardItem*> open{m_model->invisibleRootItem()};
  while (!open.empty()) {
    QStandardItem* item = open.back();
    open.pop_back();
    for (int row = 0; row < item->rowCount(); ++row) open.push_back(item->child(row));
    if (item->data(outline::kKind).isValid() && item->data(outline::kKind).toInt() == static_cast<int>(kind) &&
        item->data(outline::kId).toString() == wanted)
      return item;
  }
  return nullptr;
}

std::pair<OutlineKind, std::string> Outliner::selected() const {
  const QModelIndex index = m_view->currentIndex();
  if (!index.isValid()) return {OutlineKind::Scene, ""};
  const SelectedItem item = itemOf(index);
  return {item.kind, item.id};
}

std::vector<Address> Outliner::selectedThings() const {
  std::vector<Address> things;
  for (const SelectedItem& item : m_selection.items()) {
    const auto thing = thingOf(item);
    if (thing && item.kind != OutlineKind::Pin) things.push_back(*thing);
  }
  return things;
}

void Outliner::toggleVisible() {
  const std::vector<Address> things = selectedThings();
  if (!things.empty()) m_document.setVisible(things, !m_document.marks(things.back())->visible);
}

void Outliner::toggleLocked() {
  const std::vector<Address> things = selectedThings();
  if (!things.empty()) m_document.setLocked(things, !m_document.marks(things.back())->locked);
}

void Outliner::renameSelected() {
  if (m_view->currentIndex().flags() & Qt::ItemIsEditable) m_view->edit(m_view->currentIndex());
}

void Outliner::rename(int kind, const std::string& id, const QString& name) {
  switch (static_cast<OutlineKind>(kind)) {
    case OutlineKind::Body:
      return m_document.renameBody(id, name);
    case OutlineKind::Group:
      return m_document.renameGroup(id, name);
    case OutlineKind::Probe:
      return m_document.renameProbe(id, name);
    case OutlineKind::Wall:
      return m_document.renameWall(id, name);
    default:
      return m_document.renamePort({kind == static_cast<int>(OutlineKind::Sink), id}, name);
  }
}

}  // namespace ps
