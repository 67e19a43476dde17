// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/failure.h"

#include "core/base/progress.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/sceneproblem.h"

#include <cctype>
#include <exception>
#include <new>

namespace ps {

EngineEvent failureAtHand(EngineEvent::Kind kind) {
  EngineEvent event;
  event.kind = kind;
  try {
    throw;
  } catch (const Cancelled&) {
    event.kind = EngineEvent::Kind::Cancelled;
  } catch (const SceneError& error) {
    event.message = error.what();  // a sentence; elsewhere a file's name comes before it
    event.message[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(event.message[0])));
    event.culprit = error.culprit;
  } catch (const PluginError& error) {
    event.message = error.what();
    event.flags = static_cast<StepFlags>(StepFlag::PluginFault);
  } catch (const std::bad_alloc&) {
    event.message = "there is not enough memory for it";
  } catch (const std::exception& error) {
    event.message = error.what();
  } catch (...) {
    event.message = "an exception that is no std::exception";
  }
  return event;
}

EngineEvent refusalOf(const SetParameter& edit, const Project& present, EngineEvent failure) {
  failure.culprit = edit.address;
  failure.asked = edit.value;
  failure.kept = storedValue(present, edit.address);
  return failure;
}

}  // namespace ps
