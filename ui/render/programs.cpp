// SPDX-License-Identifier: Apache-2.0
#include "ui/render/programs.h"

#include <utility>

namespace ps::render {

namespace {

Program pixels(bool computed, Program::Files texts, const char* whoAsks) {
  texts.push_back(computed ? whoAsks : "pixel.frag");
  return computed ? Program(texts) : Program(Program::Files{"tiles.vert"}, texts);
}

}  // namespace

Program pixelProgram(bool computed, Program::Files texts) { return pixels(computed, std::move(texts), "pixel.comp"); }
Program overProgram(bool computed, Program::Files texts) { return pixels(computed, std::move(texts), "over.comp"); }

Programs::Programs(bool computed)
    : occlusion(pixelProgram(computed, {"occlusion.glsl"})),
      fluidSmooth(pixelProgram(computed, {"fluidsmooth.glsl"})),
      fluidNormal(pixelProgram(computed, {"fluidnormal.glsl"})),
      fluidLight(overProgram(computed, {computed ? "shadowcomputed.glsl" : "shadowdrawn.glsl", "fluidlight.glsl"})),
      steamOver(overProgram(computed, {"steamover.glsl"})),
      glass({"glass.vert"}, {"glass.frag"}),
      edge({"edge.vert"}, {"edge.frag"}),
      outlineMask({"particle.glsl", "cover.glsl", "outlinemask.vert"}, {"outlinemask.frag"}),
      ghost(overProgram(computed, {"ghost.glsl"})),
      panel({"panel.vert"}, {"panel.frag"}),
      outline({"tiles.vert"}, {"outline.frag"}),
      hidden({"tiles.vert"}, {"hidden.frag"}),
      depth({"fullscreen.vert"}, {"depth.frag"}),
      panelDepth({"panel.vert"}, {"nothing.frag"}),
      final(pixelProgram(computed, {"final.glsl"})),
      still(computed ? pixelProgram(computed, {"final.glsl"})
                     : Program(Program::Files{"fullscreen.vert"}, Program::Files{"final.glsl", "pixel.frag"})) {}

}  // namespace ps::render
