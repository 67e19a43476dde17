// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <epoxy/gl.h>

#include "ui/render/bins.h"
#include "ui/render/globjects.h"
#include "ui/render/layers.h"
#include "ui/render/passclock.h"
#include "ui/render/prepared.h"
#include "ui/render/programs.h"
#include "ui/render/viewframe.h"

#include <array>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <vector>

namespace ps::render {

/// What a machine can afford. Software renderers get fewer samples and smaller soft layers, and draw what others
/// compute: a processor skips what no triangle touches, works out both ways of a branch, and takes 3.5 times as long to
/// compute a picture as to draw it. Cards made for computing draw it 13 times as slowly.
struct Quality {
  int shadowSize = 2048, shadowTaps = 8;
  int occlusionScale = 1, occlusionSamples = 12;
  int fluidScale = 2, fluidTaps = 12, fluidRounds = 2;
  int steamScale = 2, steamSprites = 4;
  int outlineScale = 1;
  bool cull = false;        ///< the processor leaves out hidden spheres
  bool compute = true;      ///< surfaces and pixels by programs that compute, else by drawing triangles
  bool takesTurns = false;  ///< no two threads may draw at once, each in a context of its own
};
Quality qualityOf(const char* rendererName, PixelWork work);
/// With half as many samples of what is soft for each step, as RenderTarget::coarser has them. Textures keep their
/// sizes.
Quality coarser(const Quality& full, int steps);
/// Of the buffer's corners of triangles, MeshVertex or EdgeVertex, in the vertex array that is bound.
void meshAttributes(GLuint buffer);

inline constexpr float kDistanceGrowth = 1.25f;  ///< liquid's surface lies on spheres so many times as large
inline constexpr float kThicknessGrowth = 1.7f;  ///< and it adds up smoothly from these

/// Shaders, textures and buffers, and the passes in their order, most of which are drawn or computed (Quality): the
/// shadow picture once for everything that is prepared; surfaces, occlusion, light, liquid, vapour, glass, ghost,
/// final, outline, panels for each picture.
class Passes {
 public:
  explicit Passes(PixelWork work);
  int largestPicture() const { return m_largest; }  ///< pixels along each side
  const Quality& quality() const { return m_quality; }
  void prepare(const Prepared& prepared);
  void show(const Props& props);
  void timePasses(std::vector<PassTime>* times) { m_times = times; }
  /// What was prepared last, into the framebuffer that the frame names.
  void draw(const Prepared& prepared, const ViewFrame& frame, Layers& layers);
  /// How far what that drew last is, and the first of its panels.
  void drawDepth(const Prepared& prepared, const ViewFrame& frame, const Layers& layers, const RenderTarget& target,
                 size_t panels);

 private:
  /// What the passes of one picture share.
  struct Job {
    const Prepared& prepared;
    const ViewFrame& frame;
    Layers& layers;
    const VertexArray& plain;
    PassClock& clock;
  };
  /// The parts of a picture that need a pass.
  struct Tiles {
    const Buffer& buffer;
    const std::vector<TileSet::Corner>& corners;
  };

  /// x, y, width, height; pixels of a layer.
  using PixelBox = std::array<int, 4>;

  void uploadPrepared(const Prepared& prepared);
  void uploadFrame(const ViewFrame& frame);
  void drawShadow(const Prepared& prepared, const VertexArray& plain);
  void computeShadow(const Prepared& prepared);
  void drawSurfaces(const Job& job);
  void drawMesh(const Program& program, const Buffer& buffer, const std::vector<MeshVertex>& mesh);
  void sortLists(const Job& job);
  void computeSurfaces(const Job& job);
  void drawOcclusion(const Job& job);
  const Texture& drawBackground(const Job& job);
  void drawLight(const Job& job);
  void computeLight(const Job& job);
  void lightTextures(const Program& program, const Layers& layers);
  void drawFluid(const Job& job);
  void drawNearest(const Job& job, const Texture& to, Texture& depth, Range range, float growth);
  void drawThickness(const Job& job);
  void computeThickness(const Job& job);
  Bins::Order sphereOrder(Bins& bins, Range range, float growth, const Bins::Field& field);
  void computeNearest(const Texture& to, const Bins& bins);
  void work(const Program& program, const Texture& to, const Tiles& tiles, const Texture* depth = nullptr);
  void workWithin(const PixelBox& box, const Program& program, const Texture& to);
  void workOver(const Job& job, const Program& program, const Texture& below, const Tiles& tiles, const PixelBox& box);
  void smoothFluid(const Job& job, const PixelBox& texels);
  void drawOver(const Job& job);
  void drawSteam(const Job& job);
  void computeSteam(const Job& job, int sprites);
  void tellSprites(const Program& program, int sprites, bool data);
  void steamTextures(const Program& program, const Layers& layers);
  void drawGlass(const Job& job);
  void drawGhost(const Job& job);
  void drawOutline(const Job& job, const PicturePlace& place);
  void drawFinal(const Job& job);
  void computeFinal(const Job& job);
  void drawPanels(const Job& job);
  void panelAttributes();
  void clearAllButDistances(const ViewFrame& frame, const RenderTarget& target);
  void hideInDepth(const Job& job);
  void drawHidden(const Job& job);
  void drawParticles(const Program& program, const VertexArray& plain, const Buffer& particles, Range range,
                     int triangles = 1);
  void tellParticles(const Program& program, const Buffer& particles, Range range);
  void drawTiles(const Tiles& tiles);

  Quality m_quality;  ///< of the picture being drawn
  const Quality m_full;
  std::vector<PassTime>* m_times = nullptr;
  GLint m_largest = 0;
  Programs m_programs;
  std::optional<DrawingPrograms> m_drawing;  // one of the two
  std::optional<ComputingPrograms> m_computing;
  Bins m_bins, m_triangleBins, m_liquidBins, m_thicknessBins;
  Texture m_shadow, m_contact{GL_RGBA8, GL_LINEAR};
  bool m_shadowless = false;  // m_shadow has been computed of nothing
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
  Buffer m_uniforms, m_visible, m_liquidTiles, m_detailTiles, m_outlineTiles, m_ghostTiles, m_allTiles, m_hiddenTiles,
      m_hiddenBits;  // of the picture being drawn
  Fence m_fence;     // behind the last call, whose context may have been another
};

}  // namespace ps::render
