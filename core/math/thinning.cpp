// SPDX-License-Identifier: Apache-2.0
#include "core/math/responseedit.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr size_t kBetween = 4;  // places per piece at which two curves are compared
constexpr size_t kDense = 200;  // points of a law before they are thinned out
constexpr size_t kReach = 3;    // pieces on either side of a point that may change with it

/// A curve that loses points, and how far it is then from what it was.
class Thinning {
 public:
  Thinning(const Response& curve, bool logarithmic) : m_curve(curve), m_logarithmic(logarithmic) {
    const std::vector<CurvePoint>& p = curve.points;
    double largest = 0;
    for (size_t k = 0; k < p.size(); ++k) {
      largest = std::max(largest, std::abs(p[k].y));
      for (size_t i = 0; i < kBetween && k + 1 < p.size(); ++i) {
        const double x = p[k].x + static_cast<double>(i) / kBetween * (p[k + 1].x - p[k].x);
        m_samples.push_back({x, curve.at(x)});
      }
    }
    m_scale = largest > 0 ? largest : 1;
  }

  double away(const CurvePoint& sample, const Response& thin) const {
    const double y = thin.at(sample.x);
    if (!m_logarithmic || y <= 0 || sample.y <= 0) return std::abs(y - sample.y) / m_scale;
    return std::abs(std::log(y / sample.y));
  }

  /// The most that a curve through the kept points is away between two of the points that there were.
  double error(const std::vector<size_t>& kept, size_t first, size_t last) const {
    const Response thin = through(kept);
    double most = 0;
    for (size_t i = first * kBetween; i < last * kBetween; ++i) most = std::max(most, away(m_samples[i], thin));
    return most;
  }

  Response through(const std::vector<size_t>& kept) const {
    Response thin = m_curve;
    thin.points.clear();
    for (const size_t k : kept) thin.points.push_back(m_curve.points[k]);
    return thin;
  }

  /// The points to be kept besides, one in each piece that is too far off: the one nearest to where it is farthest.
  std::vector<size_t> missing(const std::vector<size_t>& kept, double tolerance) const {
    const Response thin = through(kept);
    std::vector<size_t> found;
    for (size_t piece = 0; piece + 1 < kept.size(); ++piece) {
      const size_t from = kept[piece], to = kept[piece + 1];
      double most = tolerance;
      size_t at = 0;
      for (size_t i = from * kBetween; i < to * kBetween; ++i) {
        if (const double off = away(m_samples[i], thin); off > most) most = off, at = (i + kBetween / 2) / kBetween;
      }
      if (most <= tolerance) continue;
      if (to - from > 1) found.push_back(std::clamp(at, from + 1, to - 1));
      // Between neighbours it is the slopes that are other ones: of a point beside them.
      else if (piece > 0 && from - kept[piece - 1] > 1)
        found.push_back(from - 1);
      else if (piece + 2 < kept.size() && kept[piece + 2] - to > 1)
        found.push_back(to + 1);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  const Response& m_curve;
  bool m_logarithmic;
  double m_scale = 1;
  std::vector<CurvePoint> m_samples;  ///< kBetween for each piece
};

}  // namespace

Thinned thinned(const Response& curve, double tolerance, bool logarithmic) {
  if (curve.kind != Response::Kind::Curve || curve.points.size() < 3) return {curve, 0};
  const Thinning work(curve, logarithmic);
  const size_t last = curve.points.size() - 1;
  std::vector<size_t> kept{0, last};
  for (;;) {
    const std::vector<size_t> more = work.missing(kept, tolerance);
    if (more.empty()) break;
    kept.insert(kept.end(), more.begin(), more.end());
    std::sort(kept.begin(), kept.end());
  }
  for (size_t k = 1; k + 1 < kept.size();) {
    std::vector<size_t> fewer = kept;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    const size_t from = kept[k > kReach ? k - kReach : 0], to = kept[std::min(k + kReach, kept.size() - 1)];
    if (work.error(fewer, from, to) <= tolerance)
      kept = std::move(fewer);
    else
      ++k;
  }
  return {work.through(kept), work.error(kept, 0, last)};
}

Response asPoints(const Response& response, double firstKelvin, double lastKelvin, bool logarithmic) {
  const Response dense = curveThrough(sampled(response, firstKelvin, lastKelvin, kDense));
  return thinned(dense, kLawTolerance, logarithmic).curve;
}

}  // namespace ps
