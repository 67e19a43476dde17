// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/packedstate.h"
#include "core/math/pieces.h"
#include "core/math/vector.h"
#include "core/parameters/parameterset.h"
#include "core/scene/address.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace ps {

/// Keys that this version does not know, kept for the next save. nullptr: none.
using Unknown = std::shared_ptr<const nlohmann::json>;

/// What a material was mixed from, by the rules of core/matter/mixture.h. The parts are whole, with every value that
/// they had: the share can be changed where they are not installed, or have left the scene.
struct Mixture {
  struct Part {
    std::string label;
    ParameterSet properties{};             ///< keys of the property catalogue
    std::vector<std::string> adheresTo{};  ///< see Material::adheresTo
    Unknown unknown{};
  };
  double share = 0.5;  ///< of the second part, by mass: 0 to 1
  Part first{}, second{};
  Unknown unknown{};
};

/// A material of the scene: an installed one by id (`base`), with changed properties, or a mixture.
struct SceneMaterial {
  std::string id;  ///< unique in the scene; bodies refer to it
  std::string label;
  std::string base;         ///< id of the installed material: "water"
  ParameterSet properties;  ///< keys of the property catalogue
  ParameterSet parameters;  ///< the plugin's own
  /// Ids of materials, installed or of the scene, that it holds on to when one of the two freezes, in place of those
  /// that the installed one names.
  std::optional<std::vector<std::string>> adheresTo;
  /// What it was mixed from: `properties` are then what came of it, and it is not the installed one that it is written
  /// beside. nullptr: it was not.
  std::shared_ptr<const Mixture> mixture{};
  Unknown unknown;
  std::vector<std::string> tags{};  ///< words by which people find it, see core/matter/tags.h
};

/// A block of particles on a cubic lattice of the scene's spacing.
struct BoxShape {
  Vector3 center{0, 0, 0};  ///< m
  Vector3 size{0.1, 0.1, 0.1};
  Unknown unknown{};
  bool operator==(const BoxShape&) const = default;
};

/// Copies of a stroke about an axis, at most.
inline constexpr int kMostTurns = 64;

/// Sketched cells: runs along x of a lattice whose cell (0, 0, 0) is centred at `origin`. It keeps the particle spacing
/// at which it was drawn: with another one, the same place is filled with finer or coarser particles.
struct VoxelShape {
  struct Run {
    int x = 0, y = 0, z = 0, length = 1, palette = 0;
    bool operator==(const Run&) const = default;
  };
  struct Paint {
    std::string material;
    double temperature = 293.15;  ///< K
    std::string colour{};         ///< of its own, "#rrggbb" (sRGB); "": that of the material
    Unknown unknown{};
    bool operator==(const Paint&) const = default;
  };
  /// What a stroke is drawn with at the same time: in a mirror, and turned about an upright axis, in equal steps.
  struct Symmetry {
    std::string mirror = "none";  ///< or "x", "y", "z": the axis across it
    int turns = 1;                ///< copies about the axis, with the stroke itself; at least 1
    Vector3 centre{0, 0, 0};      ///< m, that mirror and axis go through
    Unknown unknown{};
    bool operator==(const Symmetry&) const = default;
  };
  /// The shape of a body, as a brush stamped it: kept with the stroke, so that it is drawn again whatever becomes of
  /// the body.
  struct Stamp {
    double spacing = 0.02;      ///< m, edge of a cell
    std::vector<Run> cells;     ///< as runs along x, of no palette, in the order of cells
    Vector3 rotation{0, 0, 0};  ///< degrees about x, then y, then z, of their lattice
    Unknown unknown{};
    bool operator==(const Stamp&) const = default;
  };
  struct Stroke {
    std::string brush;  ///< plugin id
    bool erase = false;
    double radius = 0.05;  ///< m
    int palette = 0;
    ParameterSet parameters;
    Vector3 up{0, 1, 0};  ///< away from what it was drawn on; any length but zero
    std::optional<Symmetry> symmetry;
    std::optional<Stamp> stamp{};  ///< that was stamped; none of brushes that stamp no shape
    bool hidden = false;           ///< the sketch is as if it had not been drawn
    /// x, y, z in m, pressure, time in s, and the turn of a pen or a hand (api::StrokeSample::turn) in rad
    std::vector<std::array<double, 8>> samples;
    Unknown unknown{};
    bool operator==(const Stroke&) const = default;
  };
  Vector3 origin{0, 0, 0};  ///< m
  double spacing = 0.02;    ///< m, edge of a cell
  std::vector<Paint> palette;
  std::vector<Run> runs;
  std::vector<Stroke> strokes;
  /// What was drawn may stand elsewhere by now, see poseOf(): first turned about the origin of the scene, then shifted.
  /// Cells and strokes are as they were drawn.
  Vector3 rotation{0, 0, 0};  ///< degrees about x, then y, then z
  Vector3 shift{0, 0, 0};     ///< m
  Unknown unknown{};
  bool operator==(const VoxelShape&) const = default;
};

