// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/fields.h"
#include "core/scene/project.h"

// Private to this room.
namespace ps::fields {

inline constexpr const char* kMixturePart = "material_part";  ///< among the schema's definitions
const FieldTable<Mixture::Part>& mixturePartFields();
const FieldTable<Mixture>& mixtureFields();

}  // namespace ps::fields
