// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"
#include "ui/document/strokerecord.h"

#include <QtCore/QObject>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class Document;
class EngineThread;

/// Carries a document's changes to the engine's thread, and the live pieces of a stroke past the document. Commands act
/// between frames, in order; what they need to remember of particles (ids, fields) stays on the engine's thread.
class SceneLink : public QObject {
  Q_OBJECT
 public:
  using KnownStroke = std::pair<std::shared_ptr<StrokeRecord>, bool>;  ///< and whether it is done, not undone

  SceneLink(Document& document, EngineThread& engine, QObject* parent = nullptr);
  ~SceneLink() override;

  /// Back to the start, edits kept. Undoing an earlier stroke still removes exactly its particles.
  void reset();
  /// The engine could not build the scene: its snapshot is empty, and an event says why. Each change of the scene,
  /// reset() and rebuild() try again.
  bool isBroken() const;
  void rebuild(bool play);
  /// A piece of a stroke in the making: `body` is the painted body as it was before, `cells` are new.
  void paint(const StrokeRecord& stroke, std::shared_ptr<const Body> body, std::vector<std::array<int, 3>> cells);
  /// Removes what is in the cells now, except matter of locked bodies.
  void erase(const StrokeRecord& stroke, std::vector<std::array<int, 3>> cells);
  /// Takes back a stroke that the document does not know yet (Esc).
  void cancel(const std::shared_ptr<StrokeRecord>& stroke);

 private:
  void onChanged(const ChangeEvent& event);
  void remember(const StrokeChanged& event);
  void onStroke(const StrokeChanged& event);
  void undoStroke(const std::shared_ptr<StrokeRecord>& stroke);
  void redoStroke(const std::shared_ptr<StrokeRecord>& stroke);
  void onBody(const BodyChanged& event);
  void pushProject();
  std::vector<KnownStroke> strokes() const;

  Document& m_document;
  EngineThread& m_engine;
  std::shared_ptr<uint64_t> m_run;                                      ///< counts resets; engine thread only
  std::vector<std::pair<std::weak_ptr<StrokeRecord>, bool>> m_strokes;  ///< like KnownStroke
};

}  // namespace ps
