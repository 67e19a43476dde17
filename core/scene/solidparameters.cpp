// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"
#include "core/scene/solidform.h"

namespace ps {
namespace {

using namespace declare;

constexpr Range kEdge{0.1, 0.01, 1, 1e-6, 1e4}, kWall{0.01, 0.001, 0.1, 1e-6, 1e4}, kPlace{0, -1, 1, -1e4, 1e4},
    kTurn{0, -180, 180, -3600, 3600};

constexpr api::ParameterDeclaration size(Names names, const char* help, const char* example, Range range = kEdge) {
  return atReset(number(names, range, {"Shape", help, example, ""}));
}
constexpr api::ParameterDeclaration carrying(api::ParameterDeclaration d) {
  d.actsAt = api::ActsAt::WithItsMatter;
  return d;
}
constexpr api::ParameterDeclaration place(Names names, const char* help) {
  return carrying(number(names, kPlace, {"Place", help, "0.5 is half a metre from the middle of the scene", ""}));
}
constexpr api::ParameterDeclaration turn(Names names, const char* help) {
  return carrying(number(names, kTurn, {"Place", help, "30 for a ramp, 90 for a cylinder that lies", ""}));
}

constexpr api::ParameterDeclaration kSolid[] = {
    atReset(choice({"kind", "Shape", "", ""}, kSolidKinds, 0,
                   {"Shape",
                    "What the sizes along its own axes are the extents of. Cylinders, cones, capsules and tubes stand "
                    "upright, a torus lies.",
                    "ellipsoid with three equal sizes for a ball", ""})),
    size({"size_x", "Size along x", "", "m"}, "Extent along its own x axis.", "a dice 0.016, a brick 0.25"),
    size({"size_y", "Size along y", "", "m"},
         "Extent along its own y axis, which points up where it is not turned. Of a torus: the thickness of its ring.",
         "a mug 0.1, a table 0.75"),
    size({"size_z", "Size along z", "", "m"}, "Extent along its own z axis.", "a plank 0.02"),
    actingWhen("kind = tube",
               size({"wall", "Thickness of the wall", "", "m"},
                    "Of a tube, measured inwards; as much as it is wide makes it a cylinder.", "a pipe 0.005", kWall)),
    actingWhen(
        "kind != block",
        atReset(choice({"fill", "Particles", "", ""}, "lattice|relaxed", 0,
                       {"Shape",
                        "How particles lie in it at the start: on a lattice along its own axes, whose outermost cells "
                        "make steps of a round surface, or packed against that surface, as even as they can lie.",
                        "relaxed for a smooth ball or mould, lattice for a crystal", ""}))),
    place({"position_x", "Position x", "", "m"}, "Where the middle of the shape is."),
    place({"position_y", "Position y", "", "m"}, "How high the middle of the shape is."),
    place({"position_z", "Position z", "", "m"}, "Where the middle of the shape is."),
    turn({"rotation_x", "Rotation about x", "", "°"}, "Turned about the scene's x axis, before those about y and z."),
    turn({"rotation_y", "Rotation about y", "", "°"}, "Turned about the scene's y axis, after that about x."),
    turn({"rotation_z", "Rotation about z", "", "°"}, "Turned about the scene's z axis, after those about x and y."),
};

}  // namespace

api::ParameterList solidParameters() { return api::listOf(kSolid); }

}  // namespace ps
