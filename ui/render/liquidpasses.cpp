// SPDX-License-Identifier: Apache-2.0
// The liquid's surface of a picture: distances and thickness of its particles, smoothed and lit.
#include "ui/render/passes.h"

namespace ps::render {

void Passes::drawFluidDepth(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  const Target target({&layers.fluid}, &layers.fluidDepth);
  clearDepth();
  clearColour(0, kFar, 0, 0, 0);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  m_programs.fluidDepth.use();
  glUniform1f(m_programs.fluidDepth.at("growth"), 1.25f);
  drawParticles(m_programs.fluidDepth, plain, m_particles, prepared.instances.liquidRange(frame.amongLiquids));
  glDisable(GL_DEPTH_TEST);
}

/// Into the lower left corner of a picture that has room for the finest scale: the scale changes with every step of the
/// camera, storage does not.
void Passes::drawThickness(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  const bool one = prepared.instances.clearness.has_value();
  const Target target =
      one ? Target({&layers.fluidColour}, nullptr) : Target({&layers.fluidColour, &layers.fluidClear}, nullptr);
  glViewport(0, 0, reduced(frame.width, frame.thicknessScale), reduced(frame.height, frame.thicknessScale));
  clearColour(0, 0, 0, 0, 0);
  if (!one) clearColour(1, 0, 0, 0, 0);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  const Program& program = m_programs.fluidColour;
  program.use();
  program.texture("distanceTexture", 0, layers.distance.name());
  glUniform1i(program.at("scale"), frame.thicknessScale);
  glUniform1f(program.at("growth"), kThicknessGrowth);
  drawParticles(program, plain, m_particles, prepared.instances.liquidRange(true));
  glDisable(GL_BLEND);
}

void Passes::drawFluid(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  const int scale = m_quality.fluidScale, width = reduced(frame.width, scale), height = reduced(frame.height, scale);
  for (Texture* texture : {&layers.fluid, &layers.fluidOther, &layers.fluidColour, &layers.fluidClear,
                           &layers.fluidDepth, &layers.fluidNormal})
    texture->resize(width, height);
  layers.behind.resize(frame.width, frame.height);
  drawFluidDepth(job);
  drawThickness(job);
  smoothFluid(job);

  copyPicture(layers.picture, layers.behind, {0, 0, frame.width, frame.height});
  const Target target({&layers.picture}, nullptr);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
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
  drawTiles(m_liquidTiles, frame.liquidTiles);
  glDisable(GL_BLEND);
}

void Passes::smoothFluid(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  const Program& program = m_programs.fluidSmooth;
  program.use();
  glUniform1i(program.at("limit"), m_quality.fluidTaps * (frame.still ? 2 : 1));
  glDepthMask(GL_FALSE);
  glEnable(GL_DEPTH_TEST);
  for (int pass = 0; pass < 2 * m_quality.fluidRounds; ++pass) {
    const Texture& from = pass % 2 ? layers.fluidOther : layers.fluid;
    const Texture& to = pass % 2 ? layers.fluid : layers.fluidOther;
    const Target target({&to}, &layers.fluidDepth);
    glDepthFunc(GL_GREATER);  // where there is liquid
    if (pass == 0) clearColour(0, kFar, 0, 0, 0);
    program.texture("fluidTexture", 0, from.name());
    glUniform2i(program.at("direction"), pass % 2 ? 0 : 1, pass % 2 ? 1 : 0);
    glUniform1f(program.at("width"), prepared.instances.radius * (pass < 2 ? 1.5f : 0.8f));
    glUniform1i(program.at("fine"), pass >= 2);
    drawTiles(m_liquidTiles, frame.liquidTiles);
  }
  const Target target({&layers.fluidNormal}, &layers.fluidDepth);
  clearColour(0, 0.5f, 0.5f, 1, 1);
  m_programs.fluidNormal.use();
  m_programs.fluidNormal.texture("fluidTexture", 0, layers.fluid.name());
  drawTiles(m_liquidTiles, frame.liquidTiles);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace ps::render
