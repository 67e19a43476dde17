// SPDX-License-Identifier: Apache-2.0
// What the table does with all points at once.
#include "core/math/responseedit.h"
#include "ui/curves/curvetarget.h"
#include "ui/curves/pointspanel.h"
#include "ui/curves/pointtable.h"
#include "ui/theme/numbers.h"

#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QLineEdit>

#include <cmath>

namespace ps {

void PointsPanel::paste() {
  PastedTable table = readTable(QGuiApplication::clipboard()->text(), m_target.axis(), m_target.declaration());
  if (!table.problem.isEmpty()) return note(table.problem);
  const size_t count = table.points.size();
  if (m_target.set(curveThrough(std::move(table.points)), QStringLiteral("Paste points of ") + m_target.title()))
    note(QStringLiteral("%1 points were pasted.").arg(count));
}

/// Within so many per cent: of each value where the axis is logarithmic, else of the largest.
void PointsPanel::thinOut() {
  const Response response = m_target.response();
  const auto percent = parseNumber(m_tolerance->text().remove(QLatin1Char('%')));
  if (!percent || *percent <= 0) return note(QStringLiteral("The tolerance must be a number above 0."));
  if (response.kind != Response::Kind::Curve) return;
  const Thinned thin = thinned(response, 0.01 * *percent, m_target.declaration().scale == api::Scale::Logarithmic);
  const size_t before = response.points.size(), after = thin.curve.points.size();
  if (after == before) return note(QStringLiteral("No point can go within %1 %.").arg(formatShort(*percent)));
  if (m_target.set(thin.curve, QStringLiteral("Thin out points of ") + m_target.title()))
    note(QStringLiteral("%1 of %2 points are left; the curve moved by %3 % at most.")
             .arg(after)
             .arg(before)
             .arg(formatShort(100 * thin.error, 2)));
}

}  // namespace ps
