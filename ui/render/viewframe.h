// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/render/hiddentiles.h"
#include "ui/render/instances.h"
#include "ui/render/layers.h"
#include "ui/render/tiles.h"

#include <array>
#include <vector>

namespace ps::render {

struct Prepared;
struct Quality;

/// What one picture of a Prepared needs besides it: where it is seen from, how large it becomes, and what of it shows.
struct ViewFrame {
  FrameUniforms uniforms;
  PicturePlace place;
  uint32_t texture = 0;       ///< behind the framebuffer, where that is known
  int width = 0, height = 0;  ///< of the inner targets, pixels
  int coarser = 0;            ///< as RenderTarget has it
  bool still = false;         ///< inner targets have two pixels for one of the picture, along each side
  bool culled = false;        ///< `visible` has the spheres that show; else all do
  bool lidInFront = true;     ///< the eye is above the lid
  bool amongSpheres = false;  ///< the eye is among them, and sees what is buried
  bool amongLiquids = false;
  int thicknessScale = 2;                       ///< inner pixels along a side for one of the liquid's thickness
  float lineWidth = 0, haloWidth = 0;           ///< of the outline, inner pixels
  std::vector<Instance> visible;                ///< nearest first
  float ghostWidth = 0;                         ///< of the line around a ghost, inner pixels
  TileSet liquid, detail, outline, ghost, all;  ///< what the next five are made of
  std::vector<TileSet::Corner> liquidTiles;     ///< where liquid may be
  std::vector<TileSet::Corner> detailTiles;     ///< where edges and crevices may be
  std::vector<TileSet::Corner> outlineTiles;    ///< where the outline may be
  std::vector<TileSet::Corner> ghostTiles;      ///< where the ghost may be
  std::vector<TileSet::Corner> allTiles;        ///< the whole picture
  const HiddenTiles::Hidden* hidden = nullptr;  ///< where nobody sees anything, if anywhere; no others are there
  std::array<int, 4> vapourBox{}, liquidBox{};  ///< x, y, width, height of the pixels that they may touch
  std::array<int, 4> distanceBox{};             ///< the same of all that has a distance

  /// With Quality::cull finds out what is hidden, and which parts of the picture need which passes. A graphics card
  /// draws all of it faster than a processor finds out.
  void fill(const Prepared& prepared, const Eye& eye, const RenderTarget& target, const Quality& quality);

 private:
  void fillUniforms(const Prepared& prepared, const Eye& eye);
  void chooseThickness(const Prepared& prepared, const Eye& eye, int finest);
  void findTiles(const Prepared& prepared, const Eye& eye);
  void hide(const RenderTarget& target, const Eye& eye);
  void listTiles(bool computed);

  HiddenTiles m_hidden;
};

/// Pixels along a side of the inner targets for one of the picture's.
int innerScale(const PictureSize& size);

}  // namespace ps::render
