// SPDX-License-Identifier: Apache-2.0
#include "ui/render/passes.h"

#include "ui/render/colourmap.h"
#include "ui/render/noise.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace ps::render {
namespace {

constexpr int kFineRows = 1600;
constexpr GLint kMatter = 1, kMetal = 2;  // marks in the stencil: what lights a pixel

constexpr const char* kSoftware[] = {"llvmpipe", "softpipe", "SwiftShader", "SWR"};

void meshAttributes(GLuint buffer) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  const GLint sizes[] = {3, 3, 4};
  const GLsizei stride = 10 * sizeof(float);
  size_t offset = 0;
  for (GLuint i = 0; i < 3; ++i) {
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, stride, reinterpret_cast<const void*>(offset));
    offset += static_cast<size_t>(sizes[i]) * sizeof(float);
  }
}
static_assert(sizeof(MeshVertex) == 40 && sizeof(EdgeVertex) == 40 && sizeof(Instance) == 32);
static_assert(sizeof(FrameUniforms) == 4 * 64 + 9 * 16);

void drawEverywhere(const VertexArray& plain) {
  plain.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace

Quality qualityOf(const char* rendererName) {
  for (const char* name : kSoftware)
    if (rendererName && std::strstr(rendererName, name)) return {512, 2, 2, 6, 2, 5, 2, 4, 2, 2, true};
  return {};
}

Passes::Passes() : m_quality(qualityOf(reinterpret_cast<const char*>(glGetString(GL_RENDERER)))) {
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &m_largest);
  glBindTexture(GL_TEXTURE_2D, m_shadow.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  m_shadow.resize(m_quality.shadowSize, m_quality.shadowSize);
  m_noise.upload(256, 256, GL_RGBA, GL_UNSIGNED_BYTE, noiseTexels().data());
  glGenerateMipmap(GL_TEXTURE_2D);
  // One channel of every second texel of the clouds: soft, small, and cheap to look up.
  const std::vector<uint8_t> noise = noiseTexels();
  std::vector<uint8_t> cloud(128 * 128);
  for (size_t i = 0; i < cloud.size(); ++i) cloud[i] = noise[(i / 128 * 2 * 256 + i % 128 * 2) * 4 + 1];
  m_cloud.upload(128, 128, GL_RED, GL_UNSIGNED_BYTE, cloud.data());
}

void Passes::uploadPrepared(const Prepared& prepared) {
  const std::vector<Instance>& particles = prepared.instances.particles;
  m_particles.upload(GL_TEXTURE_BUFFER, particles.data(), particles.size() * sizeof(Instance));
  m_contact.upload(ContactMap::kCells, ContactMap::kCells, GL_RGBA, GL_UNSIGNED_BYTE, prepared.contact.texels.data());
  m_guides.upload(GL_ARRAY_BUFFER, prepared.guides.data(), prepared.guides.size() * sizeof(EdgeVertex));
  if (m_furniture == prepared.furnitureRevision) return;
  m_furniture = prepared.furnitureRevision;
  const Furniture& furniture = prepared.furniture;
  m_opaque.upload(GL_ARRAY_BUFFER, furniture.opaque.data(), furniture.opaque.size() * sizeof(MeshVertex));
  m_clear.upload(GL_ARRAY_BUFFER, furniture.clear.data(), furniture.clear.size() * sizeof(MeshVertex));
  m_edges.upload(GL_ARRAY_BUFFER, furniture.edges.data(), furniture.edges.size() * sizeof(EdgeVertex));
}

void Passes::show(const Props& props) {
  m_fence.wait();
  for (const auto& [buffer, mesh] : {std::pair{&m_opaqueProps, &props.opaque}, {&m_clearProps, &props.clear}})
    buffer->upload(GL_ARRAY_BUFFER, mesh->data(), mesh->size() * sizeof(MeshVertex));
  std::vector<std::array<float, 5>> corners;
  while (m_panelPictures.size() < props.panels.size()) m_panelPictures.emplace_back();
  auto picture = m_panelPictures.begin();
  for (const Panel& panel : props.panels) {
    for (const size_t k : {0, 1, 2, 0, 2, 3}) {
      const std::array<float, 3> at = floats(panel.corners[k]);
      corners.push_back({at[0], at[1], at[2], k == 1 || k == 2 ? 1.f : 0.f, k < 2 ? 1.f : 0.f});
    }
    PanelPicture& held = *picture++;
    if (held.image == panel.image) continue;
    held.image = panel.image;
    held.texture.upload(panel.image->width, panel.image->height, GL_RGBA, GL_UNSIGNED_BYTE, panel.image->pixels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
  }
  m_panels.upload(GL_ARRAY_BUFFER, corners.data(), corners.size() * sizeof(corners[0]));
  m_fence.set();
}

void Passes::uploadFrame(const ViewFrame& frame) {
  m_uniforms.upload(GL_UNIFORM_BUFFER, &frame.uniforms, sizeof frame.uniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, m_uniforms.name());
  if (frame.culled) m_visible.upload(GL_TEXTURE_BUFFER, frame.visible.data(), frame.visible.size() * sizeof(Instance));
  for (const auto& [buffer, tiles] : {std::pair{&m_liquidTiles, &frame.liquidTiles},
                                      {&m_detailTiles, &frame.detailTiles},
                                      {&m_outlineTiles, &frame.outlineTiles},
                                      {&m_ghostTiles, &frame.ghostTiles}})
    buffer->upload(GL_ARRAY_BUFFER, tiles->data(), tiles->size() * sizeof(TileSet::Corner));
}

void Passes::drawParticles(const Program& program, const VertexArray& plain, const Buffer& particles, Range range,
                           int triangles) {
  if (!range.count) return;
  m_particleTexture.bind(7, particles.name());
  glUniform1i(program.at("particles"), 7);
  glUniform1i(program.at("firstParticle"), static_cast<GLint>(range.first));
  plain.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3 * triangles * static_cast<GLsizei>(range.count));
}

void Passes::drawTiles(const Buffer& buffer, const std::vector<TileSet::Corner>& tiles) {
  const VertexArray array;
  array.bind();
  glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(tiles.size()));
}

