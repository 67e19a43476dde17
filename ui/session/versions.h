// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QDateTime>
#include <QtCore/QString>

#include <vector>

namespace ps::versions {

/// What a project's file held before it was saved anew.
struct Version {
  QString file;    ///< the bytes, in the user's state directory
  QDateTime time;  ///< when they were saved
  qint64 size = 0;
};

inline constexpr int kKept = 5;

/// Newest first, at most kKept.
std::vector<Version> of(const QString& path);
/// The file as it stands now becomes a version, unless it is the newest already; older ones than kKept go. Nothing
/// happens where there is no file. Throws Error.
void keep(const QString& path);

}  // namespace ps::versions
