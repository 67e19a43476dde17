// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <QtCore/QObject>
#include <QtCore/QString>

#include <cstddef>
#include <future>
#include <string>

namespace ps {

class Session;

/// Edits the strokes of a sketch: what is left of them draws it again, on a thread beside the window, as one step of
/// undo. One at a time.
class StrokeListEdits : public QObject {
  Q_OBJECT
 public:
  explicit StrokeListEdits(Session& session, QObject* parent = nullptr);
  /// Waits for what is being drawn, if only for so long.
  ~StrokeListEdits() override;

  /// The last one takes the body with it.
  void remove(const std::string& body, size_t stroke);
  void move(const std::string& body, size_t stroke, size_t to);
  /// The sketch is as without it, and it stays in the list. Not of the only one that is shown.
  void setHidden(const std::string& body, size_t stroke, bool hidden);
  /// SceneMaterial::id that it draws in, as warm as before.
  void setMaterial(const std::string& body, size_t stroke, const std::string& material);
  /// By so much, in m.
  void carry(const std::string& body, size_t stroke, const Vector3& way);
  /// Another one in its place, of the same matter.
  void replace(const std::string& body, size_t stroke, VoxelShape::Stroke other);
  /// Whether the strokes can be edited now; told where they cannot.
  bool isPossible(const std::string& body, size_t stroke) { return sketched(body, stroke) != nullptr; }
  bool busy() const { return m_busy; }

 Q_SIGNALS:
  void busyChanged();
  void told(const QString& title, const QString& sentence);  ///< what became of it, where it is not what was asked for
  void edited(size_t stroke);  ///< the one that was edited stands there now, or another one in its place

 private:
  struct Drawn {
    VoxelShape sketch;
    size_t lost = 0;  ///< cells that none of the strokes explains
    QString problem;
  };
  const Body* sketched(const std::string& body, size_t stroke);  ///< nullptr, and told why
  void stay(const QString& why);
  void redraw(const Body& body, VoxelShape wanted, const QString& title, size_t stroke);
  void take();

  Session& m_session;
  bool m_busy = false;
  std::future<Drawn> m_work;
  uint64_t m_begun = 0;  ///< Document::changeCount()
  std::string m_body;
  QString m_title;
  size_t m_stroke = 0;
};

}  // namespace ps
