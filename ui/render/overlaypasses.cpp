// SPDX-License-Identifier: Apache-2.0
// What goes over the lit picture: vapour, glass and thin lines, a ghost, an outline, panels.
#include "ui/render/colourmap.h"
#include "ui/render/passes.h"

#include <algorithm>

namespace ps::render {

void Passes::drawSteam(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const int scale = m_quality.steamScale;
  layers.steam.resize(reduced(frame.width, scale), reduced(frame.height, scale));
  const Range vapours = prepared.instances.vapourRange();
  // Crowded vapour needs fewer sprites a parcel for the same cloud.
  const int sprites = vapours.count > 1500 ? std::max(1, m_quality.steamSprites / 2) : m_quality.steamSprites;
  if (m_quality.compute) {
    computeSteam(job, sprites);
  } else {
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    const Target target({&layers.steam}, nullptr);
    clearColour(0, 0, 0, 0, 0);
    const Program& program = m_drawing->steam;
    program.use();
    steamTextures(program, layers);
    tellSprites(program, sprites, prepared.data);
    drawParticles(program, plain, m_particles, vapours, 2 * sprites);
    glDisable(GL_BLEND);
  }
  clock.mark("vapour");
  m_programs.steamOver.use();
  m_programs.steamOver.texture("steamTexture", 0, layers.steam.name());
  workOver(job, m_programs.steamOver, layers.picture, {m_allTiles, frame.allTiles}, frame.vapourBox);
  clock.mark("vapour over it");
}

void Passes::tellSprites(const Program& program, int sprites, bool data) {
  glUniform1i(program.at("sprites"), sprites);
  glUniform1f(program.at("growth"), 4.6f);
  glUniform1f(program.at("opacity"), (data ? 0.10f : 0.22f) / static_cast<float>(sprites));
}

void Passes::steamTextures(const Program& program, const Layers& layers) {
  program.texture("distanceTexture", 0, layers.distance.name());
  program.texture("cloudTexture", 1, m_cloud.name());
  glUniform1i(program.at("scale"), m_quality.steamScale);
}

void Passes::drawGlass(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const Target target({&layers.picture}, nullptr);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const int fluidScale = prepared.instances.liquids() ? m_quality.fluidScale : 0;
  const VertexArray array;
  array.bind();
  const GLuint fluid = layers.fluid.name();
  const auto draw = [&](const Program& program, const Buffer& buffer, size_t vertices) {
    if (!vertices) return;
    meshAttributes(buffer.name());
    program.texture("fluidTexture", 0, fluid);
    program.texture("distanceTexture", 2, layers.distance.name());
    glUniform1i(program.at("fluidScale"), fluidScale);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices));
  };
  m_programs.glass.use();
  m_programs.glass.texture("noiseTexture", 1, m_noise.name());
  draw(m_programs.glass, m_clear, prepared.furniture.clear.size());
  draw(m_programs.glass, m_clearProps, prepared.props.clear.size());
  m_programs.edge.use();
  glUniform3fv(m_programs.edge.at("tint"), 1, sceneColour(prepared.look.dark, "edge").data());
  glUniform1f(m_programs.edge.at("width"),
              (frame.still ? 2.f : 1.f) * std::max(1.f, static_cast<float>(frame.height) / 1400));
  draw(m_programs.edge, m_edges, prepared.furniture.edges.size());
  glUniform3fv(m_programs.edge.at("tint"), 1, sceneColour(prepared.look.dark, "guide").data());
  draw(m_programs.edge, m_guides, prepared.guides.size());
  glDisable(GL_BLEND);
}

/// Its nearest surface first, and then what that covers.
void Passes::drawGhost(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  layers.ghost.resize(frame.width, frame.height);
  drawNearest(job, layers.ghost, layers.ghostDepth, prepared.instances.ghostRange(), 1);
  const Program& program = m_programs.ghost;
  program.use();
  program.texture("ghostTexture", 0, layers.ghost.name());
  program.texture("distanceTexture", 1, layers.distance.name());
  program.texture("fluidTexture", 2, layers.fluid.name());
  glUniform1i(program.at("fluidScale"), prepared.instances.liquids() ? m_quality.fluidScale : 0);
  glUniform1f(program.at("width"), frame.ghostWidth);
  glUniform3fv(program.at("tint"), 1, prepared.look.ghost->colour.data());
  glUniform3fv(program.at("halo"), 1, prepared.look.ghost->halo.data());
  workOver(job, program, layers.picture, {m_ghostTiles, frame.ghostTiles}, {0, 0, frame.width, frame.height});
}

/// Into the picture itself, which begins at `place` of its framebuffer.
void Passes::drawOutline(const Job& job, const PicturePlace& place) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  // Distances, unlike edges, lose nothing to a smaller mask that is read smoothly.
  layers.mask.resize(reduced(frame.width, m_quality.outlineScale), reduced(frame.height, m_quality.outlineScale));
  const BodyOutline& look = *prepared.look.outline;
  const float reach = frame.lineWidth + frame.haloWidth;
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  {
    const Target target({&layers.mask}, nullptr);
    clearColour(0, 0, 0, 0, 0);
    glBlendEquation(GL_MAX);
    m_programs.outlineMask.use();
    glUniform1f(m_programs.outlineMask.at("reach"), reach);
    drawParticles(m_programs.outlineMask, plain, m_particles, prepared.instances.outlineRange());
    glBlendEquation(GL_FUNC_ADD);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, place.framebuffer);
  glViewport(place.x, place.y, frame.width, frame.height);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  const Program& program = m_programs.outline;
  program.use();
  program.texture("mask", 0, layers.mask.name());
  glUniform2i(program.at("origin"), place.x, place.y);
  glUniform1f(program.at("reach"), reach);
  glUniform1f(program.at("lineWidth"), frame.lineWidth);
  glUniform3fv(program.at("tint"), 1, look.colour.data());
  glUniform3fv(program.at("halo"), 1, look.halo.data());
  drawTiles({m_outlineTiles, frame.outlineTiles});
  glDisable(GL_BLEND);
}

