// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <vector>

namespace ps {

class Tool;
class Toolbox;

/// One tool as buttons, menus and keys know it. A new tool is a class in a file of its own and a row in the table.
struct ToolRow {
  const char* id;    ///< "brush"; in settings and actions
  const char* icon;  ///< of its button
  const char* name;  ///< "Brush": in menus
  const char* tip;   ///< of its button
  const char* key;   ///< "B"
  const char* page;  ///< heading of its gestures among the shortcuts: "In the scene with the brush"
  std::unique_ptr<Tool> (*make)(Toolbox&);
};

const std::vector<ToolRow>& toolTable();
const ToolRow* toolRow(const std::string& id);  ///< nullptr for an unknown id

// Ids of the tools that the program itself goes to.
inline constexpr const char* kSelectTool = "select";  ///< the first one; Esc goes back to it
inline constexpr const char* kEraseTool = "erase";
inline constexpr const char* kBrushTool = "brush";  ///< that the workspace Sketch begins with

}  // namespace ps
