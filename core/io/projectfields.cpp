// SPDX-License-Identifier: Apache-2.0
#include "core/io/projectfields.h"

#include "core/io/fieldkinds.h"
#include "core/scene/group.h"
#include "core/scene/track.h"

namespace ps::fields {
namespace {

class PluginCollector : public FieldVisitor {
 public:
  void plugin(std::optional<PluginKind>, const std::string& id, const std::string&, const char*) override {
    m_ids.insert(id);
  }
  std::vector<std::string> ids() const { return {m_ids.begin(), m_ids.end()}; }

 private:
  std::set<std::string> m_ids;
};

/// What the file is, and what may read it.
std::vector<Field<Project>> formatRows() {
  Field<Project> format{"format", {{"const", "phasesketch"}}};
  format.read = [](Project&, Json&, const PluginRegistry&) {};
  format.write = [](const Project&) { return Json("phasesketch"); };
  return {std::move(format).required(),
          field("version", &Project::version, Integer{1, 1'000'000},
                "format of this file; a newer one is read when minVersion allows it")
              .required(),
          field("minVersion", &Project::minVersion, Integer{1, kProjectVersion},
                "oldest format that a reader must know; absent: version")
              .absentMeans([](Project& project, const PluginRegistry&) { project.minVersion = project.version; })
              .omittedWhen([](const Project& project) { return project.minVersion == project.version; }),
          field("generator", &Project::generator, Text{}, "program that wrote the file")
              .always()
              .writtenAs([](const Project&) { return Json("phasesketch " PS_VERSION); }),
          field("title", &Project::title, Text{}, "shown to people"),
          field("description", &Project::description, Text{}, "shown to people"),
          field("toTry", &Project::toTry, Text{}, "what to try first in it, a sentence; shown among recent projects"),
          field("pluginsRequired", &Project::pluginsRequired, List{PluginId{}}, "missing ones are an error")};
}

/// Each once, in the order of the bodies that are of them.
std::vector<std::shared_ptr<const SceneMesh>> usedMeshes(const Project& project) {
  std::vector<std::shared_ptr<const SceneMesh>> meshes;
  std::set<std::string> known;
  for (const Body& body : project.bodies) {
    const auto* solid = std::get_if<SolidShape>(&body.shape);
    if (solid && solid->mesh && known.insert(solid->mesh->id).second) meshes.push_back(solid->mesh);
  }
  return meshes;
}

/// The scene. What is missing is told by the first that needs it, so pluginsUsed comes last.
std::vector<Field<Project>> sceneRows() {
  return {
      field("materials", &Project::materials, List{Object{materialFields(), "material"}}, "materials of the scene")
          .required(),
      field("meshes", &Project::meshes, List{Shared{Object{meshFields()}}}, "surfaces that bodies are of")
          .omittedWhen([](const Project& project) { return usedMeshes(project).empty(); })
          .writtenAs(
              [](const Project& project) { return List{Shared{Object{meshFields()}}}.write(usedMeshes(project)); }),
      field("bodies", &Project::bodies, List{Object{bodyFields(), "body"}}, "matter at the start").required(),
      field("emitters", &Project::emitters, List{Object{emitterFields()}}, "matter that comes while the scene runs"),
      field("sinks", &Project::sinks, List{Object{sinkFields()}}, "where matter goes"),
      field("environment", &Project::environment, Object{environmentFields()}, "").always(),
      field("solver", &Project::solver, Object{solverFields()}, "")
          .always()
          .absentMeans([](Project& project, const PluginRegistry& plugins) {
            project.solver.thermalModel = plugins.standard(PluginKind::Thermal);
          }),
      field("probes", &Project::probes, List{Object{probeFields()}}, "what is measured"),
      field("graphs", &Project::graphs, Optional{List{Object{graphFields()}}},
            "what is looked at beside the scene; absent: what suits the probes"),
      field("duration", &Project::duration, Number{0, 1e9, "s"}, "length of the scene").always(),
      field("view", &Project::view, Object{viewFields()}, "").omittedWhen([](const Project& project) {
        const ViewState& view = project.view;
        return !view.camera && !view.section && !view.unknown && view.pinned.empty() &&
               view.colour == ViewState().colour;
      }),
      field("state", &Project::state, Shared{Object{stateFields()}},
            "matter as it stands at a later time: the project opens there, and its start stays what it is"),
      field("end", &Project::end, Optional{Object{endFields()}},
            "what a run came to where the project was shared; whoever opens it can see whether it does so there"),
      field("thumbnail", &Project::thumbnail, Text{1 << 20}, "picture of the scene, PNG as base64"),
      field("tracks", &Project::tracks, List{Object{trackFields()}}, "parameters over time")
          .omittedWhen([](const Project& project) { return ownedTracks(project).empty(); })
          .writtenAs([](const Project& project) { return List{Object{trackFields()}}.write(ownedTracks(project)); }),
      field("markers", &Project::markers, List{Object{markerFields()}}, "moments that have names"),
      field("groups", &Project::groups, List{Object{groupFields()}}, "what people see together")
          .omittedWhen([](const Project& project) { return livingGroups(project).empty(); })
          .writtenAs([](const Project& project) { return List{Object{groupFields()}}.write(livingGroups(project)); }),
      field("pluginsUsed", &Project::pluginsUsed, List{PluginId{std::nullopt, "what it does is left out"}},
            "missing ones are a warning")
          .always()
          .writtenAs([](const Project& project) { return Json(pluginsOf(project)); })};
}

}  // namespace

const FieldTable<Project>& projectFields() {
  static const FieldTable<Project> table = [] {
    FieldTable<Project> all{.help = "Keys that a reader does not know are kept when the project is saved again.",
                            .rows = formatRows(),
                            .unknown = &Project::unknown};
    for (Field<Project>& row : sceneRows()) all.rows.push_back(std::move(row));
    return all;
  }();
  return table;
}

std::vector<std::string> pluginsOf(const Project& project) {
  PluginCollector collector;
  projectFields().visit(project, "", collector);
  return collector.ids();
}

}  // namespace ps::fields
