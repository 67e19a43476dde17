// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/scriptreader.h"

#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "tests/vr/runtime/joints.h"
#include "tests/vr/runtime/names.h"
#include "tests/vr/runtime/profiles.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace ps::scripted {
namespace {

constexpr double kAnyFrame = 1e9;
constexpr std::string_view kStates[] = {"IDLE", "SYNCHRONIZED", "VISIBLE", "FOCUSED", "EXITING", "LOSS_PENDING"};
constexpr std::string_view kHandNames[] = {"left", "right"};

struct Format {
  std::string_view name;
  int64_t value;
};
constexpr Format kFormats[] = {{"SRGB8_ALPHA8", GL_SRGB8_ALPHA8},
                               {"RGBA16F", GL_RGBA16F},
                               {"RGBA8", GL_RGBA8},
                               {"DEPTH_COMPONENT32F", GL_DEPTH_COMPONENT32F},
                               {"DEPTH_COMPONENT24", GL_DEPTH_COMPONENT24}};

template <class List>
bool holds(const List& list, std::string_view wanted) {
  return std::find(std::begin(list), std::end(list), wanted) != std::end(list);
}

}  // namespace

XrPosef poseOf(const nlohmann::json& numbers) {
  const auto n = numbers.get<std::vector<float>>();
  return {n.size() == 7 ? XrQuaternionf{n[3], n[4], n[5], n[6]} : XrQuaternionf{0, 0, 0, 1}, {n[0], n[1], n[2]}};
}

std::vector<int64_t> swapchainFormats() {
  std::vector<int64_t> formats;
  for (const Format& format : kFormats) formats.push_back(format.value);
  return formats;
}

void ScriptReader::refuse(const std::string& pointer, const std::string& what) const {
  throw InputError(m_path + ":" + pointer + ": " + what);
}

double ScriptReader::number(const json& value, const std::string& pointer, double minimum, double maximum) const {
  if (!value.is_number()) refuse(pointer, "must be a number, not " + jsonInWords(value));
  const double result = value.get<double>();
  if (result < minimum || result > maximum) refuse(pointer, "is out of range");
  return result;
}

bool ScriptReader::boolean(const json& value, const std::string& pointer) const {
  if (!value.is_boolean()) refuse(pointer, "must be true or false, not " + jsonInWords(value));
  return value.get<bool>();
}

std::string ScriptReader::text(const json& value, const std::string& pointer) const {
  if (!value.is_string()) refuse(pointer, "must be a text, not " + jsonInWords(value));
  return value.get<std::string>();
}

const ScriptReader::json& ScriptReader::list(const json& value, const std::string& pointer) const {
  if (!value.is_array()) refuse(pointer, "must be a list, not " + jsonInWords(value));
  return value;
}

XrPosef ScriptReader::pose(const json& value, const std::string& pointer) const {
  const size_t size = list(value, pointer).size();
  if (size != 3 && size != 7) refuse(pointer, "must be x, y, z, or these and a quaternion's x, y, z, w");
  for (size_t i = 0; i < size; ++i) number(value[i], pointer + "/" + std::to_string(i), -1e4, 1e4);
  const XrPosef result = poseOf(value);
  if (!isUnit(result.orientation)) refuse(pointer, "its quaternion must have the length 1");
  return result;
}

void ScriptReader::read(Script& script) {
  std::ifstream file(m_path);
  if (!file) throw InputError(m_path + ": cannot be read");
  std::ostringstream content;
  content << file.rdbuf();
  const json all = parseJson(content.str(), m_path);
  if (!all.is_object()) refuse("", "must be an object");
  for (const auto& [key, value] : all.items()) readTop(script, key, value);
  const auto byFrame = [](const auto& a, const auto& b) { return a.frame < b.frame; };
  std::stable_sort(script.events.begin(), script.events.end(), byFrame);
  std::stable_sort(script.m_head.begin(), script.m_head.end(), byFrame);
  for (size_t hand = 0; hand < 2; ++hand) {
    std::stable_sort(script.m_grip[hand].begin(), script.m_grip[hand].end(), byFrame);
    std::stable_sort(script.m_aim[hand].begin(), script.m_aim[hand].end(), byFrame);
    std::stable_sort(script.m_hands[hand].begin(), script.m_hands[hand].end(), byFrame);
  }
}

