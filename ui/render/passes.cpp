// SPDX-License-Identifier: Apache-2.0
#include "ui/render/passes.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace ps::render {
namespace {

constexpr float kFar = 1e6f;              // frame.glsl knows the same
constexpr GLint kMatter = 1, kMetal = 2;  // marks in the stencil: what lights a pixel

constexpr const char* kSoftware[] = {"llvmpipe", "softpipe", "SwiftShader", "SWR"};

int reduced(int pixels, int scale) { return (pixels + scale - 1) / scale; }

// Value noise that repeats after 256 texels; `cells` to a side.
float noiseAt(int x, int y, int cells, uint32_t seed) {
  const auto lattice = [&](int i, int j) {
    uint32_t h = static_cast<uint32_t>(i % cells) * 374761393u + static_cast<uint32_t>(j % cells) * 668265263u +
                 seed * 2246822519u;
    h = (h ^ h >> 13) * 1274126177u;
    return static_cast<float>((h ^ h >> 16) & 0xFFFF) / 65535;
  };
  const int step = 256 / cells;
  const auto curve = [&](int v) {
    const float t = static_cast<float>(v % step) / static_cast<float>(step);
    return t * t * (3 - 2 * t);
  };
  const int i = x / step, j = y / step;
  const float u = curve(x), v = curve(y);
  const float low = lattice(i, j) + (lattice(i + 1, j) - lattice(i, j)) * u;
  const float high = lattice(i, j + 1) + (lattice(i + 1, j + 1) - lattice(i, j + 1)) * u;
  return low + (high - low) * v;
}

// Red: fine grain for brushed metal. Green: clouds.
std::vector<uint8_t> noiseTexels() {
  std::vector<uint8_t> texels(256 * 256 * 4, 255);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      uint8_t* texel = &texels[static_cast<size_t>((y * 256 + x) * 4)];
      const float grain = 0.5f * noiseAt(x, y, 256, 1) + 0.3f * noiseAt(x, y, 128, 2) + 0.2f * noiseAt(x, y, 32, 3);
      float cloud = 0, amplitude = 0.5f;
      for (int cells = 4; cells <= 64; cells *= 2, amplitude *= 0.5f)
        cloud += amplitude * noiseAt(x, y, cells, 10u + static_cast<uint32_t>(cells));
      texel[0] = static_cast<uint8_t>(255 * grain);
      texel[1] = static_cast<uint8_t>(255 * std::min(cloud / 0.97f, 1.f));
    }
  return texels;
}

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

void clearColour(GLint buffer, float r, float g, float b, float a) {
  const float value[] = {r, g, b, a};
  glClearBufferfv(GL_COLOR, buffer, value);
}
// Same size and format: a copy of memory where a processor draws.
void copyPicture(const Texture& from, const Texture& to, const std::array<int, 4>& box) {
  const Target target({&to}, nullptr), source({&from}, nullptr);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.name());
  const int right = box[0] + box[2], top = box[1] + box[3];
  glBlitFramebuffer(box[0], box[1], right, top, box[0], box[1], right, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}
void clearDepth() {
  const float one = 1;
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_DEPTH, 0, &one);
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

void Passes::resize(int width, int height) {
  for (Texture* texture : {&m_surface, &m_normal, &m_distance, &m_depth, &m_picture}) texture->resize(width, height);
  m_open.resize(reduced(width, m_quality.occlusionScale), reduced(height, m_quality.occlusionScale));
}

void Passes::upload(const Frame& frame) {
  m_uniforms.upload(GL_UNIFORM_BUFFER, &frame.uniforms, sizeof frame.uniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, m_uniforms.name());
  const Instances& instances = frame.instances;
  m_particles.upload(GL_TEXTURE_BUFFER, instances.particles.data(), instances.particles.size() * sizeof(Instance));
  const Furniture& furniture = frame.furniture;
  if (m_furniture != frame.furnitureRevision) {
    m_furniture = frame.furnitureRevision;
    m_opaque.upload(GL_ARRAY_BUFFER, furniture.opaque.data(), furniture.opaque.size() * sizeof(MeshVertex));
    m_clear.upload(GL_ARRAY_BUFFER, furniture.clear.data(), furniture.clear.size() * sizeof(MeshVertex));
    m_edges.upload(GL_ARRAY_BUFFER, furniture.edges.data(), furniture.edges.size() * sizeof(EdgeVertex));
  }
  for (const auto& [buffer, tiles] : {std::pair{&m_liquidTiles, &frame.liquidTiles},
                                      {&m_detailTiles, &frame.detailTiles},
                                      {&m_outlineTiles, &frame.outlineTiles}})
    buffer->upload(GL_ARRAY_BUFFER, tiles->data(), tiles->size() * sizeof(TileSet::Corner));
  m_contact.upload(ContactMap::kCells, ContactMap::kCells, GL_RGBA, GL_UNSIGNED_BYTE, frame.contact.texels.data());
}

