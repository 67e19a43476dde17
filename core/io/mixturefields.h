// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/fields.h"
#include "core/io/mixing.h"

// Private to this room.
namespace ps::fields {

inline constexpr const char* kMixtureKey = "mixture";
inline constexpr const char* kMixturePart = "material_part";  ///< among the schema's definitions
const FieldTable<Mixture::Part>& mixturePartFields();
const FieldTable<Mixture>& mixtureFields();
/// The key of a material's own table: it is checked and described, and stays as it stands in the file.
Field<SceneMaterial> mixtureRow();

}  // namespace ps::fields
