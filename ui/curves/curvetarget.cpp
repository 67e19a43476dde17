// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/curvetarget.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/snapshot.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/presets.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/rowmodels.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"

#include <QtCore/QMimeData>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ps {
namespace {

constexpr double kAround = 100;     // K, on both sides of where matter is
constexpr double kLeastRange = 20;  // K, of those that are left of a law
constexpr double kHottest = 5000;   // K, of a table of what particles have
constexpr size_t kTableSamples = 4096;

/// Of an installed material alone, which says what it is like.
Project sceneOf(const std::string& base, const PluginRegistry* plugins) {
  const Material* material = plugins ? plugins->material(base) : nullptr;
  Project project;
  project.materials.push_back({base, material ? material->label : base, base, {}, {}, {}, {}, {}});
  return project;
}

}  // namespace

std::optional<OtherMaterial> draggedMaterial(const QMimeData& data) {
  for (const bool installed : {false, true}) {
    const QString kind = QLatin1String(installed ? kInstalledMime : kMaterialMime);
    if (data.hasFormat(kind)) return OtherMaterial{data.data(kind).toStdString(), installed};
  }
  return std::nullopt;
}

QString labelOf(Between way) {
  static const std::array kLabels{"Step", "Linear", "Monotone", "Stated slopes"};
  return QString::fromLatin1(kLabels[static_cast<size_t>(way)]);
}

const api::ParameterDeclaration& temperatureDeclaration() {
  return propertyCatalogue()[static_cast<size_t>(propertyIndex("melting_temperature"))];
}

CurveTarget::CurveTarget(Session& session, Selection& selection, QObject* parent)
    : QObject(parent), m_session(session), m_selection(selection) {
  connect(&selection, &Selection::materialChanged, this, [this] {
    m_track.reset();
    onTarget();
  });
  connect(&selection, &Selection::changed, this, &CurveTarget::markChanged);
  connect(&session.document(), &Document::changed, this, &CurveTarget::onChanged);
}

void CurveTarget::onChanged(const ChangeEvent& event) {
  if (std::holds_alternative<ProjectOpened>(event)) {
    m_laws.clear();
    m_compared.clear();
    m_track.reset();
  }
  if (std::holds_alternative<MaterialsChanged>(event)) followInstalled();
  if (std::holds_alternative<ProjectOpened>(event) || std::holds_alternative<MaterialsChanged>(event))
    return onTarget();
  if (m_track && !document().track(*m_track)) return onTarget();
  const auto* parameter = std::get_if<ParameterChanged>(&event);
  const auto* track = std::get_if<TracksChanged>(&event);
  const bool mine =
      m_track ? track && track->parameter == m_track->text() : parameter && parameter->address.owner == Owner::Material;
  if (!mine) return;
  remember();
  Q_EMIT responseChanged();
}

Document& CurveTarget::document() const { return m_session.document(); }
std::string CurveTarget::material() const { return m_selection.material(); }

QString CurveTarget::materialLabel() const {
  return material().empty() ? QString() : ownerLabel(document().project(), address());
}

const api::ParameterDeclaration& CurveTarget::declaration() const {
  if (const auto* declared = m_track ? document().keyDeclaration(*m_track) : nullptr) return *declared;
  return propertyCatalogue()[static_cast<size_t>(propertyIndex(m_key))];
}

Response CurveTarget::response() const {
  if (const Track* keys = m_track ? document().track(*m_track) : nullptr) return curveOf(keys->keys);
  return material().empty() ? Response(declaration().defaultValue) : responseOf(document().value(address()));
}

std::optional<Response> CurveTarget::ghost() const {
  if (m_track || material().empty()) return std::nullopt;
  const auto last = m_laws.find(address().text());
  const Response standard = responseOf(document().defaultValue(address()));
  const Response law = last != m_laws.end() ? last->second : standard;
  return law.kind == Response::Kind::Law && !(law == response()) ? std::optional(law) : std::nullopt;
}

double CurveTarget::shownSlope(double value, double slope) const {
  const double shown = slope * displayFactor(declaration());
  if (declaration().scale != api::Scale::Logarithmic) return shown;
  const double here = toDisplay(declaration(), value);
  return here > 0 ? shown / (here * std::log(10.0)) : 0;
}

double CurveTarget::storedSlope(double value, double shown) const {
  const double one = shownSlope(value, 1);
  return one != 0 ? shown / one : 0;
}

QString CurveTarget::slopeUnit() const {
  const bool decades = declaration().scale == api::Scale::Logarithmic;
  return (decades ? QStringLiteral("dec") : displayUnit(declaration())) + QLatin1Char('/') +
         QString::fromUtf8(axis().unit);
}

