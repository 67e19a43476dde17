// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/handlesettings.h"
#include "ui/tools/brushsettings.h"
#include "ui/tools/mousepreset.h"
#include "ui/tools/tool.h"

#include <phasesketch/brush.h>

#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <array>
#include <chrono>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class Document;
struct StampCells;
struct StampForm;
class SceneLink;
class Selection;

/// The one that stands so many places on, or back, in a ring; the first where `now` is none of it, nullptr without any.
const std::string* further(const std::vector<std::string>& ring, const std::string& now, int by);

/// One of the strokes of a sketch, as somebody chose it in their list.
struct ChosenStroke {
  std::string body;  ///< Body::id
  size_t index = 0;  ///< in VoxelShape::strokes
  bool operator==(const ChosenStroke&) const = default;
};

/// The tools of one editor, which of them is in hand, and the brush that several share. Views feed the tool in hand;
/// panels and buttons follow the signals.
class Toolbox : public QObject {
  Q_OBJECT
 public:
  Toolbox(Document& document, Selection& selection, QObject* parent = nullptr);
  ~Toolbox() override;

  /// nullptr: there is no engine any more. The brush begins with the standard one of the document's plugins.
  void attach(SceneLink* link);

  const std::string& active() const { return m_active; }  ///< ToolRow::id
  /// An unknown one is ignored. One that draws or erases takes the last brush that draws; the brush itself puts aside
  /// one that stamps too.
  void activate(const std::string& id);
  Tool& tool() const { return *m_tools.at(m_active); }
  Tool& tool(const std::string& id) const { return *m_tools.at(id); }

  MousePreset mouse() const { return m_mouse; }
  void setMouse(MousePreset preset);  ///< whose buttons move the view

  const HandleSettings& handles() const { return m_handles; }
  void setHandles(const HandleSettings& settings);

  const BrushSettings& brush() const { return m_brush; }
  void setBrush(const BrushSettings& brush);
  void stepBrush(int direction);  ///< larger (1) or smaller (-1)
  void stepFlow(int direction);   ///< more (1) or less (-1) of what a brush lets fall; others have no flow
  /// How large the brush is: its radius in m or, of one that stamps and goes by it, the scale of its copies.
  double brushSize() const;
  void setBrushSize(double size);  ///< within what it may be
  QString brushSizeName() const;   ///< "Radius", "Scale"
  QString brushSizeText() const;   ///< "50 mm", "80 %"
  /// Its own parameter that stands for its size; nullptr where that is the radius.
  const api::ParameterDeclaration* scaleParameter() const;
  /// Strokes are drawn from now on on a plane that stands still: on the surface that is pointed at, so far above it
  /// that the brush stands on it, or across the view through what that looks at. Refused where nothing is pointed at.
  void layPlane(const Pointer& pointer, bool acrossView);
  void stepShape(int by);     ///< so many brushes on, or back, in the order of their names
  void stepMaterial(int by);  ///< likewise of what is drawn with, among the scene's materials
  /// Takes a brush in hand; one that does not draw puts the eraser aside.
  void takeBrush(const std::string& id);
  /// Whether the brush in hand works on the matter that is there, instead of drawing.
  bool touchesMatter() const { return can(api::kTouchesMatter, m_brush.shape); }
  /// Whether it makes that matter of another material.
  bool paints() const { return can(api::kPaintsMatter, m_brush.shape); }
  /// Whether it gives that matter a colour of its own.
  bool colours() const { return can(api::kColoursMatter, m_brush.shape); }
  /// Whether it rounds what is drawn.
  bool smooths() const { return can(api::kSmoothsMatter, m_brush.shape); }
  /// Whether it stamps the shape of a body.
  bool stampsShape() const { return can(api::kStampsShape, m_brush.shape); }
  /// That shape, of the body that is selected, or was last while none is; nullopt where there is none, or not yet:
  /// brushChanged() follows.
  std::optional<VoxelShape::Stamp> shape();
  bool fillsShape() const { return m_shape.making.valid(); }  ///< it is still being filled with cells
  /// Its name; "" of none.
  std::string shapeName() const;
  /// Whether it changes what is drawn, in one of these ways, instead of drawing.
  bool reworks() const { return paints() || colours() || smooths(); }
  /// Half extents of one stamp in m, and whether it fills that box; the radius on all axes when the brush is not
  /// installed, or does not come back: it is then put aside in the next turn of the event loop.
  /// `up`: away from what it draws on.
  std::pair<Vector3, bool> stamp(const Vector3& up = {0, 1, 0});
  /// What one stamp fills, likewise: nullptr of one that is the ball or the box that stamp() says, or touches matter.
  std::shared_ptr<const StampForm> form(const Vector3& up = {0, 1, 0});