void Passes::drawShadow(const Prepared& prepared, const VertexArray& plain) {
  const Target target({}, &m_shadow);
  clearDepth();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  const Program& program = m_programs.shadow;
  program.use();
  glUniformMatrix4fv(program.at("toLight"), 1, GL_FALSE, prepared.toLight.data());
  glUniform2f(program.at("radiusScale"), prepared.shadowScale[0], prepared.shadowScale[1]);
  // Clear liquid casts no hard shadow; the contact map dims the floor a little under it.
  drawParticles(program, plain, m_particles, prepared.instances.casterRange());
}

void Passes::drawSurfaces(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  const Target target({&layers.surface, &layers.normal, &layers.distance}, &layers.depth);
  glDepthMask(GL_TRUE);
  glClearBufferfi(GL_DEPTH_STENCIL, 0, 1, 0);
  clearColour(2, kFar, 0, 0, 0);  // the others are read only where something was drawn
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glStencilFunc(GL_ALWAYS, kMatter, 0xFF);
  m_programs.sphere.use();
  if (frame.culled)
    drawParticles(m_programs.sphere, plain, m_visible, {0, frame.visible.size()});
  else
    drawParticles(m_programs.sphere, plain, m_particles, prepared.instances.sphereRange(frame.amongSpheres));
  const auto drawMesh = [this](GLint mark, const Buffer& buffer, const std::vector<MeshVertex>& mesh, float ofScene) {
    if (mesh.empty()) return;
    glStencilFunc(GL_ALWAYS, mark, 0xFF);
    m_programs.mesh.use();
    glUniform1f(m_programs.mesh.at("ofScene"), ofScene);
    const VertexArray array;
    array.bind();
    meshAttributes(buffer.name());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(mesh.size()));
  };
  drawMesh(kMatter, m_opaqueProps, prepared.props.opaque, 0);
  drawMesh(kMetal, m_opaque, prepared.furniture.opaque, 1);
  glDisable(GL_STENCIL_TEST);
}

void Passes::drawOcclusion(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  // Crevices are soft: beyond the rows of a desktop's view each second pixel is enough.
  const int scale = std::max(m_quality.occlusionScale, frame.height > kFineRows ? 2 : 1);
  layers.open.resize(reduced(frame.width, scale), reduced(frame.height, scale));
  const Target target({&layers.open}, nullptr);
  clearColour(0, 1, 1, 1, 1);
  glDisable(GL_DEPTH_TEST);
  const Program& program = m_programs.occlusion;
  program.use();
  program.texture("normalTexture", 0, layers.normal.name());
  program.texture("distanceTexture", 1, layers.distance.name());
  glUniform1f(program.at("radius"), prepared.instances.radius * 4.5f);
  glUniform1i(program.at("samples"), m_quality.occlusionSamples);
  glUniform1i(program.at("scale"), scale);
  drawTiles(m_detailTiles, frame.detailTiles);
}

