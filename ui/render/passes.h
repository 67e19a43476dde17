// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <epoxy/gl.h>

#include "ui/render/globjects.h"
#include "ui/render/layers.h"
#include "ui/render/prepared.h"
#include "ui/render/viewframe.h"

#include <cstdint>
#include <list>
#include <memory>

namespace ps::render {

/// What a machine can afford. Software renderers get fewer samples and smaller soft layers.
struct Quality {
  int shadowSize = 2048, shadowTaps = 8;
  int occlusionScale = 1, occlusionSamples = 12;
  int fluidScale = 2, fluidTaps = 12, fluidRounds = 2;
  int steamScale = 2, steamSprites = 4;
  int outlineScale = 1;
  bool cull = false;  ///< the processor leaves out hidden spheres
};
Quality qualityOf(const char* rendererName);

inline constexpr float kThicknessGrowth = 1.7f;  ///< liquid adds up smoothly from spheres so many times as large

/// Shaders, textures and buffers, and the passes in their order: the shadow picture once for everything that is
/// prepared; surfaces, occlusion, light, liquid, vapour, glass, ghost, final, outline, panels for each picture.
class Passes {
 public:
  Passes();
  int largestPicture() const { return m_largest; }  ///< pixels along each side
  const Quality& quality() const { return m_quality; }
  void prepare(const Prepared& prepared);
  void show(const Props& props);
  /// What was prepared last, into the framebuffer that the frame names.
  void draw(const Prepared& prepared, const ViewFrame& frame, Layers& layers);

 private:
  struct Programs {
    Program sphere{"sphere.vert", "sphere.frag", "particle.glsl"};
    Program mesh{"mesh.vert", "mesh.frag"};
    Program shadow{"shadow.vert", "shadow.frag", "particle.glsl"};
    Program occlusion{"tiles.vert", "occlusion.frag"};
    Program background{"fullscreen.vert", "background.frag"};
    Program lightMetal{"fullscreen.vert", "lightmetal.frag", "", "light.glsl"};
    Program lightMatter{"fullscreen.vert", "lightmatter.frag", "", "light.glsl"};
    Program fluidDepth{"fluid.vert", "fluiddepth.frag", "particle.glsl"};
    Program fluidColour{"fluid.vert", "fluidcolour.frag", "particle.glsl"};
    Program fluidSmooth{"tiles.vert", "fluidsmooth.frag"};
    Program fluidNormal{"tiles.vert", "fluidnormal.frag"};
    Program fluidLight{"tiles.vert", "fluidlight.frag"};
    Program steam{"steam.vert", "steam.frag", "particle.glsl"};
    Program steamOver{"fullscreen.vert", "steamover.frag"};
    Program glass{"glass.vert", "glass.frag"};
    Program edge{"edge.vert", "edge.frag"};
    Program outlineMask{"outlinemask.vert", "outlinemask.frag", "particle.glsl"};
    Program ghost{"tiles.vert", "ghost.frag"};
    Program panel{"panel.vert", "panel.frag"};
    Program outline{"tiles.vert", "outline.frag"};
    Program final{"tiles.vert", "final.frag"}, still{"fullscreen.vert", "final.frag"};
  };

  /// What the passes of one picture share.
  struct Job {
    const Prepared& prepared;
    const ViewFrame& frame;
    Layers& layers;
    const VertexArray& plain;
  };

  void uploadPrepared(const Prepared& prepared);
  void uploadFrame(const ViewFrame& frame);
  void drawShadow(const Prepared& prepared, const VertexArray& plain);
  void drawSurfaces(const Job& job);
  void drawOcclusion(const Job& job);
  const Texture& drawBackground(const Job& job);
  void drawLight(const Job& job);
  void drawFluid(const Job& job);
  void drawFluidDepth(const Job& job);
  void drawThickness(const Job& job);
  void smoothFluid(const Job& job);
  void drawSteam(const Job& job);
  void drawGlass(const Job& job);
  void drawGhost(const Job& job);
  void drawOutline(const Job& job, const PicturePlace& place);
  void drawFinal(const Job& job);
  void drawPanels(const Job& job);
  void drawParticles(const Program& program, const VertexArray& plain, const Buffer& particles, Range range,
                     int triangles = 1);
  void drawTiles(const Buffer& buffer, const std::vector<TileSet::Corner>& tiles);

  Quality m_quality;
  GLint m_largest = 0;
  Programs m_programs;
  Texture m_shadow{GL_DEPTH_COMPONENT24, GL_LINEAR}, m_contact{GL_RGBA8, GL_LINEAR};
  Texture m_noise{GL_RGBA8, GL_LINEAR_MIPMAP_NEAREST, GL_REPEAT}, m_cloud{GL_R8, GL_LINEAR, GL_REPEAT};
  uint64_t m_furniture = 0;  // revision that is in the buffers
  BufferTexture m_particleTexture;
  Buffer m_particles, m_opaque, m_clear, m_edges, m_guides;  // of what is prepared
  Buffer m_opaqueProps, m_clearProps, m_panels;
  /// By their place among the panels.
  struct PanelPicture {
    Texture texture{GL_RGBA8, GL_LINEAR_MIPMAP_LINEAR};
    std::shared_ptr<const PanelImage> image;  ///< that it holds
  };
  std::list<PanelPicture> m_panelPictures;
  Buffer m_uniforms, m_visible, m_liquidTiles, m_detailTiles, m_outlineTiles,
      m_ghostTiles;  // of the picture being drawn
  Fence m_fence;     // behind the last call, whose context may have been another
};

}  // namespace ps::render