/// The surface of a thing, as triangles: what a file of some other program holds. Shared by the bodies that are of its
/// shape, and never changed.
struct SceneMesh {
  std::string id;                                  ///< unique in the scene
  std::string name;                                ///< shown to people
  std::vector<std::array<float, 3>> points;        ///< m
  std::vector<std::array<uint32_t, 3>> triangles;  ///< of points; anticlockwise as seen from outside
  std::string origin{};                            ///< what it was read from, and what was done to it then
  Unknown unknown{};
};

/// A solid of some kind, of any size and at any pose: see solidParameters(). It fills with particles of the scene's
/// spacing, on a cubic lattice along its own axes.
struct SolidShape {
  ParameterSet parameters;
  std::string meshId;                       ///< SceneMesh::id, of the kind "mesh"
  std::shared_ptr<const SceneMesh> mesh{};  ///< the same; nullptr for other kinds
  Unknown unknown{};
  bool operator==(const SolidShape&) const = default;
};

/// A constraint plugin used by a body.
struct BodyConstraint {
  std::string plugin;  ///< its id
  ParameterSet parameters;
  Unknown unknown;
  bool operator==(const BodyConstraint&) const = default;
};

/// A box in space, its faces included.
struct Region {
  Vector3 minimum{0, 0, 0}, maximum{0, 0, 0};  ///< m
  Unknown unknown{};
  bool contains(const Vector3& p) const {
    for (size_t a = 0; a < 3; ++a) {
      if (p[a] < minimum[a] || p[a] > maximum[a]) return false;
    }
    return true;
  }
  bool operator==(const Region&) const = default;
};

/// A sine along an axis of the scene: what a body adds to its velocity at the start, or what a probe looks for.
struct Wave {
  int axis = 0;               ///< 0 x, 1 y, 2 z
  double wavelength = 1;      ///< m
  double phase = 0;           ///< radians at the origin of the scene
  Vector3 velocity{0, 0, 0};  ///< m/s, amplitude; of bodies
  Unknown unknown{};
  bool operator==(const Wave&) const = default;
};

struct Body {
  std::string id, name;
  std::string material;  ///< SceneMaterial::id; sketched bodies: of their first palette entry
  std::variant<BoxShape, VoxelShape, SolidShape> shape;
  ParameterSet parameters;           ///< see bodyParameters(): temperature, phase, fixed, heating_power, motion_*, ...
  Vector3 velocity{0, 0, 0};         ///< m/s at the start; of a fixed body from motion_start to motion_stop
  Vector3 spin{0, 0, 0};             ///< rad/s about the body's centre, on top of `velocity`, likewise
  std::optional<Wave> velocityWave;  ///< on top of both; not of fixed bodies
  Vector3 temperatureGradient{0, 0, 0};  ///< K/m about the body's centre, where `temperature` holds
  std::vector<Region> pins;  ///< what stands in one of them at the start is held in place; a fixed body needs none
  std::vector<BodyConstraint> constraints;
  bool visible = true, locked = false;
  Unknown unknown;
  bool operator==(const Body&) const = default;
};

