// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/tooltable.h"

#include "ui/tools/drawtool.h"
#include "ui/tools/gizmotool.h"
#include "ui/tools/measuretool.h"
#include "ui/tools/placedrain.h"
#include "ui/tools/placetap.h"
#include "ui/tools/selecttool.h"
#include "ui/tools/takeinhand.h"

#include <algorithm>

namespace ps {
namespace {

template <class T>
std::unique_ptr<Tool> make(Toolbox& box) {
  return std::make_unique<T>(box);
}

}  // namespace

const std::vector<ToolRow>& toolTable() {
  static const std::vector<ToolRow> kTable{
      {kSelectTool, "select", "Select and orbit", "Select and orbit", "Q", "In the scene", make<SelectTool>},
      {"move", "move", "Move", "Move what is selected", "W", "In the scene with the handles to move", make<MoveTool>},
      {"rotate", "rotate", "Rotate", "Rotate what is selected", "R", "In the scene with the rings to rotate",
       make<RotateTool>},
      {"scale", "scale", "Scale", "Scale what is selected", "S", "In the scene with the handles to scale",
       make<ScaleTool>},
      {"hand", "hand", "Take in hand", "Lead a tool through matter", "A", "In the scene with a tool in hand",
       make<TakeInHand>},
      {kBrushTool, "brush", "Brush", "Draw matter", "B", "In the scene with the brush", make<DrawTool>},
      {kEraseTool, "erase", "Erase", "Erase matter", "E", "In the scene with the eraser", make<EraseTool>},
      {"tap", "tap", "Place a tap", "Place a tap that pours matter", "T", "In the scene with a tap", make<PlaceTap>},
      {"drain", "drain", "Place a drain", "Place a drain that takes matter away", "D", "In the scene with a drain",
       make<PlaceDrain>},
      {"ruler", "ruler", "Measure", "Measure how far it is", "U", "In the scene with the ruler", make<MeasureTool>},
  };
  return kTable;
}

const ToolRow* toolRow(const std::string& id) {
  const std::vector<ToolRow>& table = toolTable();
  const auto found = std::find_if(table.begin(), table.end(), [&](const ToolRow& row) { return id == row.id; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace ps
