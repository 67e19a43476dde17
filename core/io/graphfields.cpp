// SPDX-License-Identifier: Apache-2.0
#include "core/io/fieldkinds.h"
#include "core/io/projectfields.h"
#include "core/simulation/particlefield.h"

#include <algorithm>

namespace ps::fields {
namespace {

/// What a graph shows, by name.
struct GraphKind : Choice {
  GraphKind() : Choice(graphKindNames()) {}
  void read(Json& value, Graph::Kind& out, const PluginRegistry&) const {
    const auto found = std::find(names.begin(), names.end(), value.get_ref<const std::string&>());
    out = static_cast<Graph::Kind>(found - names.begin());
  }
  Json write(Graph::Kind kind) const { return names[static_cast<size_t>(kind)]; }
};

/// A field of particles; those of plugins are looked up by the check of the graph.
struct FieldName : ShownName {
  static constexpr bool kHasDefault = true, kVisited = false;
  FieldName() : ShownName(ParticleFields().names()) {}
};

}  // namespace

const FieldTable<Graph>& graphFields() {
  static const FieldTable<Graph> table{
      .help = "what is looked at beside the scene",
      .rows = {field("id", &Graph::id, Id{}, "").required(),
               field("title", &Graph::title, Text{200}, "empty: made of what it shows"),
               field("kind", &Graph::kind, GraphKind{},
                     "curves over time; the mass in each phase; where the energy is; how many particles have which "
                     "value of a field now; a field's mean and ends along an axis now")
                   .always(),
               field("series", &Graph::series,
                     List{Text{300},
                          "probe/ID, frame/ and what each frame tells, as frame/temperature, or parameter/ and the "
                          "address of a "
                          "number or a switch, as parameter/wall/floor/temperature"},
                     "curves over time"),
               field("logarithmic", &Graph::logarithmic, Toggle{}, "the axis of its values"),
               field("difference", &Graph::difference, Toggle{},
                     "of curves over time: beside them their difference from the run that this one is compared with"),
               field("below", &Graph::below, Toggle{}, "it stands below the graph before it, not beside it"),
               field("field", &Graph::field, FieldName{}, "of a histogram or a profile"),
               field("body", &Graph::body, Text{}, "of a histogram or a profile: id of a body; empty for all matter"),
               field("axis", &Graph::axis, Axis{}, "of a profile").omittedWhen([](const Graph& graph) {
                 return graph.axis == Graph().axis;
               })},
      .unknown = &Graph::unknown};
  return table;
}

}  // namespace ps::fields
