// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/particlefield.h"

#include <QtCore/QString>

#include <string>

class QMenu;

namespace ps {

class Document;

/// What a graph's menu offers: curves to add and to take away, what it shows, graphs beside it. Each is an edit of the
/// document.
class GraphMenu {
 public:
  GraphMenu(Document& document, const ParticleFields& fields) : m_document(document), m_fields(fields) {}
  void fill(QMenu& menu, const Graph* graph) const;  ///< nullptr: where there is none

 private:
  void addPlot(QMenu& menu, const Graph* graph) const;
  void addParameters(QMenu& menu, const std::string& graph) const;
  void addTargets(QMenu& menu, const std::string& graph) const;
  void addQuantities(QMenu& menu, const std::string& graph, const Probe& of, const QString& name) const;
  void addRemoval(QMenu& menu, const Graph& graph) const;
  void addFields(QMenu& menu, const Graph& graph) const;
  void addGraphs(QMenu& menu, const QString& title, const Graph* beside, bool below) const;
  void addPlaces(QMenu& menu, const Graph& graph) const;
  Document& m_document;
  const ParticleFields& m_fields;
};

}  // namespace ps