void ScriptReader::readTop(Script& script, const std::string& key, const json& value) const {
  const std::string pointer = "/" + key;
  if (key == "profile") {
    const std::string name = text(value, pointer);
    if (!interactionProfile(name)) refuse(pointer, "no such interaction profile");
    script.profile.fill(name);
  } else if (key == "view") {
    readView(script, value);
  } else if (key == "period") {
    script.period = number(value, pointer, 1e-4, 1);
  } else if (key == "real_time") {
    script.realTime = boolean(value, pointer);
  } else if (key == "extensions") {
    readExtensions(script, value);
  } else if (key == "refresh_rates") {
    script.refreshRates.clear();
    for (const json& rate : list(value, pointer))
      script.refreshRates.push_back(static_cast<float>(number(rate, pointer, 1, 1000)));
  } else if (key == "hidden_corners") {
    script.hiddenCorners = static_cast<float>(number(value, pointer, 0, 1));
  } else if (key == "sees_hands") {
    script.seesHands = boolean(value, pointer);
  } else if (key == "stage") {
    script.stage = boolean(value, pointer);
  } else if (key == "formats") {
    readFormats(script, value);
  } else if (key == "keys") {
    for (size_t i = 0; i < list(value, pointer).size(); ++i)
      readKey(script, value[i], pointer + "/" + std::to_string(i));
  } else if (key == "events") {
    for (size_t i = 0; i < list(value, pointer).size(); ++i)
      readEvent(script, value[i], pointer + "/" + std::to_string(i));
  } else if (key == "pictures") {
    for (const json& frame : list(value, pointer))
      script.m_pictures.insert(static_cast<int64_t>(number(frame, pointer, 0, kAnyFrame)));
  } else {
    refuse(pointer, "no such key");
  }
}

void ScriptReader::readView(Script& script, const json& value) const {
  for (const auto& [key, part] : value.items()) {
    const std::string pointer = "/view/" + key;
    if (key == "width") {
      script.width = static_cast<int>(number(part, pointer, 1, 4096));
    } else if (key == "height") {
      script.height = static_cast<int>(number(part, pointer, 1, 4096));
    } else if (key == "field_of_view") {
      script.fieldOfView = static_cast<float>(number(part, pointer, 0.1, 3));
    } else if (key == "eye_distance") {
      script.eyeDistance = static_cast<float>(number(part, pointer, 0, 1));
    } else {
      refuse(pointer, "no such key");
    }
  }
}

void ScriptReader::readExtensions(Script& script, const json& value) const {
  script.extensions.clear();
  for (const json& name : list(value, "/extensions")) {
    script.extensions.push_back(text(name, "/extensions"));
    if (!holds(knownExtensions(), script.extensions.back())) refuse("/extensions", "cannot be offered");
  }
}

void ScriptReader::readFormats(Script& script, const json& value) const {
  script.formats.clear();
  for (const json& name : list(value, "/formats")) {
    const std::string wanted = text(name, "/formats");
    const auto* found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                     [&](const Format& format) { return format.name == wanted; });
    if (found == std::end(kFormats)) refuse("/formats", "no such format");
    script.formats.push_back(found->value);
  }
}

void ScriptReader::readKey(Script& script, const json& value, const std::string& pointer) const {
  if (!value.is_object() || !value.contains("frame")) refuse(pointer, "must be an object with a frame");
  const double frame = number(value["frame"], pointer + "/frame", 0, kAnyFrame);
  for (const auto& [key, part] : value.items()) {
    const std::string place = pointer + "/" + key;
    if (key == "frame") continue;
    if (key == "head") {
      script.m_head.push_back({frame, pose(part, place)});
    } else if (key == kHandNames[0] || key == kHandNames[1]) {
      readHand(script, key == kHandNames[0] ? 0 : 1, frame, part, place);
    } else {
      refuse(place, "no such key");
    }
  }
}

