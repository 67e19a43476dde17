// SPDX-License-Identifier: Apache-2.0
#include "core/scene/project.h"

namespace ps {

const std::vector<std::string>& graphKindNames() {
  static const std::vector<std::string> names{"time", "phases", "energy", "histogram", "profile"};
  return names;
}

}  // namespace ps
