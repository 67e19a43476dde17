// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/runtime.h"

namespace ps::vr {

/// Where the floor is: the one below where its wearer sits or stands (XR_EXT_local_floor); else that of the stage;
/// else, of a headset that knows nothing of floors, one as far below its eyes as those of somebody who stands.
class Floor {
 public:
  static constexpr const char* kExtension = "XR_EXT_local_floor";

  /// Throws Failure.
  Floor(const Runtime& runtime, XrSession session);
  /// y is up, and 0 at the floor; z points back from where its user looked at first. It goes with the session.
  XrSpace space() const { return m_space; }
  XrReferenceSpaceType type() const { return m_type; }

 private:
  XrReferenceSpaceType m_type = XR_REFERENCE_SPACE_TYPE_LOCAL;
  XrSpace m_space = XR_NULL_HANDLE;
};

}  // namespace ps::vr
