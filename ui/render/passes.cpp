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

static_assert(sizeof(MeshVertex) == 40 && sizeof(EdgeVertex) == 40 && sizeof(Instance) == 32);
static_assert(sizeof(FrameUniforms) == 4 * 64 + 9 * 16);

void drawEverywhere(const VertexArray& plain) {
  plain.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace

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

Quality qualityOf(const char* rendererName, PixelWork work) {
  Quality quality;
  for (const char* name : kSoftware)
    if (rendererName && std::strstr(rendererName, name)) quality = {512, 2, 2, 6, 2, 5, 2, 4, 2, 2, true, false, true};
  if (work != PixelWork::AsSuitsTheCard) quality.compute = work == PixelWork::Computed;
  quality.cull = quality.cull && !quality.compute;
  return quality;
}

Quality coarser(const Quality& full, int steps) {
  Quality quality = full;
  for (int step = 0; step < std::min(steps, kSoftSteps); ++step)
    for (int* samples : {&quality.shadowTaps, &quality.occlusionSamples, &quality.fluidTaps, &quality.fluidRounds,
                         &quality.steamSprites})
      *samples = std::max(1, *samples / 2);
  return quality;
}

Passes::Passes(PixelWork work)
    : m_quality(qualityOf(reinterpret_cast<const char*>(glGetString(GL_RENDERER)), work)),
      m_full(m_quality),
      m_programs(m_quality.compute),
      m_shadow(m_quality.compute ? GL_R32F : GL_DEPTH_COMPONENT24, m_quality.compute ? GL_NEAREST : GL_LINEAR) {
  if (m_quality.compute)
    m_computing.emplace();
  else
    m_drawing.emplace();
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &m_largest);
  glBindTexture(GL_TEXTURE_2D, m_shadow.name());
  if (!m_quality.compute) glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
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
  PassClock clock(m_times);
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
  clock.mark("props uploaded");
  m_fence.set();
}

void Passes::uploadFrame(const ViewFrame& frame) {
  m_uniforms.upload(GL_UNIFORM_BUFFER, &frame.uniforms, sizeof frame.uniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, m_uniforms.name());
  if (frame.culled) m_visible.upload(GL_TEXTURE_BUFFER, frame.visible.data(), frame.visible.size() * sizeof(Instance));
  for (const auto& [buffer, tiles] : {std::pair{&m_liquidTiles, &frame.liquidTiles},
                                      {&m_detailTiles, &frame.detailTiles},
                                      {&m_outlineTiles, &frame.outlineTiles},
                                      {&m_ghostTiles, &frame.ghostTiles},
                                      {&m_allTiles, &frame.allTiles}})
    buffer->upload(GL_ARRAY_BUFFER, tiles->data(), tiles->size() * sizeof(TileSet::Corner));
  if (frame.hidden)
    m_hiddenTiles.upload(GL_ARRAY_BUFFER, frame.hidden->corners.data(),
                         frame.hidden->corners.size() * sizeof(TileSet::Corner));
  if (!m_quality.compute) return;
  static const std::vector<uint32_t> kAllSeen{0, 0};
  const std::vector<uint32_t>& bits = frame.hidden ? frame.hidden->bits : kAllSeen;
  m_hiddenBits.upload(GL_SHADER_STORAGE_BUFFER, bits.data(), bits.size() * sizeof(uint32_t));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, m_hiddenBits.name());
}

void Passes::drawParticles(const Program& program, const VertexArray& plain, const Buffer& particles, Range range,
                           int triangles) {
  if (!range.count) return;
  tellParticles(program, particles, range);
  plain.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3 * triangles * static_cast<GLsizei>(range.count));
}

void Passes::tellParticles(const Program& program, const Buffer& particles, Range range) {
  m_particleTexture.bind(7, particles.name());
  glUniform1i(program.at("particles"), 7);
  glUniform1i(program.at("firstParticle"), static_cast<GLint>(range.first));
}

void Passes::drawTiles(const Tiles& tiles) {
  const VertexArray array;
  array.bind();
  glBindBuffer(GL_ARRAY_BUFFER, tiles.buffer.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(tiles.corners.size()));
}

void Passes::drawShadow(const Prepared& prepared, const VertexArray& plain) {
  const Target target({}, &m_shadow);
  clearDepth();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  const Program& program = m_drawing->shadow;
  program.use();
  glUniformMatrix4fv(program.at("toLight"), 1, GL_FALSE, prepared.toLight.data());
  glUniform2f(program.at("radiusScale"), prepared.shadowScale[0], prepared.shadowScale[1]);
  // Clear liquid casts no hard shadow; the contact map dims the floor a little under it.
  drawParticles(program, plain, m_particles, prepared.instances.casterRange());
}

void Passes::drawSurfaces(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  layers.depth.resize(frame.width, frame.height);
  const Target target({&layers.surface, &layers.normal, &layers.distance}, &layers.depth);
  glDepthMask(GL_TRUE);
  glClearBufferfi(GL_DEPTH_STENCIL, 0, 1, 0);
  clearColour(2, kFar, 0, 0, 0);  // the others are read only where something was drawn
  hideInDepth(job);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  glStencilFunc(GL_ALWAYS, kMatter, 0xFF);
  m_drawing->sphere.use();
  if (frame.culled)
    drawParticles(m_drawing->sphere, plain, m_visible, {0, frame.visible.size()});
  else
    drawParticles(m_drawing->sphere, plain, m_particles, prepared.instances.sphereRange(frame.amongSpheres));
  const Program& mesh = m_drawing->mesh;
  mesh.use();
  glUniform1f(mesh.at("belongs"), 0);  // kHand, then kFurniture in frame.glsl
  drawMesh(mesh, m_opaqueProps, prepared.props.opaque);
  glStencilFunc(GL_ALWAYS, kMetal, 0xFF);
  glUniform1f(mesh.at("belongs"), 2 / 3.f);
  drawMesh(mesh, m_opaque, prepared.furniture.opaque);
  glDisable(GL_STENCIL_TEST);
}

