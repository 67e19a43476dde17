// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/parameter.h>

#include <mutex>
#include <set>
#include <string>

// Short forms for the declarations of the program itself: the scene's, the brush's.
namespace ps::declare {

using api::actingWhen;
using api::atReset;
using api::related;

/// Default, slider's range, and the range beyond which values are refused; stored unit.
struct Range {
  double value, minimum, maximum, hardMinimum, hardMaximum;
};
struct Names {
  const char *key, *label, *symbol, *unit;
};
struct Words {
  const char *group, *help, *example, *source;
};
/// shown = stored * scale + offset.
struct Display {
  const char* unit;
  double scale, offset;
};
inline constexpr Display kAsStored{"", 1, 0};
inline constexpr Display kCelsius{"°C", 1, -273.15};
inline constexpr Display kMillimetres{"mm", 1000, 0};

/// The same text at the same place for ever: declarations keep pointers to it.
inline const char* kept(const std::string& text) {
  static std::mutex mutex;  // panels and engines ask
  static std::set<std::string> texts;
  const std::lock_guard lock(mutex);
  return texts.insert(text).first->c_str();
}

constexpr api::ParameterDeclaration number(Names n, Range r, Words w, Display d = kAsStored,
                                           api::Scale scale = api::Scale::Linear,
                                           api::ParameterKind kind = api::ParameterKind::Number) {
  return {n.key,         n.label, n.symbol, n.unit,   kind, scale,   r.value, r.minimum, r.maximum, r.hardMinimum,
          r.hardMaximum, d.unit,  d.scale,  d.offset, "",   w.group, w.help,  w.example, w.source};
}

/// With a word for its hard minimum.
constexpr api::ParameterDeclaration leastMeans(const char* word, api::ParameterDeclaration d) {
  d.leastWord = word;
  return d;
}

constexpr api::ParameterDeclaration integer(Names n, Range r, Words w) {
  return number(n, r, w, kAsStored, api::Scale::Linear, api::ParameterKind::Integer);
}

constexpr api::ParameterDeclaration toggle(Names n, bool on, Words w) {
  return number(n, {on ? 1.0 : 0.0, 0, 1, 0, 1}, w, kAsStored, api::Scale::Linear, api::ParameterKind::Toggle);
}

/// `choices`: names with | between them; `value`: index of the default.
constexpr api::ParameterDeclaration choice(Names n, const char* choices, int value, Words w) {
  int last = 0;
  for (const char* c = choices; *c; ++c) last += *c == '|';
  api::ParameterDeclaration d = number(n, {double(value), 0, double(last), 0, double(last)}, w, kAsStored,
                                       api::Scale::Linear, api::ParameterKind::Choice);
  d.choices = choices;
  return d;
}

}  // namespace ps::declare