void Passes::drawParticles(const Program& program, size_t first, size_t vertices) {
  if (!vertices) return;
  m_particleTexture.bind(7, m_particles.name());
  glUniform1i(program.at("particles"), 7);
  glUniform1i(program.at("firstParticle"), static_cast<GLint>(first));
  m_vertexArray->bind();
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices));
}

void Passes::drawTiles(const Buffer& buffer, const std::vector<TileSet::Corner>& tiles) {
  const VertexArray array;
  array.bind();
  glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(tiles.size()));
}

void Passes::drawEverywhere() {
  m_vertexArray->bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Passes::drawShadow(const Frame& frame) {
  const Target target({}, &m_shadow);
  clearDepth();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  const Program& program = m_programs.shadow;
  program.use();
  glUniformMatrix4fv(program.at("toLight"), 1, GL_FALSE, frame.toLight.data());
  glUniform2f(program.at("radiusScale"), frame.shadowScale[0], frame.shadowScale[1]);
  // Clear liquid casts no hard shadow; the contact map dims the floor a little under it.
  drawParticles(program, 0, 3 * (frame.instances.spheres + frame.instances.dense));
}

void Passes::drawSurfaces(const Frame& frame) {
  const Target target({&m_surface, &m_normal, &m_distance}, &m_depth);
  glDepthMask(GL_TRUE);
  glClearBufferfi(GL_DEPTH_STENCIL, 0, 1, 0);
  clearColour(2, kFar, 0, 0, 0);  // the others are read only where something was drawn
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glStencilFunc(GL_ALWAYS, kMatter, 0xFF);
  m_programs.sphere.use();
  drawParticles(m_programs.sphere, 0, 3 * frame.instances.visible);
  if (!frame.furniture.opaque.empty()) {
    glStencilFunc(GL_ALWAYS, kMetal, 0xFF);
    m_programs.mesh.use();
    const VertexArray array;
    array.bind();
    meshAttributes(m_opaque.name());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(frame.furniture.opaque.size()));
  }
  glDisable(GL_STENCIL_TEST);
}

void Passes::drawOcclusion(const Frame& frame) {
  const Target target({&m_open}, nullptr);
  clearColour(0, 1, 1, 1, 1);
  glDisable(GL_DEPTH_TEST);
  const Program& program = m_programs.occlusion;
  program.use();
  program.texture("normalTexture", 0, m_normal.name());
  program.texture("distanceTexture", 1, m_distance.name());
  glUniform1f(program.at("radius"), frame.instances.radius * 4.5f);
  glUniform1i(program.at("samples"), m_quality.occlusionSamples);
  glUniform1i(program.at("scale"), m_quality.occlusionScale);
  drawTiles(m_detailTiles, frame.detailTiles);
}

// The studio is drawn anew only when the camera, the size or the plate changed.
void Passes::drawBackground(const Frame& frame) {
  FrameUniforms key = frame.uniforms;
  key.shadow = {};
  key.contact = key.matter = key.glowTint = {};
  key.matter[3] = frame.uniforms.matter[3];
  key.ground[2] = 0;
  glDisable(GL_DEPTH_TEST);
  // Equal bytes are meant: what the shader would be handed. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  if (std::memcmp(&key, &m_backgroundUniforms, sizeof key) == 0) return;
  m_backgroundUniforms = key;
  m_background.resize(frame.width, frame.height);
  const Target target({&m_background}, nullptr);
  m_programs.background.use();
  drawEverywhere();
}

void Passes::drawLight(const Frame& frame) {
  drawBackground(frame);
  copyPicture(m_background, m_picture, {0, 0, frame.width, frame.height});
  const Target target({&m_picture}, &m_depth);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  for (const auto& [program, kind] : {std::pair{&m_programs.lightMetal, kMetal}, {&m_programs.lightMatter, kMatter}}) {
    glStencilFunc(GL_EQUAL, kind, 0xFF);
    program->use();
    program->texture("surfaceTexture", 0, m_surface.name());
    program->texture("normalTexture", 1, m_normal.name());
    program->texture("distanceTexture", 2, m_distance.name());
    program->texture("openTexture", 3, m_open.name());
    program->texture("shadowTexture", 4, m_shadow.name());
    program->texture("contactTexture", 5, m_contact.name());
    program->texture("noiseTexture", 6, m_noise.name());
    glUniform1i(program->at("shadowTaps"), m_quality.shadowTaps);
    drawEverywhere();
  }
  glDisable(GL_STENCIL_TEST);
}

