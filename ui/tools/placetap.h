// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/placetool.h"

namespace ps {

/// Puts an emitter: a click pours away from the surface, a drag up pours down from above it, and so does the air.
class PlaceTap final : public PlaceTool<Emitter> {
 public:
  using PlaceTool::PlaceTool;
  ToolPicture picture() const override;
  QString words() const override { return QStringLiteral("Place a tap"); }
  std::vector<Gesture> gestures() const override;

 private:
  Emitter at(const Surface& surface, const Pointer* pressed, const Pointer& pointer) const override;
  void put(Emitter tap) override;
};

}  // namespace ps
