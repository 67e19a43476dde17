// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/call.h"
#include "tests/vr/runtime/closing.h"
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/names.h"
#include "tests/vr/runtime/timeline.h"

#include <cstdio>

namespace ps::scripted {

XrResult destroyInstance(Instance& instance, XrInstance) {
  if (instance.session) closeSession(instance);
  instance.log.write({{"instance", "destroyed"}, {"textures", instance.texturesAlive}});
  runtime().instance.reset();
  return XR_SUCCESS;
}

XrResult getInstanceProperties(Instance&, XrInstance, XrInstanceProperties* properties) {
  typed(properties, XR_TYPE_INSTANCE_PROPERTIES).runtimeVersion = XR_MAKE_VERSION(1, 0, 0);
  std::snprintf(properties->runtimeName, sizeof properties->runtimeName, "PhaseSketch scripted runtime");
  return XR_SUCCESS;
}

XrResult pollEvent(Instance& instance, XrInstance, XrEventDataBuffer* buffer) {
  typed(buffer, XR_TYPE_EVENT_DATA_BUFFER);
  if (instance.events.empty() && instance.session && !instance.session->running) nextFrame(instance);
  if (instance.events.empty()) return XR_EVENT_UNAVAILABLE;
  *buffer = instance.events.front();
  instance.events.pop_front();
  return XR_SUCCESS;
}

XrResult resultToString(Instance&, XrInstance, XrResult result, char* text) {
  std::snprintf(&wanted(text), XR_MAX_RESULT_STRING_SIZE, "%s", nameOf(result).c_str());
  return XR_SUCCESS;
}

XrResult structureTypeToString(Instance&, XrInstance, XrStructureType type, char* text) {
  std::snprintf(&wanted(text), XR_MAX_STRUCTURE_NAME_SIZE, "%s", nameOf(type).c_str());
  return XR_SUCCESS;
}

XrResult stringToPath(Instance& instance, XrInstance, const char* text, XrPath* path) {
  wanted(path) = instance.paths.pathOf(&wanted(text));
  return XR_SUCCESS;
}

XrResult pathToString(Instance& instance, XrInstance, XrPath path, uint32_t capacity, uint32_t* count, char* text) {
  const std::string& known = instance.paths.textOf(path);
  const std::string_view ended(known.c_str(), known.size() + 1);
  return enumerate(ended, capacity, count, text);
}

}  // namespace ps::scripted
