// SPDX-License-Identifier: Apache-2.0
#include "core/io/fieldkinds.h"
#include "core/io/projectfields.h"
#include "core/scene/track.h"

#include <algorithm>

namespace ps::fields {
namespace {

/// A way from a key to the next by name.
struct WayToNext : Choice {
  WayToNext() : Choice(toNextNames()) {}
  void read(Json& value, ToNext& out, const PluginRegistry&) const {
    const auto found = std::find(names.begin(), names.end(), value.get_ref<const std::string&>());
    out = static_cast<ToNext>(found - names.begin());
  }
  Json write(ToNext value) const { return names[static_cast<size_t>(value)]; }
};

const FieldTable<TrackKey>& keyFields() {
  const Number slope{-1e300, 1e300};
  static const FieldTable<TrackKey> table{
      .help = "a value at a time",
      .rows = {field("time", &TrackKey::time, Number{0, 1e9, "s"}, "of the scene").required(),
               field("value", &TrackKey::value, Number{-1e300, 1e300},
                     "in the parameter's stored unit and within its range; of a switch 0 or 1")
                   .required(),
               field("to_next", &TrackKey::toNext, WayToNext{},
                     "what lies between it and the next key: its value, a straight line, or a cubic that is monotone "
                     "where no slope is given")
                   .always(),
               field("slope_before", &TrackKey::slopeBefore, Optional{slope},
                     "of a smooth piece that ends here, in units of the value per second"),
               field("slope_after", &TrackKey::slopeAfter, Optional{slope},
                     "of a smooth piece that begins here, in units of the value per second")},
      .unknown = &TrackKey::unknown};
  return table;
}

}  // namespace

const FieldTable<Track>& trackFields() {
  static const FieldTable<Track> table{
      .help = "a parameter's values over time, from its first key on; before it, its value elsewhere in the file holds",
      .rows = {field("parameter", &Track::parameter, Text{500},
                     "address of what acts while the scene runs: "
                     "wall/floor/temperature; of a curve's point with its number behind it, counted from 0: "
                     "material/wax/viscosity[2]")
                   .required(),
               field("keys", &Track::keys, List{Object{keyFields()}}, "in order of time, one at least").required()},
      .unknown = &Track::unknown};
  return table;
}

const FieldTable<Marker>& markerFields() {
  static const FieldTable<Marker> table{
      .help = "a moment of the scene that has a name",
      .rows = {field("time", &Marker::time, Number{0, 1e9, "s"}, "of the scene").required(),
               field("name", &Marker::name, Text{200}, "shown to people").required()},
      .unknown = &Marker::unknown};
  return table;
}

const FieldTable<SceneGroup>& groupFields() {
  static const FieldTable<SceneGroup> table{
      .help = "things that belong together for people; a thing is in the first group that names it",
      .rows = {field("id", &SceneGroup::id, Id{}, "").required(),
               field("name", &SceneGroup::name, Text{200}, "shown to people"),
               field("members", &SceneGroup::members, List{Text{400}},
                     "\"body/ID\", \"emitter/ID\", \"sink/ID\", \"wall/ID\", \"probe/ID\"; what the scene has not is "
                     "left out")
                   .required()},
      .unknown = &SceneGroup::unknown};
  return table;
}

}  // namespace ps::fields
