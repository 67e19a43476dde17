// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/rawclient.h"

#include <vector>

namespace ps {

/// The events of one type that wait; the others are dropped.
template <class Event>
std::vector<Event> eventsOf(RawClient& client, XrStructureType type) {
  std::vector<Event> found;
  while (const auto event = client.runtime().nextEvent())
    if (event->type == type) found.push_back(reinterpret_cast<const Event&>(*event));
  return found;
}

/// A frame without layers that leaves the events where they are.
inline void passFrame(RawClient& client) { vr::check(client.end(client.begin(), nullptr), "xrEndFrame"); }

}  // namespace ps
