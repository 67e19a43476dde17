// SPDX-License-Identifier: Apache-2.0
// What a frame must not leave behind: no numbers, leaps, temperatures that cannot be, particles out of bounds.
#include "core/base/parallel.h"
#include "core/solver/frame/solverimpl.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

namespace ps {
namespace {

/// Whether none of `count` numbers is not finite: those have all bits of their exponent.
template <class Bits, class Number>
bool allFiniteOf(const Number* numbers, size_t count, Bits exponent) {
  Bits found = 0;
  for (size_t k = 0; k < count; ++k) {
    Bits bits;
    std::memcpy(&bits, numbers + k, sizeof bits);
    found |= (bits & exponent) == exponent ? 1 : 0;
  }
  return found == 0;
}

bool finite(const api::Float4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

}  // namespace

void Solver::Impl::checkBounds() {
  const double size = settings.spacing;
  const double low[3] = {bounds.minimum.x - size, bounds.minimum.y - size, bounds.minimum.z - size};
  const double high[3] = {bounds.maximum.x + size, bounds.maximum.y + size, bounds.maximum.z + size};
  const auto isOutside = [&](float c, size_t a) {
    return static_cast<float>(std::clamp(double{c}, low[a], high[a])) != c || c < low[a] || c > high[a];
  };
  const bool any = anyChunk(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    bool outside = false;
    for (size_t i = first; i < last; ++i) {
      const api::Float4& p = store.position()[i];
      const bool beyond = (isOutside(p.x, 0) && !bounds.periodic[0]) || (isOutside(p.y, 1) && !bounds.periodic[1]) ||
                          (isOutside(p.z, 2) && !bounds.periodic[2]);
      outside = outside || (beyond && store.velocity()[i].w != 0);
    }
    return outside;
  });
  if (!any) return;
  size_t lost = 0, culprit = store.size();
  for (size_t i = 0; i < store.size(); ++i) {
    api::Float4& p = store.position()[i];
    if (store.velocity()[i].w == 0) continue;
    float* c[3] = {&p.x, &p.y, &p.z};
    bool outside = false;
    for (size_t a = 0; a < 3; ++a) {
      if (bounds.periodic[a]) continue;
      const float inside = static_cast<float>(std::clamp(double{*c[a]}, low[a], high[a]));
      outside = outside || inside != *c[a];
      if (*c[a] < low[a] || *c[a] > high[a]) *c[a] = inside;
    }
    if (!outside) continue;
    external.add(-double{store.mass()[i]} * vectorOf(store.velocity()[i]));
    store.velocity()[i] = {0, 0, 0, store.velocity()[i].w};
    ++lost;
    if (culprit == store.size() || store.id()[i] < store.id()[culprit]) culprit = i;
  }
  if (lost == 0) return;
  const std::string others = lost > 1 ? " and " + std::to_string(lost - 1) + " more" : "";
  raise(StepFlag::LostParticle, describe(culprit) + others + " left the bounds and stopped there");
}

bool Solver::Impl::allFinite() const {
  return !anyChunk(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    constexpr uint32_t kSingle = 0x7f800000u;
    constexpr uint64_t kDouble = 0x7ff0000000000000u;
    return !allFiniteOf(&store.position()[first].x, 4 * (last - first), kSingle) ||
           !allFiniteOf(&store.velocity()[first].x, 4 * (last - first), kSingle) ||
           !allFiniteOf(store.temperature() + first, last - first, kDouble);
  });
}

int64_t Solver::Impl::firstNotFinite(std::string& what) const {
  int64_t culprit = -1;
  for (size_t i = 0; i < store.size(); ++i) {
    const bool position = finite(store.position()[i]), velocity = finite(store.velocity()[i]),
               temperature = std::isfinite(store.temperature()[i]);
    if (position && velocity && temperature) continue;
    if (culprit >= 0 && store.id()[i] > store.id()[static_cast<size_t>(culprit)]) continue;
    culprit = static_cast<int64_t>(i);
    what = !position ? "position" : !velocity ? "velocity" : "temperature";
  }
  return culprit;
}

bool Solver::Impl::rejectIfNotFinite() {
  if (allFinite()) return false;
  std::string what;
  const int64_t culprit = firstNotFinite(what);
  if (culprit < 0) return false;
  raise(StepFlag::NotFinite, describe(static_cast<size_t>(culprit)) + ": " + what + " is not finite");
  backToLastGood();
  report.message += whoMovedIt();
  return true;
}

