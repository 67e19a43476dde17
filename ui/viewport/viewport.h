// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/tools/porthandles.h"
#include "ui/tools/stroketool.h"
#include "ui/tools/viewnavigator.h"
#include "ui/tools/viewtool.h"
#include "ui/viewport/legendrange.h"
#include "ui/viewport/overlays.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QTimer>
#include <QtOpenGLWidgets/QOpenGLWidget>

#include <memory>
#include <optional>
#include <set>
#include <string>

namespace ps {

class Document;
class EngineThread;
class SceneLink;

/// The scene, live. Draws the newest snapshot, repaints when there is a new one or somebody interacts, and no more
/// often than leaves the solver time to work. Needs OpenGL 4.3; without it a sentence stands in its place.
class Viewport : public QOpenGLWidget {
  Q_OBJECT
 public:
  explicit Viewport(QWidget* parent = nullptr);
  ~Viewport() override;

  /// Any may be nullptr; they must outlive this widget or be taken away first.
  void attach(Document* document, EngineThread* engine, SceneLink* link);
  void snapshotArrived();
  SnapshotPtr snapshot() const { return m_now; }  ///< the one that is shown
  /// The document's view, walls or bodies changed.
  void projectOpened();
  void bodiesChanged();

  ViewTool tool() const { return m_tool; }
  void setTool(ViewTool tool);
  const BrushSettings& brush() const { return m_brush; }
  void setBrush(const BrushSettings& brush);
  ColourBy colour() const { return m_colour; }
  void setColour(ColourBy colour);
  const ViewNavigator& navigator() const { return m_navigator; }
  void show(StandardView view);
  void frameSelection();
  void frameAll();
  void setSelectedBody(const std::string& id);
  void setSelectedPort(const std::optional<Port>& port);
  const std::optional<Port>& selectedPort() const { return m_selectedPort; }
  /// What the pointer would take hold of there, in the widget's pixels.
  std::optional<PortHandle> portHandleAt(const QPointF& position) const;
  bool hintShown() const { return m_hint; }
  void setHintShown(bool on);
  /// Esc: gives up a drag or stroke. False when there was none.
  bool cancelGesture();
  /// "" or why there is no picture.
  const QString& problem() const { return m_problem; }
  double drawMilliseconds() const { return m_drawCost; }
  const OverlayHits& overlayHits() const { return m_hits; }  ///< as painted last
  std::pair<double, double> legendRange() const { return m_range; }
  /// Tool, brush and what is marked, in words: what a screen reader says.
  QString summary() const;
  /// What to do in a scene without matter; "" where there is some.
  QString invitation() const;
  /// Phase marks of the legend: of the first material in the scene.
  void setTransitions(double meltingPoint, double boilingPoint);

 Q_SIGNALS:
  void bodyPicked(const std::string& id);  ///< "" for none
  void portPicked(const ps::Port& port);
  void placingRefused(const QString& why);
  void toolChanged(ps::ViewTool tool);
  void brushChanged();
  void strokeRefused(const QString& why);
  void viewMenuRequested(const QPoint& global);
  void glReady(const QString& description);
  void glFailed(const QString& problem);

 protected:
  bool event(QEvent* event) override;
  void initializeGL() override;
  void paintGL() override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  enum class Drag { None, Orbit, Pan, Dolly, Stroke, Click, LegendHigh, LegendLow, Place, Port };
  struct Surface {
    Vector3 point{0, 0, 0};   ///< m
    Vector3 normal{0, 0, 0};  ///< unit; zero in the air
  };
  Drag dragFor(const QMouseEvent& event) const;
  void releaseGl();
  void requestPaint();
  double blend() const;
  OverlayState overlayState() const;
  Look look();
  std::optional<BodyOutline> outline() const;
  std::optional<SceneTag> tag() const;
  std::optional<std::pair<Vector3, Vector3>> boxOfBody(const std::string& id) const;
  std::optional<std::pair<Vector3, Vector3>> boxAround(const Port& port) const;
  void pick(const QPointF& position);
  bool clickOverlay(const QPointF& position);
  std::optional<Surface> surfaceAt(const QPointF& position) const;
  Vector3 normalAt(const Vector3& point) const;
  std::optional<Vector3> strokePoint(const QPointF& position);
  Vector3 brushExtent() const;
  void updateCursor(const QPointF& position, Qt::KeyboardModifiers modifiers);
  void updatePointer(const QPointF& position);
  Drag legendEndAt(const QPointF& position) const;  ///< None: there is no end of the legend
  static void installAccessibility();               ///< may be called often
  void announce();                                  ///< tells assistive technology of another summary()
  void beginStroke(const QMouseEvent& event);
  // viewportports.cpp
  PortView portView() const;
  void paintPortsOver(QPainter& painter) const;
  Ray rayAt(const QPointF& position) const;
  double spacing() const;
  void updatePlacing(const QPointF& position);  ///< under the pointer, or as it is being dragged
  Emitter tapAt(const QPointF& position) const;
  Sink drainAt(const QPointF& position) const;
  void finishPlacing();
  bool takePort(const QPointF& position);
  void dragPort(const QPointF& position, Qt::KeyboardModifiers modifiers);
  void endPortDrag(bool keep);
  double floorHeight() const;
  void storeView();

  Document* m_document = nullptr;
  EngineThread* m_engine = nullptr;
  std::unique_ptr<Renderer> m_renderer;
  QString m_problem;
  SnapshotPtr m_now, m_previous;
  RenderScene m_scene;
  /// The project that was opened has no camera of its own, and snapshots of this revision are of the one before.
  std::optional<uint64_t> m_unframed;
  std::set<std::string> m_hidden;
  std::string m_selectedBody;
  std::optional<std::pair<uint64_t, uint32_t>> m_tagged;  ///< revision and id of the particle clicked last

  ViewNavigator m_navigator;
  ColourBy m_colour = ColourBy::Material;
  LegendRange m_legendRange;
  std::pair<double, double> m_range{0, 1};
  double m_meltingPoint = 273.15, m_boilingPoint = 373.15;
  OverlayHits m_hits;
  bool m_hint = true;

  ViewTool m_tool = ViewTool::Select;
  BrushSettings m_brush;
  StrokeTool m_stroke;
  DrawingPlane m_strokePlane;
  QElapsedTimer m_strokeClock;
  std::optional<BrushCursor> m_cursor;

  std::optional<Port> m_selectedPort, m_hoveredPort;
  std::optional<Surface> m_placeSurface;  ///< under the pointer, or where a drag began
  std::variant<std::monostate, Emitter, Sink> m_placing;
  struct Grip {
    PortHandle handle;
    std::variant<Emitter, Sink> before;
    bool moved = false;
  };
  std::optional<Grip> m_grip;

  Drag m_drag = Drag::None;
  QPointF m_pressed, m_last;
  Camera m_before;
  LegendRange m_legendBefore;

  QTimer m_paintTimer;
  QElapsedTimer m_sinceSnapshot, m_sincePaint;
  double m_interval = 0;  ///< ms between the last two snapshots
  double m_drawCost = 0;  ///< ms, smoothed
};

}  // namespace ps