void Passes::drawFluid(const Frame& frame) {
  const int scale = m_quality.fluidScale, width = reduced(frame.width, scale), height = reduced(frame.height, scale);
  for (Texture* texture : {&m_fluid, &m_fluidOther, &m_fluidColour, &m_fluidClear, &m_fluidDepth, &m_fluidNormal})
    texture->resize(width, height);
  m_behind.resize(frame.width, frame.height);
  const size_t first = frame.instances.spheres, count = frame.instances.liquids;
  {
    const Target target({&m_fluid}, &m_fluidDepth);
    clearDepth();
    clearColour(0, kFar, 0, 0, 0);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    m_programs.fluidDepth.use();
    glUniform1f(m_programs.fluidDepth.at("growth"), 1.25f);
    drawParticles(m_programs.fluidDepth, first, 3 * count);
  }
  {
    const Target target({&m_fluidColour, &m_fluidClear}, nullptr);
    clearColour(0, 0, 0, 0, 0);
    clearColour(1, 0, 0, 0, 0);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    m_programs.fluidColour.use();
    m_programs.fluidColour.texture("distanceTexture", 0, m_distance.name());
    glUniform1i(m_programs.fluidColour.at("scale"), scale);
    glUniform1f(m_programs.fluidColour.at("growth"), 1.7f);
    drawParticles(m_programs.fluidColour, first, 3 * count);
    glDisable(GL_BLEND);
  }
  smoothFluid(frame);

  copyPicture(m_picture, m_behind, {0, 0, frame.width, frame.height});
  const Target target({&m_picture}, nullptr);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  const Program& program = m_programs.fluidLight;
  program.use();
  program.texture("fluidTexture", 0, m_fluid.name());
  program.texture("fluidColour", 1, m_fluidColour.name());
  program.texture("fluidNormal", 5, m_fluidNormal.name());
  program.texture("fluidClear", 6, m_fluidClear.name());
  program.texture("distanceTexture", 2, m_distance.name());
  program.texture("behindTexture", 3, m_behind.name());
  program.texture("shadowTexture", 4, m_shadow.name());
  drawTiles(m_liquidTiles, frame.liquidTiles);
  glDisable(GL_BLEND);
}

void Passes::smoothFluid(const Frame& frame) {
  const Program& program = m_programs.fluidSmooth;
  program.use();
  glUniform1i(program.at("limit"), m_quality.fluidTaps * (frame.still ? 2 : 1));
  glDepthMask(GL_FALSE);
  glEnable(GL_DEPTH_TEST);
  for (int pass = 0; pass < 2 * m_quality.fluidRounds; ++pass) {
    const Texture& from = pass % 2 ? m_fluidOther : m_fluid;
    const Texture& to = pass % 2 ? m_fluid : m_fluidOther;
    const Target target({&to}, &m_fluidDepth);
    glDepthFunc(GL_GREATER);  // where there is liquid
    if (pass == 0) clearColour(0, kFar, 0, 0, 0);
    program.texture("fluidTexture", 0, from.name());
    glUniform2i(program.at("direction"), pass % 2 ? 0 : 1, pass % 2 ? 1 : 0);
    glUniform1f(program.at("width"), frame.instances.radius * (pass < 2 ? 1.5f : 0.8f));
    glUniform1i(program.at("fine"), pass >= 2);
    drawTiles(m_liquidTiles, frame.liquidTiles);
  }
  const Target target({&m_fluidNormal}, &m_fluidDepth);
  clearColour(0, 0.5f, 0.5f, 1, 1);
  m_programs.fluidNormal.use();
  m_programs.fluidNormal.texture("fluidTexture", 0, m_fluid.name());
  drawTiles(m_liquidTiles, frame.liquidTiles);
  glDisable(GL_DEPTH_TEST);
}

void Passes::drawSteam(const Frame& frame) {
  const int scale = m_quality.steamScale;
  m_steam.resize(reduced(frame.width, scale), reduced(frame.height, scale));
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const size_t count = frame.instances.vapours;
  // Crowded vapour needs fewer sprites a parcel for the same cloud.
  const int sprites = count > 1500 ? std::max(1, m_quality.steamSprites / 2) : m_quality.steamSprites;
  {
    const Target target({&m_steam}, nullptr);
    clearColour(0, 0, 0, 0, 0);
    const Program& program = m_programs.steam;
    program.use();
    program.texture("distanceTexture", 0, m_distance.name());
    program.texture("cloudTexture", 1, m_cloud.name());
    glUniform1i(program.at("scale"), scale);
    glUniform1i(program.at("sprites"), sprites);
    glUniform1f(program.at("growth"), 4.6f);
    glUniform1f(program.at("opacity"), (frame.data ? 0.10f : 0.22f) / static_cast<float>(sprites));
    drawParticles(program, frame.instances.spheres + frame.instances.liquids, 6 * count * static_cast<size_t>(sprites));
  }
  const Target target({&m_picture}, nullptr);
  m_programs.steamOver.use();
  m_programs.steamOver.texture("steamTexture", 0, m_steam.name());
  glEnable(GL_SCISSOR_TEST);
  glScissor(frame.vapourBox[0], frame.vapourBox[1], frame.vapourBox[2], frame.vapourBox[3]);
  drawEverywhere();
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
}