/// The frame goes on from the last good one with every call of a plugin watched; then it is taken back again.
std::string Solver::Impl::whoMovedIt() {
  if (!lastGoodValid || (constraints.count() == 0 && !constraints.gathers())) return {};
  constraints.watch(kFarthestLeap * settings.spacing);
  startLeads();
  freshLists();
  gas.measure(store, neighbours);
  viscosity.refresh(store, neighbours, density);
  for (int s = 0; s < settings.substeps && constraints.culprit().empty(); ++s) substep(static_cast<uint32_t>(s));
  std::string culprit = constraints.culprit();
  constraints.watch(0);
  backToLastGood();
  leapt.clear();
  return culprit.empty() ? culprit : "; plugin '" + culprit + "' moved it";
}

/// After a call of plugins, before walls bring back what was thrown out: particles that are farther from where they
/// began than their velocity and kFarthestLeap take them.
void Solver::Impl::noteLeaps(double dt) {
  const auto most = static_cast<float>(kFarthestLeap * settings.spacing), step = static_cast<float>(dt);
  const auto leap = [&](size_t i, float along) {  // m, against `along` times the way of the velocity
    const api::Float4 &x = store.position()[i], &from = store.previous()[i], &v = store.velocity()[i];
    const float a = x.x - from.x - along * v.x, b = x.y - from.y - along * v.y, c = x.z - from.z - along * v.z;
    return std::sqrt(a * a + b * b + c * c);
  };
  std::atomic<bool> far{false};
  forChunks(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (leap(i, 0) > most && store.velocity()[i].w != 0 && leap(i, step) > most) far = true;
    }
  });
  if (!far || !leapt.empty()) return;
  size_t culprit = 0;
  for (size_t i = 1; i < store.size(); ++i) {
    if (store.velocity()[i].w != 0 && leap(i, step) > leap(culprit, step)) culprit = i;
  }
  leapt = describe(culprit) + " leapt " + std::to_string(std::lround(leap(culprit, step))) + " m in one substep";
}

bool Solver::Impl::rejectIfLeapt() {
  if (leapt.empty()) return false;
  raise(StepFlag::Unphysical, std::exchange(leapt, {}));
  backToLastGood();
  report.message += whoMovedIt();
  return true;
}

/// What the thermal model says of matter, against what can be. Temperatures are no failure where explicit steps beyond
/// the stability limit were asked for (thermal_cfl above 1): those leave what can be by themselves, which is a limit.
bool Solver::Impl::rejectIfUnphysical() {
  constexpr double kHottest = 1e9;    // K
  constexpr float kRounding = 1e-3f;  // of shares
  const double* t = store.temperature();
  overshot = false;
  const auto isShare = [](float share) { return share >= -kRounding && share <= 1 + kRounding; };
  const bool any = anyChunk(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    bool wrong = false;
    for (size_t i = first; i < last; ++i) {
      const float s = store.solidFraction()[i], l = store.liquidFraction()[i], g = store.gasFraction()[i];
      const bool shares = isShare(s) && isShare(l) && isShare(g) && isShare(s + l + g);
      wrong = wrong || !shares || !(t[i] >= 0 && t[i] <= kHottest);
    }
    return wrong;
  });
  if (!any) return false;
  for (size_t i = 0; i < store.size(); ++i) {
    const float s = store.solidFraction()[i], l = store.liquidFraction()[i], g = store.gasFraction()[i];
    const bool shares = isShare(s) && isShare(l) && isShare(g) && isShare(s + l + g);
    const bool warm = t[i] >= 0 && t[i] <= kHottest;
    if (!warm && thermal.cfl > 1) overshot = true;
    if ((warm || thermal.cfl > 1) && shares) continue;
    char what[96];
    if (shares)
      std::snprintf(what, sizeof what, "a temperature of %.4g K", t[i]);
    else
      std::snprintf(what, sizeof what, "shares of %.3g solid, %.3g liquid, %.3g gas", double{s}, double{l}, double{g});
    const std::string message = "plugin '" + modelName + "' gave " + describe(i) + " " + what;
    backToLastGood();
    raise(StepFlag::Unphysical, message);
    return true;
  }
  return false;
}

}  // namespace ps
