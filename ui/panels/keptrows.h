// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/address.h"
#include "core/scene/project.h"
#include "ui/rows/parameterrow.h"

#include <QtCore/QRectF>

#include <string>
#include <vector>

class QPainter;

namespace ps {

/// Values for a plugin that is not here, in a group that bears its id, as rows that show what the file says and that
/// nobody can edit: what they mean, and in which units, the plugin alone knows. `unknown`: of the owner, as the file's
/// reader kept it; `part`: "" or the object in it that holds "parameters". `any`: whose they are, without a key.
std::vector<RowModel> keptRows(const ParameterSet& set, const Unknown& unknown, const char* part, const Address& any,
                               const std::string& plugin);

/// What stands for the look of matter whose material is not here: hatched, with a plug.
void paintPlaceholder(QPainter& painter, const QRectF& square);

}  // namespace ps
