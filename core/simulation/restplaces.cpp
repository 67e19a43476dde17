// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/restplaces.h"

#include "core/base/error.h"
#include "core/base/statestream.h"

#include <algorithm>
#include <cmath>
#include <utility>

// Why runs that are shared: snapshots hold a copy, and each sample of a stroke adds some. No copy is made of more than
// the last run, as long as that is short.
namespace ps {
namespace {

constexpr size_t kShort = 1024;  // particles: runs that grow
constexpr const char *kRuns = "scene/rest_runs", *kPlaces = "scene/rest_places";

}  // namespace

void RestPlaces::add(std::span<const uint32_t> ids, std::span<const Place> places) {
  for (size_t begin = 0; begin < ids.size();) {
    size_t end = begin + 1;
    while (end < ids.size() && ids[end] == ids[end - 1] + 1) ++end;
    const auto part = places.subspan(begin, end - begin);
    const auto at = std::upper_bound(m_runs.begin(), m_runs.end(), ids[begin],
                                     [](uint32_t id, const Run& run) { return id < run.first; });
    const bool grows = at != m_runs.begin() && (at - 1)->end() == ids[begin] && (at - 1)->places->size() < kShort;
    if (grows) {
      std::vector<Place> longer = *(at - 1)->places;
      longer.insert(longer.end(), part.begin(), part.end());
      (at - 1)->places = std::make_shared<const std::vector<Place>>(std::move(longer));
    } else {
      m_runs.insert(at, {ids[begin], std::make_shared<const std::vector<Place>>(part.begin(), part.end())});
    }
    begin = end;
  }
}

void RestPlaces::shift(std::span<const uint32_t> ids, const Vector3& way) {
  auto from = ids.begin();
  for (Run& run : m_runs) {
    from = std::lower_bound(from, ids.end(), run.first);
    const auto to = std::lower_bound(from, ids.end(), run.end());
    if (from == to) continue;
    auto shifted = std::make_shared<std::vector<Place>>(*run.places);
    for (; from != to; ++from) {
      Place& place = (*shifted)[*from - run.first];
      for (size_t a = 0; a < 3; ++a) place[a] += static_cast<float>(way[static_cast<Eigen::Index>(a)]);
    }
    run.places = std::move(shifted);
  }
}

std::optional<Vector3> RestPlaces::of(uint32_t id) const {
  const auto after = std::upper_bound(m_runs.begin(), m_runs.end(), id,
                                      [](uint32_t wanted, const Run& run) { return wanted < run.first; });
  if (after == m_runs.begin() || id >= (after - 1)->end()) return std::nullopt;
  const Place& place = (*(after - 1)->places)[id - (after - 1)->first];
  return Vector3(place[0], place[1], place[2]);
}

void RestPlaces::save(StateWriter& writer) const {
  if (empty()) return;
  // Whole, however they came: two engines of one history save the same.
  std::vector<uint32_t> runs;
  uint64_t count = 0;
  for (const Run& run : m_runs) {
    const auto length = static_cast<uint32_t>(run.places->size());
    if (!runs.empty() && runs[runs.size() - 2] + runs.back() == run.first)
      runs.back() += length;
    else
      runs.insert(runs.end(), {run.first, length});
    count += length;
  }
  writer.array(kRuns, runs);
  writer.open(kPlaces, StateType::Float32, 3 * count);
  for (const Run& run : m_runs) writer.put(run.places->data(), run.places->size() * sizeof(Place));
  writer.close();
}

RestPlaces RestPlaces::read(const StateReader& reader) {
  RestPlaces rest;
  if (!reader.has(kRuns)) return rest;
  const std::vector<uint32_t> runs = reader.array<uint32_t>(kRuns);
  const std::vector<float> places = reader.array<float>(kPlaces);
  if (runs.size() % 2 != 0) StateReader::fail(kRuns, "is not made of beginnings and lengths");
  if (!std::all_of(places.begin(), places.end(), [](float c) { return std::isfinite(c); }))
    StateReader::fail(kPlaces, "has a number that is not finite");
  size_t taken = 0;
  for (size_t k = 0; k < runs.size(); k += 2) {
    const uint64_t first = runs[k], length = runs[k + 1], end = first + length;
    if (length == 0 || end > ~uint32_t{0} || (k > 0 && first < rest.m_runs.back().end()))
      StateReader::fail(kRuns, "has runs that do not ascend");
    if (3 * (taken + length) > places.size()) StateReader::fail(kPlaces, "has fewer places than are counted");
    std::vector<Place> own(length);
    for (size_t i = 0; i < length; ++i, ++taken)
      own[i] = {places[3 * taken], places[3 * taken + 1], places[3 * taken + 2]};
    rest.m_runs.push_back({runs[k], std::make_shared<const std::vector<Place>>(std::move(own))});
  }
  if (3 * taken != places.size()) StateReader::fail(kPlaces, "has more places than are counted");
  return rest;
}

}  // namespace ps
