// SPDX-License-Identifier: Apache-2.0
#include "particle.h"

#include "frame.h"
#include "stamping.h"

#include <vector>

ParticleBrush::ParticleBrush()
    : Described({"Particle",
                 "Draws a thread, one particle thick, whatever the brush's radius is. It knows the lattice only, not "
                 "what stands in the way; occupied cells are left as they are.",
                 {}}) {}

void ParticleBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                           const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  std::vector<ps::api::Cell>& cells = ps::brushes::roomForCells();
  ps::brushes::alongWay(context, samples, 0, [&](const ps::brushes::Section& section) {
    cells.push_back(ps::brushes::cellAt(context, section.centre));
  });
  sink.submit(kind, {cells.data(), cells.size()});
}

ps::api::Double3 ParticleBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  const double half = context.spacing / 2;
  return {half, half, half};
}