/// In the vertex array that is bound.
void Passes::panelAttributes() {
  glBindBuffer(GL_ARRAY_BUFFER, m_panels.name());
  constexpr GLsizei kStride = 5 * sizeof(float);
  for (const auto& [index, size, offset] : {std::array{0, 3, 0}, {1, 2, 3}}) {
    glEnableVertexAttribArray(static_cast<GLuint>(index));
    glVertexAttribPointer(static_cast<GLuint>(index), size, GL_FLOAT, GL_FALSE, kStride,
                          reinterpret_cast<const void*>(static_cast<size_t>(offset) * sizeof(float)));
  }
}

/// Over the smoothed picture: what is written on them stays sharp. Matter does not hide them, only hands do.
void Passes::drawPanels(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const int scale = frame.still ? 2 : 1;
  glBindFramebuffer(GL_FRAMEBUFFER, frame.place.framebuffer);
  glViewport(frame.place.x, frame.place.y, frame.width / scale, frame.height / scale);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  const Program& program = m_programs.panel;
  program.use();
  program.texture("distanceTexture", 1, layers.distance.name());
  program.texture("normalTexture", 2, layers.normal.name());
  glUniform1i(program.at("scale"), scale);
  glUniform2i(program.at("origin"), frame.place.x, frame.place.y);
  const VertexArray array;
  array.bind();
  panelAttributes();
  auto picture = m_panelPictures.begin();
  for (size_t k = 0; k < prepared.props.panels.size(); ++k) {
    program.texture("image", 0, (picture++)->texture.name());
    glDrawArrays(GL_TRIANGLES, 6 * static_cast<GLint>(k), 6);
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
}

/// Leaves the scissor around the pixels of a target in which something has a distance: cards that are made for
/// computing clear it far faster than they draw.
void Passes::clearAllButDistances(const ViewFrame& frame, const RenderTarget& target) {
  const auto& [width, height, still] = target.size;
  glEnable(GL_SCISSOR_TEST);
  glScissor(target.x, target.y, width, height);
  clearDepth();
  const auto& [x, y, wide, high] = frame.distanceBox;
  const auto low = [](int pixel, int from, int to) { return std::max(pixel * to / from - 1, 0); };
  const auto end = [](int pixel, int from, int to) { return std::min(pixel * to / from + 2, to); };
  const int left = low(x, frame.width, width), bottom = low(y, frame.height, height);
  const int right = end(x + wide, frame.width, width), top = end(y + high, frame.height, height);
  glScissor(target.x + left, target.y + bottom, std::max(right - left, 0), std::max(top - bottom, 0));
}

void Passes::drawDepth(const Prepared& prepared, const ViewFrame& frame, const Layers& layers,
                       const RenderTarget& target, size_t panels) {
  m_fence.wait();
  PassClock clock(m_times);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, m_uniforms.name());
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glViewport(target.x, target.y, target.size.width, target.size.height);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_ALWAYS);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  const Program& program = m_programs.depth;
  program.use();
  program.texture("distanceTexture", 0, layers.distance.name());
  program.texture("fluidTexture", 1, layers.fluid.name());
  glUniform1i(program.at("fluidScale"), prepared.instances.liquids() ? m_quality.fluidScale : 0);
  const VertexArray array;
  array.bind();
  clearAllButDistances(frame, target);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_SCISSOR_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_CULL_FACE);  // panels have one side
  m_programs.panelDepth.use();
  panelAttributes();
  glDrawArrays(GL_TRIANGLES, 0, 6 * static_cast<GLsizei>(std::min(panels, prepared.props.panels.size())));
  glDisable(GL_CULL_FACE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  clock.mark("depths");
  m_fence.set();
}

/// Before all else, so that nothing is drawn where nobody sees it. Into the depth of the target that is bound.
void Passes::hideInDepth(const Job& job) {
  if (!job.frame.hidden) return;
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_ALWAYS);
  glDepthRange(0, 0);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  m_programs.hidden.use();
  drawTiles({m_hiddenTiles, job.frame.hidden->corners});
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthRange(0, 1);
}

/// Black, for who looks on: there the passes before have left what was there.
void Passes::drawHidden(const Job& job) {
  const ViewFrame& frame = job.frame;
  if (!frame.hidden) return;
  const int scale = frame.still ? 2 : 1;
  glBindFramebuffer(GL_FRAMEBUFFER, frame.place.framebuffer);
  glViewport(frame.place.x, frame.place.y, frame.width / scale, frame.height / scale);
  glDisable(GL_DEPTH_TEST);
  m_programs.hidden.use();
  drawTiles({m_hiddenTiles, frame.hidden->corners});
}

}  // namespace ps::render
