// SPDX-License-Identifier: Apache-2.0
#include "core/io/fieldkinds.h"
#include "core/io/projectfields.h"

namespace ps::fields {
namespace {

const FieldTable<BoxShape>& boxFields() {
  static const FieldTable<BoxShape> table{
      .help = "a block of particles on a cubic lattice",
      .rows = {field("center", &BoxShape::center, Vector{"m"}, "centre").required(),
               field("size", &BoxShape::size, Vector{"m", 1e-6}, "edge lengths").required()},
      .unknown = &BoxShape::unknown};
  return table;
}

const FieldTable<VoxelShape::Paint>& paintFields() {
  using Paint = VoxelShape::Paint;
  static const FieldTable<Paint> table{
      .help = "what cells are made of",
      .rows = {field("material", &Paint::material, MaterialId{}, "").required(),
               field("temperature", &Paint::temperature, Number{1, 10000, "K"}, "").required(),
               field("colour", &Paint::colour, ColourText{}, "of its own, red, green and blue")
                   .omittedWhen([](const Paint& paint) { return paint.colour.empty(); })},
      .unknown = &Paint::unknown};
  return table;
}

const FieldTable<VoxelShape::Symmetry>& symmetryFields() {
  using Symmetry = VoxelShape::Symmetry;
  static const FieldTable<Symmetry> table{
      .help = "copies that were drawn along with a stroke",
      .rows = {field("mirror", &Symmetry::mirror, Choice{{"none", "x", "y", "z"}}, "axis across the mirror"),
               field("turns", &Symmetry::turns, Integer{1, kMostTurns}, "copies about an upright axis, with itself"),
               field("centre", &Symmetry::centre, Vector{"m"}, "that mirror and axis go through")},
      .unknown = &Symmetry::unknown};
  return table;
}

const Integer kCoordinate{-1'000'000, 1'000'000};

const FieldTable<VoxelShape::Stamp>& stampFields() {
  using Stamp = VoxelShape::Stamp;
  using Run = VoxelShape::Run;
  const Tuple<Run> run{
      "x, y, z, length",
      {memberPart<&Run::x, Run>(kCoordinate), memberPart<&Run::y, Run>(kCoordinate),
       memberPart<&Run::z, Run>(kCoordinate), memberPart<&Run::length, Run>({1, 1'000'000}, "cells along x")}};
  static const FieldTable<Stamp> table{
      .help = "the shape of a body, as it was stamped",
      .rows = {field("spacing", &Stamp::spacing, Number{0.0005, 10, "m"}, "edge of a cell").required(),
               field("cells", &Stamp::cells, List{run}, "as runs along x").required(),
               field("rotation", &Stamp::rotation, Vector{"°"}, "of its lattice, about the x, then y, then z axis")},
      .unknown = &Stamp::unknown};
  return table;
}

const FieldTable<VoxelShape::Stroke>& strokeFields() {
  using Stroke = VoxelShape::Stroke;
  using Sample = std::array<double, 8>;
  const Number turn{-10, 10, "rad"};
  const Number place{-kFarthest, kFarthest, "m"};
  const Tuple<Sample> sample{
      "x, y, z, pressure, time, and the turn of a pen or a hand as an axis of that length",
      {elementPart<0, Sample>(place), elementPart<1, Sample>(place), elementPart<2, Sample>(place),
       elementPart<3, Sample>({0, 1}), elementPart<4, Sample>({0, 1e9, "s"}), elementPart<5, Sample>(turn),
       elementPart<6, Sample>(turn), elementPart<7, Sample>(turn)},
      5};
  static const FieldTable<Stroke> table{
      .help = "how cells were drawn",
      .rows = {field("brush", &Stroke::brush,
                     PluginId{PluginKind::Brush, "the stroke's cells are there, but it cannot be drawn again"}, "")
                   .required(),
               field("erase", &Stroke::erase, Toggle{}, "takes matter away"),
               field("hidden", &Stroke::hidden, Toggle{}, "left out of the sketch until it is shown again"),
               field("radius", &Stroke::radius, Number{1e-6, kFarthest, "m"}, "size of the brush").required(),
               field("palette", &Stroke::palette, Integer{0, 65535}, "index into the palette").required(),
               pluginParameters(&Stroke::parameters, "brush", &Stroke::brush, PluginKind::Brush,
                                "the brush's own parameters"),
               field("up", &Stroke::up, Direction{}, "away from what it was drawn on"),
               field("symmetry", &Stroke::symmetry, Optional{Object{symmetryFields()}}, ""),
               field("stamp", &Stroke::stamp, Optional{Object{stampFields()}}, "what was stamped"),
               field("samples", &Stroke::samples, List{sample}, "where the hand went").required()},
      .unknown = &Stroke::unknown};
  return table;
}

}  // namespace

const FieldTable<VoxelShape>& voxelFields() {
  using Run = VoxelShape::Run;
  const Tuple<Run> run{
      "x, y, z, length, palette",
      {memberPart<&Run::x, Run>(kCoordinate), memberPart<&Run::y, Run>(kCoordinate),
       memberPart<&Run::z, Run>(kCoordinate), memberPart<&Run::length, Run>({1, 1'000'000}, "cells along x"),
       memberPart<&Run::palette, Run>({0, 65535}, "index into the palette")}};
  static const FieldTable<VoxelShape> table{
      .help = "sketched cells",
      .rows = {field("origin", &VoxelShape::origin, Vector{"m"}, "centre of cell (0, 0, 0)").required(),
               // Earlier files do not say it; who reads the whole project then takes the scene's.
               field("spacing", &VoxelShape::spacing, Number{0.0005, 10, "m"},
                     "edge of a cell; the scene's particle spacing where it is left out")
                   .always()
                   .absentMeans([](VoxelShape& shape, const PluginRegistry&) { shape.spacing = 0; }),
               field("palette", &VoxelShape::palette, List{Object{paintFields()}}, "materials of the cells").required(),
               field("runs", &VoxelShape::runs, List{run}, "filled cells as runs along x").required(),
               field("strokes", &VoxelShape::strokes, List{Object{strokeFields()}},
                     "how it was drawn, so that it stays editable"),
               field("rotation", &VoxelShape::rotation, Vector{"°"},
                     "what was drawn is turned about the scene's x, then y, then z axis, through its origin"),
               field("shift", &VoxelShape::shift, Vector{"m"}, "and moved after that")},
      .unknown = &VoxelShape::unknown};
  return table;
}

namespace {

const FieldTable<SolidShape>& solidFields() {
  static const FieldTable<SolidShape> table{
      .help = "a solid of any size, at any pose",
      .rows = {field("mesh", &SolidShape::meshId, Id{}, "of the kind mesh: one of the scene's meshes")
                   .omittedWhen([](const SolidShape& solid) { return solid.meshId.empty(); })},
      .parameters = &SolidShape::parameters,
      .declarations = &solidParameters,
      .unknown = &SolidShape::unknown};
  return table;
}

const FieldTable<Wave>& velocityWaveFields() {
  static const FieldTable<Wave> table = [] {
    FieldTable<Wave> wave = waveFields("a sine added to the velocity");
    wave.rows.push_back(field("velocity", &Wave::velocity, Vector{"m/s"}, "amplitude").required());
    return wave;
  }();
  return table;
}

const FieldTable<BodyConstraint>& constraintFields() {
  static const FieldTable<BodyConstraint> table{
      .help = "a constraint plugin that holds the body together",
      .rows = {field("plugin", &BodyConstraint::plugin, PluginId{PluginKind::Constraint, "the body stands still"}, "")
                   .required(),
               pluginParameters(&BodyConstraint::parameters, "plugin", &BodyConstraint::plugin, PluginKind::Constraint,
                                "the constraint's own parameters")},
      .unknown = &BodyConstraint::unknown};
  return table;
}

}  // namespace

FieldTable<Region> regionFields(const char* help) {
  return {.help = help,
          .rows = {field("minimum", &Region::minimum, Vector{"m"}, "").required(),
                   field("maximum", &Region::maximum, Vector{"m"}, "").required()},
          .unknown = &Region::unknown};
}

FieldTable<Wave> waveFields(const char* help) {
  return {.help = help,
          .rows = {field("axis", &Wave::axis, Axis{}, "along which it changes").required(),
                   field("wavelength", &Wave::wavelength, Number{1e-6, kFarthest, "m"}, "").required(),
                   field("phase", &Wave::phase, Number{-kFarthest, kFarthest, "rad"}, "at the origin of the scene")},
          .unknown = &Wave::unknown};
}

const FieldTable<Body>& bodyFields() {
  static const FieldTable<Region> pin = regionFields("a box; its faces belong to it");
  static const FieldTable<Body> table{
      .help = "matter at the start",
      .rows = {field("id", &Body::id, Id{}, "").required(), field("name", &Body::name, Text{}, "name shown to people"),
               field("material", &Body::material, MaterialId{}, "").required(),
               field("shape", &Body::shape,
                     OneOf{Alternative<BoxShape>{"box", "a block", &boxFields()},
                           Alternative<VoxelShape>{"voxels", "a sketch", &voxelFields()},
                           Alternative<SolidShape>{"solid", "a solid", &solidFields()}},
                     "")
                   .required(),
               field("velocity", &Body::velocity, Vector{"m/s"},
                     "velocity at the start; of a fixed body as long as it moves"),
               field("spin", &Body::spin, Vector{"rad/s"}, "turns about its centre, likewise"),
               field("velocity_wave", &Body::velocityWave, Optional{Object{velocityWaveFields()}}, ""),
               field("temperature_gradient", &Body::temperatureGradient, Vector{"K/m"},
                     "about the body's centre, where its temperature holds"),
               field("pins", &Body::pins, List{Object{pin}},
                     "particles that stand in one of these at the start are held in place"),
               field("constraints", &Body::constraints, List{Object{constraintFields()}}, "what holds it together"),
               field("visible", &Body::visible, Toggle{}, "drawn"),
               field("locked", &Body::locked, Toggle{}, "protected from edits")},
      .parameters = &Body::parameters,
      .declarations = &bodyParameters,
      .unknown = &Body::unknown};
  return table;
}

}  // namespace ps::fields
