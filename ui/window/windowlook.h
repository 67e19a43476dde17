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

}  // namespace ps
