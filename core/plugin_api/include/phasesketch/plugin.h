// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/parameter.h>
#include <phasesketch/views.h>

namespace ps::api {

/// What a plugin may ask of the program. Lives as long as the process; may be called from any thread. What belongs to
/// one scene (its time, its materials) comes with each call, in the context: objects of plugins are shared by scenes.
class Host {
 public:
  enum class Severity : uint32_t { Note, Warning };
  /// One line in the program's log, under the plugin's name. Long texts are cut; more than 100 lines are dropped.
  virtual void log(Severity severity, const char* text) noexcept = 0;
  /// Value of a property (a key of the catalogue) of an installed material at a temperature in K; NaN for what is not
  /// there, and while plugins are being loaded. Not for inner loops.
  virtual double property(const char* material, const char* key, double temperature) const noexcept = 0;
  /// Services beyond these, by name; nullptr for what the program does not know.
  virtual const void* extension(const char* name) const noexcept = 0;

 protected:
  ~Host() = default;
};

/// Service of the host: extension(kThreads) is its Threads, which a plugin keeps from attach() on.
inline constexpr const char* kThreads = "threads";
class Threads {
 public:
  /// Calls body(data, first, last) for consecutive chunks of `grain` of `count` elements, from any thread, and returns
  /// when all are done, on as many threads as it is worth: of `microseconds` on one, until it was seen. Chunks are the
  /// same for any number of threads, and so is what is summed chunk by chunk and then in their order. Throws what a
  /// body has thrown.
  virtual void share(size_t count, size_t grain, double microseconds,
                     void (*body)(void* data, size_t first, size_t last), void* data) const = 0;

 protected:
  ~Threads() = default;
};
/// body(first, last) by chunks; one after the other where there are no threads.
template <class Body>
void shareAmong(const Threads* threads, size_t count, size_t grain, double microseconds, const Body& body) {
  if (threads && count > grain) {
    const auto call = [](void* data, size_t first, size_t last) { (*static_cast<const Body*>(data))(first, last); };
    return threads->share(count, grain, microseconds, call, const_cast<Body*>(&body));
  }
  for (size_t first = 0; first < count; first += grain) body(first, first + grain < count ? first + grain : count);
}

/// What all kinds share. Objects are stateless after attach() and may be called from several threads at once: whatever
/// a scene needs lives in fields, constraint values and parameters that the host owns.
///
/// What a plugin declares (label, help, parameters and the lists of its kind) is read when it is loaded, must be the
/// same at every call and live as long as the object. A constructor or a declaration that throws makes the host refuse
/// the plugin. Later a function may throw std::exception only where its comment says so; the host then names the
/// plugin, pauses the scene, and goes on without it. The same happens where a function returns what cannot be: numbers
/// that are not finite, temperatures below 0 K, shares outside 0 .. 1, null pointers.
class Plugin {
 public:
  virtual ~Plugin() = default;
  virtual const char* label() const = 0;         ///< a few words: "Water"
  virtual const char* help() const = 0;          ///< one paragraph: model, source, validity, limits
  virtual ParameterList parameters() const = 0;  ///< own parameters; values arrive in this order
  /// Capabilities and interfaces beyond those of its kind, by name; nullptr for what the plugin does not know.
  virtual const void* extension(const char* /*name*/) const noexcept { return nullptr; }
  /// Called once, when all it declares has been read. The host lives as long as the plugin. May throw.
  virtual void attach(Host& /*host*/) {}
};

/// What a plugin declares of itself where that is the same for all its objects; the texts outlive the plugin.
struct About {
  const char* label;
  const char* help;
  ParameterList parameters;
};

/// A kind of plugin that declares by its constructor: `class Lamp : public QObject, public Described<HeatSourcePlugin>`
/// with `Lamp::Lamp() : Described({"Lamp", "A round beam ...", listOf(kParameters)}) {}`.
template <class Kind>
class Described : public Kind {
 public:
  explicit Described(const About& about) noexcept : m_about(about) {}
  const char* label() const noexcept override { return m_about.label; }
  const char* help() const noexcept override { return m_about.help; }
  ParameterList parameters() const noexcept override { return m_about.parameters; }

 private:
  About m_about;
};

}  // namespace ps::api
