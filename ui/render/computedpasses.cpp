// SPDX-License-Identifier: Apache-2.0
// What programs that compute do in place of drawing: cards made for computing draw many times slower, and others win
// too.
#include "ui/render/passes.h"

#include <algorithm>
#include <vector>

namespace ps::render {

/// Pixels of a picture by a program that is in use, drawn where `depth` passes or computed.
void Passes::work(const Program& program, const Texture& to, const Tiles& tiles, const Texture* depth) {
  if (!m_quality.compute) {
    const Target target({&to}, depth);
    return drawTiles(tiles);
  }
  workWithin({0, 0, to.width(), to.height()}, program, to);
}

/// The same of a part of the picture, where it is computed. Of what lies around, nothing is known afterwards.
void Passes::workWithin(const PixelBox& box, const Program& program, const Texture& to) {
  to.bindImage(0);
  glUniform2i(program.at("used"), to.width(), to.height());
  glUniform2i(program.at("origin"), 0, 0);
  glUniform2i(program.at("first"), box[0], box[1]);
  computePixels(box[2], box[3]);
}

/// What a program that is in use puts over the picture, of which `below` has all so far, within a box of pixels.
void Passes::workOver(const Job& job, const Program& program, const Texture& below, const Tiles& tiles,
                      const PixelBox& box) {
  const Texture& picture = job.layers.picture;
  if (!m_quality.compute) {
    const Target target({&picture}, nullptr);
    glEnable(GL_SCISSOR_TEST);
    glScissor(box[0], box[1], box[2], box[3]);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    drawTiles(tiles);
    glDisable(GL_BLEND);
    return glDisable(GL_SCISSOR_TEST);
  }
  if (box[2] < 1 || box[3] < 1) return;
  picture.bindImage(0);
  below.bindImage(1, GL_READ_ONLY);
  glUniform2i(program.at("used"), picture.width(), picture.height());
  glUniform2i(program.at("first"), box[0], box[1]);
  glUniform2i(program.at("end"), box[0] + box[2], box[1] + box[3]);
  computePixels(box[2], box[3]);
}

Bins::Order Passes::sphereOrder(Bins& bins, Range range, float growth, const Bins::Field& field) {
  const Program& sort = m_computing->sortSpheres;
  return {bins, sort, range.count, 1, field, [this, &sort, range, growth] {
            tellParticles(sort, m_particles, range);
            glUniform1f(sort.at("growth"), growth);
          }};
}

void Passes::computeShadow(const Prepared& prepared) {
  const Range range = prepared.instances.casterRange();
  if (range.count == 0 && m_shadowless) return;
  m_shadowless = range.count == 0;
  const Program& sort = m_computing->sortDiscs;
  Bins::sort({Bins::Order{m_bins, sort, range.count, 1, {m_shadow.width(), m_shadow.height()}, [&] {
                            tellParticles(sort, m_particles, range);
                            glUniformMatrix4fv(sort.at("toLight"), 1, GL_FALSE, prepared.toLight.data());
                            glUniform2fv(sort.at("radiusScale"), 1, prepared.shadowScale.data());
                          }}});
  const Program& program = m_computing->discs;
  program.use();
  glUniform2fv(program.at("radiusScale"), 1, prepared.shadowScale.data());
  m_shadow.bindImage(0);
  m_bins.run(program);
}

/// Of the opaque scene, and of liquid.
void Passes::sortLists(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const size_t props = prepared.props.opaque.size() / 3, all = props + prepared.furniture.opaque.size() / 3;
  const Program& sort = m_computing->sortTriangles;
  const Bins::Field whole{frame.width, frame.height};
  const auto field = [&frame = job.frame](int scale) {
    return Bins::Field{reduced(frame.width, scale), reduced(frame.height, scale)};
  };
  std::vector<Bins::Order> orders{
      {m_triangleBins, sort, all, 3, whole, [&] { glUniform1i(sort.at("ofProps"), static_cast<GLint>(props)); }}};
  const Instances& drawn = prepared.instances;
  orders.push_back(sphereOrder(m_bins, drawn.sphereRange(frame.amongSpheres), 1, whole));
  if (drawn.liquids() > 0) {
    orders.push_back(
        sphereOrder(m_liquidBins, drawn.liquidRange(frame.amongLiquids), kDistanceGrowth, field(m_quality.fluidScale)));
    Bins::Field thickness = field(frame.thicknessScale);
    thickness.smallest = 3;
    orders.push_back(sphereOrder(m_thicknessBins, drawn.liquidRange(true), kThicknessGrowth, thickness));
  }
  Bins::sort(orders);
}

void Passes::computeSurfaces(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, m_opaque.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, m_opaqueProps.name());
  sortLists(job);
  clock.mark("sorting");
  layers.triangles.resize(frame.width, frame.height);
  m_computing->triangles.use();
  layers.triangles.bindImage(0);
  m_triangleBins.run(m_computing->triangles, 16);
  clock.mark("triangles");

