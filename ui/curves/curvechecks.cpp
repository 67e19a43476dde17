// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/curvechecks.h"

#include "ui/curves/curvetarget.h"
#include "ui/document/document.h"
#include "ui/rows/groupheading.h"
#include "ui/session/session.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/theme.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr int kSamples = 400;    // of the curve, from end to end
constexpr size_t kMostRows = 5;  // that checksOf() gives
constexpr double kLevel = 1e-9;  // of the largest value: less is no rise

using Kind = CurveCheck::Kind;

struct Sample {
  double x, y;
};

std::vector<Sample> samplesOf(const CurveTarget& target) {
  const Response response = target.response();
  const auto [first, last] = target.range();
  std::vector<Sample> samples;
  for (int i = 0; i <= kSamples; ++i) {
    const double x = first + (last - first) * i / kSamples;
    samples.push_back({x, response.at(x)});
  }
  return samples;
}

/// Whether it rises or falls all the way, or where it first turns.
CurveCheck wayOf(const CurveTarget& target, const std::vector<Sample>& samples) {
  double largest = 0;
  for (const Sample& s : samples) largest = std::max(largest, std::abs(s.y));
  const QString over = target.track() ? QStringLiteral("over time") : QStringLiteral("with temperature");
  int way = 0;
  for (size_t i = 1; i < samples.size(); ++i) {
    const double rise = samples[i].y - samples[i - 1].y;
    const int now = std::abs(rise) <= kLevel * largest ? 0 : rise > 0 ? 1 : -1;
    if (now != 0 && way != 0 && now != way)
      return {Kind::News, QStringLiteral("%1 up to %2, then %3")
                              .arg(way > 0 ? QStringLiteral("Rises") : QStringLiteral("Falls"),
                                   formatValue(target.axis(), samples[i - 1].x),
                                   way > 0 ? QStringLiteral("falls") : QStringLiteral("rises"))};
    if (now != 0) way = now;
  }
  if (way == 0) return {Kind::Fine, QStringLiteral("The same everywhere")};
  return {Kind::Fine,
          (way > 0 ? QStringLiteral("Rises %1 everywhere") : QStringLiteral("Falls %1 everywhere")).arg(over)};
}

/// Against the slider's range, which holds what real matter has.
CurveCheck usualOf(const CurveTarget& target, const std::vector<Sample>& samples) {
  const api::ParameterDeclaration& d = target.declaration();
  const auto [least, most] =
      std::minmax_element(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.y < b.y; });
  const auto unusual = [&](const Sample& sample, const QString& side, double bound) {
    return CurveCheck{Kind::Warning, QStringLiteral("%1 at %2 is %3 what is usual, %4")
                                         .arg(formatValue(d, sample.y), formatValue(target.axis(), sample.x), side,
                                              formatBound(d, bound))};
  };
  if (most->y > d.maximum) return unusual(*most, QStringLiteral("above"), d.maximum);
  if (least->y < d.minimum) return unusual(*least, QStringLiteral("below"), d.minimum);
  return {Kind::Fine, QStringLiteral("All values are usual ones")};
}

QString counted(size_t count) { return formatFixed(static_cast<double>(count)); }

/// Where no point stands the value of the outermost one holds.
CurveCheck beyondPoints(const CurveTarget& target) {
  const std::vector<CurvePoint> points = target.response().points;
  const MaterialNow now = target.now(points.front().x, std::max(points.back().x, points.front().x + kPointGap));
  if (now.within == now.count) return {Kind::Fine, QStringLiteral("All particles lie between its points")};
  return {Kind::News, QStringLiteral("%1 particles lie beyond its points: the outermost value holds for them")
                          .arg(counted(now.count - now.within))};
}

void addSolver(const CurveTarget& target, std::vector<CurveCheck>& checks) {
  const auto most = target.delivered();
  if (!most) {
    checks.push_back({Kind::Fine, QStringLiteral("The solver follows all particles")});
    return;
  }
  const size_t all = target.now(0, 1).count, above = target.countAbove(*most);
  if (all == 0) return;
  const double share = 100 * static_cast<double>(all - above) / static_cast<double>(all);
  checks.push_back({2 * above > all ? Kind::News : Kind::Fine,
                    QStringLiteral("The solver follows %1 % of the particles").arg(formatShort(share, 2))});
  if (above > 0)
    checks.push_back({Kind::Warning, QStringLiteral("%1 particles are above %2, as far as the solver follows")
                                         .arg(counted(above), formatValue(target.declaration(), *most))});
}

}  // namespace

std::vector<CurveCheck> checksOf(const CurveTarget& target) {
  std::vector<CurveCheck> checks;
  if (!target.track() && target.material().empty()) return checks;
  const std::vector<Sample> samples = samplesOf(target);
  checks.push_back(wayOf(target, samples));
  checks.push_back(usualOf(target, samples));
  if (target.track()) {
    const double last = target.response().points.back().x, end = target.document().project().duration;
    if (last > end)
      checks.push_back({Kind::News, QStringLiteral("Its last key, at %1, lies behind the scene's %2")
                                        .arg(formatValue(target.axis(), last), formatValue(target.axis(), end))});
    return checks;
  }
  if (target.response().kind == Response::Kind::Curve) checks.push_back(beyondPoints(target));
  addSolver(target, checks);
  return checks;
}

CurveChecks::CurveChecks(Session& session, CurveTarget& target, QWidget* parent)
    : QWidget(parent), m_target(target), m_heading(new GroupHeading(QStringLiteral("Checks"))) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 8);
  column->setSpacing(4);
  column->addWidget(m_heading);
  for (size_t k = 0; k < kMostRows; ++k) {
    const Row row{new QWidget, new QLabel, new QLabel};
    row.text->setFont(Theme::font(TextRole::Small));
    row.text->setWordWrap(true);
    auto* line = new QHBoxLayout(row.box);
    line->setContentsMargins(10, 0, 8, 0);
    line->setSpacing(6);
    line->addWidget(row.sign, 0, Qt::AlignTop);
    line->addWidget(row.text, 1);
    column->addWidget(row.box);
    m_rows.push_back(row);
  }
  const auto follow = [this] {
    if (isVisible()) refresh();
  };
  connect(m_heading, &GroupHeading::foldedChanged, this, follow);
  connect(&target, &CurveTarget::responseChanged, this, follow);
  connect(&session, &Session::totalsDue, this, follow);
}

void CurveChecks::showEvent(QShowEvent*) { refresh(); }

void CurveChecks::refresh() {
  const Theme& theme = Theme::current();
  const std::vector<CurveCheck> checks = m_heading->isFolded() ? std::vector<CurveCheck>{} : checksOf(m_target);
  for (size_t k = 0; k < m_rows.size(); ++k) {
    m_rows[k].box->setVisible(k < checks.size());
    if (k >= checks.size()) continue;
    const auto [name, token] = checks[k].kind == Kind::Fine   ? std::pair("check", Token::Ok)
                               : checks[k].kind == Kind::News ? std::pair("info", Token::Info)
                                                              : std::pair("warning", Token::Warning);
    m_rows[k].sign->setPixmap(iconPixmap(QString::fromLatin1(name), theme[token], 14, devicePixelRatioF()));
    m_rows[k].text->setText(checks[k].text);
  }
}

}  // namespace ps