void Passes::drawMesh(const Program& program, const Buffer& buffer, const std::vector<MeshVertex>& mesh) {
  if (mesh.empty()) return;
  program.use();
  const VertexArray array;
  array.bind();
  meshAttributes(buffer.name());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(mesh.size()));
}

void Passes::drawOcclusion(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  // Crevices are soft: beyond the rows of a desktop's view each second pixel is enough.
  const int scale = std::max(m_quality.occlusionScale, frame.height > kFineRows ? 2 : 1);
  layers.open.resize(reduced(frame.width, scale), reduced(frame.height, scale));
  glDisable(GL_DEPTH_TEST);
  if (!m_quality.compute) {
    const Target target({&layers.open}, nullptr);
    clearColour(0, 1, 1, 1, 1);
  }
  const Program& program = m_programs.occlusion;
  program.use();
  program.texture("normalTexture", 0, layers.normal.name());
  program.texture("distanceTexture", 1, layers.distance.name());
  glUniform1f(program.at("radius"), prepared.instances.radius * 4.5f);
  glUniform1i(program.at("samples"), m_quality.occlusionSamples);
  glUniform1i(program.at("scale"), scale);
  work(program, layers.open, {m_detailTiles, frame.detailTiles});
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
  m_drawing->background.use();
  drawEverywhere(job.plain);
  return background.picture;
}

void Passes::drawLight(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const auto& backdrop = prepared.look.backdrop;
  if (!backdrop) copyPicture(drawBackground(job), layers.picture, {0, 0, frame.width, frame.height});
  const Target target({&layers.picture}, &layers.depth);
  if (backdrop) clearColour(0, (*backdrop)[0], (*backdrop)[1], (*backdrop)[2], 1);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  for (const auto& [program, kind] : {std::pair{&m_drawing->lightMetal, kMetal}, {&m_drawing->lightMatter, kMatter}}) {
    glStencilFunc(GL_EQUAL, kind, 0xFF);
    program->use();
    lightTextures(*program, layers);
    drawEverywhere(plain);
  }
  glDisable(GL_STENCIL_TEST);
}

void Passes::lightTextures(const Program& program, const Layers& layers) {
  program.texture("surfaceTexture", 0, layers.surface.name());
  program.texture("normalTexture", 1, layers.normal.name());
  program.texture("distanceTexture", 2, layers.distance.name());
  program.texture("openTexture", 3, layers.open.name());
  program.texture("shadowTexture", 4, m_shadow.name());
  program.texture("contactTexture", 5, m_contact.name());
  program.texture("noiseTexture", 6, m_noise.name());
  glUniform1i(program.at("shadowTaps"), m_shadowless ? 0 : m_quality.shadowTaps);
}

void Passes::drawFinal(const Job& job) {
  const ViewFrame& frame = job.frame;
  const auto [framebuffer, x, y] = frame.place;
  const int scale = frame.still ? 2 : 1, width = frame.width / scale, height = frame.height / scale;
  // Where all of it is smoothed, nothing of it needs to be there before.
  if (!frame.still && !frame.detail.full()) {
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
    drawTiles({m_detailTiles, frame.detailTiles});
}

void Passes::prepare(const Prepared& prepared) {
  const VertexArray plain;
  m_fence.wait();
  PassClock clock(m_times);
  uploadPrepared(prepared);
  clock.mark("matter uploaded");
  if (m_quality.compute)
    computeShadow(prepared);
  else
    drawShadow(prepared, plain);
  clock.mark("shadow");
  m_fence.set();
}

void Passes::draw(const Prepared& prepared, const ViewFrame& frame, Layers& layers) {
  const VertexArray plain;
  m_quality = coarser(m_full, frame.coarser);
  m_fence.wait();
  PassClock clock(m_times);
  const Job job{prepared, frame, layers, plain, clock};
  uploadFrame(frame);
  clock.mark("view uploaded");
  if (m_quality.compute)
    computeSurfaces(job);
  else
    drawSurfaces(job);
  clock.mark("surfaces");
  drawOcclusion(job);
  clock.mark("occlusion");
  if (m_quality.compute)
    computeLight(job);
  else
    drawLight(job);
  clock.mark("light");
  if (prepared.instances.liquids()) drawFluid(job);
  drawOver(job);
  m_fence.set();
}

void Passes::drawOver(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const auto glass = [&] {
    drawGlass(job);
    clock.mark("glass and lines");
  };
  if (!frame.lidInFront) glass();
  if (prepared.instances.vapours) drawSteam(job);
  if (frame.lidInFront) glass();
  if (prepared.instances.ghosts) drawGhost(job);
  clock.mark("ghost");
  // Smoothing stair steps would wash out so thin a line, which has smooth sides of its own.
  if (prepared.instances.outlined && frame.still) drawOutline(job, {Target({&layers.picture}, nullptr).name(), 0, 0});
  if (m_quality.compute)
    computeFinal(job);
  else
    drawFinal(job);
  clock.mark("final");
  if (prepared.instances.outlined && !frame.still) drawOutline(job, frame.place);
  clock.mark("outline");
  if (!prepared.props.panels.empty()) drawPanels(job);
  clock.mark("panels");
  drawHidden(job);
  clock.mark("hidden parts");
}

}  // namespace ps::render
