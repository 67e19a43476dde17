// SPDX-License-Identifier: Apache-2.0
// What comes into a document's scene and leaves it: bodies with their matter, materials.
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/leaving.h"
#include "ui/document/presets.h"

#include <algorithm>
#include <set>

namespace ps {
namespace {

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

bool isOf(const Body& body, const std::string& material) {
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  return body.material == material ||
         (voxels && std::any_of(voxels->palette.begin(), voxels->palette.end(),
                                [&](const VoxelShape::Paint& paint) { return paint.material == material; }));
}

/// The same triangles are one mesh, and others have an id of their own.
void shareMesh(const Project& project, SolidShape& solid) {
  const std::string stem = solid.meshId;
  for (int n = 1;; ++n) {
    const std::string id = n == 1 ? stem : stem + "-" + std::to_string(n);
    const auto other = std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& body) {
      const auto* one = std::get_if<SolidShape>(&body.shape);
      return one && one->mesh && one->mesh->id == id;
    });
    if (other == project.bodies.end()) {
      auto mesh = std::make_shared<SceneMesh>(*solid.mesh);
      mesh->id = solid.meshId = id;
      solid.mesh = std::move(mesh);
      return;
    }
    const auto& present = std::get<SolidShape>(other->shape).mesh;
    if (present->points != solid.mesh->points || present->triangles != solid.mesh->triangles) continue;
    solid.mesh = present;
    solid.meshId = id;
    return;
  }
}

}  // namespace

std::string Document::addBody(Body body) {
  body.id = freeBodyId(body.id);
  if (auto* solid = std::get_if<SolidShape>(&body.shape); solid && solid->mesh) shareMesh(m_project, *solid);
  const std::string id = body.id;
  const QString title = QStringLiteral("adding %1").arg(nameOf(body));
  const size_t place = m_project.bodies.size();
  m_undo.push(new BodiesCommand(*this, {BodyEdit{id, std::nullopt, std::move(body), place}}, title, newMatter()));
  return id;
}

QString Document::removeBody(const std::string& id) {
  const Body* old = body(id);
  if (!old) return {};
  if (old->locked) return QStringLiteral("“%1” is locked. Unlock it first.").arg(nameOf(*old));
  const QString title = QStringLiteral("deletion of %1").arg(nameOf(*old));
  takeOut(*this, {Owner::Body, id, ""}, title, [&] {
    const BodyEdit edit{id, *old, std::nullopt, static_cast<size_t>(old - m_project.bodies.data())};
    m_undo.push(new BodiesCommand(*this, {edit}, title, newMatter()));
  });
  return {};
}

void Document::setStructure(const std::string& id, const std::string& plugin) {
  const Body* old = body(id);
  const std::string present = old ? structureOf(*old, m_plugins) : std::string();
  if (!old || present == plugin) return;
  // Of what is not installed nobody knows whether it holds a body: what the row did not show stays.
  const auto gives = [&](const BodyConstraint& c) {
    const bool installed = m_plugins && m_plugins->constraint(c.plugin);
    return c.plugin == present || c.plugin == plugin ||
           ((installed || plugin == kNoStructure) && holdsTogether(c.plugin, m_plugins));
  };
  editBody(id, QStringLiteral("structure of %1").arg(nameOf(*old)), [&](Body& b) {
    const auto first = std::find_if(b.constraints.begin(), b.constraints.end(), gives);
    const auto place = first - b.constraints.begin();
    b.constraints.erase(std::remove_if(first, b.constraints.end(), gives), b.constraints.end());
    if (plugin != kNoStructure) b.constraints.insert(b.constraints.begin() + place, BodyConstraint{plugin, {}, {}});
  });
}

void Document::setNeighbourConstraint(const std::string& id, const std::string& plugin, bool used) {
  const Body* old = body(id);
  if (!old || uses(*old, plugin) == used) return;
  const QString title =
      QStringLiteral("%1 of %2").arg(text(declaration({Owner::Body, id, kNeighbourKey + plugin})->label), nameOf(*old));
  editBody(id, title, [&](Body& b) {
    std::erase_if(b.constraints, [&](const BodyConstraint& c) { return c.plugin == plugin; });
    if (used) b.constraints.push_back(BodyConstraint{plugin, {}, {}});
  });
}

void Document::setBodyMaterial(const std::string& id, const std::string& material) {
  const Body* old = body(id);
  if (!old || old->material == material) return;
  editBody(id, QStringLiteral("material of %1").arg(nameOf(*old)), [&](Body& b) {
    if (auto* voxels = std::get_if<VoxelShape>(&b.shape)) {
      for (VoxelShape::Paint& paint : voxels->palette) {
        if (paint.material == b.material) paint.material = material;
      }
    }
    b.material = material;
  });
}

