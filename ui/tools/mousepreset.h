// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/preferences.h"

#include <QtCore/QString>
#include <QtCore/Qt>

#include <optional>
#include <vector>

// Which buttons turn, shift and near a view: PhaseSketch's own, or those of a program that somebody comes from.
namespace ps {

enum class ViewMotion { Orbit, Pan, Dolly };

/// One drag that moves the view.
struct MouseBinding {
  ViewMotion motion;
  Qt::MouseButton button;
  Qt::KeyboardModifiers keys;
  QString text() const;  ///< "Shift+Middle-drag"; with the left button "Alt+Drag"
};

/// The drag that makes a brush in hand smaller or larger; no preset moves the view by it.
struct SizeDrag {
  Qt::MouseButton button;
  Qt::KeyboardModifiers keys;
  QString text() const;  ///< "Alt+Right-drag"
};
SizeDrag sizeDrag(MousePreset preset);

/// What drags do with a tool in hand, the most used of each motion first. `draws`: the left button is the tool's, but
/// with Alt; otherwise a drag that the tool does not take may move the view.
std::vector<MouseBinding> bindings(MousePreset preset, bool draws);

/// Of those with this button the one most of whose keys are held, and all of them; none: the button is not the view's.
std::optional<MouseBinding> bindingFor(MousePreset preset, bool draws, Qt::MouseButton button,
                                       Qt::KeyboardModifiers held);

/// "PhaseSketch", "Blender", as Preferences offer it.
QString nameOf(MousePreset preset);
/// "Drag to turn it, Shift+Drag to move it, the wheel to come closer.", said of the view while nothing is drawn.
QString howToLook(MousePreset preset);
/// "Middle-drag or Alt+Drag", which turns the view while something is drawn.
QString turningKeys(MousePreset preset);

}  // namespace ps
