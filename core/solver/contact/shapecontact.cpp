// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/shapecontact.h"

#include "core/base/parallel.h"

#include <algorithm>

namespace ps {
namespace {

/// Pieces into which a way is cut, at most: what slides goes on by half a spacing each.
constexpr int kMostPieces = 48;
/// Half spacings beyond the resting distance from which on a surface is touched.
constexpr double kTouch = 0.05;
/// How far planes are believed, in half spacings from where they were found.
constexpr double kBelieved = 0.6;
constexpr int kCorners = 2;       ///< times that what moves is led off all faces
constexpr double kStands = 1e-6;  ///< half spacings

}  // namespace

void ShapeContact::configure(const SolverSettings& settings) { m_rest = 0.5 * settings.spacing; }

/// Where a way ends that slides along what it meets; `body` is set to what it met last.
Vector3 ShapeContact::slid(const FixedShapes& shapes, Vector3 at, Vector3 way, uint32_t& body, int which) const {
  for (int piece = 0; piece < kMostPieces; ++piece) {
    const double length = way.norm();
    if (!(length > kStands * m_rest)) return at + way;
    FixedShapes::Faces faces;
    const size_t count = shapes.facesAt(at, length + (1 + kTouch) * m_rest, faces, which);
    if (count == 0) return at + way;
    const double gap = faces[0].distance - m_rest;
    if (gap > kTouch * m_rest) {
      const double share = std::min(1.0, gap / length);
      at += share * way;
      way *= 1 - share;
      continue;
    }
    const double share = std::min(1.0, m_rest / length);
    Vector3 part = share * way;
    for (int k = 0; k < kCorners; ++k) {
      for (const FixedShapes::Face& face : std::span(faces).first(count)) {
        const double into = -part.dot(face.plane.normal), room = std::max(0.0, face.plane.heightOf(at) - m_rest);
        if (!(into > room)) continue;
        part += (into - room) * face.plane.normal;
        way -= std::min(0.0, way.dot(face.plane.normal)) * face.plane.normal;
        body = face.body;
      }
    }
    at += part;
    way *= 1 - share;
  }
  return at;
}

/// The same of a whole substep, past what moves in it: whoever it meets, goes on along it as seen by it.
Vector3 ShapeContact::sweptOf(const FixedShapes& shapes, const Vector3& from, const Vector3& to, uint32_t& body) const {
  Vector3 end = slid(shapes, from, to - from, body, FixedShapes::kStill);
  for (const uint32_t mover : shapes.movers()) {
    if (!shapes.isBeside(mover, from, end, (1 + kTouch) * m_rest)) continue;
    const Vector3 carried = shapes.carried(mover, from);
    const Vector3 along = slid(shapes, carried, end - carried, body, static_cast<int>(mover));
    if (isApart(along, end)) end = slid(shapes, from, along - from, body, FixedShapes::kStill);
  }
  return end;
}

bool ShapeContact::isBelieved(const Vector3& at, const Vector3& noted) const {
  return (at - noted).squaredNorm() < kBelieved * kBelieved * m_rest * m_rest;
}

/// By more than rounding.
bool ShapeContact::isApart(const Vector3& a, const Vector3& b) const {
  return (a - b).squaredNorm() > kStands * kStands * m_rest * m_rest;
}

/// Whether a way comes near no surface.
bool ShapeContact::isFree(const FixedShapes& shapes, size_t fluid, const Vector3& from, const Vector3& to) const {
  const double rest = (1 + kTouch) * m_rest;
  const double room = double{shapes.clearance(fluid)} - rest - shapes.drift(fluid, from, to, rest);
  if (!(room > 0)) return false;
  const Vector3& noted = shapes.noted(fluid);
  return (from - noted).squaredNorm() < room * room && (to - noted).squaredNorm() < room * room;
}

template <class Body>
void ShapeContact::forFluids(const FixedShapes& shapes, const Body& body) {
  const size_t count = shapes.fluids().size(), chunks = chunkCount(count, grain::kNeighbours);
  m_moved.start(chunks);
  m_reactions->start(chunks);
  forChunks(count, grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) body(k, shapes.fluids()[k], first / grain::kNeighbours);
  });
  m_externalImpulse.add(m_moved.total());
  m_reactions->finish();
}

