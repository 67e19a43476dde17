// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <string>

// What is made of the rows that bench writes: one run beside another, and how cost grows with the number of particles.
namespace ps {

/// Rows of `now` beside those of `old`, both as bench writes them, that have name, threads and particles in common:
/// "ratio" of the medians, new by old, and "stages" with theirs, where both took a hundredth of the frame or more.
/// Throws InputError where `old`, which is called `name`, is no file of bench.
nlohmann::json compareBench(const nlohmann::json& old, const nlohmann::json& now, const std::string& name);
/// What differs between two machines, as "cpu: A, now B"; "" where nothing does.
std::string machineDifference(const nlohmann::json& old, const nlohmann::json& now);

/// name, particles, threads, ms, ns per particle and iteration, share of one thread, bytes per particle.
std::string growthTable(const nlohmann::json& scenes);
/// ms per frame over particles on logarithmic axes, a line for each scene and number of threads, as SVG.
std::string growthPlot(const nlohmann::json& scenes);

}  // namespace ps
