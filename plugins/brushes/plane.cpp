// SPDX-License-Identifier: Apache-2.0
#include "plane.h"

#include "sheet.h"
#include "stamping.h"
#include "turned.h"

#include <string_view>

namespace {

using namespace ps::brushes;

constexpr ps::api::ParameterDeclaration kParameters[] = {
    rotation(0.78539816339744831, "Turns the sheet about its normal.", "0° along the axes, 45° on its corner"),
    kFollowing};

}  // namespace

PlaneBrush::PlaneBrush()
    : Described(
          {"Plane",
           "Draws with a square sheet, one particle thick, that lies on what is drawn on: a table top at a touch. "
           "Its half edge is the brush's radius. It knows the lattice only, not what stands in the way; occupied "
           "cells are left as they are.",
           ps::api::listOf(kParameters)}) {}

void PlaneBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                        const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const double hair = kHair * context.spacing;
  const auto inside = [&](double side, double front) {
    return reaches(side, context.radius, hair) && reaches(front, context.radius, hair);
  };
  stampSheets(context, frameOf(context, parameter(context, 0, 0)), parameter(context, 1, kFollowsRotation),
              context.radius, samples, kind, inside, sink);
}

ps::api::Double3 PlaneBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return extentOf(frameOf(context, parameter(context, 0, 0)), {context.spacing / 2, context.radius, context.radius});
}

const void* PlaneBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kBoxStamp ? this : nullptr;
}
