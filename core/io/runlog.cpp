// SPDX-License-Identifier: Apache-2.0
#include "core/io/runlog.h"

#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/io/fieldkinds.h"
#include "core/io/projectfields.h"
#include "core/io/schema.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace ps {
namespace fields {
namespace {

constexpr int64_t kMostFrames = int64_t{1} << 53;
/// Far beyond all keys that a session gives: it counts its strokes.
constexpr uint64_t kElsewhere = uint64_t{1} << 40;
constexpr int64_t kMostKey = int64_t{1} << 52;

struct UpdateDocument {
  uint64_t document = 0;
};
struct SetTogether {
  std::vector<SetParameter> values;
};
using LoggedEdit =
    std::variant<SetTogether, UpdateDocument, SetTracks, AddCells, TakeCells, TakeBody, TakeMatter, PutBack, PaintCells,
                 MoveBody, PassMatter, NameMatter, ReturnBody, ForgetMatter, TouchMatter, UndoTouch, RedoTouch>;
struct LogEntry {
  uint64_t frame = 0;
  LoggedEdit edit;
};

struct Key : Integer {
  Key() : Integer(0, kMostKey) {}
  void read(Json& value, MatterKey& out, const PluginRegistry&) const { out = keyHere(value.get<uint64_t>()); }
};

struct AddressKind : Text {
  void read(Json& value, Address& out, const PluginRegistry&) const {
    const auto address = Address::parse(value.get_ref<const std::string&>());
    if (!address) throw InputError("'" + value.get<std::string>() + "' is no address of a parameter");
    out = *address;
  }
  Json write(const Address& address) const { return address.text(); }
};

/// Whatever a parameter may have; the declaration takes a number for a constant response and back.
struct AnyValue : Plain {
  Json schema() const { return valueSchema(); }
  void read(Json& value, Value& out, const PluginRegistry&) const {
    api::ParameterDeclaration declaration;
    declaration.kind = value.is_boolean()  ? api::ParameterKind::Toggle
                       : value.is_string() ? api::ParameterKind::Choice
                       : value.is_object() ? api::ParameterKind::Response
                                           : api::ParameterKind::Number;
    out = valueFromJson(value, declaration);
  }
  Json write(const Value& value) const { return jsonFromValue(value); }
};

/// x, y, z of one cell after the other.
struct Cells : Plain {
  Json schema() const {
    return {{"type", "array"}, {"items", {{"type", "integer"}, {"minimum", -1'000'000}, {"maximum", 1'000'000}}}};
  }
  void read(Json& value, CellIndices& out, const PluginRegistry&) const {
    if (value.size() % 3 != 0) throw InputError("cells have three numbers each");
    for (size_t i = 0; i < value.size(); i += 3)
      out.push_back({value[i].get<int>(), value[i + 1].get<int>(), value[i + 2].get<int>()});
  }
  Json write(const CellIndices& cells) const {
    Json out = Json::array();
    for (const auto& cell : cells) {
      for (const int place : cell) out.push_back(place);
    }
    return out;
  }
};

struct SketchedBody : Shared<Object<Body>> {
  SketchedBody() : Shared(Object{bodyFields(), "body"}) {}
};

const FieldTable<SetParameter>& setFields() {
  static const FieldTable<SetParameter> table{
      .rows = {field("address", &SetParameter::address, AddressKind{}, "").required(),
               field("value", &SetParameter::value, AnyValue{}, "").required()}};
  return table;
}
const FieldTable<SetTogether>& togetherFields() {
  static const FieldTable<SetTogether> table{
      .rows = {field("values", &SetTogether::values, List{Object{setFields()}}, "").required()}};
  return table;
}
const FieldTable<UpdateDocument>& updateFields() {
  static const FieldTable<UpdateDocument> table{
      .rows = {field("document", &UpdateDocument::document, Integer{0, kMostFrames}, "").required()}};
  return table;
}
const FieldTable<SetTracks>& tracksFields() {
  static const FieldTable<SetTracks> table{
      .rows = {field("tracks", &SetTracks::tracks, List{Object{trackFields()}}, "").required()}};
  return table;
}
struct Turn : Plain {
  Json schema() const { return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 4}, {"maxItems", 4}}; }
  void read(Json& value, Quaternion& out, const PluginRegistry&) const {
    for (int k = 0; k < 4; ++k) out.coeffs()[k] = value[static_cast<size_t>(k)].get<double>();
    if (!(std::abs(out.norm() - 1) < 1e-9)) throw InputError("a body was turned by no rotation");
  }
  Json write(const Quaternion& turn) const { return {turn.x(), turn.y(), turn.z(), turn.w()}; }
};
const FieldTable<RigidMove>& rigidMoveFields() {
  static const FieldTable<RigidMove> table{.rows = {field("turn", &RigidMove::turn, Turn{}, "").required(),
                                                    field("shift", &RigidMove::shift, Vector{"m"}, "").required()}};
  return table;
}
const FieldTable<AddCells>& addFields() {
  static const FieldTable<AddCells> table{
      .rows = {field("body", &AddCells::body, SketchedBody{}, "").required(),
               field("cells", &AddCells::cells, Cells{}, "").required(),
               field("palette", &AddCells::palette, Integer{0, 65535}, ""), field("key", &AddCells::key, Key{}, ""),
               field("way", &AddCells::way, Object{rigidMoveFields()}, "").omittedWhen([](const AddCells& cells) {
                 return cells.way.isNothing();
               })}};
  return table;
}
const FieldTable<TakeCells>& takeCellsFields() {
  static const FieldTable<TakeCells> table{
      .rows = {field("lattice", &TakeCells::lattice, Object{voxelFields()}, "").required(),
               field("cells", &TakeCells::cells, Cells{}, "").required(),
               field("spared", &TakeCells::spared, List{Id{}}, ""), field("key", &TakeCells::key, Key{}, "")}};
  return table;
}
const FieldTable<TakeBody>& takeBodyFields() {
  static const FieldTable<TakeBody> table{
      .rows = {field("body", &TakeBody::body, Id{}, "").required(), field("key", &TakeBody::key, Key{}, "")}};
  return table;
}
const FieldTable<TakeMatter>& takeMatterFields() {
  static const FieldTable<TakeMatter> table{
      .rows = {field("key", &TakeMatter::key, Key{}, ""),
               field("lattice", &TakeMatter::lattice, Object{voxelFields()}, "").required(),
               field("cells", &TakeMatter::cells, Cells{}, "").required()}};
  return table;
}
const FieldTable<PutBack>& putBackFields() {
  static const FieldTable<PutBack> table{
      .rows = {field("key", &PutBack::key, Key{}, ""), field("cells", &PutBack::cells, List{Object{addFields()}}, "")}};
  return table;
}
const FieldTable<PaintCells>& paintCellsFields() {
  static const FieldTable<PaintCells> table{
      .rows = {field("lattice", &PaintCells::lattice, Object{voxelFields()}, "").required(),
               field("cells", &PaintCells::cells, Cells{}, "").required(),
               field("material", &PaintCells::material, Text{}, "").required(),
               field("spared", &PaintCells::spared, List{Id{}}, ""), field("key", &PaintCells::key, Key{}, "")}};
  return table;
}
const FieldTable<MoveBody>& moveFields() {
  static const FieldTable<MoveBody> table{
      .rows = {field("body", &MoveBody::body, SketchedBody{}, "").required(),
               field("move", &MoveBody::move, Object{rigidMoveFields()}, "").required(),
               field("led", &MoveBody::led, Toggle{}, "")}};
  return table;
}
const FieldTable<PassMatter>& passFields() {
  static const FieldTable<PassMatter> table{
      .rows = {field("from", &PassMatter::from, Id{}, "").required(), field("to", &PassMatter::to, Id{}, "").required(),
               field("lattice", &PassMatter::lattice, Object{voxelFields()}, ""),
               field("cells", &PassMatter::cells, Cells{}, ""), field("all", &PassMatter::all, Toggle{}, "")}};
  return table;
}
const FieldTable<NameMatter>& nameFields() {
  static const FieldTable<NameMatter> table{
      .rows = {field("key", &NameMatter::key, Key{}, ""), field("body", &NameMatter::body, Id{}, "").required(),
               field("lattice", &NameMatter::lattice, Object{voxelFields()}, "").required(),
               field("cells", &NameMatter::cells, Cells{}, "").required(),
               field("painted_from", &NameMatter::paintedFrom, Text{}, "").omittedWhen([](const NameMatter& named) {
                 return named.paintedFrom.empty();
               })}};
  return table;
}
const FieldTable<ReturnBody>& returnFields() {
  static const FieldTable<ReturnBody> table{
      .rows = {field("body", &ReturnBody::body, SketchedBody{}, ""), field("key", &ReturnBody::key, Key{}, ""),
               field("named", &ReturnBody::named, List{Object{nameFields()}}, "")}};
  return table;
}
const FieldTable<ForgetMatter>& forgetFields() {
  static const FieldTable<ForgetMatter> table{.rows = {field("keys", &ForgetMatter::keys, List{Key{}}, "").required()}};
  return table;
}

