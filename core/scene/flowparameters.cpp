// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"

namespace ps {
namespace {

using namespace declare;

constexpr api::ParameterDeclaration kEmitter[] = {
    number(
        {"speed", "Speed", "v", "m/s"}, {1, 0, 5, 0, 100},
        {"Jet", "Speed with which matter leaves the mouth. 0 closes it.", "kitchen tap 1 m/s, garden hose 5 m/s", ""}),
    number({"diameter", "Width of the mouth", "d", "m"}, {0.06, 0.02, 0.3, 1e-4, 10},
           {"Jet",
            "Diameter of the round mouth. What it pours is its area times the speed, however many particles fit into "
            "it; one narrower than a particle drips.",
            "tap 20 mm, pipe 60 mm", ""},
           {"mm", 1000, 0}),
    number({"temperature", "Temperature", "T", "K"}, {293.15, 173.15, 1773.15, 1, 10000},
           {"Jet", "Temperature of what comes out; matter has the phase that is stable at it.",
            "cold tap 10 °C, kettle's steam 110 °C, lava 1200 °C", ""},
           kCelsius),
    number({"start", "Opens at", "", "s"}, {0, 0, 60, 0, 1e9}, {"Time", "When it begins to pour.", "0 at once", ""}),
    related("should be > start", number({"stop", "Closes at", "", "s"}, {1e9, 0, 60, 0, 1e9},
                                        {"Time", "When it stops pouring.", "10 for ten seconds of rain", ""})),
    integer(
        {"most", "Most particles", "", ""}, {20000, 100, 100000, 0, 20000000},
        {"Time",
         "Particles of this tap that may be there at a time: it waits while there are so many, and goes on when some "
         "have been drained, so that a tap left open does not fill the computer. To pour so much and no more, say "
         "when it closes.",
         "20000; with a drain below it never stops", ""}),
};

constexpr api::ParameterDeclaration turn(Names names, const char* help) {
  return number(names, {0, -180, 180, -3600, 3600}, {"Place", help, "30° along a slope", ""});
}

constexpr api::ParameterDeclaration kSink[] = {
    toggle({"open", "Open", "", ""}, true,
           {"Sink", "Takes away every particle whose centre comes into the box. Matter held in place stays.",
            "a drain, the end of a river", ""}),
    turn({"rotation_x", "Rotation about x", "", "°"},
         "Turned about the scene's x axis, about its middle, before those about y and z."),
    turn({"rotation_y", "Rotation about y", "", "°"}, "Turned about the scene's y axis, after that about x."),
    turn({"rotation_z", "Rotation about z", "", "°"}, "Turned about the scene's z axis, after those about x and y."),
};

}  // namespace

api::ParameterList emitterParameters() { return api::listOf(kEmitter); }
api::ParameterList sinkParameters() { return api::listOf(kSink); }

}  // namespace ps
