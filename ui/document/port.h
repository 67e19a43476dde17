// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "ui/document/matterref.h"

#include <optional>
#include <string>
#include <variant>

namespace ps {

/// An emitter or a sink: where matter comes into the scene, or leaves it.
struct Port {
  bool sink = false;
  std::string id;  ///< Emitter::id or Sink::id
  bool operator==(const Port&) const = default;
};

/// An emitter or a sink before and after an edit; nothing: it did not exist (then `index` says where it goes). `matter`
/// names what an emitter has poured, which comes and goes with it.
template <class Item>
struct PortEdit {
  std::optional<Item> before, after;
  size_t index = 0;
  MatterRef matter{};
};
using AnyPortEdit = std::variant<PortEdit<Emitter>, PortEdit<Sink>>;

}  // namespace ps
