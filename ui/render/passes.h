// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <epoxy/gl.h>

#include "ui/render/furniture.h"
#include "ui/render/globjects.h"
#include "ui/render/instances.h"
#include "ui/render/tiles.h"

#include <array>
#include <cstdint>

namespace ps::render {

/// The uniform block of frame.glsl, std140.
struct FrameUniforms {
  using Matrix = std::array<float, 16>;
  using Four = std::array<float, 4>;
  Matrix view, projection, inverseView, shadow;
  Four eye, size, lens, light, plate, ground, contact, matter, glowTint;
};

/// Everything about one frame that the passes need.
struct Frame {
  FrameUniforms uniforms;
  Instances instances;
  Furniture furniture;
  uint64_t furnitureRevision = 0;  ///< rises with every change of `furniture`
  ContactMap contact;
  FrameUniforms::Matrix toLight;              ///< world to clip space of the shadow picture
  std::array<float, 2> shadowScale{};         ///< metres to clip space
  TileSet liquid, detail, outline;            ///< what the next three are made of
  std::vector<TileSet::Corner> detailTiles;   ///< where edges and crevices may be
  std::vector<TileSet::Corner> liquidTiles;   ///< where liquid may be
  std::vector<TileSet::Corner> outlineTiles;  ///< where the outline may be
  BodyOutline outlined;                       ///< of the body that instances.outlined draws, in inner pixels
  std::array<int, 4> vapourBox{};             ///< x, y, width, height of the pixels that vapour may touch
  std::array<float, 3> edgeTint{};
  int width = 0, height = 0;  ///< of the inner targets
  bool data = false, still = false;
  bool lidInFront = true;  ///< the eye is above the lid
};

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

/// Shaders, textures and buffers, and the passes of a frame in their order: shadow, surfaces, occlusion, light, liquid,
/// vapour, glass, final, outline.
class Passes {
 public:
  Passes();
  int largestPicture() const { return m_largest; }  ///< pixels along each side
  const Quality& quality() const { return m_quality; }
  void draw(const Frame& frame, GLuint framebuffer);

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
    Program outline{"tiles.vert", "outline.frag"};
    Program final{"tiles.vert", "final.frag"}, still{"fullscreen.vert", "final.frag"};
  };

  void resize(int width, int height);
  void upload(const Frame& frame);
  void drawShadow(const Frame& frame);
  void drawSurfaces(const Frame& frame);
  void drawOcclusion(const Frame& frame);
  void drawBackground(const Frame& frame);
  void drawLight(const Frame& frame);
  void drawFluid(const Frame& frame);
  void smoothFluid(const Frame& frame);
  void drawSteam(const Frame& frame);
  void drawGlass(const Frame& frame);
  void drawOutline(const Frame& frame, GLuint framebuffer);
  void drawFinal(const Frame& frame, GLuint framebuffer);
  void drawParticles(const Program& program, size_t first, size_t vertices);
  void drawTiles(const Buffer& buffer, const std::vector<TileSet::Corner>& tiles);
  void drawEverywhere();

  Quality m_quality;
  GLint m_largest = 0;
  Programs m_programs;
  Texture m_surface{GL_RGBA8, GL_NEAREST}, m_normal{GL_RGB10_A2, GL_NEAREST}, m_distance{GL_R32F, GL_NEAREST};
  Texture m_depth{GL_DEPTH24_STENCIL8, GL_NEAREST}, m_open{GL_R8, GL_LINEAR};
  Texture m_picture{GL_RGBA8, GL_LINEAR}, m_behind{GL_RGBA8, GL_LINEAR};
  Texture m_shadow{GL_DEPTH_COMPONENT24, GL_LINEAR};
  Texture m_fluid{GL_R32F, GL_NEAREST}, m_fluidOther{GL_R32F, GL_NEAREST}, m_fluidColour{GL_RGBA16F, GL_LINEAR};
  Texture m_fluidClear{GL_R16F, GL_LINEAR};
  Texture m_fluidNormal{GL_RGB10_A2, GL_LINEAR}, m_cloud{GL_R8, GL_LINEAR, GL_REPEAT};
  Texture m_fluidDepth{GL_DEPTH_COMPONENT24, GL_NEAREST};
  Texture m_steam{GL_RGBA16F, GL_LINEAR};
  Texture m_mask{GL_R8, GL_LINEAR};
  Texture m_contact{GL_RGBA8, GL_LINEAR}, m_noise{GL_RGBA8, GL_LINEAR_MIPMAP_NEAREST, GL_REPEAT};
  Texture m_background{GL_RGBA8, GL_NEAREST};
  FrameUniforms m_backgroundUniforms{};  // for which m_background was drawn
  uint64_t m_furniture = 0;              // revision that is in the buffers
  BufferTexture m_particleTexture;
  Buffer m_uniforms, m_particles, m_opaque, m_clear, m_edges, m_liquidTiles, m_detailTiles, m_outlineTiles;
  const VertexArray* m_vertexArray = nullptr;  // of the frame being drawn
};

}  // namespace ps::render