void ScriptReader::readHand(Script& script, size_t hand, double frame, const json& value,
                            const std::string& pointer) const {
  Script::HandKey state{frame, {}, {}, {}, {}};
  for (const auto& [key, part] : value.items()) {
    const std::string place = pointer + "/" + key;
    if (key == "grip") {
      script.m_grip[hand].push_back({frame, pose(part, place)});
    } else if (key == "aim") {
      script.m_aim[hand].push_back({frame, pose(part, place)});
    } else if (key == "active") {
      state.active = boolean(part, place);
    } else if (key == "tracked") {
      state.tracked = boolean(part, place);
    } else if (key == "joints") {
      state.shape = text(part, place);
      if (!holds(kHandShapes, *state.shape)) refuse(place, "no such shape of a hand");
    } else if (key.starts_with("/input/")) {
      state.inputs[key] = part.is_boolean() ? float(part.get<bool>()) : float(number(part, place, -1, 1));
    } else {
      refuse(place, "no such key");
    }
  }
  script.m_hands[hand].push_back(std::move(state));
}

void ScriptReader::readEvent(Script& script, const json& value, const std::string& pointer) const {
  if (!value.is_object()) refuse(pointer, "must be an object");
  ScriptEvent event{-1, value};
  if (value.contains("frame")) event.frame = number(value["frame"], pointer + "/frame", -1, kAnyFrame);
  std::string kind;
  for (const std::string_view known : {"state", "fail", "dies", "session_lost", "instance_loss", "profile", "recentre",
                                       "refresh_rate", "events_lost", "hidden_corners", "hangs", "steals_context"})
    if (value.contains(known)) kind = known;
  if (kind.empty()) refuse(pointer, "says nothing that can happen");
  checkEvent(kind, value, pointer);
  event.what["kind"] = kind;
  script.events.push_back(std::move(event));
}

void ScriptReader::checkEvent(const std::string& kind, const json& value, const std::string& pointer) const {
  const std::string place = pointer + "/" + kind;
  const auto result = [&](const std::string& key) {
    if (!value.contains(key) || !resultNamed(text(value[key], pointer + "/" + key)))
      refuse(pointer + "/" + key, "must be a result of OpenXR, such as XR_ERROR_RUNTIME_FAILURE");
  };
  for (const auto& [key, part] : value.items())
    if (!holds(
            std::initializer_list<std::string_view>{"frame", kind, "result", "times", "after", "hand", "milliseconds"},
            key))
      refuse(pointer + "/" + key, "no such key");
  if (kind == "state" && !holds(kStates, text(value[kind], place))) refuse(place, "no such state");
  if (kind == "fail") {
    if (!text(value[kind], place).starts_with("xr")) refuse(place, "must be a function of OpenXR");
    result("result");
    if (value.contains("times")) number(value["times"], pointer + "/times", 1, kAnyFrame);
    if (value.contains("after")) number(value["after"], pointer + "/after", 0, kAnyFrame);
  }
  if (kind == "dies") result("dies");
  if (kind == "session_lost" || kind == "instance_loss") boolean(value[kind], place);
  if (kind == "profile" && !text(value[kind], place).empty() && !interactionProfile(text(value[kind], place)))
    refuse(place, "no such interaction profile");
  if (value.contains("hand") && !holds(kHandNames, text(value["hand"], pointer + "/hand")))
    refuse(pointer + "/hand", "must be left or right");
  if (kind == "recentre") pose(value[kind], place);
  if (kind == "refresh_rate") number(value[kind], place, 1, 1000);
  if (kind == "steals_context" && !text(value[kind], place).starts_with("xr"))
    refuse(place, "must be a function of OpenXR");
  if (kind == "hangs") {
    if (!text(value[kind], place).starts_with("xr")) refuse(place, "must be a function of OpenXR");
    if (!value.contains("milliseconds")) refuse(pointer + "/milliseconds", "must say for how long");
    number(value["milliseconds"], pointer + "/milliseconds", 0, 60000);
  }
  if (kind == "hidden_corners") number(value[kind], place, 0, 1);
  if (kind == "events_lost") number(value[kind], place, 1, kAnyFrame);
}

}  // namespace ps::scripted