  /// That the view shows, and the tool Move takes hold of in place of its body.
  void choose(std::optional<ChosenStroke> stroke);
  /// nullopt: none, or it has gone.
  std::optional<ChosenStroke> stroke() const;
  /// Its way, where the document has it.
  std::optional<Wire> strokeWire() const;

  // For tools
  Document& document() const { return m_document; }
  Selection& selection() const { return m_selection; }
  SceneLink* link() const { return m_link; }
  double spacing() const;  ///< m, of particles, as the document has it
  void refuse(const QString& title, const QString& why) { Q_EMIT refused(title, why); }
  void work(const QString& stage, int percent) { Q_EMIT working(stage, percent); }
  /// A brush has failed: it is out of service, and another one in hand where there is one.
  void putAside(const std::string& brush, const std::string& problem);

 Q_SIGNALS:
  void toolChanged();
  void brushChanged();
  void mouseChanged();
  void handlesChanged();
  void strokeChosen();
  void strokeMoved(const ps::ChosenStroke& stroke, const ps::Vector3& way);  ///< m, by a hand that wants it there
  void working(const QString& stage, int percent);         ///< on what takes long and can be given up; -1: no more
  void refused(const QString& title, const QString& why);  ///< "Nothing was drawn.", why not

  void brushFailed(const QString& brush, const QString& problem);  ///< whoever has the plugins takes it out of them

 private:
  void giveUp();
  /// What a brush said of its stamp, and of which settings.
  struct Stamp {
    std::string brush;
    double spacing = 0, radius = 0;  ///< m
    std::vector<double> parameters;
    std::shared_ptr<const StampCells> shape{};
    Vector3 up{0, 0, 0};
    Vector3 half{0, 0, 0};  ///< m
    bool box = false;
    std::shared_ptr<const StampForm> form{};
  };
  const Stamp& stampNow(const Vector3& up);
  const Body* stampedBody() const;
  std::shared_ptr<const StampCells> shapeCells();
  void takeShape(std::chrono::milliseconds patience);
  void takeInstalled(const std::string& wanted);
  bool can(const char* capability, const std::string& brush) const;
  bool draws(const std::string& brush) const;
  Document& m_document;
  Selection& m_selection;
  SceneLink* m_link = nullptr;
  BrushSettings m_brush;
  std::string m_drawing;  ///< the last brush that draws
  /// The last ones, of two hands: pictures ask for them often.
  std::array<Stamp, 2> m_stamps;
  size_t m_lastStamp = 0;
  std::optional<ChosenStroke> m_stroke;
  std::string m_stamped;  ///< Body::id of what was selected last
  /// Its shape, as it was asked for last, and of what.
  struct Shape {
    uint64_t change = 0;  ///< Document::changeCount()
    std::string body;
    decltype(Body::shape) form{};
    double spacing = 0;  ///< m
    struct Filled {
      std::optional<VoxelShape::Stamp> stamp;
      std::shared_ptr<const StampCells> cells;
    };
    Filled filled;
    std::future<Filled> making;  ///< valid as long as it is being filled
  };
  Shape m_shape;
  QTimer m_shapeLooks;  ///< whether it is filled
  std::map<std::string, std::unique_ptr<Tool>> m_tools;
  std::string m_active;
  MousePreset m_mouse = MousePreset::PhaseSketch;
  HandleSettings m_handles;
};

}  // namespace ps
