// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/parameter.h>
#include <phasesketch/views.h>

namespace ps::api {

/// What all four kinds share. Objects are stateless after construction and may be called from several threads at once:
/// whatever a scene needs lives in fields, constraint values and parameters that the host owns.
/// A function may throw std::exception only where its comment says so; the host then names the plugin, pauses the
/// scene, and goes on without it.
class Plugin {
 public:
  virtual ~Plugin() = default;
  virtual const char* label() const noexcept = 0;
  virtual const char* help() const noexcept = 0;           ///< one paragraph: model, source, validity, limits
  virtual ParameterList parameters() const noexcept = 0;   ///< own parameters; values arrive in this order
  /// For interfaces added in a later 1.x; nullptr when unknown.
  virtual void* extension(const char* /*name*/) noexcept { return nullptr; }
};

}  // namespace ps::api
