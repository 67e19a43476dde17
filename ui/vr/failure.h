// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"

#include <openxr/openxr.h>

namespace ps::vr {

/// A call of OpenXR that failed; the message says to whoever wears the headset what happened and what to do.
class Failure : public Error {
 public:
  Failure(XrResult result, const char* call);
  XrResult result() const { return m_result; }

 private:
  XrResult m_result;
};

/// Throws Failure for a result that is an error. What is returned tells apart the kinds of success.
XrResult check(XrResult result, const char* call);

}  // namespace ps::vr