struct Place : Plain {
  Json schema() const { return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}}; }
  void read(Json& value, api::Double3& out, const PluginRegistry&) const {
    out = {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
  }
  Json write(const api::Double3& place) const { return {place.x, place.y, place.z}; }
  bool isDefault(const api::Double3& place) const { return place.x == 0 && place.y == 0 && place.z == 0; }
};
struct Kind : Plain {
  static constexpr const char* kNames[] = {"heat", "push", "hold", "cut", "weld"};
  Json schema() const { return namesSchema({std::begin(kNames), std::end(kNames)}); }
  void read(Json& value, api::TouchKind& out, const PluginRegistry&) const {
    const auto* name = std::find(std::begin(kNames), std::end(kNames), value.get<std::string>());
    out = static_cast<api::TouchKind>(name - std::begin(kNames));
  }
  Json write(api::TouchKind kind) const { return kNames[static_cast<size_t>(kind)]; }
};
const FieldTable<api::Touch>& touchFields() {
  constexpr double kMost = 1e15;
  static const FieldTable<api::Touch> table{
      .rows = {field("does", &api::Touch::kind, Kind{}, "").required(),
               field("centre", &api::Touch::centre, Place{}, "").required(),
               field("radius", &api::Touch::radius, Number{0, kFarthest, "m"}, "").required(),
               field("falloff", &api::Touch::falloff, Number{0, 1}, ""),
               field("power", &api::Touch::power, Number{-kMost, kMost, "W"}, ""),
               field("limit", &api::Touch::limit, Number{0, 1e4, "K"}, ""),
               field("force", &api::Touch::force, Number{0, kMost, "N"}, ""),
               field("velocity", &api::Touch::velocity, Place{}, ""), field("spin", &api::Touch::spin, Place{}, ""),
               field("normal", &api::Touch::normal, Place{}, "")}};
  return table;
}
const FieldTable<TouchMatter>& touchMatterFields() {
  static const FieldTable<TouchMatter> table{
      .rows = {field("path", &TouchMatter::path, List{Object{touchFields()}}, ""),
               field("samples", &TouchMatter::samples, Integer{1, 1'000'000}, ""),
               field("still", &TouchMatter::still, List{Object{touchFields()}}, ""),
               field("spared", &TouchMatter::spared, List{Id{}}, ""), field("key", &TouchMatter::key, Key{}, "")}};
  return table;
}
template <class Edit>
const FieldTable<Edit>& keyFields() {
  static const FieldTable<Edit> table{.rows = {field("key", &Edit::key, Key{}, "").required()}};
  return table;
}