void Document::setAdhesion(const std::string& id, const std::string& other, bool holds) {
  std::vector<SceneMaterial> after = m_project.materials;
  const auto material = std::find_if(after.begin(), after.end(), [&](const SceneMaterial& m) { return m.id == id; });
  if (material == after.end()) return;
  const Material* installed = m_plugins ? m_plugins->material(material->base) : nullptr;
  const std::vector<std::string> names = installed ? installed->adheresTo : std::vector<std::string>{};
  const std::vector<std::string> byNames = namedByInstalled(m_project, names);
  std::vector<std::string> partners = material->adheresTo ? namedInScene(m_project, *material->adheresTo) : byNames;
  if ((std::find(partners.begin(), partners.end(), other) != partners.end()) == holds) return;
  if (holds) {
    partners.push_back(other);
  } else {
    std::erase(partners, other);
  }
  // What is not in the scene stays named.
  const auto absent = [&](const std::vector<std::string>& from) {
    std::set<std::string> left;
    for (const std::string& name : from) {
      if (namedByInstalled(m_project, {name}).empty()) left.insert(name);
    }
    return left;
  };
  const std::set<std::string> others = absent(material->adheresTo.value_or(names));
  const std::set<std::string> wanted(partners.begin(), partners.end());
  if (others == absent(names) && wanted == std::set<std::string>(byNames.begin(), byNames.end())) {
    material->adheresTo.reset();
  } else {
    material->adheresTo.emplace(others.begin(), others.end());
    material->adheresTo->insert(material->adheresTo->end(), partners.begin(), partners.end());
  }
  const QString title = QStringLiteral("what %1 holds on to").arg(text(shownName(*material)));
  m_undo.push(new MaterialsCommand(*this, m_project.materials, std::move(after), title));
}

std::string Document::addMaterial(const std::string& base) {
  std::vector<SceneMaterial>& materials = m_project.materials;
  if (const SceneMaterial* present = installedIn(m_project, base)) return present->id;
  const auto taken = [&](const std::string& id) {
    return std::any_of(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == id; });
  };
  SceneMaterial material;
  material.base = material.id = base;
  for (int n = 2; taken(material.id); ++n) material.id = base + "-" + std::to_string(n);
  const Material* installed = m_plugins ? m_plugins->material(base) : nullptr;
  material.label = installed && !installed->label.empty() ? installed->label : base;
  const std::string id = material.id;
  const QString title = QStringLiteral("adding %1").arg(text(material.label));
  std::vector<SceneMaterial> after = materials;
  after.push_back(std::move(material));
  m_undo.push(new MaterialsCommand(*this, materials, std::move(after), title));
  return id;
}

void Document::useOtherMaterial(const std::string& id, const std::string& base) {
  std::vector<SceneMaterial> after = m_project.materials;
  const auto material = std::find_if(after.begin(), after.end(), [&](const SceneMaterial& m) { return m.id == id; });
  const Material* installed = m_plugins ? m_plugins->material(base) : nullptr;
  if (material == after.end() || !installed || material->base == base) return;
  const QString title = QStringLiteral("another material for %1").arg(text(shownName(*material)));
  SceneMaterial other;
  other.id = id;
  other.base = base;
  other.label = installed->label.empty() ? base : installed->label;
  *material = std::move(other);
  m_undo.push(new MaterialsCommand(*this, m_project.materials, std::move(after), title));
}

QString Document::whyMaterialStays(const std::string& id) const {
  for (const Body& body : m_project.bodies) {
    if (isOf(body, id)) return QStringLiteral("“%1” is of it").arg(nameOf(body));
  }
  for (const Emitter& emitter : m_project.emitters) {
    if (emitter.material == id) return QStringLiteral("“%1” pours it").arg(nameOf(emitter));
  }
  return {};
}

QString Document::removeMaterial(const std::string& id) {
  const QString problem = whyMaterialStays(id);
  const auto found = std::find_if(m_project.materials.begin(), m_project.materials.end(),
                                  [&](const SceneMaterial& m) { return m.id == id; });
  if (!problem.isEmpty() || found == m_project.materials.end()) return problem;
  const QString title = QStringLiteral("removing %1").arg(text(shownName(*found)));
  std::vector<SceneMaterial> after = m_project.materials;
  std::erase_if(after, [&](const SceneMaterial& m) { return m.id == id; });
  takeOut(*this, {Owner::Material, id, ""}, title,
          [&] { m_undo.push(new MaterialsCommand(*this, m_project.materials, std::move(after), title)); });
  return {};
}

}  // namespace ps
