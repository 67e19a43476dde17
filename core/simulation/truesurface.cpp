// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/truesurface.h"

#include "core/base/parallel.h"
#include "core/geometry/solidsurface.h"
#include "core/solver/truesurface.h"

#include <string>

namespace ps {
namespace {

api::Float4* fieldOf(ParticleStore& store) {
  return static_cast<api::Float4*>(store.find(field::kTrueSurface, api::FieldType::Float4));
}

}  // namespace

bool hasTrueSurface(const Body& body) {
  const auto* solid = std::get_if<SolidShape>(&body.shape);
  return solid && isPacked(*solid) && toggleOf(body.parameters, bodyParameters(), "fixed") &&
         body.velocity == Vector3::Zero() && body.spin == Vector3::Zero();
}

void noteTrueSurface(ParticleStore& store, std::span<const uint32_t> ids, const Body& body, double spacing) {
  store.declare(field::kTrueSurface, api::FieldType::Float4, "m", "normal and depth of the surface of a fixed shape");
  api::Float4* noted = fieldOf(store);
  const SolidSurface surface(std::get<SolidShape>(body.shape));
  const SolidForm& form = surface.form();
  forChunks(ids.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const size_t i = store.indexOf(ids[k]);
      const SolidSurface::Near near = surface.at(form.toOwn(vectorOf(store.position()[i])));
      if (near.distance > -spacing && near.distance < 0)
        noted[i] = float4Of(form.toScene(near.normal) - form.middle(), static_cast<float>(-near.distance));
    }
  });
}

}  // namespace ps
