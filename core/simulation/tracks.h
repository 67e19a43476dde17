// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/track.h"
#include "core/simulation/edits.h"
#include "core/solver/report.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

// What a project's tracks say while it runs.
namespace ps {

class PluginRegistry;

/// "" or why the value of an address, or a point of its curve, can have no keys, as a sentence: "Shape acts at the
/// start; ...". Of a body that is not held in place its motion has none either, which `whenFixed` leaves out.
std::string whyNoKeys(const Project& project, const PluginRegistry* plugins, const TrackTarget& target,
                      bool whenFixed = false);
/// "" or why a key of a declared parameter may not have this value: "must be at most 10000 K, not 20000".
std::string problemOfKey(const TrackKey& key, const api::ParameterDeclaration& declaration);
/// The number of a key as a value of the declared kind, within its hard range: of a toggle on above a half, of a whole
/// number the nearest, of a response a constant.
Value valueOfKey(double number, const api::ParameterDeclaration& declaration);
/// s by which a key may lie behind the clock of frames that are `dt` s long and count as reached.
inline double keySlack(double dt) { return 1e-4 * dt; }

/// A project's environment as its tracks have it at a time in s: what is drawn and shown of walls and air then.
Environment environmentAt(const Project& project, const PluginRegistry* plugins, double time);

/// The values of tracks laid over those of a living project, which it can lift off again: what the document says of an
/// animated parameter is not lost, and holds where no track does. A track that has no place in the project (its owner
/// has gone, or it cannot act while the scene runs) waits and does nothing.
class TrackOverlay {
 public:
  /// Whether a body was born fixed.
  using IsFixed = std::function<bool(const std::string& body)>;

  bool empty() const { return m_tracks.empty(); }
  /// Looks up what a project's tracks mean. Nothing may be laid. What it gave keeps its value where its track still is;
  /// where it has none, `dropped` says what is to be compiled again.
  void bind(const Project& project, const PluginRegistry& plugins, const IsFixed& isFixed, Touched& dropped);
  /// Whether the tracks say something else at a time than what they gave.
  bool moves(const Project& project, double time, double slack) const;
  /// How many there are.
  size_t size() const { return m_tracks.size(); }
  /// Takes what a track says at a time, or all of them, for the next lay(). Nothing may be laid.
  void advance(const Project& project, size_t track, double time, double slack, Touched& touched);
  void advance(const Project& project, double time, double slack, Touched& touched);
  /// A track's value at a time cannot be: until it says another one the document's holds, which hangs on nothing that
  /// came before.
  void refuse(const Project& project, size_t track, double time, double slack, const std::string& why);
  void lay(Project& project);
  void lift(Project& project);
  /// A copy of a project with the document's values.
  void liftFrom(Project& copy) const;
  /// What was refused, and what holds instead.
  std::vector<Limit> limits() const;

 private:
  struct Laid {
    TrackTarget target;
    const api::ParameterDeclaration* declaration = nullptr;
    size_t track = 0;                 ///< in Project::tracks
    std::optional<double> given;      ///< nothing: the document's value holds
    double otherwise = 0;             ///< that one
    std::optional<double> refused{};  ///< what cannot be
    std::string why{};
    std::optional<Value> own{};  ///< the document's, while something is laid over it
    Vector3 gravity{0, 0, 0};    ///< m/s², likewise: strength alone does not say where it points
    Response curve{};            ///< of a point, where the project says none: the installed material's
    bool isLaid = false;
  };
  std::optional<double> wanted(const Project& project, const Laid& laid, double time, double slack) const;
  static void restore(Project& project, const Laid& laid);
  static Value valueOf(const Project& project, const Laid& laid);

  std::vector<Laid> m_tracks;
};

}  // namespace ps
