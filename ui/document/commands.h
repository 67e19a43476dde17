// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/strokerecord.h"

#include <QtGui/QUndoCommand>

#include <memory>

namespace ps {

class Document;

/// One parameter from an old to a new value; "nothing" is the default. Commands of one gesture on one address merge, so
/// that a whole drag is one step; one that ends where it began vanishes.
class ParameterCommand : public QUndoCommand {
 public:
  ParameterCommand(Document& document, Address address, std::optional<Value> before, std::optional<Value> after,
                   int gesture, const QString& text);
  void undo() override;
  void redo() override;
  int id() const override { return 1; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  Document& m_document;
  Address m_address;
  std::optional<Value> m_before, m_after;
  int m_gesture;
};

/// Bodies replaced, added or removed as values: names, visibility, locks.
class BodiesCommand : public QUndoCommand {
 public:
  BodiesCommand(Document& document, std::vector<SceneEdit> edits, const QString& text);
  void undo() override;
  void redo() override;

 private:
  void apply(bool forward);
  Document& m_document;
  std::vector<SceneEdit> m_edits;
};

/// A finished stroke. Its particles are in the engine before the command is pushed.
class StrokeCommand : public QUndoCommand {
 public:
  StrokeCommand(Document& document, std::shared_ptr<StrokeRecord> stroke, const QString& text);
  void undo() override;
  void redo() override;

 private:
  Document& m_document;
  std::shared_ptr<StrokeRecord> m_stroke;
  bool m_live = true;
};

/// The rows of "Try these".
class PinsCommand : public QUndoCommand {
 public:
  PinsCommand(Document& document, std::vector<std::string> before, std::vector<std::string> after, const QString& text);
  void undo() override;
  void redo() override;

 private:
  Document& m_document;
  std::vector<std::string> m_before, m_after;
};

}  // namespace ps