/// A round nozzle that adds matter while the scene runs.
struct Emitter {
  std::string id, name;         ///< the id is unique among bodies as well: its particles belong to it
  std::string material;         ///< SceneMaterial::id
  Vector3 point{0, 0.5, 0};     ///< m, centre of the mouth
  Vector3 direction{0, -1, 0};  ///< of the jet; any length but zero
  ParameterSet parameters;      ///< see emitterParameters(): speed, diameter, temperature, start, stop, most
  bool visible = true, locked = false;
  Unknown unknown;
};

/// A box that takes away what enters it.
struct Sink {
  std::string id, name;
  Vector3 minimum{-0.1, -0.1, -0.1}, maximum{0.1, 0.1, 0.1};  ///< m
  ParameterSet parameters;                                    ///< see sinkParameters(): open
  bool visible = true, locked = false;
  Unknown unknown;
};

/// What nothing passes, with a name: floor, lid, sides of a tray, a pipe, a bowl, a pillar. Its face: scenewall.h.
struct SceneWall {
  std::string id, name;
  Vector3 point{0, 0, 0};   ///< m, on the wall; on the axis of a cylinder, the centre of a sphere
  Vector3 normal{0, 1, 0};  ///< into the scene, along a cylinder; any length but zero; idle for a sphere
  ParameterSet parameters;  ///< see wallParameters(): shape, radius, heat, temperature, friction, ...
  bool visible = true, locked = false;
  Unknown unknown;
};
/// Whether its parameter `temperature` acts: its surface or the fluid behind it has one.
bool hasTemperature(const SceneWall& wall);

struct Environment {
  ParameterSet parameters;  ///< see environmentParameters()
  Vector3 gravity{0, -9.81, 0};
  Vector3 boundsMinimum{-1, 0, -1}, boundsMaximum{1, 2, 1};  ///< m
  std::array<bool, 3>
      periodic{};  ///< axes along which the bounds repeat: what leaves by one face comes in by the other
  std::vector<SceneWall> walls;
  Unknown unknown;
};

/// A plugin that warms or cools matter, whatever the thermal model.
struct UsedHeatSource {
  std::string plugin;
  ParameterSet parameters;
  Unknown unknown;
};

struct SolverOptions {
  ParameterSet parameters;   ///< see solverParameters()
  std::string thermalModel;  ///< plugin id; "" for none. A file that names none means PluginRegistry::standard()
  ParameterSet thermalParameters;
  std::vector<UsedHeatSource> heatSources;
  Unknown unknown;
};

/// Something to measure each frame.
struct Probe {
  static constexpr const char *kAtStart = "start", *kNow = "now";
  std::string id, name;
  std::string quantity;               ///< "temperature", "mass", "speed_max", ... see ParticleFields
  std::string body;                   ///< Body::id; "" for all particles
  std::string wall;                   ///< SceneWall::id, of a force on a wall
  std::string material;               ///< SceneMaterial::id; "" for all
  std::string phase;                  ///< "solid", "melting", "liquid", "boiling", "gas"; "" for all
  bool fixed = false;                 ///< sees what is held in place as well, as one of a fixed body always does
  std::optional<Region> region;       ///< only what stands in it
  std::string regionWhen = kAtStart;  ///< "start": what stood in it then, wherever it is; "now": what is in it
  std::optional<Wave> wave;           ///< measures the amplitude of this wave in the quantity, not the quantity itself
  bool visible = true, locked = false;
  Unknown unknown{};
  bool operator==(const Probe&) const = default;
};

/// What people look at beside the scene: curves over time, or how a field is spread now.
struct Graph {
  enum class Kind : uint8_t { Time, Phases, Energy, Histogram, Profile };
  std::string id, title;  ///< title "": made of what it shows
  Kind kind = Kind::Time;
  std::vector<std::string> series;          ///< over time: sources as GraphSource knows them
  bool logarithmic = false;                 ///< the axis of its values
  bool below = false;                       ///< it stands below the graph before it, not beside it
  std::string field = "temperature", body;  ///< of a histogram or profile: a field of ParticleFields; "" for all matter
  int axis = 1;                             ///< of a profile: 0 x, 1 y, 2 z
  bool difference = false;                  ///< of curves over time: from the run that this one is compared with
  Unknown unknown{};
  bool operator==(const Graph&) const = default;
};
/// Kinds as files name them, in their order: "time", "phases", "energy", "histogram", "profile".
const std::vector<std::string>& graphKindNames();

