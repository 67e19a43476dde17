// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/address.h"
#include "core/simulation/runrecord.h"

namespace ps {

/// What a parameter, a number or a switch, was at each frame of a run: the document's value as it was edited, and, from
/// their first on, its keys.
class ParameterCourse {
 public:
  ParameterCourse(const RunEdits& run, const PluginRegistry* plugins, const Address& address);
  /// In the unit of its declaration, 0 or 1 of a switch; NaN where the document has no such parameter.
  double at(const FrameStats& stats) const;

 private:
  struct Piece {
    uint64_t from = 0;  ///< number of the first frame at which it holds
    double own = 0;     ///< what the document says
    std::vector<TrackKey> keys;
  };
  void take(uint64_t frame, const Project& project, const PluginRegistry* plugins, const Address& address);
  Piece& pieceFrom(uint64_t frame);
  std::vector<Piece> m_pieces;
  double m_slack = 0;  ///< s
};

}  // namespace ps
