// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/brushsettings.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>

#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

/// A brush as somebody likes it, to be taken in hand again in any scene.
struct FavouriteBrush {
  QString name;
  BrushSettings brush;  ///< with the parameters of its own shape only
  QByteArray asKept{};  ///< as it is kept, where its brush is not installed; "": as it is here
  bool operator==(const FavouriteBrush&) const = default;
};

/// Named after what it is: "Sphere, 50 mm, Water, −10 °C".
FavouriteBrush favouriteOf(const BrushSettings& brush, const PluginRegistry& plugins, const Project& project);
/// What a brush in hand becomes of it: other shapes keep their parameters, and where the scene has not the favourite's
/// material, the present one stays.
BrushSettings taken(const FavouriteBrush& favourite, BrushSettings inHand, const Project& project);

/// As JSON text, and back. What is not installed stays as it was. Of what is damaged, or beyond its range by now, the
/// default comes back; a favourite without a name or a shape is left out.
QByteArray textOf(const std::vector<FavouriteBrush>& favourites);
std::vector<FavouriteBrush> favouritesOf(const QByteArray& text, const PluginRegistry& plugins);
/// The same of a brush in hand, with the parameters of all shapes. What cannot be had any more stays as it is in hand.
std::string textOf(const BrushSettings& brush);
BrushSettings brushOf(const std::string& text, BrushSettings inHand, const PluginRegistry& plugins,
                      const Project& project);

}  // namespace ps
