// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

class GraphsPanel;
class Resuming;
class Session;
class Toolbox;
class Viewport;

/// How graphs and legend are zoomed, and the brush, come back with the work. `view`: nullptr where there is no picture.
void keepLook(Resuming& resuming, Session& session, GraphsPanel& graphs, Toolbox& tools, Viewport* view);

/// The tool in hand, as the window is closed, and as it is opened again: where it is one of the workspace that comes
/// back.
void keepTool(const Toolbox& tools);
void takeToolAgain(Toolbox& tools);

}  // namespace ps