  const size_t props = prepared.props.opaque.size() / 3;
  const Range spheres = prepared.instances.sphereRange(frame.amongSpheres);
  const Program& program = m_computing->surface;
  program.use();
  tellParticles(program, m_particles, spheres);
  glUniform1i(program.at("ofProps"), static_cast<GLint>(props));
  layers.surface.bindImage(0);
  layers.normal.bindImage(1);
  layers.distance.bindImage(2);
  program.texture("triangles", 0, layers.triangles.name());
  m_bins.run(program);
  glFlush();  // the card begins with this while it is told the rest
}

/// Into the picture, or to where liquid is seen over it.
void Passes::computeLight(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const bool liquid = prepared.instances.liquids() > 0;
  if (liquid) layers.behind.resize(frame.width, frame.height);
  const Program& program = m_computing->light;
  program.use();
  lightTextures(program, layers);
  const auto& backdrop = prepared.look.backdrop;
  const std::array<float, 3> even = backdrop.value_or(std::array<float, 3>{});
  glUniform4f(program.at("backdrop"), even[0], even[1], even[2], backdrop ? 1.f : 0.f);
  work(program, liquid ? layers.behind : layers.picture, {m_allTiles, frame.allTiles});
  glFlush();  // as after surfaces
}

/// Of spheres that were sorted.
void Passes::computeNearest(const Texture& to, const Bins& bins) {
  m_computing->nearest.use();
  to.bindImage(0);
  bins.run(m_computing->nearest);
}

void Passes::computeThickness(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const Range range = prepared.instances.liquidRange(true);
  const int scale = frame.thicknessScale;
  const Program& program = m_computing->thickness;
  program.use();
  tellParticles(program, m_particles, range);
  program.texture("distanceTexture", 0, layers.distance.name());
  glUniform1i(program.at("scale"), scale);
  layers.fluidColour.bindImage(0);
  layers.fluidClear.bindImage(1);
  m_thicknessBins.run(program);
}

void Passes::computeSteam(const Job& job, int sprites) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const Range range = prepared.instances.vapourRange();
  const Program& sort = m_computing->sortSprites;
  Bins::sort({Bins::Order{m_bins,
                          sort,
                          range.count * static_cast<size_t>(sprites),
                          3,
                          {layers.steam.width(), layers.steam.height()},
                          [&, data = prepared.data] {
                            tellParticles(sort, m_particles, range);
                            tellSprites(sort, sprites, data);
                          }}});
  const Program& program = m_computing->steam;
  program.use();
  tellParticles(program, m_particles, range);
  tellSprites(program, sprites, prepared.data);
  steamTextures(program, layers);
  layers.steam.bindImage(0);
  m_bins.run(program);
}

/// Into the target's own texture where it has one that programs may write, else into a picture that is copied there: by
/// far the most of the time that this takes.
void Passes::computeFinal(const Job& job) {
  const auto& [prepared, frame, layers, plain, clock] = job;
  const auto [framebuffer, x, y] = frame.place;
  const int scale = frame.still ? 2 : 1, width = frame.width / scale, height = frame.height / scale;
  const WritableView direct(frame.texture);
  if (!direct.name()) layers.finished.resize(width, height);
  const Program& program = m_programs.final;
  program.use();
  program.texture("picture", 0, layers.picture.name());
  glUniform1i(program.at("still"), frame.still);
  glUniform2i(program.at("used"), width, height);
  glUniform2i(program.at("origin"), direct.name() ? x : 0, direct.name() ? y : 0);
  if (direct.name())
    glBindImageTexture(0, direct.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA8);
  else
    layers.finished.bindImage(0);
  computePixels(width, height);
  if (direct.name()) return;
  const Target source({&layers.finished}, nullptr);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glBlitFramebuffer(0, 0, width, height, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace ps::render
