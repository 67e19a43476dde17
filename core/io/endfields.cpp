// SPDX-License-Identifier: Apache-2.0
#include "core/io/fieldkinds.h"
#include "core/io/projectfields.h"

namespace ps::fields {

const FieldTable<RunEnd>& endFields() {
  constexpr int64_t kMostWhole = int64_t{1} << 53;  // that JSON's numbers hold without rounding
  static const FieldTable<RunEnd> table{
      .help = "",
      .rows = {field("frame", &RunEnd::frame, Integer{0, kMostWhole}, "since the start").required(),
               field("time", &RunEnd::time, Number{0, 1e12, "s"}, "since the start"),
               field("state_hash", &RunEnd::hash, Text{16}, "hash of all that goes on into the next frame").required(),
               field("scene_hash", &RunEnd::scene, Text{16},
                     "hash of the project without what people look at: with another one it has been changed since")
                   .required(),
               field("program", &RunEnd::program, Text{}, "that ran it"),
               field("particles", &RunEnd::particles, Integer{0, kMostWhole}, ""),
               field("temperature", &RunEnd::temperature, Number{0, 1e9, "K"}, "mean by mass"),
               field("thermal_energy", &RunEnd::thermalEnergy, Number{-1e30, 1e30, "J"}, ""),
               field("kinetic_energy", &RunEnd::kineticEnergy, Number{0, 1e30, "J"}, "")},
      .unknown = &RunEnd::unknown};
  return table;
}

}  // namespace ps::fields