// The studio is drawn anew only when the camera, the size or the plate changed.
const Texture& Passes::drawBackground(const Job& job) {
  FrameUniforms key = job.frame.uniforms;
  key.shadow = {};
  key.contact = key.matter = key.glowTint = {};
  key.matter[3] = job.frame.uniforms.matter[3];
  key.ground[2] = 0;
  glDisable(GL_DEPTH_TEST);
  Layers::Background& background = job.layers.backgroundOf(job.frame.place);
  // Equal bytes are meant: what the shader would be handed. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  if (std::memcmp(&key, &background.uniforms, sizeof key) == 0) return background.picture;
  background.uniforms = key;
  background.picture.resize(job.frame.width, job.frame.height);
  const Target target({&background.picture}, nullptr);
  m_programs.background.use();
  drawEverywhere(job.plain);
  return background.picture;
}

void Passes::drawLight(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  const auto& backdrop = prepared.look.backdrop;
  if (!backdrop) copyPicture(drawBackground(job), layers.picture, {0, 0, frame.width, frame.height});
  const Target target({&layers.picture}, &layers.depth);
  if (backdrop) clearColour(0, (*backdrop)[0], (*backdrop)[1], (*backdrop)[2], 1);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  for (const auto& [program, kind] : {std::pair{&m_programs.lightMetal, kMetal}, {&m_programs.lightMatter, kMatter}}) {
    glStencilFunc(GL_EQUAL, kind, 0xFF);
    program->use();
    program->texture("surfaceTexture", 0, layers.surface.name());
    program->texture("normalTexture", 1, layers.normal.name());
    program->texture("distanceTexture", 2, layers.distance.name());
    program->texture("openTexture", 3, layers.open.name());
    program->texture("shadowTexture", 4, m_shadow.name());
    program->texture("contactTexture", 5, m_contact.name());
    program->texture("noiseTexture", 6, m_noise.name());
    glUniform1i(program->at("shadowTaps"), m_quality.shadowTaps);
    drawEverywhere(plain);
  }
  glDisable(GL_STENCIL_TEST);
}

void Passes::drawSteam(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  const int scale = m_quality.steamScale;
  layers.steam.resize(reduced(frame.width, scale), reduced(frame.height, scale));
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const Range vapours = prepared.instances.vapourRange();
  // Crowded vapour needs fewer sprites a parcel for the same cloud.
  const int sprites = vapours.count > 1500 ? std::max(1, m_quality.steamSprites / 2) : m_quality.steamSprites;
  {
    const Target target({&layers.steam}, nullptr);
    clearColour(0, 0, 0, 0, 0);
    const Program& program = m_programs.steam;
    program.use();
    program.texture("distanceTexture", 0, layers.distance.name());
    program.texture("cloudTexture", 1, m_cloud.name());
    glUniform1i(program.at("scale"), scale);
    glUniform1i(program.at("sprites"), sprites);
    glUniform1f(program.at("growth"), 4.6f);
    glUniform1f(program.at("opacity"), (prepared.data ? 0.10f : 0.22f) / static_cast<float>(sprites));
    drawParticles(program, plain, m_particles, vapours, 2 * sprites);
  }
  const Target target({&layers.picture}, nullptr);
  m_programs.steamOver.use();
  m_programs.steamOver.texture("steamTexture", 0, layers.steam.name());
  glEnable(GL_SCISSOR_TEST);
  glScissor(frame.vapourBox[0], frame.vapourBox[1], frame.vapourBox[2], frame.vapourBox[3]);
  drawEverywhere(plain);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
}

void Passes::drawGlass(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  const Target target({&layers.picture}, &layers.depth);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_FALSE);
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
  glDisable(GL_DEPTH_TEST);
}

