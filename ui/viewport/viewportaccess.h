// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// Makes viewports known to assistive technology; may be called often.
void installViewportAccessibility();

}  // namespace ps
