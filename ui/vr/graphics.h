// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/runtime.h"

#include <variant>

namespace ps::vr {

/// OpenXR's word for an OpenGL context.
using GraphicsBinding = std::variant<XrGraphicsBindingEGLMNDX, XrGraphicsBindingOpenGLXlibKHR>;

/// Of the context that is current on this thread, by EGL or by GLX. Throws Error where none is, or where the runtime
/// does not know its kind.
GraphicsBinding currentGraphics(const Runtime& runtime);

/// Of the same kind; what it is does not matter, but whether it is still the same. nullptr: none is current.
const void* currentContext();

}  // namespace ps::vr
