// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/hostservices.h"

#include "core/base/callee.h"
#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/plugin_host/pluginloader.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

namespace ps {
namespace {

constexpr int kMostLines = 100;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What is known of a plugin's loop, by its function; loops that find no place share one. `microseconds`: for an
/// element, as the plugin has it.
LoopCost& costOf(const void* loop, double microseconds) {
  struct Known {
    std::atomic<const void*> loop = nullptr;
    LoopCost cost;
  };
  static std::array<Known, 256> all;
  for (size_t k = std::hash<const void*>()(loop) / 16 % all.size(), n = 0; n < all.size();
       ++n, k = (k + 1) % all.size()) {
    const void* there = all[k].loop.load(std::memory_order_acquire);
    if (!there && all[k].loop.compare_exchange_strong(there, loop)) {
      all[k].cost = LoopCost(microseconds);
      there = loop;
    }
    if (there == loop) return all[k].cost;
  }
  return all[0].cost;
}

/// Those of the program. Whoever runs a part of a plugin's loop runs that plugin's code.
class SharedThreads final : public api::Threads {
 public:
  void share(size_t count, size_t grain, double microseconds, void (*body)(void* data, size_t first, size_t last),
             void* data) const override {
    const char* const callee = t_callee;
    forChunks(
        count, grain,
        [&](size_t first, size_t last) {
          const CalleeScope scope(callee);
          body(data, first, last);
        },
        costOf(reinterpret_cast<const void*>(body),
               std::max(0.0, microseconds) / static_cast<double>(std::max<size_t>(1, count))));
  }
};
const SharedThreads g_threads;

}  // namespace

void HostServices::log(Severity severity, const char* text) noexcept {
  const int line = m_lines.fetch_add(1);
  if (!text || line > kMostLines) return;
  try {
    const std::string words = line < kMostLines ? oneLine(text) : "says no more: it has written 100 lines";
    ps::log(severity == Severity::Warning ? LogLevel::Warning : LogLevel::Info, "plugin '" + m_plugin + "': " + words);
  } catch (...) {  // a line that cannot be written is lost
  }
}

double HostServices::property(const char* material, const char* key, double temperature) const noexcept {
  if (!material || !key || !std::isfinite(temperature)) return kNone;
  try {
    std::unique_lock own(m_mutex);
    const std::shared_ptr<InstalledMaterials> materials = m_materials;
    own.unlock();
    const std::lock_guard lock(materials->mutex);
    const auto found = materials->byId.find(material);
    if (found == materials->byId.end()) return kNone;
    const auto value = found->second->properties.find(key);
    return value == found->second->properties.end() ? kNone : value->second.at(temperature);
  } catch (...) {
    return kNone;
  }
}

const void* HostServices::extension(const char* name) const noexcept {
  const bool threads = name && std::string_view(name) == api::kThreads;
  return threads ? static_cast<const api::Threads*>(&g_threads) : nullptr;
}

void HostServices::use(std::shared_ptr<InstalledMaterials> materials) {
  const std::lock_guard lock(m_mutex);
  m_materials = std::move(materials);
}

void attach(api::Plugin& plugin, const std::string& id, const std::shared_ptr<InstalledMaterials>& materials) {
  static std::mutex mutex;
  static auto& attached = *new std::map<const api::Plugin*, std::unique_ptr<HostServices>>;
  const std::lock_guard lock(mutex);
  if (const auto known = attached.find(&plugin); known != attached.end()) return known->second->use(materials);
  auto services = std::make_unique<HostServices>(id, materials);
  plugin.attach(*services);
  attached.emplace(&plugin, std::move(services));
}

}  // namespace ps