struct TrackKey {
  double time = 0;   ///< s, of the scene's time
  double value = 0;  ///< as the parameter's declaration stores it; 0 or 1 of a toggle
  ToNext toNext = ToNext::Linear;
  std::optional<double> slopeBefore{}, slopeAfter{};  ///< units of the value per s, of smooth pieces on either side
  Unknown unknown{};
  bool operator==(const TrackKey&) const = default;
};
inline double xOf(const TrackKey& key) { return key.time; }
inline double yOf(const TrackKey& key) { return key.value; }

/// A parameter's values over time. Its address is its identity: a project has one track of each at most.
struct Track {
  std::string parameter;       ///< Address::text()
  std::vector<TrackKey> keys;  ///< one at least; times ascend
  Unknown unknown{};
  bool operator==(const Track&) const = default;
};

/// A moment of the scene that has a name.
struct Marker {
  double time = 0;  ///< s
  std::string name;
  Unknown unknown{};
  bool operator==(const Marker&) const = default;
};

/// Things of the scene that belong together for people; it moves and changes nothing by itself.
struct SceneGroup {
  std::string id;                    ///< unique among groups
  std::string name;                  ///< shown to people
  std::vector<std::string> members;  ///< "body/ID", "emitter/ID", "sink/ID", "wall/ID"; in one group at most
  Unknown unknown{};
  bool operator==(const SceneGroup&) const = default;
};

/// Orbits its target; y is up.
struct ViewCamera {
  Vector3 target{0, 0.2, 0};                            ///< m
  double distance = 1.5, azimuth = 35, elevation = 20;  ///< m, degrees
  bool operator==(const ViewCamera&) const = default;
};

/// A plane through the scene; what lies before it is not shown, so that one sees what is inside. It changes nothing.
struct ViewSection {
  std::string across = "view";  ///< "x", "y" or "z": the axis that it cuts across; "view": it faces whoever looks
  Vector3 through{0, 0, 0};     ///< m, a point of the plane
  bool flipped = false;         ///< shows what lies up the axis, or on the near side, instead of the other part
  bool operator==(const ViewSection&) const = default;
};

struct ViewState {
  std::optional<ViewCamera> camera;    ///< none: the whole scene is shown
  std::optional<ViewSection> section;  ///< none: nothing is cut away
  std::string colour = "material";     ///< that, or the name of a field of particles: see ParticleFields
  std::vector<std::string> pinned;     ///< addresses of "Try these" rows: "wall/floor/temperature"
  Unknown unknown;
};

/// Matter as it stands at a later time: the project opens there. A value that is shared, never changed.
struct ProjectState {
  struct Shape {
    std::string id;     ///< Body::id
    std::string stamp;  ///< of its shape: 16 hexadecimal digits
    Unknown unknown{};
  };
  uint64_t frame = 0;
  double time = 0;            ///< s
  std::vector<Shape> bodies;  ///< those that it is of: with others, or of other shapes, it does not fit
  std::vector<PackedBlock> blocks;
  Unknown unknown{};
};

/// What a run of the project came to where it was shared: whoever opens it can see whether it comes to that elsewhere.
struct RunEnd {
  uint64_t frame = 0;
  double time = 0;          ///< s
  std::string hash, scene;  ///< of the state, of the project that was run: 16 hexadecimal digits
  std::string program;      ///< that ran it
  // For people, where the hashes differ:
  uint64_t particles = 0;
  double temperature = 0, thermalEnergy = 0, kineticEnergy = 0;  ///< K, mean by mass; J
  Unknown unknown{};
};

