// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/benchtables.h"

#include "core/base/error.h"
#include "core/parameters/parameterset.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

namespace ps {
namespace {

using nlohmann::json;

constexpr double kLeastShare = 0.01;  ///< of a frame, for a stage whose ratio says something

double ratioOf(const json& now, const json& old) {
  const double before = old.at("median"), after = now.at("median");
  return before > 0 ? after / before : 0;
}

bool isSame(const json& a, const json& b) {
  return a.at("name") == b.at("name") && a.at("threads") == b.at("threads") && a.at("particles") == b.at("particles");
}

json compareRow(const json& old, const json& now) {
  json stages = json::object();
  const double before = old.at("ms").at("median"), after = now.at("ms").at("median");
  for (const auto& [stage, cost] : now.at("stages").items()) {
    if (!old.at("stages").contains(stage)) continue;
    const json& former = old.at("stages").at(stage);
    if (former.at("median").get<double>() < kLeastShare * before &&
        cost.at("median").get<double>() < kLeastShare * after)
      continue;
    stages[stage] = ratioOf(cost, former);
  }
  return {{"name", now.at("name")},
          {"threads", now.at("threads")},
          {"particles", now.at("particles")},
          {"ratio", ratioOf(now.at("ms"), old.at("ms"))},
          {"stages", stages}};
}

/// Text between the tags of an SVG.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += c;
  }
  return result;
}

/// An axis of powers of ten around some values, as a line on the page.
class LogAxis {
 public:
  LogAxis(const std::vector<double>& values, double from, double to) : m_from(from), m_to(to) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    m_low = std::floor(std::log10(*least));
    m_high = std::max(m_low + 1, std::ceil(std::log10(*most)));
  }
  double at(double value) const { return m_from + (std::log10(value) - m_low) / (m_high - m_low) * (m_to - m_from); }
  std::vector<double> powers() const {
    std::vector<double> result;
    for (double p = m_low; p <= m_high; ++p) result.push_back(std::pow(10.0, p));
    return result;
  }

 private:
  double m_from, m_to, m_low = 0, m_high = 1;
};

struct Point {
  double particles, milliseconds;
};

constexpr double kWidth = 720, kHeight = 480, kLeft = 70, kRight = 520, kTop = 30, kBottom = 420;

void drawAxes(std::ostream& svg, const LogAxis& x, const LogAxis& y) {
  const auto line = [&](double x0, double y0, double x1, double y1) {
    svg << "<line x1=\"" << x0 << "\" y1=\"" << y0 << "\" x2=\"" << x1 << "\" y2=\"" << y1 << "\" stroke=\"#ccc\"/>\n";
  };
  for (const double p : x.powers()) {
    line(x.at(p), kTop, x.at(p), kBottom);
    svg << "<text x=\"" << x.at(p) << "\" y=\"" << kBottom + 18 << "\" text-anchor=\"middle\">" << numberText(p)
        << "</text>\n";
  }
  for (const double p : y.powers()) {
    line(kLeft, y.at(p), kRight, y.at(p));
    svg << "<text x=\"" << kLeft - 8 << "\" y=\"" << y.at(p) + 4 << "\" text-anchor=\"end\">" << numberText(p)
        << "</text>\n";
  }
  svg << "<text x=\"" << (kLeft + kRight) / 2 << "\" y=\"" << kBottom + 42
      << "\" text-anchor=\"middle\">particles</text>\n<text x=\"" << kLeft - 8 << "\" y=\"" << kTop - 12
      << "\" text-anchor=\"end\">ms per frame</text>\n";
}

}  // namespace

json compareBench(const json& old, const json& now, const std::string& name) {
  try {
    json rows = json::array();
    for (const json& row : now.at("scenes")) {
      if (!row.contains("stages")) continue;
      for (const json& former : old.at("scenes")) {
        if (former.contains("stages") && isSame(former, row)) rows.push_back(compareRow(former, row));
      }
    }
    return rows;
  } catch (const json::exception&) {
    throw InputError(name + ": is no file that bench wrote");
  }
}

std::string machineDifference(const json& old, const json& now) {
  std::string text;
  for (const char* key : {"cpu", "cores", "isa", "compiler"}) {
    const json before = old.contains("machine") ? old["machine"].value(key, json()) : json(),
               after = now["machine"].value(key, json());
    if (before == after) continue;
    text += (text.empty() ? "" : "; ") + std::string(key) + ": " + before.dump() + ", now " + after.dump();
  }
  return text;
}

std::string growthTable(const json& scenes) {
  std::ostringstream table;
  table << "name,particles,threads,ms,ns_per_particle_iteration,serial_share,memory_per_particle\n";
  for (const json& row : scenes) {
    table << row["name"].get<std::string>() << ',' << row["particles"] << ',' << row["threads"] << ','
          << numberText(row["ms"]["median"]) << ',' << numberText(row["ns_per_particle_iteration"]) << ','
          << numberText(row["serial_share"]) << ',' << numberText(row["memory_per_particle"]) << '\n';
  }
  return table.str();
}

std::string growthPlot(const json& scenes) {
  std::map<std::string, std::vector<Point>> lines;
  std::vector<double> particles, milliseconds;
  for (const json& row : scenes) {
    const Point point{row["particles"], row["ms"]["median"]};
    lines[row["name"].get<std::string>() + ", " + std::to_string(row["threads"].get<int>()) + " threads"].push_back(
        point);
    particles.push_back(point.particles);
    milliseconds.push_back(point.milliseconds);
  }
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kWidth << "\" height=\"" << kHeight
      << "\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  if (!particles.empty()) {
    const LogAxis x(particles, kLeft, kRight), y(milliseconds, kBottom, kTop);
    drawAxes(svg, x, y);
    static constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
    size_t index = 0;
    for (auto& [name, points] : lines) {
      std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.particles < b.particles; });
      const char* colour = kColours[index % std::size(kColours)];
      svg << "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" << colour << "\" points=\"";
      for (const Point& p : points) svg << x.at(p.particles) << ',' << y.at(p.milliseconds) << ' ';
      svg << "\"/>\n<text x=\"" << kRight + 12 << "\" y=\"" << kTop + 18 * static_cast<double>(index + 1)
          << "\" fill=\"" << colour << "\">" << escaped(name) << "</text>\n";
      ++index;
    }
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace ps
