// SPDX-License-Identifier: Apache-2.0
// The liquid's surface of a picture: distances and thickness of its particles, smoothed and lit.
#include "ui/render/passes.h"

#include <algorithm>

namespace ps::render {
namespace {

/// Texels of a layer that a box of the picture's pixels touches, and some around them in which there is nothing of it,
/// but at the picture's edge. It begins where programs have blocks.
std::array<int, 4> texelsOf(const std::array<int, 4>& box, int scale, const Texture& layer) {
  constexpr int kAround = 2, kBlock = 8;
  std::array<int, 4> texels{};
  for (size_t k = 0; k < 2; ++k) {
    const int side = k == 0 ? layer.width() : layer.height();
    const int first = std::max(box[k] / scale - kAround, 0) / kBlock * kBlock;
    const int end = std::min(reduced(box[k] + box[k + 2], scale) + kAround, side);
    texels[k] = first;
    texels[k + 2] = std::max(end - first, 0);
  }
  return texels;
}

}  // namespace

/// How far the nearest of some spheres is.
void Passes::drawNearest(const Job& job, const Texture& to, Texture& depth, Range range, float growth) {
  if (m_quality.compute) {
    Bins::sort({sphereOrder(m_bins, range, growth, {to.width(), to.height()})});
    return computeNearest(to, m_bins);
  }
  depth.resize(to.width(), to.height());
  const Target target({&to}, &depth);
  clearDepth();
  clearColour(0, kFar, 0, 0, 0);
  hideInDepth(job);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  m_drawing->fluidDepth.use();
  glUniform1f(m_drawing->fluidDepth.at("growth"), growth);
  drawParticles(m_drawing->fluidDepth, job.plain, m_particles, range);
  glDisable(GL_DEPTH_TEST);
}

/// Into the lower left corner of a picture that has room for the finest scale: the scale changes with every step of the
/// camera, storage does not.
void Passes::drawThickness(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const bool one = prepared.instances.clearness.has_value();
  const Target target =
      one ? Target({&layers.fluidColour}, nullptr) : Target({&layers.fluidColour, &layers.fluidClear}, nullptr);
  glViewport(0, 0, reduced(frame.width, frame.thicknessScale), reduced(frame.height, frame.thicknessScale));
  clearColour(0, 0, 0, 0, 0);
  if (!one) clearColour(1, 0, 0, 0, 0);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  const Program& program = m_drawing->fluidColour;
  program.use();
  program.texture("distanceTexture", 0, layers.distance.name());
  glUniform1i(program.at("scale"), frame.thicknessScale);
  glUniform1f(program.at("growth"), kThicknessGrowth);
  drawParticles(program, plain, m_particles, prepared.instances.liquidRange(true));
  glDisable(GL_BLEND);
}

void Passes::drawFluid(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const int scale = m_quality.fluidScale, width = reduced(frame.width, scale), height = reduced(frame.height, scale);
  for (Texture* texture :
       {&layers.fluid, &layers.fluidOther, &layers.fluidColour, &layers.fluidClear, &layers.fluidNormal})
    texture->resize(width, height);
  layers.behind.resize(frame.width, frame.height);
  if (m_quality.compute)
    computeNearest(layers.fluid, m_liquidBins);
  else
    drawNearest(job, layers.fluid, layers.fluidDepth, prepared.instances.liquidRange(frame.amongLiquids),
                kDistanceGrowth);
  clock.mark("liquid's distance");
  if (m_quality.compute)
    computeThickness(job);
  else
    drawThickness(job);
  clock.mark("liquid's thickness");
  PixelBox texels{0, 0, width, height};
  if (m_quality.compute) texels = texelsOf(frame.liquidBox, scale, layers.fluid);
  smoothFluid(job, texels);
  clock.mark("liquid's smoothing");
  // Programs that compute have put the picture there in the first place.
  if (!m_quality.compute) copyPicture(layers.picture, layers.behind, {0, 0, frame.width, frame.height});
  const Program& program = m_programs.fluidLight;
  program.use();
  program.texture("fluidTexture", 0, layers.fluid.name());
  program.texture("fluidColour", 1, layers.fluidColour.name());
  program.texture("fluidNormal", 5, layers.fluidNormal.name());
  program.texture("fluidClear", 6, layers.fluidClear.name());
  program.texture("distanceTexture", 2, layers.distance.name());
  program.texture("behindTexture", 3, layers.behind.name());
  program.texture("shadowTexture", 4, m_shadow.name());
  const auto thickness = static_cast<float>(frame.thicknessScale);
  const auto used = [thickness](int pixels) { return static_cast<float>(pixels) / thickness; };
  glUniform2f(program.at("thicknessSize"), used(frame.width), used(frame.height));
  glUniform1f(program.at("oneClearness"), prepared.instances.clearness.value_or(-1));
  const auto& [x, y, wide, high] = texels;
  glUniform2i(program.at("firstLiquid"), scale * x, scale * y);
  glUniform2i(program.at("endLiquid"), scale * (x + wide), scale * (y + high));
  workOver(job, program, layers.behind, {m_liquidTiles, frame.liquidTiles}, {0, 0, frame.width, frame.height});
  clock.mark("liquid's light");
}

void Passes::smoothFluid(const Job& job, const PixelBox& texels) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const Tiles tiles{m_liquidTiles, frame.liquidTiles};
  if (!m_quality.compute) {
    const Target target({&layers.fluidOther}, nullptr), normal({&layers.fluidNormal}, nullptr);
    clearColour(0, 0.5f, 0.5f, 1, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    clearColour(0, kFar, 0, 0, 0);
    glDepthMask(GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);  // where there is liquid
  }
  const Texture* depth = m_quality.compute ? nullptr : &layers.fluidDepth;
  const Program& program = m_programs.fluidSmooth;
  program.use();
  glUniform1i(program.at("limit"), m_quality.fluidTaps * (frame.still ? 2 : 1));
  const auto& [x, y, width, height] = texels;
  glUniform2i(program.at("least"), x, y);
  glUniform2i(program.at("most"), x + width - 1, y + height - 1);
  const auto workOn = [&](const Program& what, const Texture& to) {
    m_quality.compute ? workWithin(texels, what, to) : work(what, to, tiles, depth);
  };
  for (int pass = 0; pass < 2 * m_quality.fluidRounds; ++pass) {
    const Texture& from = pass % 2 ? layers.fluidOther : layers.fluid;
    const Texture& to = pass % 2 ? layers.fluid : layers.fluidOther;
    program.texture("fluidTexture", 0, from.name());
    glUniform2i(program.at("direction"), pass % 2 ? 0 : 1, pass % 2 ? 1 : 0);
    glUniform1f(program.at("width"), prepared.instances.radius * (pass < 2 ? 1.5f : 0.8f));
    glUniform1i(program.at("fine"), pass >= 2);
    workOn(program, to);
  }
  m_programs.fluidNormal.use();
  m_programs.fluidNormal.texture("fluidTexture", 0, layers.fluid.name());
  workOn(m_programs.fluidNormal, layers.fluidNormal);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace ps::render
