// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"
#include "ui/render/renderer.h"
#include "ui/tools/navigation.h"
#include "ui/tools/porthandles.h"
#include "ui/viewport/legendrange.h"
#include "ui/viewport/overlaychoice.h"
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
class Selection;
class Session;
class Toolbox;

/// Asks for the OpenGL that views need; before the application is made.
void requestViewFormat();

/// The scene, live. Draws the newest snapshot, repaints when there is a new one or somebody interacts, and no more
/// often than leaves the solver time to work. It feeds the tool in hand and draws what that says; it follows session,
/// document, selection and toolbox by itself. Needs OpenGL 4.3; without it a sentence stands in its place.
class Viewport : public QOpenGLWidget {
  Q_OBJECT
 public:
  /// All three must outlive it.
  Viewport(Session& session, Selection& selection, Toolbox& tools, QWidget* parent = nullptr);
  ~Viewport() override;

  SnapshotPtr snapshot() const { return m_now; }  ///< the one that is shown
  const RenderScene& scene() const { return m_scene; }
  Look look();  ///< of the next picture
  Toolbox& tools() const { return m_tools; }
  const std::string& colour() const { return m_colour; }  ///< "material", or the name of a field
  const ViewNavigator& navigator() const { return m_navigator; }
  void show(StandardView view);
  void frameSelection();
  void frameAll();
  /// Where the mouse points, or the middle of the view where it is elsewhere.
  Pointer pointerNow() const;
  /// What the pointer would take hold of there, in the widget's pixels.
  std::optional<PortHandle> portHandleAt(const QPointF& position) const;
  const OverlayChoice& overlays() const { return m_overlays; }
  void setOverlays(const OverlayChoice& overlays);
  /// Logical pixels at the upper edge over which something else lies: what stands there begins below.
  void setCovered(int top);
  Studio studio() const { return m_studio; }
  void setStudio(Studio studio);
  const std::optional<ViewSection>& viewSection() const { return m_section; }  ///< none: the whole scene is shown
  /// As it is seen from here.
  std::optional<Section> section() const;
  /// Cuts the scene open across "x", "y" or "z", from the side that one sees, or facing the viewer ("view"): through
  /// the middle of what is selected or in view, or where it is cut by now.
  void cutAcross(const std::string& across);
  void flipSection();
  void moveSection(int steps);  ///< so many spacings away from the side that is cut away
  bool endSection();            ///< false: there was none
  /// Esc: gives up a drag or stroke. False when there was none.
  bool cancelGesture();
  /// "" or why there is no picture.
  const QString& problem() const { return m_problem; }
  const QString& graphics() const { return m_graphics; }  ///< "OpenGL 4.5"; "" before the first picture
  double drawMilliseconds() const { return m_drawCost; }
  const OverlayHits& overlayHits() const { return m_hits; }  ///< as painted last
  std::pair<double, double> legendRange() const { return m_range; }
  /// The same where somebody has set it; SI units.
  std::optional<std::pair<double, double>> ownLegendRange() const;
  void setLegendRange(const std::pair<double, double>& range);  ///< of the field that is shown
  /// Of the picture that was drawn last, without what is selected or compared.
  Look shownLook() const;
  const std::set<std::string>& hiddenBodies() const { return m_hidden; }
  /// The body that a dragged material would be dropped on, which has the line around it meanwhile; "" where there is
  /// none.
  const std::string& dropTarget() const { return m_dropTarget; }
  /// What is said at the top meanwhile; "" for nothing.
  const QString& dropNote() const { return m_dropNote; }
  /// Tool, brush and what is marked, in words: what a screen reader says.
  QString summary() const;
  /// What the strip of hints says.
  std::vector<OverlayHint> hints() const;
  /// What to do in a scene without matter; "" where there is some.
  QString invitation() const;

