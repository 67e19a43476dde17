// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/globjects.h"

namespace ps::render {

/// Pictures are worked out pixel by pixel by the same text either way, which says how in `shade()`: where it is drawn,
/// in the tiles that need it, or computed for the whole picture.
Program pixelProgram(bool computed, Program::Files texts);
/// The same over what is there already.
Program overProgram(bool computed, Program::Files texts);

/// Shaders of what every renderer draws.
struct Programs {
  explicit Programs(bool computed);
  Program occlusion, fluidSmooth, fluidNormal, fluidLight, steamOver, glass, edge, outlineMask, ghost, panel, outline,
      hidden, depth, panelDepth, final, still;
};

/// Of shadows, opaque surfaces, liquids and vapour where triangles are drawn.
struct DrawingPrograms {
  Program shadow{{"particle.glsl", "cover.glsl", "shadow.vert"}, {"shadow.frag"}};
  Program sphere{{"particle.glsl", "cover.glsl", "sphere.vert"}, {"sphere.frag"}};
  Program mesh{{"mesh.vert"}, {"mesh.frag"}};
  Program background{{"fullscreen.vert"}, {"studio.glsl", "studio.frag"}};
  Program lightMetal{{"fullscreen.vert"}, {"shadowdrawn.glsl", "light.glsl", "lightmetal.glsl", "lightmetal.frag"}};
  Program lightMatter{{"fullscreen.vert"}, {"shadowdrawn.glsl", "light.glsl", "lightmatter.glsl", "lightmatter.frag"}};
  Program fluidDepth{{"particle.glsl", "cover.glsl", "fluid.vert"}, {"fluiddepth.frag"}};
  Program steam{{"particle.glsl", "steam.glsl", "steam.vert"}, {"cloud.glsl", "steam.frag"}};
  Program fluidColour{{"particle.glsl", "cover.glsl", "fluid.vert"}, {"fluidcolour.frag"}};
};

/// The same where they are computed.
struct ComputingPrograms {
  Program sortSpheres{{"particle.glsl", "bins.glsl", "sortspheres.glsl", "sort.comp"}};
  Program sortDiscs{{"particle.glsl", "bins.glsl", "sortdiscs.glsl", "sort.comp"}};
  Program sortTriangles{{"bins.glsl", "corners.glsl", "sorttriangles.glsl", "sort.comp"}};
  Program sortSprites{{"particle.glsl", "bins.glsl", "steam.glsl", "sortsprites.glsl", "sort.comp"}};
  Program triangles{{"bins.glsl", "gather.glsl", "triangles.comp"}};
  Program surface{{"particle.glsl", "bins.glsl", "gather.glsl", "nearest.glsl", "corners.glsl", "surface.comp"}};
  Program steam{{"particle.glsl", "bins.glsl", "gather.glsl", "cloud.glsl", "steam.comp"}};
  Program discs{{"bins.glsl", "gather.glsl", "discs.comp"}};
  Program nearest{{"bins.glsl", "gather.glsl", "nearest.glsl", "nearest.comp"}};
  Program thickness{{"particle.glsl", "bins.glsl", "gather.glsl", "thickness.comp"}};
  Program light{{"shadowcomputed.glsl", "light.glsl", "lightmetal.glsl", "lightmatter.glsl", "studio.glsl",
                 "lightall.glsl", "pixel.comp"}};
};

}  // namespace ps::render
