// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/parameter.h>
#include <phasesketch/views.h>

namespace ps::api {

/// What all four kinds share. Objects are stateless after construction and may be called from several threads at once:
/// whatever a scene needs lives in fields, constraint values and parameters that the host owns.
///
/// What a plugin declares (label, help, parameters and the lists of its kind) is read when it is loaded, must be the
/// same at every call and live as long as the object. A constructor or a declaration that throws makes the host refuse
/// the plugin. Later a function may throw std::exception only where its comment says so; the host then names the
/// plugin, pauses the scene, and goes on without it.
class Plugin {
 public:
  virtual ~Plugin() = default;
  virtual const char* label() const = 0;         ///< a few words: "Water"
  virtual const char* help() const = 0;          ///< one paragraph: model, source, validity, limits
  virtual ParameterList parameters() const = 0;  ///< own parameters; values arrive in this order
  /// Capabilities and interfaces beyond those of 1.0, by name; nullptr for what the plugin does not know.
  virtual const void* extension(const char* /*name*/) const noexcept { return nullptr; }
};

}  // namespace ps::api
