// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/base/packedstate.h"
#include "core/base/statestream.h"
#include "core/io/fieldkinds.h"
#include "core/io/projectfields.h"

#include <cstring>

namespace ps::fields {
namespace {

constexpr int64_t kMostElements = 100'000'000;
constexpr int64_t kMostText = int64_t{3} << 29;

/// Triples of numbers of 4 bytes, as a state's blocks have them. What cannot be unpacked is read as none: the check of
/// a mesh says so, with its place.
template <StateType kType>
struct PackedTriples : Plain {
  Json schema() const {
    return {{"type", "object"},
            {"properties",
             {{"count", {{"type", "integer"}, {"minimum", 0}, {"maximum", kMostElements}}},
              {"data",
               {{"type", "string"},
                {"maxLength", kMostText},
                {"description", std::string("base64 of zstd of three ") + stateTypeName(kType) +
                                    " each, little-endian, in planes: all lowest bytes, then all second ones ..."}}}}},
            {"required", {"count", "data"}}};
  }
  template <class V>
  void read(Json& value, std::vector<V>& out, const PluginRegistry&) const {
    const auto count = value.at("count").get<uint64_t>();
    const PackedBlock block{{}, stateTypeName(kType), 1, 3 * count, value.at("data").get<std::string>(), {}};
    value.erase("count");
    value.erase("data");
    try {
      const std::vector<std::byte> bytes = unpackBlock(block, kMostPackedBytes);
      out.resize(count);
      std::memcpy(out.data(), bytes.data(), bytes.size());
    } catch (const InputError&) {
      out.clear();
    }
  }
  template <class V>
  Json write(const std::vector<V>& values) const {
    static_assert(sizeof(V) == 12);
    const PackedBlock block = packBlock({}, kType, 3 * values.size(), std::as_bytes(std::span(values)));
    return {{"count", values.size()}, {"data", block.data}};
  }
};

}  // namespace

const FieldTable<SceneMesh>& meshFields() {
  static const FieldTable<SceneMesh> table{
      .help = "the surface of a thing, as triangles",
      .rows = {field("id", &SceneMesh::id, Id{}, "").required(),
               field("name", &SceneMesh::name, Text{}, "name shown to people"),
               field("points", &SceneMesh::points, PackedTriples<StateType::Float32>{}, "corners, in m").required(),
               field("triangles", &SceneMesh::triangles, PackedTriples<StateType::UInt32>{},
                     "three points each, from 0, anticlockwise as seen from outside")
                   .required(),
               field("origin", &SceneMesh::origin, Text{}, "what it was read from, and what was done to it then")
                   .omittedWhen([](const SceneMesh& mesh) { return mesh.origin.empty(); })},
      .unknown = &SceneMesh::unknown};
  return table;
}

}  // namespace ps::fields
