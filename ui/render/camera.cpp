// SPDX-License-Identifier: Apache-2.0
#include "ui/render/camera.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec3 along(const Vec3& a, const Vec3& direction, double length) {
  return {a[0] + direction[0] * length, a[1] + direction[1] * length, a[2] + direction[2] * length};
}

double halfHeight(const Camera& camera) { return std::tan(camera.fieldOfView * kDegree / 2); }

}  // namespace

Mat4 multiply(const Mat4& a, const Mat4& b) {
  Mat4 out{};
  for (size_t column = 0; column < 4; ++column)
    for (size_t row = 0; row < 4; ++row)
      for (size_t k = 0; k < 4; ++k) out[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
  return out;
}

std::array<double, 4> transform(const Mat4& a, const Vec3& v) {
  std::array<double, 4> out{};
  for (size_t row = 0; row < 4; ++row) out[row] = a[row] * v[0] + a[4 + row] * v[1] + a[8 + row] * v[2] + a[12 + row];
  return out;
}

Mat4 inverse(const Mat4& a) {
  // Gauss-Jordan with partial pivoting.
  Mat4 left = a, out{};
  for (size_t i = 0; i < 4; ++i) out[i * 5] = 1;
  for (size_t column = 0; column < 4; ++column) {
    size_t pivot = column;
    for (size_t row = column + 1; row < 4; ++row)
      if (std::abs(left[column * 4 + row]) > std::abs(left[column * 4 + pivot])) pivot = row;
    const double value = left[column * 4 + pivot];
    if (value == 0) throw Error("inverse: the matrix is singular");
    for (size_t k = 0; k < 4; ++k) {
      std::swap(left[k * 4 + pivot], left[k * 4 + column]);
      std::swap(out[k * 4 + pivot], out[k * 4 + column]);
      left[k * 4 + column] /= value;
      out[k * 4 + column] /= value;
    }
    for (size_t row = 0; row < 4; ++row) {
      if (row == column) continue;
      const double factor = left[column * 4 + row];
      for (size_t k = 0; k < 4; ++k) {
        left[k * 4 + row] -= factor * left[k * 4 + column];
        out[k * 4 + row] -= factor * out[k * 4 + column];
      }
    }
  }
  return out;
}

CameraFrame frameOf(const Camera& camera) {
  const double sa = std::sin(camera.azimuth * kDegree), ca = std::cos(camera.azimuth * kDegree);
  const double se = std::sin(camera.elevation * kDegree), ce = std::cos(camera.elevation * kDegree);
  const Vec3 toEye{ce * sa, se, ce * ca};
  return {
      along(camera.target, toEye, camera.distance), {ca, 0, -sa}, {-se * sa, ce, -se * ca}, {-ce * sa, -se, -ce * ca}};
}

double nearPlane(const Camera& camera) { return camera.distance * 0.02; }
double farPlane(const Camera& camera) { return camera.distance * 10 + 20; }

Mat4 viewMatrix(const Camera& camera) {
  const CameraFrame f = frameOf(camera);
  return {f.right[0], f.up[0], -f.forward[0], 0, f.right[1],           f.up[1],           -f.forward[1],         0,
          f.right[2], f.up[2], -f.forward[2], 0, -dot(f.right, f.eye), -dot(f.up, f.eye), dot(f.forward, f.eye), 1};
}

Mat4 projectionMatrix(const Camera& camera, int width, int height) {
  const double near = nearPlane(camera), far = farPlane(camera), scale = 1 / halfHeight(camera);
  Mat4 p{};
  p[0] = scale * height / std::max(1, width);
  p[5] = scale;
  p[10] = -(far + near) / (far - near);
  p[11] = -1;
  p[14] = -2 * far * near / (far - near);
  return p;
}

Ray rayThrough(const Camera& camera, int width, int height, double x, double y) {
  const CameraFrame f = frameOf(camera);
  const double pixel = 2 * halfHeight(camera) / height;
  Vec3 d = along(f.forward, f.right, (x - width * 0.5) * pixel);
  d = along(d, f.up, (height * 0.5 - y) * pixel);
  const double length = std::sqrt(dot(d, d));
  return {f.eye, {d[0] / length, d[1] / length, d[2] / length}};
}

std::optional<Vec3> project(const Camera& camera, int width, int height, const Vec3& world) {
  const CameraFrame f = frameOf(camera);
  const Vec3 d = minus(world, f.eye);
  const double depth = dot(d, f.forward);
  if (depth < nearPlane(camera)) return std::nullopt;
  const double pixel = pixelSize(camera, height, depth);
  return Vec3{width * 0.5 + dot(d, f.right) / pixel, height * 0.5 - dot(d, f.up) / pixel, depth};
}

double pixelSize(const Camera& camera, int height, double depth) { return 2 * halfHeight(camera) * depth / height; }

void orbit(Camera& camera, double azimuth, double elevation) {
  camera.azimuth = std::remainder(camera.azimuth + azimuth, 360.0);
  camera.elevation = std::clamp(camera.elevation + elevation, -90.0, 90.0);
}

void pan(Camera& camera, int height, double dx, double dy) {
  const CameraFrame f = frameOf(camera);
  const double pixel = pixelSize(camera, height, camera.distance);
  camera.target = along(along(camera.target, f.right, -dx * pixel), f.up, dy * pixel);
}

void dollyTo(Camera& camera, int width, int height, double x, double y, double factor) {
  const CameraFrame f = frameOf(camera);
  const double before = camera.distance;
  camera.distance = std::clamp(before * factor, 1e-3, 1e3);
  // The offset of the cursor's point from the target keeps its place in the picture when it shrinks with the distance.
  const double shift = 1 - camera.distance / before;
  const double pixel = pixelSize(camera, height, before);
  camera.target =
      along(along(camera.target, f.right, (x - width * 0.5) * pixel * shift), f.up, (height * 0.5 - y) * pixel * shift);
}

void frameAll(Camera& camera, int width, int height, const Vec3& minimum, const Vec3& maximum) {
  Vec3 half{};
  for (size_t i = 0; i < 3; ++i) {
    camera.target[i] = (minimum[i] + maximum[i]) / 2;
    half[i] = (maximum[i] - minimum[i]) / 2;
  }
  const double radius = std::max(1e-4, std::sqrt(dot(half, half)));
  const double narrow = std::min(1.0, static_cast<double>(width) / std::max(1, height)) * halfHeight(camera);
  camera.distance = radius / std::sin(std::atan(narrow));
}

std::optional<size_t> pickParticle(const Snapshot& snapshot, const Camera& camera, int width, int height, double x,
                                   double y) {
  const Ray ray = rayThrough(camera, width, height, x, y);
  std::optional<size_t> hit;
  double nearest = 0;
  for (size_t i = 0; i < snapshot.position.size(); ++i) {
    const api::Float4& p = snapshot.position[i];
    const Vec3 d = minus({p.x, p.y, p.z}, ray.origin);
    const double middle = dot(d, ray.direction);
    const double inside = static_cast<double>(p.w) * p.w - (dot(d, d) - middle * middle);
    if (inside < 0) continue;
    const double distance = middle - std::sqrt(inside);
    if (distance <= 0 || (hit && distance >= nearest)) continue;
    hit = i;
    nearest = distance;
  }
  return hit;
}

std::optional<Vec3> meetPlane(const Ray& ray, const Vec3& point, const Vec3& normal) {
  const double slope = dot(ray.direction, normal);
  if (std::abs(slope) < 1e-12) return std::nullopt;
  const double t = dot(minus(point, ray.origin), normal) / slope;
  if (t < 0) return std::nullopt;
  return along(ray.origin, ray.direction, t);
}

}  // namespace ps
