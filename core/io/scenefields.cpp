// SPDX-License-Identifier: Apache-2.0
#include "core/io/fieldkinds.h"
#include "core/io/mixturefields.h"
#include "core/io/projectfields.h"
#include "core/matter/material.h"
#include "core/simulation/particlefield.h"

namespace ps::fields {
namespace {

const FieldTable<SceneWall>& wallFields() {
  static const FieldTable<SceneWall> table{
      .help = "a plane, cylinder or sphere that particles cannot pass",
      .rows = {field("id", &SceneWall::id, Id{}, "").required(),
               field("name", &SceneWall::name, Text{}, "name shown to people"),
               field("point", &SceneWall::point, Vector{"m"},
                     "a point on the wall; of a cylinder on its axis, of a sphere its centre")
                   .required(),
               field("normal", &SceneWall::normal, Direction{},
                     "direction into the scene, of a cylinder along its axis, of a sphere any; any length but zero")
                   .required(),
               field("visible", &SceneWall::visible, Toggle{}, "drawn; it acts all the same"),
               field("locked", &SceneWall::locked, Toggle{}, "protected from edits by hand")},
      .parameters = &SceneWall::parameters,
      .declarations = &wallParameters,
      .unknown = &SceneWall::unknown};
  return table;
}

}  // namespace

const FieldTable<SceneMaterial>& materialFields() {
  static const FieldTable<SceneMaterial> table{
      .help = "an installed material with changed properties",
      .rows = {field("id", &SceneMaterial::id, Id{}, "").required(),
               field("label", &SceneMaterial::label, Text{}, "name shown to people"),
               field("tags", &SceneMaterial::tags, List{Text{}, "a short word: food, building"},
                     "words by which people find it in the library"),
               field("base", &SceneMaterial::base, PluginId{PluginKind::Material, "bodies made of it stand still"}, "")
                   .required(),
               field("properties", &SceneMaterial::properties, Declared{&propertyCatalogue}, ""),
               pluginParameters(&SceneMaterial::parameters, "base", &SceneMaterial::base, PluginKind::Material,
                                "the material plugin's own parameters"),
               field("adheres_to", &SceneMaterial::adheresTo,
                     Optional{List{Text{}, "id of a material, installed or of the scene"}},
                     "materials that it holds on to when one of the two freezes, in place of those that the installed "
                     "one names"),
               field("mixture", &SceneMaterial::mixture, Shared{Object{mixtureFields()}}, "")},
      .unknown = &SceneMaterial::unknown};
  return table;
}

const FieldTable<Emitter>& emitterFields() {
  static const FieldTable<Emitter> table{
      .help = "a nozzle that adds matter while the scene runs",
      .rows = {field("id", &Emitter::id, Id{}, "").required(),
               field("name", &Emitter::name, Text{}, "name shown to people"),
               field("material", &Emitter::material, MaterialId{}, "").required(),
               field("point", &Emitter::point, Vector{"m"}, "centre of the mouth").required(),
               field("direction", &Emitter::direction, Direction{}, "of the jet, any length but zero").required(),
               field("visible", &Emitter::visible, Toggle{}, "drawn; it acts all the same"),
               field("locked", &Emitter::locked, Toggle{}, "protected from edits by hand")},
      .parameters = &Emitter::parameters,
      .declarations = &emitterParameters,
      .unknown = &Emitter::unknown};
  return table;
}

const FieldTable<Sink>& sinkFields() {
  static const FieldTable<Sink> table{
      .help = "a box that takes away what enters it",
      .rows = {field("id", &Sink::id, Id{}, "").required(), field("name", &Sink::name, Text{}, "name shown to people"),
               field("minimum", &Sink::minimum, Vector{"m"}, "corner of the box").required(),
               field("maximum", &Sink::maximum, Vector{"m"}, "the corner opposite").required(),
               field("visible", &Sink::visible, Toggle{}, "drawn; it acts all the same"),
               field("locked", &Sink::locked, Toggle{}, "protected from edits by hand")},
      .parameters = &Sink::parameters,
      .declarations = &sinkParameters,
      .unknown = &Sink::unknown};
  return table;
}

const FieldTable<Environment>& environmentFields() {
  const FieldTable<Environment> bounds{
      .help = "particles that leave this box are lost",
      .rows = {field("minimum", &Environment::boundsMinimum, Vector{"m"}, "").required(),
               field("maximum", &Environment::boundsMaximum, Vector{"m"}, "").required()}};
  static const FieldTable<Environment> table{
      .help = "what surrounds the matter",
      .rows = {field("gravity", &Environment::gravity, Vector{"m/s²"}, "gravity").always(),
               group("bounds", bounds).always(),
               field("periodic", &Environment::periodic, AxisToggles{},
                     "whether the bounds repeat along x, y and z: what leaves by one face comes in by the other; such "
                     "an edge is at least three times as long as particles reach, and no wall leans along it"),
               field("walls", &Environment::walls, List{Object{wallFields()}}, "floor, lid, sides of a tray").always()},
      .parameters = &Environment::parameters,
      .declarations = &environmentParameters,
      .unknown = &Environment::unknown};
  return table;
}

const FieldTable<UsedHeatSource>& heatSourceFields() {
  static const FieldTable<UsedHeatSource> table{
      .help = "a plugin that brings heat",
      .rows = {field("plugin", &UsedHeatSource::plugin, PluginId{PluginKind::HeatSource, "its heat is missing"}, "")
                   .required(),
               pluginParameters(&UsedHeatSource::parameters, "plugin", &UsedHeatSource::plugin, PluginKind::HeatSource,
                                "the heat source's own parameters")},
      .unknown = &UsedHeatSource::unknown};
  return table;
}

const FieldTable<SolverOptions>& solverFields() {
  const FieldTable<SolverOptions> thermal{
      .help = "how heat is kept",
      .rows = {field("model", &SolverOptions::thermalModel, OptionalPluginId{PluginKind::Thermal, "no heat flows"},
                     "id of a thermal plugin; empty for no heat")
                   .required(),
               pluginParameters(&SolverOptions::thermalParameters, "model", &SolverOptions::thermalModel,
                                PluginKind::Thermal, "the thermal model's own parameters"),
               field("sources", &SolverOptions::heatSources, List{Object{heatSourceFields()}},
                     "what warms or cools matter, whatever the model")}};
  static const FieldTable<SolverOptions> table{
      .help = "how it is computed",
      .rows =
          {// Files always meant the standard model where they name none.
           group("thermal", thermal).always().absentMeans([](SolverOptions& solver, const PluginRegistry& plugins) {
             solver.thermalModel = plugins.standard(PluginKind::Thermal);
           })},
      .parameters = &SolverOptions::parameters,
      .declarations = &solverParameters,
      .unknown = &SolverOptions::unknown};
  return table;
}

const FieldTable<Probe>& probeFields() {
  static const FieldTable<Region> region = regionFields("only particles that stand in it; its faces belong to it");
  static const FieldTable<Wave> wave =
      waveFields("measures the amplitude of this sine in the quantity, not the quantity");
  static const FieldTable<Probe> table{
      .help = "something measured each frame",
      .rows = {field("id", &Probe::id, Id{}, "").required(),
               field("name", &Probe::name, Text{200}, "name in graphs and tables")
                   .absentMeans([](Probe& probe, const PluginRegistry&) { probe.name = probe.id; })
                   .omittedWhen([](const Probe& probe) { return probe.name == probe.id; }),
               field("quantity", &Probe::quantity, QuantityName{ParticleFields().quantityNames()}, "what is measured")
                   .required(),
               field("body", &Probe::body, Text{}, "id of a body; empty for all particles"),
               field("wall", &Probe::wall, Text{},
                     "id of a wall, whose force or torque is measured instead of a body's"),
               field("material", &Probe::material, Text{}, "id of one of the scene's materials; empty for all"),
               field("phase", &Probe::phase, Choice{{"", "solid", "melting", "liquid", "boiling", "gas"}},
                     "empty for all"),
               field("fixed", &Probe::fixed, Toggle{},
                     "sees what is held in place as well, as one of a fixed body always does"),
               field("region", &Probe::region, Optional{Object{region}}, ""),
               field("region_when", &Probe::regionWhen, Choice{{Probe::kAtStart, Probe::kNow}},
                     "start: sees what stood in the region then, wherever it is; now: what is in it, frame by frame"),
               field("wave", &Probe::wave, Optional{Object{wave}}, ""),
               field("visible", &Probe::visible, Toggle{}, "its region is drawn"),
               field("locked", &Probe::locked, Toggle{}, "protected from edits by hand")},
      .unknown = &Probe::unknown};
  return table;
}

namespace {

const FieldTable<ViewSection>& sectionFields() {
  static const FieldTable<ViewSection> table{
      .help = "a plane; what lies before it is not shown",
      .rows = {field("across", &ViewSection::across, Choice{{"view", "x", "y", "z"}},
                     "the axis that it cuts across; view: it faces whoever looks"),
               field("through", &ViewSection::through, Vector{"m"}, "a point of the plane").required(),
               field("flipped", &ViewSection::flipped, Toggle{},
                     "shows what lies up the axis, or on the near side, instead of the other part")}};
  return table;
}

}  // namespace

const FieldTable<ViewState>& viewFields() {
  const auto camera = [](Field<ViewCamera> row) { return within(&ViewState::camera, std::move(row)); };
  static const FieldTable<ViewState> table{
      .help = "how it is looked at; without target, distance and angles the whole scene is shown",
      .rows =
          {camera(field("target", &ViewCamera::target, Vector{"m"}, "what the camera looks at")),
           camera(field("distance", &ViewCamera::distance, Number{1e-4, 1e5, "m"}, "of the camera from its target")),
           camera(field("azimuth", &ViewCamera::azimuth, Number{-36000, 36000, "°"}, "")),
           camera(field("elevation", &ViewCamera::elevation, Number{-90, 90, "°"}, "")),
           field("colour", &ViewState::colour, ColourName{colourNames(ParticleFields())}, "what colours mean").always(),
           field("section", &ViewState::section, Optional{Object{sectionFields()}}, "what is cut away of the scene"),
           field("pinned", &ViewState::pinned, List{AddressText{}, "address of a parameter: wall/floor/temperature"},
                 "rows under Try these")},
      .unknown = &ViewState::unknown};
  return table;
}

}  // namespace ps::fields