template <class>
struct EditKind;
template <class... Edits>
struct EditKind<std::variant<Edits...>> : OneOf<Edits...> {
  using OneOf<Edits...>::OneOf;
  bool isDefault(const std::variant<Edits...>&) const { return false; }
};
struct AnyEdit : EditKind<LoggedEdit> {
  AnyEdit()
      : EditKind({"set", "", &togetherFields()}, {"update", "", &updateFields()}, {"tracks", "", &tracksFields()},
                 {"add_cells", "", &addFields()}, {"take_cells", "", &takeCellsFields()},
                 {"take_body", "", &takeBodyFields()}, {"take_matter", "", &takeMatterFields()},
                 {"put_back", "", &putBackFields()}, {"paint_cells", "", &paintCellsFields()},
                 {"move_body", "", &moveFields()}, {"pass_matter", "", &passFields()},
                 {"name_matter", "", &nameFields()}, {"return_body", "", &returnFields()},
                 {"forget_matter", "", &forgetFields()}, {"touch_matter", "", &touchMatterFields()},
                 {"undo_touch", "", &keyFields<UndoTouch>()}, {"redo_touch", "", &keyFields<RedoTouch>()}) {}
};

const FieldTable<LogEntry>& entryFields() {
  static const FieldTable<LogEntry> table{
      .rows = {field("frame", &LogEntry::frame, Integer{0, kMostFrames}, "").required(),
               field("edit", &LogEntry::edit, AnyEdit{}, "").required()}};
  return table;
}

void requireLattice(const VoxelShape& lattice) {
  if (lattice.spacing <= 0) throw InputError("cells are of no lattice");
}
void require(const AddCells& cells) {
  const auto* shape = std::get_if<VoxelShape>(&cells.body->shape);
  if (!shape || static_cast<size_t>(cells.palette) >= shape->palette.size())
    throw InputError("cells were added to no sketch that has their material");
  requireLattice(*shape);
}
void require(const PutBack& command) {
  for (const AddCells& cells : command.cells) require(cells);
}
void require(const ReturnBody& command) {
  const auto* shape = command.body ? std::get_if<VoxelShape>(&command.body->shape) : nullptr;
  if (shape) requireLattice(*shape);
  for (const NameMatter& named : command.named) requireLattice(named.lattice);
}
void require(const MoveBody& command) {
  if (const auto* shape = std::get_if<VoxelShape>(&command.body->shape)) requireLattice(*shape);
}
void require(const TakeCells& command) { requireLattice(command.lattice); }
void require(const PaintCells& command) { requireLattice(command.lattice); }
void require(const PassMatter& command) {
  if (!command.all) requireLattice(command.lattice);
}
void require(const TakeMatter& command) { requireLattice(command.lattice); }
void require(const NameMatter& command) { requireLattice(command.lattice); }

}  // namespace
}  // namespace fields

