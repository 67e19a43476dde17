// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

namespace ps {

/// What a folder of the user's cache may hold. What goes is made again when it is wanted.
struct CacheBound {
  qint64 bytes = qint64{32} << 20;
  int days = 180;  ///< since a file was made or asked for last
};

/// Removes what is older than the bound says, then the oldest until the rest fits, and what was left by programs that
/// were ended while they wrote. Reads and removes files: for a worker.
void tidyCache(const QString& folder, const CacheBound& bound = {});
/// Says that a file of it is of use: it is as new as one that was just made. Seldom writes.
void useCached(const QString& path);

}  // namespace ps
