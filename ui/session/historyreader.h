// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <vector>

namespace ps {

class Session;

/// Reads what each frame measured, piece by piece, for one who draws it.
class HistoryReader {
 public:
  explicit HistoryReader(Session& session) : m_session(session) {}
  struct Piece {
    bool begins = false;  ///< another run: what came before does not belong to it
    /// The frame read last comes again: the scene may have been edited since, and its newer values replace the older
    /// ones.
    std::vector<FrameStats> frames;
    bool more = false;  ///< there are more than fit one turn of the event loop: to be read in the next one
  };
  static constexpr size_t kMost = 1024;  ///< frames of a piece
  Piece read();
  void rewind() { m_revision = m_read = 0; }  ///< the next piece is all of the run

 private:
  Session& m_session;
  uint64_t m_revision = 0;
  uint64_t m_read = 0;  ///< number of the frame read last
};

}  // namespace ps
