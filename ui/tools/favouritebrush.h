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

/// A brush that comes with the program: what it says of one. Of the rest, guides for one, it leaves what is in hand.
struct ReadyBrush {
  QString name, about;
  std::string shape, material;     ///< "": none in particular
  ParameterSet brush, parameters;  ///< those of every brush, and those of its shape
};

/// Named after what it is: "Sphere, 50 mm, Water, −10 °C".
FavouriteBrush favouriteOf(const BrushSettings& brush, const PluginRegistry& plugins, const Project& project);
/// What a brush in hand becomes of it: other shapes keep their parameters, and where the scene has not the favourite's
/// material, the present one stays.
BrushSettings taken(const FavouriteBrush& favourite, BrushSettings inHand, const Project& project);
BrushSettings taken(const ReadyBrush& ready, BrushSettings inHand, const Project& project);
/// As it is under another name, also where its brush is not installed.
FavouriteBrush renamed(FavouriteBrush favourite, const QString& name);
/// One that none of them has: `name` itself, or it with a number.
QString freeName(const std::vector<FavouriteBrush>& favourites, const QString& name);

/// As JSON text, and back. What is not installed stays as it was. Of what is damaged, or beyond its range by now, the
/// default comes back; a favourite without a name or a shape is left out.
QByteArray textOf(const std::vector<FavouriteBrush>& favourites);
std::vector<FavouriteBrush> favouritesOf(const QByteArray& text, const PluginRegistry& plugins);
/// Those of a text like that whose brush is installed.
std::vector<ReadyBrush> readyBrushesOf(const QByteArray& text, const PluginRegistry& plugins);
std::vector<ReadyBrush> readyBrushes(const PluginRegistry& plugins);  ///< that come with the program
/// The same of a brush in hand, with the parameters of all shapes. What cannot be had any more stays as it is in hand.
std::string textOf(const BrushSettings& brush);
BrushSettings brushOf(const std::string& text, BrushSettings inHand, const PluginRegistry& plugins,
                      const Project& project);

}  // namespace ps