QString CurveTarget::title() const {
  return m_track ? document().trackTitle(*m_track) : QString::fromUtf8(declaration().label);
}

QString CurveTarget::subtitle() const {
  if (m_track) return QStringLiteral("over time");
  const QString from = source();
  return QStringLiteral("of %1, over temperature").arg(materialLabel()) +
         (from.isEmpty() ? from : QStringLiteral(" · ") + from);
}

QString CurveTarget::source() const { return m_track ? QString() : sourceOf(document(), material(), m_key.c_str()); }

double CurveTarget::temperature(const MaterialNow& now) const {
  if (now.count > 0) return now.mean;
  return std::get<double>(document().value({Owner::Environment, "", "ambient_temperature"}));
}

std::optional<std::array<double, 2>> CurveTarget::melting() const {
  if (m_track || material().empty()) return std::nullopt;
  const auto at = [this](const char* key) {
    return responseOf(document().value({Owner::Material, material(), key})).at(temperatureDeclaration().defaultValue);
  };
  const double middle = at("melting_temperature"), solidus = at("solidus"), liquidus = at("liquidus");
  if (middle <= 0) return std::nullopt;
  if (solidus < liquidus && solidus <= middle && middle <= liquidus) return std::array{solidus, liquidus};
  return std::array{middle, middle};
}

std::array<double, 2> CurveTarget::range() const {
  const Response present = response();
  if (m_track) return {0, std::max(document().project().duration, present.points.back().x)};
  const bool curve = present.kind == Response::Kind::Curve;
  const double kelvin = temperature(), around = curve ? 0 : kAround;
  double cold = kelvin - around, hot = kelvin + around;
  const auto take = [&](double one, double other) {
    cold = std::min(cold, one);
    hot = std::max(hot, other);
  };
  if (curve) take(present.points.front().x, present.points.back().x);
  if (const auto melts = melting()) take((*melts)[0] - 0.2 * around, (*melts)[1] + 0.2 * around);
  cold = std::max(1.0, cold);
  // A law goes on where it means nothing: a liquid's viscosity 100 K below freezing.
  const auto usual = [&](double t) {
    const double value = present.at(t);
    return value >= declaration().minimum && value <= declaration().maximum;
  };
  if (present.kind == Response::Kind::Law) {
    while (cold + kLeastRange < kelvin && !usual(cold)) cold += 1;
    while (hot - kLeastRange > kelvin && !usual(hot)) hot -= 1;
  }
  return {cold, hot};
}

std::optional<double> CurveTarget::delivered() const {
  const SnapshotPtr snapshot = m_session.snapshot();
  if (m_track || !snapshot) return std::nullopt;
  const std::string what = material() + "." + m_key;
  const auto& limits = snapshot->limits;
  const auto found = std::find_if(limits.begin(), limits.end(), [&](const Limit& limit) {
    return limit.what == what && limit.body < 0 && limit.delivered < limit.asked;
  });
  return found == limits.end() ? std::nullopt : std::optional(found->delivered);
}

MaterialNow CurveTarget::now(double firstKelvin, double lastKelvin) const {
  MaterialNow result;
  const SnapshotPtr snapshot = m_session.snapshot();
  if (!snapshot) return result;
  const auto& ids = snapshot->materialIds;
  const auto found = std::find(ids.begin(), ids.end(), material());
  if (found == ids.end()) return result;
  const auto index = static_cast<uint32_t>(found - ids.begin());
  const auto& mark = m_selection.marked();
  const bool marks = mark && mark->first == snapshot->revision;
  const double perBin = static_cast<double>(MaterialNow::kBins) / (lastKelvin - firstKelvin);
  double sum = 0;
  for (size_t i = 0; i < snapshot->material.size(); ++i) {
    if (snapshot->material[i] != index) continue;
    const double kelvin = static_cast<double>(snapshot->temperature[i]);
    sum += kelvin;
    ++result.count;
    const auto phase = static_cast<size_t>(snapshot->phase[i]);
    ++result.phases[phase];
    result.phaseMean[phase] += kelvin;
    if (snapshot->phase[i] == api::Phase::Boiling) result.boiled += static_cast<double>(snapshot->gasFraction[i]);
    if (marks && snapshot->id[i] == mark->second) result.marked = kelvin;
    const double bin = (kelvin - firstKelvin) * perBin;
    if (!(bin >= 0) || bin >= static_cast<double>(MaterialNow::kBins)) continue;
    ++result.bins[static_cast<size_t>(bin)];
    ++result.within;
  }
  const auto boiling = static_cast<size_t>(api::Phase::Boiling);
  if (result.phases[boiling] > 0) result.boiled /= static_cast<double>(result.phases[boiling]);
  for (size_t k = 0; k < result.phases.size(); ++k) {
    if (result.phases[k] > 0) result.phaseMean[k] /= static_cast<double>(result.phases[k]);
  }
  if (result.count > 0) result.mean = sum / static_cast<double>(result.count);
  return result;
}

