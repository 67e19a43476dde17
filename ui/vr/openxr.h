// SPDX-License-Identifier: Apache-2.0
#pragma once
// OpenXR with both kinds of OpenGL binding that it has on Linux; epoxy comes first, Xlib's macros leave again.
#include <epoxy/gl.h>

#include <epoxy/egl.h>

#include <epoxy/glx.h>

#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

// Each of these is a name in Qt or in our own sources.
#undef Always
#undef Bool
#undef CursorShape
#undef Expose
#undef FocusIn
#undef FocusOut
#undef FontChange
#undef KeyPress
#undef KeyRelease
#undef None
#undef Status
#undef Success
#undef Unsorted