void Passes::drawGlass(const Frame& frame) {
  const Target target({&m_picture}, &m_depth);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const int fluidScale = frame.instances.liquids ? m_quality.fluidScale : 0;
  const VertexArray array;
  array.bind();
  const auto draw = [&](const Program& program, const Buffer& buffer, size_t vertices) {
    if (!vertices) return;
    meshAttributes(buffer.name());
    program.texture("fluidTexture", 0, m_fluid.name());
    glUniform1i(program.at("fluidScale"), fluidScale);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices));
  };
  m_programs.glass.use();
  m_programs.glass.texture("noiseTexture", 1, m_noise.name());
  draw(m_programs.glass, m_clear, frame.furniture.clear.size());
  m_programs.edge.use();
  glUniform3fv(m_programs.edge.at("tint"), 1, frame.edgeTint.data());
  glUniform1f(m_programs.edge.at("width"),
              (frame.still ? 2.f : 1.f) * std::max(1.f, static_cast<float>(frame.height) / 1400));
  draw(m_programs.edge, m_edges, frame.furniture.edges.size());
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
}

void Passes::drawOutline(const Frame& frame, GLuint framebuffer) {
  // Distances, unlike edges, lose nothing to a smaller mask that is read smoothly.
  m_mask.resize(reduced(frame.width, m_quality.outlineScale), reduced(frame.height, m_quality.outlineScale));
  const Instances& instances = frame.instances;
  const float reach = frame.outlined.lineWidth + frame.outlined.haloWidth;
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  {
    const Target target({&m_mask}, nullptr);
    clearColour(0, 0, 0, 0, 0);
    glBlendEquation(GL_MAX);
    m_programs.outlineMask.use();
    glUniform1f(m_programs.outlineMask.at("reach"), reach);
    drawParticles(m_programs.outlineMask, instances.spheres + instances.liquids + instances.vapours,
                  3 * instances.outlined);
    glBlendEquation(GL_FUNC_ADD);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, frame.width, frame.height);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  const Program& program = m_programs.outline;
  program.use();
  program.texture("mask", 0, m_mask.name());
  glUniform1f(program.at("reach"), reach);
  glUniform1f(program.at("lineWidth"), frame.outlined.lineWidth);
  glUniform3fv(program.at("tint"), 1, frame.outlined.colour.data());
  glUniform3fv(program.at("halo"), 1, frame.outlined.halo.data());
  drawTiles(m_outlineTiles, frame.outlineTiles);
  glDisable(GL_BLEND);
}

void Passes::drawFinal(const Frame& frame, GLuint framebuffer) {
  const int scale = frame.still ? 2 : 1, width = frame.width / scale, height = frame.height / scale;
  if (!frame.still) {
    const Target source({&m_picture}, nullptr);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  const Program& program = frame.still ? m_programs.still : m_programs.final;
  program.use();
  program.texture("picture", 0, m_picture.name());
  glUniform1i(program.at("still"), frame.still);
  if (frame.still)
    drawEverywhere();
  else
    drawTiles(m_detailTiles, frame.detailTiles);
}

void Passes::draw(const Frame& frame, GLuint framebuffer) {
  const VertexArray plain;
  m_vertexArray = &plain;
  resize(frame.width, frame.height);
  upload(frame);
  drawShadow(frame);
  drawSurfaces(frame);
  drawOcclusion(frame);
  drawLight(frame);
  if (frame.instances.liquids) drawFluid(frame);
  if (!frame.lidInFront) drawGlass(frame);
  if (frame.instances.vapours) drawSteam(frame);
  if (frame.lidInFront) drawGlass(frame);
  // Smoothing stair steps would wash out so thin a line, which has smooth sides of its own.
  if (frame.instances.outlined && frame.still) drawOutline(frame, Target({&m_picture}, nullptr).name());
  drawFinal(frame, framebuffer);
  if (frame.instances.outlined && !frame.still) drawOutline(frame, framebuffer);
  m_vertexArray = nullptr;
}

}  // namespace ps::render
