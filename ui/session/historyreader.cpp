// SPDX-License-Identifier: Apache-2.0
#include "ui/session/historyreader.h"

#include "core/simulation/enginethread.h"
#include "ui/session/session.h"

namespace ps {

HistoryReader::Piece HistoryReader::read() {
  Piece piece;
  const SnapshotPtr snapshot = m_session.snapshot();
  if (!snapshot) return piece;
  piece.begins = snapshot->revision != m_revision;
  if (piece.begins) m_read = 0;
  m_revision = snapshot->revision;
  const size_t from = m_read > 0 ? m_read - 1 : 0;
  piece.frames = m_session.engine()->history(from);
  m_read = from + piece.frames.size();
  return piece;
}

}  // namespace ps
