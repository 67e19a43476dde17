// SPDX-License-Identifier: Apache-2.0
#include "core/base/statestream.h"
#include "core/io/fieldkinds.h"
#include "core/io/projectfields.h"

namespace ps::fields {
namespace {

constexpr int64_t kMostWhole = int64_t{1} << 53;  ///< that JSON's numbers hold without rounding
constexpr int64_t kMostText = int64_t{3} << 29;   ///< letters, of kMostPackedBytes that do not pack at all

std::vector<std::string> typeNames() {
  std::vector<std::string> names;
  for (const StateType type : {StateType::UInt8, StateType::UInt32, StateType::UInt64, StateType::Float32,
                               StateType::Float64, StateType::Float4, StateType::Text})
    names.emplace_back(stateTypeName(type));
  return names;
}

/// A list and no object of names: the order of plugins' fields is of the state.
const FieldTable<PackedBlock>& blockFields() {
  static const FieldTable<PackedBlock> table{
      .help = "what one part of the solver carries from frame to frame",
      .rows = {field("name", &PackedBlock::name, Text{4096}, "room/item").required(),
               field("type", &PackedBlock::type, Choice{typeNames()}, "of an element; float4 is four of float32")
                   .required(),
               field("version", &PackedBlock::version, Integer{1, 65535}, "of what the block means"),
               field("count", &PackedBlock::count, Integer{0, kMostWhole}, "elements; strings of a text").required(),
               field("data", &PackedBlock::data, Text{kMostText},
                     "base64 of zstd of the elements' bytes, little-endian, in planes: the first bytes of all words, "
                     "then the second ones ...; a string has its length before it as uint32; empty without elements")
                   .required()},
      .unknown = &PackedBlock::unknown};
  return table;
}

const FieldTable<ProjectState::Shape>& shapeFields() {
  static const FieldTable<ProjectState::Shape> table{
      .help = "",
      .rows = {field("id", &ProjectState::Shape::id, Id{}, "").required(),
               field("stamp", &ProjectState::Shape::stamp, Text{16}, "hash of the body's shape").required()},
      .unknown = &ProjectState::Shape::unknown};
  return table;
}

}  // namespace

const FieldTable<ProjectState>& stateFields() {
  static const FieldTable<ProjectState> table{
      .help = "",
      .rows = {field("frame", &ProjectState::frame, Integer{0, kMostWhole}, "since the start").required(),
               field("time", &ProjectState::time, Number{0, 1e12, "s"}, "since the start").required(),
               field(
                   "bodies", &ProjectState::bodies, List{Object{shapeFields()}},
                   "those that it is of; where they or their shapes are others by now, the project opens at its start")
                   .required(),
               field("blocks", &ProjectState::blocks, List{Object{blockFields()}},
                     "all that goes on into the next frame")
                   .required()},
      .unknown = &ProjectState::unknown};
  return table;
}

}  // namespace ps::fields