void ShapeContact::move(ParticleStore& store, uint32_t i, const Vector3& to, uint32_t body, size_t chunk) {
  const Vector3 before = vectorOf(store.position()[i]);
  assignTo(store.position()[i], to);
  const Vector3 moved = double{store.mass()[i]} * (vectorOf(store.position()[i]) - before);
  m_moved.add(chunk, 1, moved);
  m_reactions->add(chunk, m_reactions->ofBody(body), to, -m_reactions->perStep() * moved);
}

/// What began nearer to a face than it may rest.
void ShapeContact::giveRoom(ParticleStore& store, const FixedShapes& shapes, size_t fluid) const {
  const uint32_t i = shapes.fluids()[fluid];
  if (!isBelieved(vectorOf(store.previous()[i]), shapes.noted(fluid))) return;
  for (const FixedShapes::Near& near : shapes.near(i)) {
    const double missing = m_rest - double{near.plane.heightOf(store.previous()[i])};
    if (!(missing > 0)) continue;
    const Vector3 off = missing * Vector3(near.plane.x, near.plane.y, near.plane.z);
    addTo(store.previous()[i], off);
    addTo(store.position()[i], off);
  }
}

void ShapeContact::sweep(ParticleStore& store, const FixedShapes& shapes) {
  if (!shapes.any()) return;
  m_swept.resize(shapes.fluids().size());
  forFluids(shapes, [&](size_t fluid, uint32_t i, size_t chunk) {
    giveRoom(store, shapes, fluid);
    const Vector3 from = vectorOf(store.previous()[i]), to = vectorOf(store.position()[i]);
    if (!isFree(shapes, fluid, from, to)) {
      uint32_t body = 0;
      const Vector3 end = sweptOf(shapes, from, to, body);
      if (isApart(end, to)) move(store, i, end, body, chunk);
    }
    m_swept[fluid] = store.position()[i];
  });
}

void ShapeContact::project(ParticleStore& store, std::span<const FixedShapes::Near> near, uint32_t i, size_t chunk) {
  const float rest = static_cast<float>(m_rest);
  for (const FixedShapes::Near& face : near) {
    const float missing = rest - face.plane.heightOf(store.position()[i]);
    if (!(missing > 0)) continue;
    const Vector3 off = double{missing} * Vector3(face.plane.x, face.plane.y, face.plane.z);
    move(store, i, vectorOf(store.position()[i]) + off, face.body, chunk);
  }
}

void ShapeContact::projectNear(ParticleStore& store, const FixedShapes& shapes) {
  if (!shapes.any()) return;
  forFluids(shapes, [&](size_t, uint32_t i, size_t chunk) { project(store, shapes.near(i), i, chunk); });
}

void ShapeContact::finish(ParticleStore& store, const FixedShapes& shapes, const WallStage& walls) {
  if (!shapes.any()) return;
  forFluids(shapes, [&](size_t fluid, uint32_t i, size_t chunk) {
    const Vector3 from = vectorOf(m_swept[fluid]), asked = vectorOf(store.position()[i]), &noted = shapes.noted(fluid);
    if (isFree(shapes, fluid, from, asked)) return;
    uint32_t body = 0;
    if (isBelieved(asked, noted) && isBelieved(from, noted)) {
      project(store, shapes.near(i), i, chunk);
      if (!shapes.near(i).empty()) body = shapes.near(i)[0].body;
    } else {
      const Vector3 end = slid(shapes, from, asked - from, body, FixedShapes::kAll);
      if (isApart(end, asked)) move(store, i, end, body, chunk);
    }
    Vector3 kept = vectorOf(store.position()[i]);
    if (kept == asked) return;
    walls.clamp(kept);
    if (isApart(kept, vectorOf(store.position()[i]))) move(store, i, kept, body, chunk);
  });
}

}  // namespace ps
