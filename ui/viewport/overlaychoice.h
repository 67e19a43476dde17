// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace ps {

/// What the view shows beside the scene itself.
struct OverlayChoice {
  bool name = true, axes = true, scale = true, legend = true, outlines = true, guides = true, hints = true;
  bool operator==(const OverlayChoice&) const = default;
};

/// One of them, as menus and settings call it.
struct OverlayRow {
  const char *key, *label, *words;  ///< words: Ctrl+K finds it by these too
  bool OverlayChoice::*on;
};
inline constexpr std::array kOverlayRows{
    OverlayRow{"name", "Show the view's name", "overlay label camera", &OverlayChoice::name},
    OverlayRow{"axes", "Show axes", "overlay ball gizmo orientation xyz", &OverlayChoice::axes},
    OverlayRow{"scale", "Show scale bar", "overlay length ruler", &OverlayChoice::scale},
    OverlayRow{"legend", "Show legend", "overlay colours scale map", &OverlayChoice::legend},
    OverlayRow{"outlines", "Show outlines of what is selected", "overlay selection line", &OverlayChoice::outlines},
    OverlayRow{"guides", "Show grid and mirror of the brush", "overlay drawing plane guides symmetry",
               &OverlayChoice::guides},
    OverlayRow{"hint", "Show hints", "overlay keys help strip", &OverlayChoice::hints}};

/// Whose light falls on the scene.
enum class Studio { AsTheme, Dark, Bright };
struct StudioRow {
  const char *key, *label;
  Studio studio;
};
inline constexpr std::array kStudioRows{StudioRow{"theme", "Light as the theme", Studio::AsTheme},
                                        StudioRow{"dark", "Dark studio", Studio::Dark},
                                        StudioRow{"bright", "Bright studio", Studio::Bright}};

}  // namespace ps
