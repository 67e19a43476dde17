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
  return carrying(number(names, kTurn, {"Place", help, "30° for a ramp, 90° for a cylinder that lies", ""}));
}

constexpr Words kPoint{"Points", "Where the rope goes, from the middle of the shape along its own axes.",
                       "two points for a rope that is straight", ""};
constexpr api::ParameterDeclaration point(Names names, double value, const char* when) {
  return actingWhen(when, atReset(number(names, {value, -1, 1, -1e4, 1e4}, kPoint)));
}

constexpr api::ParameterDeclaration kSolid[] = {
    atReset(choice({"kind", "Shape", "", ""}, kSolidKinds, 0,
                   {"Shape",
                    "What the sizes along its own axes are the extents of. Cylinders, cones, capsules and tubes stand "
                    "upright, a torus lies, a bowl is open at its top.",
                    "ellipsoid with three equal sizes for a ball", ""})),
    actingWhen("kind != rope", size({"size_x", "Size along x", "", "m"}, "Extent along its own x axis.",
                                    "a dice 16 mm, a brick 250 mm")),
    size({"size_y", "Size along y", "", "m"},
         "Extent along its own y axis, which points up where it is not turned. Of a torus: the thickness of its ring; "
         "of a bowl: its height, half its width for half a ball. Sheets and ropes are one particle thick, whatever "
         "this says: so much of them a brush takes when it cuts them.",
         "a mug 100 mm, a table 750 mm"),
    actingWhen("kind != rope",
               size({"size_z", "Size along z", "", "m"}, "Extent along its own z axis.", "a plank 20 mm")),
    actingWhen(
        "kind = sheet|rope",
        atReset(choice({"held", "Held at", "", ""}, "none|start|ends", 0,
                       {"Shape",
                        "What of it stays where it is: of a rope its first point, or that and its last one; of a "
                        "sheet the edge at the low end of its z axis, or that and the opposite one.",
                        "start for a flag or a swing, ends for a hammock", ""}))),
    actingWhen("kind = tube|bowl",
               size({"wall", "Thickness of the wall", "", "m"},
                    "Of a tube or bowl, measured inwards; as much as half its width, or as a bowl is high, leaves no "
                    "room in it.",
                    "a pipe 5 mm, a bowl of clay 8 mm", kWall)),
    actingWhen("kind = mesh",
               atReset(choice(
                   {"inside", "Inside", "", ""}, "filled|hollow", 0,
                   {"Shape",
                    "Whether a mesh is filled with particles, or stands for its surface alone, one particle thick: "
                    "then there is room in it for other matter, and one with holes is a bowl or a ground.",
                    "filled for a statue, hollow for a tank, a terrain, or the room in which something flows", ""}))),
    actingWhen(
        "kind != block & kind != sheet & kind != rope",
        atReset(choice({"fill", "Particles", "", ""}, "automatic|lattice|relaxed", 0,
                       {"Shape",
                        "How particles lie in it at the start: on a lattice along its own axes, whose outermost cells "
                        "make steps of a round surface, or packed against that surface, as even as they can lie. "
                        "On a packed one that is held in place and stands, other solids slide as on the shape itself; "
                        "liquid does so on either kind, however thin. Automatic packs what is held in place.",
                        "automatic for a mould or a ramp, relaxed for a smooth ball, lattice for a crystal", ""}))),
    place({"position_x", "Position x", "", "m"}, "Where the middle of the shape is."),
    place({"position_y", "Position y", "", "m"}, "How high the middle of the shape is."),
    place({"position_z", "Position z", "", "m"}, "Where the middle of the shape is."),
    turn({"rotation_x", "Rotation about x", "", "°"}, "Turned about the scene's x axis, before those about y and z."),
    turn({"rotation_y", "Rotation about y", "", "°"}, "Turned about the scene's y axis, after that about x."),
    turn({"rotation_z", "Rotation about z", "", "°"}, "Turned about the scene's z axis, after those about x and y."),
    actingWhen("kind = rope", atReset(integer({"points", "Points", "", ""}, {2, 2, 6, 2, 6},
                                              {"Points", "Of a rope, which goes straight from one to the next.",
                                               "2 for a straight one, 3 for one that hangs over a beam", ""}))),
    point({"point_1_x", "Point 1 x", "", "m"}, -0.1, "kind = rope"),
    point({"point_1_y", "Point 1 y", "", "m"}, 0, "kind = rope"),
    point({"point_1_z", "Point 1 z", "", "m"}, 0, "kind = rope"),
    point({"point_2_x", "Point 2 x", "", "m"}, 0.1, "kind = rope"),
    point({"point_2_y", "Point 2 y", "", "m"}, 0, "kind = rope"),
    point({"point_2_z", "Point 2 z", "", "m"}, 0, "kind = rope"),
    point({"point_3_x", "Point 3 x", "", "m"}, 0.2, "kind = rope & points >= 3"),
    point({"point_3_y", "Point 3 y", "", "m"}, -0.1, "kind = rope & points >= 3"),
    point({"point_3_z", "Point 3 z", "", "m"}, 0, "kind = rope & points >= 3"),
    point({"point_4_x", "Point 4 x", "", "m"}, 0.3, "kind = rope & points >= 4"),
    point({"point_4_y", "Point 4 y", "", "m"}, -0.1, "kind = rope & points >= 4"),
    point({"point_4_z", "Point 4 z", "", "m"}, 0, "kind = rope & points >= 4"),
    point({"point_5_x", "Point 5 x", "", "m"}, 0.4, "kind = rope & points >= 5"),
    point({"point_5_y", "Point 5 y", "", "m"}, -0.1, "kind = rope & points >= 5"),
    point({"point_5_z", "Point 5 z", "", "m"}, 0, "kind = rope & points >= 5"),
    point({"point_6_x", "Point 6 x", "", "m"}, 0.5, "kind = rope & points >= 6"),
    point({"point_6_y", "Point 6 y", "", "m"}, -0.1, "kind = rope & points >= 6"),
    point({"point_6_z", "Point 6 z", "", "m"}, 0, "kind = rope & points >= 6"),
};

}  // namespace

api::ParameterList solidParameters() { return api::listOf(kSolid); }

}  // namespace ps
