// SPDX-License-Identifier: Apache-2.0
#include "ui/render/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

double halfHeight(const Camera& camera) { return std::tan(camera.fieldOfView * kDegree / 2); }

}  // namespace

CameraFrame frameOf(const Camera& camera) {
  const double sa = std::sin(camera.azimuth * kDegree), ca = std::cos(camera.azimuth * kDegree);
  const double se = std::sin(camera.elevation * kDegree), ce = std::cos(camera.elevation * kDegree);
  const Vector3 toEye{ce * sa, se, ce * ca};
  return {camera.target + camera.distance * toEye, {ca, 0, -sa}, {-se * sa, ce, -se * ca}, {-ce * sa, -se, -ce * ca}};
}

double nearPlane(const Camera& camera) { return camera.distance * 0.02; }
double farPlane(const Camera& camera) { return camera.distance * 10 + 20; }

Matrix4 viewMatrix(const Camera& camera) {
  const CameraFrame f = frameOf(camera);
  Matrix4 view = Matrix4::Identity();
  view.topLeftCorner<3, 3>() << f.right.transpose(), f.up.transpose(), -f.forward.transpose();
  view.topRightCorner<3, 1>() = -view.topLeftCorner<3, 3>() * f.eye;
  return view;
}

Matrix4 projectionMatrix(const Camera& camera, int width, int height) {
  const double near = nearPlane(camera), far = farPlane(camera), scale = 1 / halfHeight(camera);
  Matrix4 p;
  p(0, 0) = scale * height / std::max(1, width);
  p(1, 1) = scale;
  p(2, 2) = -(far + near) / (far - near);
  p(2, 3) = -2 * far * near / (far - near);
  p(3, 2) = -1;
  return p;
}

Eye eyeOf(const Camera& camera, int width, int height) {
  return {viewMatrix(camera), projectionMatrix(camera, width, height)};
}

Eye eyeThrough(const Matrix4& view, double left, double right, double down, double up, double near, double far) {
  Matrix4 p = Matrix4::Zero();
  p(0, 0) = 2 / (right - left);
  p(1, 1) = 2 / (up - down);
  p(0, 2) = (right + left) / (right - left);
  p(1, 2) = (up + down) / (up - down);
  p(2, 2) = -(far + near) / (far - near);
  p(2, 3) = -2 * far * near / (far - near);
  p(3, 2) = -1;
  return {view, p};
}

Vector3 placeOf(const Eye& eye) {
  return -(eye.view.topLeftCorner<3, 3>().transpose() * eye.view.topRightCorner<3, 1>());
}

double nearPlane(const Eye& eye) { return eye.projection(2, 3) / (eye.projection(2, 2) - 1); }

Ray rayThrough(const Eye& eye, int width, int height, double x, double y) {
  const Matrix4& p = eye.projection;
  const Vector3 seen{(2 * x / width - 1 + p(0, 2)) / p(0, 0), (1 - 2 * y / height + p(1, 2)) / p(1, 1), -1};
  const Vector3 direction = eye.view.topLeftCorner<3, 3>().transpose() * seen;
  return {placeOf(eye), direction.normalized()};
}

Ray rayThrough(const Camera& camera, int width, int height, double x, double y) {
  return rayThrough(eyeOf(camera, width, height), width, height, x, y);
}

std::optional<Vector3> project(const Eye& eye, int width, int height, const Vector3& world) {
  const Vector4 clip = eye.projection * (eye.view * world.homogeneous());
  if (clip.w() < nearPlane(eye)) return std::nullopt;
  return Vector3{(clip.x() / clip.w() + 1) / 2 * width, (1 - clip.y() / clip.w()) / 2 * height, clip.w()};
}

std::optional<Vector3> project(const Camera& camera, int width, int height, const Vector3& world) {
  return project(eyeOf(camera, width, height), width, height, world);
}

double pixelSize(const Camera& camera, int height, double depth) { return 2 * halfHeight(camera) * depth / height; }

void orbit(Camera& camera, double azimuth, double elevation) {
  camera.azimuth = std::remainder(camera.azimuth + azimuth, 360.0);
  camera.elevation = std::clamp(camera.elevation + elevation, -90.0, 90.0);
}

void pan(Camera& camera, int height, double dx, double dy) {
  const CameraFrame f = frameOf(camera);
  const double pixel = pixelSize(camera, height, camera.distance);
  camera.target = camera.target - dx * pixel * f.right + dy * pixel * f.up;
}

void dollyTo(Camera& camera, int width, int height, double x, double y, double factor) {
  const CameraFrame f = frameOf(camera);
  const double before = camera.distance;
  camera.distance = std::clamp(before * factor, 1e-3, 1e3);
  // The offset of the cursor's point from the target keeps its place in the picture when it shrinks with the distance.
  const double shift = 1 - camera.distance / before;
  const double pixel = pixelSize(camera, height, before);
  camera.target += pixel * shift * ((x - width * 0.5) * f.right + (height * 0.5 - y) * f.up);
}

void frameAll(Camera& camera, int width, int height, const Vector3& minimum, const Vector3& maximum) {
  camera.target = (minimum + maximum) / 2;
  const double radius = std::max(1e-4, (maximum - minimum).norm() / 2);
  const double narrow = std::min(1.0, static_cast<double>(width) / std::max(1, height)) * halfHeight(camera);
  camera.distance = radius / std::sin(std::atan(narrow));
}

std::optional<size_t> pickParticle(const Snapshot& snapshot, const Ray& ray, const std::optional<Section>& section) {
  std::optional<size_t> hit;
  double nearest = 0;
  for (size_t i = 0; i < snapshot.position.size(); ++i) {
    const api::Float4& p = snapshot.position[i];
    const Vector3 d = Vector3{p.x, p.y, p.z} - ray.origin;
    const double middle = d.dot(ray.direction);
    const double inside = static_cast<double>(p.w) * p.w - (d.squaredNorm() - middle * middle);
    if (inside < 0) continue;
    const double distance = middle - std::sqrt(inside);
    if (distance <= 0 || (hit && distance >= nearest)) continue;
    if (section && !section->shows({p.x, p.y, p.z})) continue;
    hit = i;
    nearest = distance;
  }
  return hit;
}

std::optional<size_t> pickParticle(const Snapshot& snapshot, const Camera& camera, int width, int height, double x,
                                   double y) {
  return pickParticle(snapshot, rayThrough(camera, width, height, x, y));
}

}  // namespace ps
