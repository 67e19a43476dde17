// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QByteArray>
#include <QtCore/QString>

namespace ps {

/// A file that the program carries: "theme/tokens.json", "icons/play.svg". Throws Error when there is none.
QByteArray themeResource(const QString& path);

}  // namespace ps