size_t CurveTarget::countAbove(double value) const {
  const SnapshotPtr snapshot = m_session.snapshot();
  if (!snapshot) return 0;
  const auto& ids = snapshot->materialIds;
  const auto index = static_cast<uint32_t>(std::find(ids.begin(), ids.end(), material()) - ids.begin());
  const ResponseTable table(response(), leastX(), kHottest, kTableSamples);
  size_t count = 0;
  for (size_t i = 0; i < snapshot->material.size(); ++i) {
    if (snapshot->material[i] == index && table.at(static_cast<double>(snapshot->temperature[i])) > value) ++count;
  }
  return count;
}

void CurveTarget::choose(const Address& address) {
  const int index = propertyIndex(address.key);
  if (address.owner != Owner::Material || index < 0) return;
  if (propertyCatalogue()[static_cast<size_t>(index)].kind != api::ParameterKind::Response) return;
  m_key = address.key;
  m_track.reset();
  if (address.id != material()) {
    m_selection.setMaterial(address.id);  // comes back as onTarget()
  } else {
    onTarget();
  }
}

void CurveTarget::onTarget() {
  m_point = -1;
  if (m_track && !document().track(*m_track)) m_track.reset();
  remember();
  Q_EMIT targetChanged();
  Q_EMIT responseChanged();
  Q_EMIT pointChanged();
}

void CurveTarget::remember() {
  if (!m_track && material().empty()) return;
  const Response present = response();
  if (present.kind == Response::Kind::Law) m_laws[address().text()] = present;
  const int last = present.kind == Response::Kind::Curve ? static_cast<int>(present.points.size()) - 1 : -1;
  if (m_point > last) choosePoint(last);
}

void CurveTarget::choosePoint(int index) {
  if (index == m_point) return;
  m_point = index;
  Q_EMIT pointChanged();
}

void CurveTarget::compare(const OtherMaterial& other, bool on) {
  if (on && other == OtherMaterial{material()}) {
    Q_EMIT refused(QStringLiteral("This is the curve of %1 already.").arg(materialLabel()));
    return;
  }
  if (on ? !m_compared.insert(other).second : m_compared.erase(other) == 0) return;
  Q_EMIT comparedChanged();
}

/// What has come into the scene is compared as it is there.
void CurveTarget::followInstalled() {
  for (const SceneMaterial& own : document().project().materials) {
    if (!own.mixture && m_compared.erase({own.base, true}) > 0) m_compared.insert({own.id});
  }
}

std::vector<OtherMaterial> CurveTarget::others() const {
  std::vector<OtherMaterial> all;
  for (const SceneMaterial& other : document().project().materials) {
    if (other.id != material()) all.push_back({other.id});
  }
  std::copy_if(m_compared.begin(), m_compared.end(), std::back_inserter(all),
               [](const OtherMaterial& other) { return other.installed; });
  return all;
}

std::vector<OtherMaterial> CurveTarget::installed() const {
  const PluginRegistry* plugins = document().plugins();
  std::vector<OtherMaterial> all;
  for (const std::string& base : plugins ? plugins->ids(PluginKind::Material) : std::vector<std::string>{}) {
    const bool there = installedIn(document().project(), base) != nullptr;
    if (!there && !m_compared.contains({base, true})) all.push_back({base, true});
  }
  return all;
}

QString CurveTarget::otherLabel(const OtherMaterial& other) const {
  const Address address{Owner::Material, other.id, m_key};
  return ownerLabel(other.installed ? sceneOf(other.id, document().plugins()) : document().project(), address);
}

Response CurveTarget::otherResponse(const OtherMaterial& other) const {
  const Address address{Owner::Material, other.id, m_key};
  if (!other.installed) return responseOf(document().value(address));
  return responseOf(valueAt(sceneOf(other.id, document().plugins()), document().plugins(), address));
}

void CurveTarget::begin(const QString& what) { document().beginGesture(what); }
void CurveTarget::end() { document().endGesture(); }

bool CurveTarget::set(const Response& response, const QString& what) {
  if (!m_track && material().empty()) return false;
  if (!what.isEmpty()) begin(what);
  const QString problem = m_track ? setTrack(response) : document().setParameter(address(), response);
  if (!what.isEmpty()) end();
  Q_EMIT refused(problem);
  return problem.isEmpty();
}

}  // namespace ps