/// Its nearest surface first, and then what that covers.
void Passes::drawGhost(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
  layers.ghost.resize(frame.width, frame.height);
  layers.ghostDepth.resize(frame.width, frame.height);
  {
    const Target target({&layers.ghost}, &layers.ghostDepth);
    clearDepth();
    clearColour(0, kFar, 0, 0, 0);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    m_programs.fluidDepth.use();
    glUniform1f(m_programs.fluidDepth.at("growth"), 1);
    drawParticles(m_programs.fluidDepth, plain, m_particles, prepared.instances.ghostRange());
    glDisable(GL_DEPTH_TEST);
  }
  const Target target({&layers.picture}, nullptr);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  const Program& program = m_programs.ghost;
  program.use();
  program.texture("ghostTexture", 0, layers.ghost.name());
  program.texture("distanceTexture", 1, layers.distance.name());
  program.texture("fluidTexture", 2, layers.fluid.name());
  glUniform1i(program.at("fluidScale"), prepared.instances.liquids() ? m_quality.fluidScale : 0);
  glUniform1f(program.at("width"), frame.ghostWidth);
  glUniform3fv(program.at("tint"), 1, prepared.look.ghost->colour.data());
  glUniform3fv(program.at("halo"), 1, prepared.look.ghost->halo.data());
  drawTiles(m_ghostTiles, frame.ghostTiles);
  glDisable(GL_BLEND);
}

/// Into the picture itself, which begins at `place` of its framebuffer.
void Passes::drawOutline(const Job& job, const PicturePlace& place) {
  const auto& [prepared, frame, layers, plain] = job;
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
  drawTiles(m_outlineTiles, frame.outlineTiles);
  glDisable(GL_BLEND);
}

void Passes::drawFinal(const Job& job) {
  const ViewFrame& frame = job.frame;
  const auto [framebuffer, x, y] = frame.place;
  const int scale = frame.still ? 2 : 1, width = frame.width / scale, height = frame.height / scale;
  if (!frame.still) {
    const Target source({&job.layers.picture}, nullptr);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, width, height, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(x, y, width, height);
  const Program& program = frame.still ? m_programs.still : m_programs.final;
  program.use();
  program.texture("picture", 0, job.layers.picture.name());
  glUniform1i(program.at("still"), frame.still);
  glUniform2i(program.at("origin"), x, y);
  if (frame.still)
    drawEverywhere(job.plain);
  else
    drawTiles(m_detailTiles, frame.detailTiles);
}

/// Over the smoothed picture: what is written on them stays sharp. Matter does not hide them, only hands do.
void Passes::drawPanels(const Job& job) {
  const auto& [prepared, frame, layers, plain] = job;
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
  glBindBuffer(GL_ARRAY_BUFFER, m_panels.name());
  constexpr GLsizei kStride = 5 * sizeof(float);
  for (const auto& [index, size, offset] : {std::array{0, 3, 0}, {1, 2, 3}}) {
    glEnableVertexAttribArray(static_cast<GLuint>(index));
    glVertexAttribPointer(static_cast<GLuint>(index), size, GL_FLOAT, GL_FALSE, kStride,
                          reinterpret_cast<const void*>(static_cast<size_t>(offset) * sizeof(float)));
  }
  auto picture = m_panelPictures.begin();
  for (size_t k = 0; k < prepared.props.panels.size(); ++k) {
    program.texture("image", 0, (picture++)->texture.name());
    glDrawArrays(GL_TRIANGLES, 6 * static_cast<GLint>(k), 6);
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
}

void Passes::prepare(const Prepared& prepared) {
  const VertexArray plain;
  m_fence.wait();
  uploadPrepared(prepared);
  drawShadow(prepared, plain);
  m_fence.set();
}

void Passes::draw(const Prepared& prepared, const ViewFrame& frame, Layers& layers) {
  const VertexArray plain;
  const Job job{prepared, frame, layers, plain};
  m_fence.wait();
  uploadFrame(frame);
  drawSurfaces(job);
  drawOcclusion(job);
  drawLight(job);
  if (prepared.instances.liquids()) drawFluid(job);
  if (!frame.lidInFront) drawGlass(job);
  if (prepared.instances.vapours) drawSteam(job);
  if (frame.lidInFront) drawGlass(job);
  if (prepared.instances.ghosts) drawGhost(job);
  // Smoothing stair steps would wash out so thin a line, which has smooth sides of its own.
  if (prepared.instances.outlined && frame.still) drawOutline(job, {Target({&layers.picture}, nullptr).name(), 0, 0});
  drawFinal(job);
  if (prepared.instances.outlined && !frame.still) drawOutline(job, frame.place);
  if (!prepared.props.panels.empty()) drawPanels(job);
  m_fence.set();
}

}  // namespace ps::render