 Q_SIGNALS:
  void viewMenuRequested(const QPoint& global);
  void sectionChanged();
  void glReady();
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
  void tabletEvent(QTabletEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// Who has the button that is down.
  enum class Drag { None, Tool, Click, View, Menu, LegendHigh, LegendLow, Section, Size };
  void onChanged(const ChangeEvent& event);
  void onTool();
  void snapshotArrived();
  void projectOpened();
  void bodiesChanged();
  void releaseGl();
  void requestPaint();
  double blend() const;
  OverlayState overlayState() const;
  std::vector<std::pair<QString, QString>> bodyClasses() const;
  double meltingPoint() const;  ///< K, the pivot of the temperature's colours
  void ghostChanged();
  void paintPortsOver(QPainter& painter) const;
  std::optional<BodyOutline> outline() const;
  std::optional<SceneTag> tag() const;
  std::optional<std::pair<Vector3, Vector3>> boxOfSelection() const;
  std::optional<std::pair<Vector3, Vector3>> boxAround(const Port& port) const;
  void announce();  ///< tells assistive technology of another summary()
  void storeView();
  // viewportsection.cpp
  void setSection(const std::optional<ViewSection>& section);
  Vector3 middleInView() const;
  const std::pair<Vector3, Vector3>& boxOfAll() const;
  std::pair<double, double> reachOfSection(const Vector3& side) const;
  void cutAt(double height);
  std::optional<SectionNote> sectionNote() const;
  bool clickSection(const QPointF& position);
  void dragSection(const QPointF& position);
  // viewportdrops.cpp
  std::string matterAt(const QPointF& position) const;
  void aimDrop(const QPointF& position);
  void endDrop();
  // viewportinput.cpp
  Vector3 leanIn(const CameraFrame& frame) const;
  Pointer pointerAt(const QPointF& position, Qt::KeyboardModifiers modifiers) const;
  std::optional<MouseBinding> bindingOf(Qt::MouseButton button, Qt::KeyboardModifiers held) const;
  bool beginSize(const QMouseEvent& event);
  void dragSize(double way);
  void dragBegins(const QMouseEvent& event);
  bool clickOverlay(const QPointF& position);
  bool typeToTool(const QKeyEvent& event, bool asks);
  void hover(const QPointF& position, Qt::KeyboardModifiers modifiers);
  void updatePointer(const QPointF& position);      ///< its shape
  Drag legendEndAt(const QPointF& position) const;  ///< None: there is no end of the legend

  Session& m_session;
  Document& m_document;
  Selection& m_selection;
  Toolbox& m_tools;
  std::unique_ptr<Renderer> m_renderer;
  QString m_problem, m_graphics;
  SnapshotPtr m_now, m_previous;
  SnapshotPtr m_ghost;  ///< of another run, without hidden bodies
  RenderScene m_scene;
  /// What the renderer has prepared: while only the camera moves, it stays.
  struct Shown {
    SnapshotPtr now, previous;
    double share = 1;
    Look look;
    bool operator==(const Shown&) const = default;
  };
  std::optional<Shown> m_shown;
  /// The project that was opened has no camera of its own, and snapshots of this revision are of the one before.
  std::optional<uint64_t> m_unframed;
  std::set<std::string> m_hidden;
  std::string m_dropTarget;
  QString m_dropNote;  ///< why nothing takes it, or that several bodies do

  ViewNavigator m_navigator;
  Navigation m_navigation{m_navigator};
  std::string m_colour = kMatterColour;
  LegendRange m_legendRange, m_legendBefore;
  std::optional<ViewSection> m_section, m_sectionBefore;     ///< of now, and before it is dragged
  mutable std::optional<std::pair<Vector3, Vector3>> m_box;  ///< of all there is to see in m_now, once it was asked for
  std::pair<double, double> m_range{0, 1};
  OverlayHits m_hits;
  OverlayChoice m_overlays;
  Studio m_studio = Studio::AsTheme;
  int m_covered = 0;

  Drag m_drag = Drag::None;
  QPointF m_pressed;
  double m_sizeBefore = 0;  ///< of the brush before its size is dragged, see Toolbox::brushSize()
  /// What the pen said last; the mouse's event that Qt makes of that follows at once.
  struct Pen {
    double pressure = 1;
    bool eraser = false;
    double tiltX = 0, tiltY = 0;  ///< rad from upright, to the right and to whoever draws
    double twist = 0;             ///< rad, see Pointer
    QElapsedTimer since;
  };
  Pen m_pen;
  QElapsedTimer m_clock;

  QTimer m_paintTimer;
  QElapsedTimer m_sinceSnapshot, m_sincePaint;
  double m_interval = 0;  ///< ms between the last two snapshots
  double m_drawCost = 0;  ///< ms, smoothed
};

}  // namespace ps
