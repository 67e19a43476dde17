// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/vr/headset.h"
#include "ui/vr/headsetlink.h"
#include "ui/vr/stand.h"

#include <array>
#include <optional>
#include <vector>

namespace ps::vr {

/// Where the interface's panels are in the room, and what hands point at on them. The palette floats over the other
/// hand while its palm faces the wearer, or stands pinned where a button asked for it, or, where the main hand is
/// alone, where its palm did; asked for again it goes. The board stands where it was asked for, turned to them, and
/// what is set beside it to its right and left; a popup lies on the one that it came from; labels hang beside the
/// hands, and nobody points at them. A hand points by a beam, or, close by, with the tip of its wand, which presses
/// what it goes through. What it began to press it keeps until it lets go. Its grip takes a board by the header that it
/// points at, and carries it at the end of the beam, or at the tip, turned to the wearer.
class Panels {
 public:
  /// In the room; +z is the side that one looks at.
  struct Place {
    HandPose pose;
    double width = 0, height = 0;          ///< m
    Vector3 at(double x, double y) const;  ///< 0..1 right and down from its upper left corner
    Vector3 own(const Vector3& room) const;
    bool holds(const Vector3& own, double edge) const;  ///< m, beside it
  };

  /// `busy`: the grips carry the scene.
  void follow(const HeadsetFrame& frame, const HeadsetView& view, bool busy = false);
  /// Of a panel; nothing while it is not seen.
  const std::optional<Place>& place(size_t panel) const { return m_places.at(panel); }
  const std::optional<Place>& labels(size_t hand) const { return m_labels.at(hand); }
  const std::optional<PanelPoint>& pointed(size_t hand) const { return m_pointed.at(hand); }
  /// Whether a place in the room is as near to a panel, m.
  bool isNear(const Vector3& place, double metres) const;
  /// m along where a hand would point from a place, to the first panel there.
  std::optional<double> ahead(const HandPose& aim) const;
  /// Whether who looks from there has a board before them; also where it is put away.
  bool isBoardAhead(const HandPose& head, size_t board = 0) const;
  /// Its grip has taken a board, and was not let go since.
  bool carries(size_t hand) const { return m_carried.at(hand).has_value(); }
  /// Its trigger is none of the brush's business.
  bool takes(size_t hand) const { return m_pointed.at(hand) || m_presses.at(hand); }
  /// m, in the room, where the hand's beam ends.
  std::optional<Vector3> hit(size_t hand) const;
  void addTo(Props& props, const Stand& stand, const HeadsetView& view) const;

 private:
  void placePalette(const HeadsetFrame& frame, const PanelView& palette);
  void pinPalette(const HeadsetFrame& frame);
  bool palmFaces(const HeadsetFrame& frame, size_t hand, bool did) const;
  HandPose atWrist(const HandPose& palm) const;
  void placeBoard(size_t board, const HeadsetFrame& frame, const HeadsetView& view);
  void carry(size_t hand, const HandInput& input, const HeadsetView& view, bool busy);
  void takeBoard(size_t hand, const HandPose& aim, const HeadsetView& view);
  void placePopup(const HeadsetView& view);
  void placeLabels(size_t hand, const HandInput& input, const PanelView& labels);
  void point(size_t hand, const HandInput& input);
  std::optional<PanelPoint> pointAnew(size_t hand, const HandPose& aim, const std::optional<PanelPoint>& before) const;
  std::optional<PanelPoint> tipOn(size_t panel, const HandPose& aim, double edge) const;
  std::optional<PanelPoint> beamOn(size_t panel, const HandPose& aim, double edge) const;

  std::array<std::optional<Place>, kPanels> m_places;
  std::array<std::optional<Place>, 2> m_labels;
  std::array<std::optional<PanelPoint>, 2> m_pointed;
  std::array<bool, 2> m_draws{}, m_presses{};  ///< its trigger was pulled elsewhere, or on a panel
  Vector3 m_head{0, 0, 0};                     ///< m
  std::array<uint64_t, kBoards> m_brought{};
  std::array<std::optional<HandPose>, kBoards> m_boards;  ///< since they were brought
  struct Carried {
    size_t panel;
    Vector3 own;          ///< m, of the panel: where it was taken
    double along;         ///< m, from where the hand aims from to there
    bool isGone = false;  ///< it was put away since
  };
  std::array<std::optional<Carried>, 2> m_carried;
  std::array<bool, 2> m_holds{};  ///< its grip is pressed
  HandRoles m_roles;
  std::optional<HandPose> m_pinned;  ///< the palette, since it was asked for
  double m_pinnedFrom = 0;           ///< m, from the eyes then
  struct Asks {
    bool byMenu = false, byPalm = false;
  };
  std::array<Asks, 2> m_asks{};  ///< for it, by what hands do already
};

}  // namespace ps::vr
