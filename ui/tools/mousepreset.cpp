// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/mousepreset.h"

#include <QtCore/QStringList>

#include <algorithm>
#include <array>
#include <bit>

namespace ps {
namespace {

using enum ViewMotion;
using enum MousePreset;
enum class While { Looking, Drawing, Always };

struct Row {
  MousePreset preset;
  While when;
  MouseBinding binding;
};

constexpr auto kLeft = Qt::LeftButton, kMiddle = Qt::MiddleButton, kRight = Qt::RightButton;

/// Drawing takes the left button; Alt with it stays the view's, where no window manager takes it to move the window:
/// what needs no key comes first.
const std::array kRows{
    Row{PhaseSketch, While::Looking, {Orbit, kLeft, {}}},
    Row{PhaseSketch, While::Looking, {Pan, kLeft, Qt::ShiftModifier}},
    Row{PhaseSketch, While::Looking, {Pan, kMiddle, {}}},
    Row{PhaseSketch, While::Drawing, {Orbit, kMiddle, {}}},
    Row{PhaseSketch, While::Drawing, {Orbit, kLeft, Qt::AltModifier}},
    Row{PhaseSketch, While::Drawing, {Pan, kMiddle, Qt::ShiftModifier}},
    Row{PhaseSketch, While::Always, {Dolly, kRight, {}}},
    Row{Blender, While::Always, {Orbit, kMiddle, {}}},
    Row{Blender, While::Always, {Orbit, kLeft, Qt::AltModifier}},
    Row{Blender, While::Always, {Pan, kMiddle, Qt::ShiftModifier}},
    Row{Blender, While::Always, {Dolly, kMiddle, Qt::ControlModifier}},
    Row{Maya, While::Always, {Orbit, kLeft, Qt::AltModifier}},
    Row{Maya, While::Always, {Pan, kMiddle, Qt::AltModifier}},
    Row{Maya, While::Always, {Dolly, kRight, Qt::AltModifier}},
    Row{Cad, While::Always, {Orbit, kMiddle, {}}},
    Row{Cad, While::Always, {Pan, kMiddle, Qt::ControlModifier}},
    Row{Cad, While::Always, {Dolly, kMiddle, Qt::ShiftModifier}},
};

int count(Qt::KeyboardModifiers keys) { return std::popcount(static_cast<unsigned>(keys)); }

QString keysOf(MousePreset preset, bool draws, ViewMotion motion) {
  for (const MouseBinding& binding : bindings(preset, draws)) {
    if (binding.motion == motion) return binding.text();
  }
  return {};
}

}  // namespace

namespace {
QString dragText(Qt::MouseButton button, Qt::KeyboardModifiers keys) {
  QStringList parts;
  if (keys & Qt::ControlModifier) parts << QStringLiteral("Ctrl");
  if (keys & Qt::AltModifier) parts << QStringLiteral("Alt");
  if (keys & Qt::ShiftModifier) parts << QStringLiteral("Shift");
  parts << (button == kMiddle  ? QStringLiteral("Middle-drag")
            : button == kRight ? QStringLiteral("Right-drag")
                               : QStringLiteral("Drag"));
  return parts.join(QLatin1Char('+'));
}
}  // namespace

QString MouseBinding::text() const { return dragText(button, keys); }
QString SizeDrag::text() const { return dragText(button, keys); }

SizeDrag sizeDrag(MousePreset preset) { return {kRight, preset == Maya ? Qt::ShiftModifier : Qt::AltModifier}; }

std::vector<MouseBinding> bindings(MousePreset preset, bool draws) {
  const While other = draws ? While::Looking : While::Drawing;
  std::vector<MouseBinding> list;
  for (const Row& row : kRows) {
    if (row.preset == preset && row.when != other) list.push_back(row.binding);
  }
  return list;
}

std::optional<MouseBinding> bindingFor(MousePreset preset, bool draws, Qt::MouseButton button,
                                       Qt::KeyboardModifiers held) {
  std::optional<MouseBinding> best;
  for (const MouseBinding& binding : bindings(preset, draws)) {
    if (binding.button != button || (binding.keys & held) != binding.keys) continue;
    if (!best || count(binding.keys) > count(best->keys)) best = binding;
  }
  return best;
}

QString nameOf(MousePreset preset) {
  switch (preset) {
    case Blender:
      return QStringLiteral("Blender");
    case Maya:
      return QStringLiteral("Maya");
    case Cad:
      return QStringLiteral("CAD, like SolidWorks");
    case PhaseSketch:
      break;
  }
  return QStringLiteral("PhaseSketch");
}

QString howToLook(MousePreset preset) {
  return QStringLiteral("%1 in the view to turn it, %2 to move it, the wheel to come closer.")
      .arg(keysOf(preset, false, Orbit), keysOf(preset, false, Pan));
}

/// All of them, "Middle-drag or Alt+Drag": not every mouse has the one, nor every desktop leaves the other.
QString turningKeys(MousePreset preset) {
  QStringList keys;
  for (const MouseBinding& binding : bindings(preset, true)) {
    if (binding.motion == Orbit) keys << binding.text();
  }
  return keys.join(QStringLiteral(" or "));
}

}  // namespace ps
