// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/ray.h"
#include "core/simulation/snapshot.h"
#include "ui/document/port.h"
#include "ui/render/section.h"

#include <QtCore/QString>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

// What a tool is: something that turns pointing, pressing and dragging into edits of the document, and says what a view
// should draw of it. It knows no widget, no picture and no headset: mouse, tablet and hands feed the same one.
namespace ps {

struct StampForm;
class Toolbox;

/// What Tool::type() gets of the keys Backspace and Enter.
inline constexpr const char *kErase = "\b", *kEnter = "\r";

/// Where somebody points, and with what: the mouse in a picture, a pen, a hand with a beam.
struct Pointer {
  Ray ray;                    ///< m; its direction has unit length
  Vector3 forward{0, 0, -1};  ///< unit vector along which the viewer looks: drawing planes face it
  Vector3 target{0, 0, 0};    ///< m, what the viewer looks at: the depth of what is put in the air
  double fineness = 1e-3;     ///< tangent of the smallest angle that can be aimed at: a pixel, a tremor of the hand
  double pressure = 1;        ///< 0 .. 1; a mouse always presses fully, as does a pen that does not tell
  bool eraser = false;        ///< the pen's other end
  Vector3 lean{0, 0, 0};      ///< how a pen leans from standing upright on the view: an axis, by its length in rad
  double twist = 0;           ///< rad, of a pen about itself, anticlockwise as seen from its end
  double seconds = 0;         ///< on any clock that runs on
  bool shift = false, control = false, alt = false;
  SnapshotPtr scene;               ///< as the view shows it, but for what the section cuts away; nullptr: nothing yet
  std::optional<Section> section;  ///< none: all is shown
};

/// The brush under the pointer.
struct BrushCursor {
  Vector3 centre{0, 0, 0};  ///< m
  Vector3 extent{0, 0, 0};  ///< half extents, m
  double floor = 0;         ///< m, height of what lies below
  double pressure = 1;      ///< 0 .. 1, of a hand that draws
  bool box = false, erase = false;
  std::shared_ptr<const StampForm> form{};  ///< what it fills there; nullptr: the box, or the ball within it
};

/// Handles that move, turn or stretch what is selected.
struct Gizmo {
  enum class Kind { Move, Rotate, Scale };
  Kind kind = Kind::Move;
  Vector3 centre{0, 0, 0};             ///< m
  Matrix3 axes = Matrix3::Identity();  ///< unit vectors, as columns
  bool along = true;                   ///< what is selected can be stretched along one of them
};
/// One of its handles.
struct GizmoPart {
  enum class Kind { Arm, Plane, Ring, Middle };
  Kind kind = Kind::Arm;
  int axis = 0;  ///< 0 x, 1 y, 2 z; of a plane the one across it
  bool operator==(const GizmoPart&) const = default;
};
struct GizmoPicture {
  std::optional<Gizmo> gizmo;                ///< none: nothing that is selected can be dragged
  std::optional<GizmoPart> hovered, active;  ///< while one is dragged it alone remains
  QString label, value;                      ///< of what is dragged: "X", "12.5 mm"
  bool typing = false;                       ///< the value is being typed
  bool wrong = false;                        ///< what has been typed is no such value
  QString note;                              ///< "" or what cannot be done, and why
};

/// What the pointer itself looks like.
enum class PointerShape { Arrow, Cross, Hidden, Move, Take };

/// The outline of something without matter: a wall, a box that pins.
struct Wire {
  std::vector<std::pair<Vector3, Vector3>> lines;  ///< m
  bool selected = false, hovered = false;
  bool dashed = false;  ///< it is no surface that anything meets
};

/// A tag at a place of the scene: "Ice block −9.2 °C".
struct SceneTag {
  Vector3 place{0, 0, 0};  ///< m
  QString name, value;
};

/// What a view should draw of a tool.
struct ToolPicture {
  PointerShape pointer = PointerShape::Arrow;
  std::optional<BrushCursor> cursor;
  std::vector<Emitter> emitters;  ///< that would be put there
  std::vector<Sink> sinks;
  std::optional<Port> hovered;  ///< would be taken hold of
  std::vector<Wire> wires;
  std::optional<SceneTag> tag;  ///< in place of what is told of the selected grain
  std::optional<GizmoPicture> gizmo;
  std::optional<std::pair<Vector3, Vector3>> frame;  ///< opposite corners of one that is drawn, as they are seen
};

/// Something that a tool's buttons and keys do, in words.
struct Gesture {
  QString keys;  ///< "Shift+Drag"
  QString does;  ///< "Move the view sideways"
  QString hint;  ///< a word or two for the strip of hints; "": not there
};

class Tool {
 public:
  explicit Tool(Toolbox& box) : m_box(box) {}
  virtual ~Tool() = default;
  Tool(const Tool&) = delete;
  Tool& operator=(const Tool&) = delete;

  /// Points somewhere with nothing pressed.
  virtual void hover(const Pointer&) {}
  /// The main button goes down. False: it is none of the tool's business as long as nothing is clicked; the view may
  /// turn instead.
  virtual bool press(const Pointer&) { return false; }
  virtual void drag(const Pointer&) {}     ///< after a press that was taken
  virtual void release(const Pointer&) {}  ///< likewise
  /// Pressed and released at one place, where press() was not taken.
  virtual void click(const Pointer&) {}
  /// What the view shows by now, before it asks for the picture; nullptr: nothing yet.
  virtual void see(const Snapshot*) {}
  /// Somebody types while something is dragged: characters, kErase or kEnter. False: they mean nothing to the tool.
  virtual bool type(const QString&) { return false; }
  virtual bool takesText(const QString&) const { return false; }  ///< whether type() would take it
  /// Gives up what is being dragged. False: there was nothing.
  virtual bool cancel() { return false; }
  virtual bool goesOn() const { return false; }  ///< with what was let go already
  virtual void leave() {}                        ///< points nowhere any more, or another tool takes over

  virtual ToolPicture picture() const { return {}; }
  /// What a screen reader says of it: "Brush, sphere, radius 50 mm".
  virtual QString words() const = 0;
  /// The most used first.
  virtual std::vector<Gesture> gestures() const = 0;
  /// What to do in a scene without matter; "" where the tool has nothing to say.
  virtual QString invitation() const { return {}; }
  virtual bool usesBrush() const { return false; }    ///< size and shape of the brush matter
  virtual bool usesHandles() const { return false; }  ///< see HandleSettings
  virtual bool turnsView() const { return false; }    ///< a drag that it does not take turns the view
  Toolbox& box() const { return m_box; }

 private:
  Toolbox& m_box;
};

}  // namespace ps