namespace {

using nlohmann::json;

fields::LoggedEdit logged(const RecordedEdit& edit,
                          const std::function<uint64_t(const std::shared_ptr<const Project>&)>& numberOf) {
  if (const auto* together = std::get_if<std::vector<SetParameter>>(&edit)) return fields::SetTogether{*together};
  return std::visit(
      [&](const auto& command) -> fields::LoggedEdit {
        using T = std::decay_t<decltype(command)>;
        if constexpr (std::is_same_v<T, SetParameter>)
          return fields::SetTogether{{command}};
        else if constexpr (std::is_same_v<T, UpdateProject>)
          return fields::UpdateDocument{numberOf(command.project)};
        else if constexpr (std::is_constructible_v<fields::LoggedEdit, T>)
          return command;
        else
          throw Error("recording: an edit that begins another run, or changes none, stands in a log");
      },
      std::get<Command>(edit));
}

RecordedEdit recorded(fields::LoggedEdit edit, const Documents& documents) {
  return std::visit(
      [&](auto& one) -> RecordedEdit {
        using T = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<T, fields::SetTogether>) {
          return std::move(one.values);
        } else if constexpr (std::is_same_v<T, fields::UpdateDocument>) {
          const auto document = documents.find(one.document);
          if (document == documents.end()) throw InputError("an edit is of a document that is not there");
          return Command{UpdateProject{document->second}};
        } else {
          if constexpr (requires { fields::require(one); }) fields::require(one);
          return Command{std::move(one)};
        }
      },
      edit);
}

const Project* documentOf(const FrameEdit& edit) {
  const auto* command = std::get_if<Command>(&edit.edit);
  const auto* update = command ? std::get_if<UpdateProject>(command) : nullptr;
  return update ? update->project.get() : nullptr;
}

/// The log names it: the document that the body came with holds it.
void takeMesh(std::shared_ptr<const Body>& placed, const Project* document) {
  auto body = std::make_shared<Body>(*placed);
  auto* solid = std::get_if<SolidShape>(&body->shape);
  if (!solid || choiceOf(solid->parameters, solidParameters(), "kind") != "mesh") return;
  if (document) {
    const auto& meshes = document->meshes;
    const auto mesh =
        std::find_if(meshes.begin(), meshes.end(), [&](const auto& one) { return one->id == solid->meshId; });
    if (mesh != meshes.end()) solid->mesh = *mesh;
  }
  if (!solid->mesh) throw InputError("a body came back whose mesh '" + solid->meshId + "' is in no document before");
  placed = std::move(body);
}

}  // namespace

json logOf(const FrameEdit* first, const FrameEdit* end,
           const std::function<uint64_t(const std::shared_ptr<const Project>&)>& numberOf) {
  json list = json::array();
  for (; first != end; ++first)
    list.push_back(fields::entryFields().write({first->frame, logged(first->edit, numberOf)}));
  return list;
}

std::vector<FrameEdit> readLog(json list, const Documents& documents, const std::vector<FrameEdit>& before,
                               const PluginRegistry& plugins) {
  static const json schema{{"type", "array"}, {"items", fields::entryFields().schema()}};
  requireSchema(schema, list, "log");
  std::vector<FrameEdit> edits;
  const Project* newest = nullptr;
  for (const FrameEdit& edit : before) {
    if (const Project* document = documentOf(edit)) newest = document;
  }
  for (json& entry : list) {
    fields::LogEntry one;
    fields::entryFields().read(one, entry, plugins);
    if (auto* back = std::get_if<ReturnBody>(&one.edit); back && back->body) takeMesh(back->body, newest);
    edits.push_back({one.frame, recorded(std::move(one.edit), documents)});
    if (const Project* document = documentOf(edits.back())) newest = document;
  }
  return edits;
}

MatterKey keyHere(uint64_t key) { return key == 0 ? 0 : key + fields::kElsewhere; }

MatterKey keyOf(const RecordedEdit& edit) {
  const auto* command = std::get_if<Command>(&edit);
  if (!command) return 0;
  return std::visit(
      [](const auto& one) -> MatterKey {
        if constexpr (requires { one.key; }) return one.key;
        return 0;
      },
      *command);
}

}  // namespace ps
