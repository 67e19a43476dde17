// SPDX-License-Identifier: Apache-2.0
#include "core/solver/viscosity.h"

#include "core/solver/chunks.h"

#include <algorithm>
#include <numbers>

namespace ps {
namespace {

constexpr size_t kGrain = 128;

/// int W x^2 dV = 4 pi/3 int W r^4 dr, by Simpson's rule.
double secondMoment(const Kernel& kernel) {
  constexpr int kSteps = 200;
  const double step = kernel.supportRadius() / kSteps;
  const auto integrand = [&](double r) { return kernel.value(r) * r * r * r * r; };
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double r = k * step;
    sum += step / 6 * (integrand(r) + 4 * integrand(r + 0.5 * step) + integrand(r + step));
  }
  return 4 * std::numbers::pi / 3 * sum;
}

}  // namespace

void ViscosityStage::configure(const SolverSettings& settings, std::span<const BakedMaterial> materials) {
  m_settings = settings;
  m_materials = materials;
  m_secondMoment = secondMoment(Kernel(settings.kernel, settings.spacing * settings.supportRatio));
}

double ViscosityStage::greatestViscosity() const { return m_secondMoment * m_settings.substeps / (2 * m_settings.dt); }

void ViscosityStage::refresh(const ParticleStore& store, const DensityStage& density) {
  const size_t n = store.size();
  m_coefficient.assign(n + 16, -1.0f);  // the dummy counts as no fluid
  const double greatest = greatestViscosity();
  const float least = static_cast<float>(std::clamp(m_settings.xsphMinimum, 0.0, 1.0));
  const std::span<const uint32_t> fluid = density.fluid();
  forChunks(fluid.size(), 4 * kGrain, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = fluid[k];
      float c = least;
      if (store.motion()[i] == api::Motion::Liquid && store.material()[i] < m_materials.size() && store.mass()[i] > 0) {
        const double density0 = double{store.mass()[i]} / double{store.position()[i].w};
        const double nu = m_materials[store.material()[i]].viscosity(store.temperature()[i]) / density0;
        c = std::clamp(static_cast<float>(nu / greatest), least, 1.0f);
      }
      m_coefficient[i] = c;
    }
  });
}

void ViscosityStage::apply(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density) {
  const std::span<const uint32_t> fluid = density.fluid(), wet = density.wetSolids();
  if (fluid.empty() || m_coefficient.size() < store.size()) return;
  m_which.assign(fluid.begin(), fluid.end());
  m_which.insert(m_which.end(), wet.begin(), wet.end());
  m_change.resize(m_which.size());
  const PairLists pairs = density.lists(neighbours);
  const float scale = static_cast<float>(density.kernelScale());
  forChunks(m_which.size(), kGrain, [&](size_t first, size_t last) {
    sumViscosity(pairs, store.position(), store.velocity(), m_coefficient.data(), m_which.data(), first, last,
                 m_change.data());
  });
  api::Float4* velocity = store.velocity();
  for (size_t k = 0; k < m_which.size(); ++k) {
    api::Float4& v = velocity[m_which[k]];
    v.x += scale * m_change[k].x;
    v.y += scale * m_change[k].y;
    v.z += scale * m_change[k].z;
  }
}

void ViscosityStage::limits(const ParticleStore& store, std::vector<Limit>& out) const {
  std::vector<double> asked(m_materials.size(), 0);  // Pa s
  std::vector<double> densities(m_materials.size(), 0);
  for (size_t i = 0; i < store.size(); ++i) {
    const uint32_t m = store.material()[i];
    if (store.motion()[i] != api::Motion::Liquid || m >= m_materials.size()) continue;
    const double viscosity = m_materials[m].viscosity(store.temperature()[i]);
    if (viscosity <= asked[m]) continue;
    asked[m] = viscosity;
    densities[m] = double{store.mass()[i]} / double{store.position()[i].w};
  }
  for (size_t m = 0; m < asked.size(); ++m) {
    const double delivered = greatestViscosity() * densities[m];
    if (asked[m] > delivered)
      out.push_back({std::string(m_materials[m].id()) + ".viscosity", asked[m], delivered, "Pa·s"});
  }
}

}  // namespace ps
