// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/placetool.h"

namespace ps {

/// Puts a sink that stands on the surface; a drag makes it wider.
class PlaceDrain final : public PlaceTool<Sink> {
 public:
  using PlaceTool::PlaceTool;
  ToolPicture picture() const override;
  QString words() const override { return QStringLiteral("Place a drain"); }
  std::vector<Gesture> gestures() const override;

 private:
  Sink at(const Surface& surface, const Pointer* pressed, const Pointer& pointer) const override;
  void put(Sink drain) override;
};

}  // namespace ps
