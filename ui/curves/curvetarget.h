// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/responseedit.h"
#include "core/scene/address.h"
#include "ui/document/changeevent.h"

#include <QtCore/QObject>
#include <QtCore/QString>

#include <array>
#include <compare>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

class QMimeData;

namespace ps {

class Document;
class Selection;
class Session;

/// Where a material's particles are on the axis of temperature at the moment.
struct MaterialNow {
  static constexpr size_t kBins = 96;
  std::vector<size_t> bins = std::vector<size_t>(kBins);  ///< over the temperatures that were asked for
  size_t count = 0, within = 0;                           ///< of particles: all, and those in a bin
  double mean = 0;                                        ///< K, of all
  std::array<size_t, 5> phases{};                         ///< how many, by api::Phase
  std::array<double, 5> phaseMean{};                      ///< K, of those
  double boiled = 0;                                      ///< share of vapour in those that boil, mean
  std::optional<double> marked;                           ///< K, of the particle that was clicked, if of this material
};

/// A material whose curve may be drawn beside the one that is tuned.
struct OtherMaterial {
  std::string id;          ///< SceneMaterial::id, or that of an installed one of which the scene has none
  bool installed = false;  ///< the latter
  auto operator<=>(const OtherMaterial&) const = default;
};

/// The one that is dragged, perhaps as a body of it; nothing where that is something else.
std::optional<OtherMaterial> draggedMaterial(const QMimeData& data);

/// What is marked on the curve: a temperature in K, or a time in s.
struct CurveMark {
  QString who;  ///< "Selected particle, now"
  double x = 0;
};

/// Which response of the current material is tuned, of one editor: what list, curve and table of the workspace Tune
/// share. Instead of one it may be the keys of a parameter, which are a curve over time. Every edit goes through the
/// document: a gesture is one undo step, a single edit another.
class CurveTarget : public QObject {
  Q_OBJECT
 public:
  CurveTarget(Session& session, Selection& selection, QObject* parent = nullptr);

  Document& document() const;
  std::string material() const;   ///< SceneMaterial::id; "" in a scene without any
  QString materialLabel() const;  ///< as people call it
  /// Whether there is something to be tuned.
  bool isKnown() const { return m_track || !material().empty(); }
  Address address() const { return {Owner::Material, material(), m_key}; }
  /// Of what has keys, where they are edited.
  const std::optional<Address>& track() const { return m_track; }
  const api::ParameterDeclaration& declaration() const;
  const api::ParameterDeclaration& axis() const;  ///< of the temperature, or the time, that the curve is over
  double leastX() const { return m_track ? 0 : 1; }
  /// A time on a frame, as keys are; a temperature as it is.
  double snapped(double x) const;
  QString title() const;     ///< "Viscosity, liquid", "Temperature of Hot plate"
  QString subtitle() const;  ///< "of Water, over temperature · Kell 1975"
  Response response() const;
  /// The law that this property had last, or has by itself, where it is another one than now.
  std::optional<Response> ghost() const;
  QString source() const;  ///< of the installed figure; "" where nothing says so
  /// A slope at a value as people see it, and back: on a logarithmic axis in decades per K.
  double shownSlope(double value, double slope) const;
  double storedSlope(double value, double shown) const;
  QString slopeUnit() const;
  /// K, at which the property is read: the mean of the material's particles, or the air's where there are none.
  double temperature() const { return temperature(now(0, 1)); }
  double temperature(const MaterialNow& now) const;  ///< the same of what is known
  /// K, where melting begins and ends; nullopt for what never melts.
  std::optional<std::array<double, 2>> melting() const;
  /// What is marked on the curve, where `now` is known.
  std::optional<CurveMark> mark(const MaterialNow& now) const;
  /// K, or s of keys: from where to where it is worth looking at: its points, or else what lies around its matter and
  /// its melting.
  std::array<double, 2> range() const;
  /// The property's unit: above it the solver does not follow, as it last said; nullopt: it follows.
  std::optional<double> delivered() const;
  /// Goes through all particles of the newest snapshot.
  MaterialNow now(double firstKelvin, double lastKelvin) const;

  /// How many of the material's particles have a value above another one, now; likewise.
  size_t countAbove(double value) const;

  void choose(const Address& address);       ///< a property of a material that is a response; others are ignored
  void chooseTrack(const Address& address);  ///< what has keys; others are ignored
  int point() const { return m_point; }      ///< that is selected, -1: none
  void choosePoint(int index);

  /// Other materials whose curves are drawn beside this one.
  const std::set<OtherMaterial>& compared() const { return m_compared; }
  void compare(const OtherMaterial& other, bool on);  ///< what has no other curve says so by refused()
  /// Those that may be: the scene's, and installed ones that are.
  std::vector<OtherMaterial> others() const;
  /// Installed ones, of which the scene has none, that are not compared yet.
  std::vector<OtherMaterial> installed() const;
  QString otherLabel(const OtherMaterial& other) const;
  Response otherResponse(const OtherMaterial& other) const;

  void begin(const QString& what);
  /// Within a gesture or as a step of its own. What is refused is said by refused(), and the old one stays.
  bool set(const Response& response, const QString& what = {});
  void end();

 Q_SIGNALS:
  void targetChanged();    ///< another material or property
  void responseChanged();  ///< another value, by whom ever; also after targetChanged
  void pointChanged();
  void comparedChanged();
  void markChanged();                    ///< another particle was clicked, perhaps
  void refused(const QString& problem);  ///< "" when the next one was taken

 private:
  void onTarget();
  void onChanged(const ChangeEvent& event);
  void remember();
  void followInstalled();
  QString setTrack(const Response& curve);
  Session& m_session;
  Selection& m_selection;
  std::string m_key = "viscosity";
  std::optional<Address> m_track;
  int m_point = -1;
  std::set<OtherMaterial> m_compared;
  std::map<std::string, Response> m_laws;  ///< by address: the last one that it was
};

/// "Monotone", as people choose it.
QString labelOf(Between way);
/// Keys as a curve over time, in s and the parameter's unit.
Response curveOf(const std::vector<TrackKey>& keys);
/// Declaration of temperatures as the curve's axis and tables show them.
const api::ParameterDeclaration& temperatureDeclaration();

}  // namespace ps
