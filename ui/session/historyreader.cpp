// SPDX-License-Identifier: Apache-2.0
#include "ui/session/historyreader.h"

#include "core/simulation/enginethread.h"
#include "ui/session/session.h"

namespace ps {

HistoryReader::Piece HistoryReader::read() {
  Piece piece;
  const SnapshotPtr snapshot = m_session.newest();
  if (!snapshot) return piece;
  piece.begins = snapshot->revision != m_revision;
  if (piece.begins) m_read = 0;
  m_revision = snapshot->revision;
  piece.frames = m_session.engine()->history(m_read, kMost);
  piece.more = piece.frames.size() == kMost;
  if (!piece.frames.empty()) m_read = piece.frames.back().frame;
  return piece;
}

}  // namespace ps
