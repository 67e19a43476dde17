// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/types.h>

// Every plugin carries the version of the headers that it was built with, in words that the host finds in the file
// before it loads any code: the metadata say what their author believes, this is what the compiler saw.
#define PHASESKETCH_STAMP_HEAD "phasesketch-sdk:"
#define PHASESKETCH_STAMP_VERSION "0.9:3"  // kVersionMajor.kVersionMinor:kLayout

namespace ps::api {
constexpr bool stampAgrees() {
  constexpr char text[] = PHASESKETCH_STAMP_VERSION;
  return text[0] == '0' + kVersionMajor && text[1] == '.' && text[2] == '0' + kVersionMinor && text[3] == ':' &&
         text[4] == '0' + kLayout && sizeof text == 6;
}
static_assert(stampAgrees(), "PHASESKETCH_STAMP_VERSION must say the versions of types.h");
}  // namespace ps::api

extern "C" __attribute__((weak, used, visibility("default"))) const char phasesketch_sdk_stamp[] =
    PHASESKETCH_STAMP_HEAD PHASESKETCH_STAMP_VERSION;