/// The document: what a project file holds. Plain values with stable ids.
struct Project {
  int version = 1, minVersion = 1;
  std::string generator, title, description;
  std::string toTry;  ///< a sentence: what to change first
  std::vector<std::string> pluginsUsed, pluginsRequired;
  std::vector<SceneMaterial> materials;
  std::vector<std::shared_ptr<const SceneMesh>> meshes;  ///< of the file; bodies hold those that they are of
  std::vector<Body> bodies;
  std::vector<Emitter> emitters;
  std::vector<Sink> sinks;
  Environment environment;
  SolverOptions solver;
  std::vector<Probe> probes;
  std::optional<std::vector<Graph>> graphs;  ///< nothing: those that suit the probes, see graphsFor()
  std::vector<Track> tracks;
  std::vector<Marker> markers;  ///< in the order in which they came
  std::vector<SceneGroup> groups;
  double duration = 60;  ///< s
  ViewState view;
  std::shared_ptr<const ProjectState> state;  ///< nullptr: it opens at its start
  std::optional<RunEnd> end;                  ///< of a copy for others
  std::string thumbnail;                      ///< PNG as base64, of a copy for others; "": none
  Unknown unknown;
};

// Declared once, here; panels, JSON checks and help come from them.
api::ParameterList environmentParameters();  ///< ambient_pressure, ambient_temperature, air_convection
api::ParameterList solverParameters();       ///< particle_spacing, substeps, iterations, thermal_time_scale, ...
api::ParameterList wallParameters();
api::ParameterList bodyParameters();
api::ParameterList solidParameters();  ///< kind, size_*, position_*, rotation_*, ...
api::ParameterList emitterParameters();
api::ParameterList sinkParameters();
/// Keys of toggles of the scene and of bodies, with a plugin's id behind them: whether the scene uses that heat source,
/// whether the body uses that constraint between neighbours.
inline constexpr const char* kHeatSourceKey = "heat_source.";
inline constexpr const char* kNeighbourKey = "uses.";
/// The plugin's id, or "" where the key is no such toggle.
inline std::string pluginBehind(const std::string& key, std::string_view prefix) {
  return key.starts_with(prefix) ? key.substr(prefix.size()) : std::string();
}
/// What holds a body together is one of its constraints rather than a parameter; panels show it as one.
inline constexpr const char* kStructureKey = "structure";
inline constexpr const char* kNoStructure = "none";
/// Its declaration as a choice; `plugins` are the ids of what can hold a body.
api::ParameterDeclaration structureParameter(const std::vector<std::string>& plugins);

/// Layers of particles `spacing` m apart that fill an edge of a box: whole ones, at least one.
double layersAlong(double edge, double spacing);
/// Particles of a body at the start, of a solid to some hundredths. A double: what sizes ask for may be more than an
/// integer holds.
double particleCount(const Body& body, double spacing);
double particleCount(const Project& project);
/// What a scene may have; more would not fit the memory of a large machine.
constexpr double kMaximumParticles = 20e6;

/// The set that holds an address's value, or nullptr when the owner does not exist.
ParameterSet* findSet(Project& project, const Address& address);
const ParameterSet* findSet(const Project& project, const Address& address);

/// What a project says outside of its parameter sets: "scene/gravity" in m/s² along the scene's own direction,
/// "scene/thermal_model" as a plugin's id or "none", and the components of a body's motion, "body/ID/velocity_x" in m/s
/// to "body/ID/spin_z" in rad/s. Nothing for other addresses.
std::optional<Value> outsideValue(const Project& project, const Address& address);
/// Sets it; where there was no gravity it points down. False, and nothing happens, for other addresses and types.
bool setOutsideValue(Project& project, const Address& address, const Value& value);
/// What a project says at an address: a value outside of the sets, or an explicit one. Nothing where a default holds.
std::optional<Value> storedValue(const Project& project, const Address& address);
/// Declarations of those of the scene; `models` are the ids of installed thermal models, `standard` the one that is
/// meant where nothing names another.
std::vector<api::ParameterDeclaration> sceneParameters(const std::vector<std::string>& models,
                                                       const std::string& standard);
/// What a declaration of any owner may name beside its own list: "environment/KEY", "solver/KEY", "scene/KEY". nullptr,
/// or nothing, for other keys.
const api::ParameterDeclaration* sceneWideDeclaration(std::string_view key);
std::optional<Value> sceneWideValue(const Project& project, std::string_view key);
/// Declarations of a body's velocity and spin, by component.
api::ParameterList bodyMotionParameters();

}  // namespace ps
