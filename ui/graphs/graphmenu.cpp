// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/graphmenu.h"

#include "core/scene/quantitygroup.h"
#include "core/scene/shownname.h"
#include "core/simulation/graphsource.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/theme/plaintext.h"

#include <QtWidgets/QMenu>

#include <algorithm>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

namespace ps {
namespace {

constexpr std::pair<Graph::Kind, const char*> kKinds[] = {{Graph::Kind::Time, "Curves over time"},
                                                          {Graph::Kind::Phases, "Mass by phase"},
                                                          {Graph::Kind::Energy, "Heat and its balance"},
                                                          {Graph::Kind::Histogram, "Histogram of a field"},
                                                          {Graph::Kind::Profile, "Profile along an axis"}};

QAction* add(QMenu& menu, const QString& text, std::function<void()> act) {
  return menu.addAction(asButtonText(text), &menu, std::move(act));
}

QAction* addCheck(QMenu& menu, const QString& text, bool on, std::function<void()> act) {
  QAction* action = add(menu, text, std::move(act));
  action->setCheckable(true);
  action->setChecked(on);
  return action;
}

size_t placeOf(const std::vector<Graph>& graphs, const std::string& id) {
  return static_cast<size_t>(std::find_if(graphs.begin(), graphs.end(), [&](const Graph& g) { return g.id == id; }) -
                             graphs.begin());
}

/// A body's own parameters, its solid's and its constraints' are one body's.
bool ofSameOwner(const Address& a, const Address& b) {
  const auto kind = [](Owner owner) {
    return owner == Owner::Shape || owner == Owner::Constraint ? Owner::Body : owner;
  };
  return kind(a.owner) == kind(b.owner) && a.id == b.id;
}

using Parameters = std::vector<std::pair<Address, const api::ParameterDeclaration*>>;

/// Those of a list whose values make a curve.
Parameters plottedOf(const Document& document, const Address& list) {
  const api::ParameterList declared = declarationsOf(document.project(), document.plugins(), list);
  Parameters plotted;
  for (size_t k = 0; k < declared.count; ++k) {
    if (canBePlotted(declared[k]))
      plotted.push_back({{list.owner, list.id, declared[k].key, list.plugin}, &declared[k]});
  }
  return plotted;
}

/// What one owner has, under its groups where it is more than a glance takes in.
void addLists(QMenu& menu, Document& document, const std::string& graph, const std::vector<Address>& lists) {
  constexpr size_t kGlance = 12;
  Parameters all;
  for (const Address& list : lists) {
    const Parameters plotted = plottedOf(document, list);
    all.insert(all.end(), plotted.begin(), plotted.end());
  }
  std::map<QString, QMenu*> groups;
  for (const auto& [address, declaration] : all) {
    const QString title = QString::fromUtf8(declaration->group);
    QMenu* place = &menu;
    if (all.size() > kGlance && !title.isEmpty()) {
      QMenu*& found = groups[title];
      if (!found) found = menu.addMenu(asButtonText(title));
      place = found;
    }
    add(*place, QString::fromUtf8(declaration->label),
        [&document, graph, source = parameterSource(address)] { document.plot(graph, source); });
  }
}

}  // namespace

void GraphMenu::fill(QMenu& menu, const Graph* graph) const {
  const bool ofField = graph && (graph->kind == Graph::Kind::Histogram || graph->kind == Graph::Kind::Profile);
  if (!ofField) addPlot(*menu.addMenu(QStringLiteral("Plot")), graph);
  if (!graph) {
    addGraphs(menu, QStringLiteral("Add graph"), nullptr, false);
    return;
  }
  if (!graph->series.empty() && graph->kind == Graph::Kind::Time)
    addRemoval(*menu.addMenu(QStringLiteral("Remove curve")), *graph);
  if (ofField) addFields(menu, *graph);
  const std::string id = graph->id;
  if (graph->kind != Graph::Kind::Phases && graph->kind != Graph::Kind::Energy) {
    addCheck(menu, QStringLiteral("Logarithmic"), graph->logarithmic, [document = &m_document, id] {
      document->editGraph(id, QStringLiteral("scale of a graph"), [](Graph& g) { g.logarithmic = !g.logarithmic; });
    });
  }
  if (graph->kind == Graph::Kind::Time) {
    addCheck(menu, QStringLiteral("Difference from the compared run"), graph->difference, [document = &m_document, id] {
      document->editGraph(id, QStringLiteral("difference in a graph"), [](Graph& g) { g.difference = !g.difference; });
    });
  }
  menu.addSeparator();
  addGraphs(menu, QStringLiteral("Split: beside it"), graph, false);
  addGraphs(menu, QStringLiteral("Split: below it"), graph, true);
  addPlaces(menu, *graph);
}

void GraphMenu::addPlot(QMenu& menu, const Graph* graph) const {
  Document* document = &m_document;
  const std::string id = graph ? graph->id : std::string();
  const Project& project = m_document.project();
  for (const Probe& probe : project.probes) {
    add(menu, nameOf(probe), [document, id, source = probeSource(probe.id)] { document->plot(id, source); });
  }
  if (!project.probes.empty()) menu.addSeparator();
  QMenu* frames = menu.addMenu(QStringLiteral("Of every frame"));
  for (const FrameQuantity& quantity : frameQuantities()) {
    add(*frames, QString::fromUtf8(quantity.label),
        [document, id, source = frameSource(quantity.key)] { document->plot(id, source); });
  }
  addParameters(*menu.addMenu(QStringLiteral("Parameter")), id);
  addTargets(menu, id);
}

/// By whose they are. Made when they are opened: there are many.
void GraphMenu::addParameters(QMenu& menu, const std::string& graph) const {
  QObject::connect(&menu, &QMenu::aboutToShow, &menu, [&menu, document = &m_document, graph] {
    if (!menu.isEmpty()) return;
    std::vector<std::pair<Address, std::vector<Address>>> owners;  // with their lists
    for (const Address& list : parameterLists(document->project())) {
      if (plottedOf(*document, list).empty()) continue;
      if (owners.empty() || !ofSameOwner(owners.back().first, list)) owners.emplace_back(list, std::vector<Address>{});
      owners.back().second.push_back(list);
    }
    for (const auto& [owner, lists] : owners) {
      QMenu* own = menu.addMenu(asButtonText(ownerLabel(document->project(), owner)));
      QObject::connect(own, &QMenu::aboutToShow, own, [own, document, graph, of = lists] {
        if (own->isEmpty()) addLists(*own, *document, graph, of);
      });
    }
  });
}

/// What no probe measures yet gets one. By whose it is: made when it is opened, there are many.
void GraphMenu::addTargets(QMenu& menu, const std::string& graph) const {
  addQuantities(*menu.addMenu(QStringLiteral("All matter")), graph, {}, QStringLiteral("All"));
  const auto each = [&](const QString& title, auto items, std::string Probe::*member, auto name) {
    if ((m_document.project().*items).empty()) return;
    QMenu* list = menu.addMenu(title);
    QObject::connect(list, &QMenu::aboutToShow, list, [list, graph, items, member, name, own = *this] {
      if (!list->isEmpty()) return;
      for (const auto& item : own.m_document.project().*items) {
        Probe of;
        of.*member = item.id;
        const QString called = name(item);
        own.addQuantities(*list->addMenu(asButtonText(called)), graph, of, called);
      }
    });
  };
  const auto named = [](const auto& item) { return nameOf(item); };
  each(QStringLiteral("Body"), &Project::bodies, &Probe::body, named);
  each(QStringLiteral("Tap"), &Project::emitters, &Probe::body, named);
  each(QStringLiteral("Material"), &Project::materials, &Probe::material,
       [](const SceneMaterial& material) { return QString::fromStdString(shownName(material)); });
}

void GraphMenu::addQuantities(QMenu& menu, const std::string& graph, const Probe& of, const QString& name) const {
  // Made when it is opened: there are many.
  QObject::connect(
      &menu, &QMenu::aboutToShow, &menu, [&menu, document = &m_document, fields = &m_fields, graph, of, name] {
        if (!menu.isEmpty()) return;
        for (const std::string_view title : quantityGroups()) {
          QMenu* group = nullptr;
          for (const Quantity& quantity : fields->quantities()) {
            if (quantityGroup(quantity.key) != title) continue;
            if (isForce(quantity.key) && of.body.empty()) continue;
            if (!group) group = menu.addMenu(QString::fromUtf8(title.data(), static_cast<qsizetype>(title.size())));
            const QString label = QString::fromStdString(quantity.label);
            add(*group, label, [document, graph, of, label, name, key = quantity.key] {
              Probe probe = of;
              probe.quantity = key;
              probe.name = (name + QLatin1Char(' ') + label.left(1).toLower() + label.mid(1)).toStdString();
              document->plotProbe(graph, std::move(probe));
            });
          }
        }
      });
}

void GraphMenu::addRemoval(QMenu& menu, const Graph& graph) const {
  for (const std::string& source : graph.series) {
    const GraphSource known(source, m_document.project(), m_fields, m_document.plugins());
    add(menu, QString::fromStdString(known ? known.label() : source),
        [document = &m_document, id = graph.id, source] { document->removeSeries(id, source); });
  }
}

void GraphMenu::addFields(QMenu& menu, const Graph& graph) const {
  const auto edit = [document = &m_document, id = graph.id](const std::function<void(Graph&)>& change) {
    document->editGraph(id, QStringLiteral("what a graph shows"), change);
  };
  QMenu* fields = menu.addMenu(QStringLiteral("Field"));
  for (const FieldPtr& field : m_fields.all()) {
    if (field->classes) continue;
    addCheck(*fields, QString::fromStdString(field->label), field->name == graph.field,
             [edit, name = field->name] { edit([&](Graph& g) { g.field = name; }); });
  }
  QMenu* bodies = menu.addMenu(QStringLiteral("Of"));
  addCheck(*bodies, QStringLiteral("All matter"), graph.body.empty(),
           [edit] { edit([](Graph& g) { g.body.clear(); }); });
  for (const Body& body : m_document.project().bodies) {
    addCheck(*bodies, nameOf(body), body.id == graph.body,
             [edit, id = body.id] { edit([&](Graph& g) { g.body = id; }); });
  }
  if (graph.kind != Graph::Kind::Profile) return;
  QMenu* axes = menu.addMenu(QStringLiteral("Along"));
  for (int axis = 0; axis < 3; ++axis) {
    addCheck(*axes, QString(QLatin1Char(static_cast<char>('x' + axis))), axis == graph.axis,
             [edit, axis] { edit([&](Graph& g) { g.axis = axis; }); });
  }
}

void GraphMenu::addGraphs(QMenu& menu, const QString& title, const Graph* beside, bool below) const {
  QMenu* kinds = menu.addMenu(title);
  const size_t place = beside ? placeOf(m_document.graphs(), beside->id) + 1 : m_document.graphs().size();
  for (const auto& [kind, name] : kKinds) {
    add(*kinds, QString::fromUtf8(name), [document = &m_document, of = kind, place, below] {
      Graph graph;
      graph.kind = of;
      graph.below = below;
      document->addGraph(std::move(graph), place, QStringLiteral("new graph"));
    });
  }
}

void GraphMenu::addPlaces(QMenu& menu, const Graph& graph) const {
  Document* document = &m_document;
  const size_t place = placeOf(m_document.graphs(), graph.id), count = m_document.graphs().size();
  QAction* left = add(menu, QStringLiteral("Move back"), [document, id = graph.id] { document->moveGraph(id, -1); });
  left->setEnabled(place > 0);
  QAction* right = add(menu, QStringLiteral("Move on"), [document, id = graph.id] { document->moveGraph(id, 1); });
  right->setEnabled(place + 1 < count);
  QAction* below = addCheck(menu, QStringLiteral("Below the graph before"), graph.below, [document, id = graph.id] {
    document->editGraph(id, QStringLiteral("place of a graph"), [](Graph& g) { g.below = !g.below; });
  });
  below->setEnabled(place > 0);
  add(menu, QStringLiteral("Remove graph"), [document, id = graph.id] { document->removeGraph(id); });
}

}  // namespace ps
