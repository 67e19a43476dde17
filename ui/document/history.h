// SPDX-License-Identifier: Apache-2.0
// Why not Qt's stack of undo commands: it can be told how many steps to keep, on the day it is empty, and nothing else.
// A step of ours may hold a number or a mesh of a hundred megabytes.
#pragma once
#include "core/simulation/command.h"
#include "core/simulation/snapshot.h"
#include "ui/document/weight.h"

#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtGui/QUndoCommand>

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <vector>

namespace ps {

/// A command that knows what it keeps in memory.
class WeighedCommand : public QUndoCommand {
 public:
  using QUndoCommand::QUndoCommand;
  virtual void weigh(Weight& weight) const = 0;
};

/// What can be undone and redone, step by step, as with QUndoStack: commands merge with the one before, those that
/// became obsolete go, macros are one step. Above a limit of memory the oldest steps are let go, but never the last
/// that can be undone. UI thread only.
class History : public QObject {
  Q_OBJECT
 public:
  static constexpr size_t kUsual = size_t{512} << 20;  ///< bytes
  static constexpr size_t kEndless = std::numeric_limits<size_t>::max();

  explicit History(QObject* parent = nullptr);
  ~History() override;

  void push(QUndoCommand* command);  ///< does it, and takes it
  void undo();
  void redo();
  void beginMacro(const QString& text);
  void endMacro();
  void clear();

  bool canUndo() const { return m_macros.empty() && m_index > 0; }
  bool canRedo() const { return m_macros.empty() && m_index < count(); }
  QString undoText() const;
  QString redoText() const;
  int index() const { return m_index; }  ///< steps that can be undone
  int count() const { return static_cast<int>(m_steps.size()); }
  QUndoCommand* command(int place) const { return m_steps[static_cast<size_t>(place)].command.get(); }
  /// As many as were done and not undone since the history was empty, those that were let go among them.
  int64_t position() const { return m_letGo + m_index; }
  int64_t letGoSteps() const { return m_letGo; }  ///< since then

  bool isClean() const { return m_macros.empty() && m_clean == m_index; }
  int cleanIndex() const { return m_clean; }  ///< -1: there is none any more
  void setClean();
  void resetClean();

  /// Bytes. What is above it goes at once, and after each step from then on.
  void setLimit(size_t bytes);
  size_t limit() const { return m_limit; }
  /// Bytes that would come back if there were no history: what steps share counts once, and what is in the document as
  /// well, not at all. An estimate, within a tenth for what is large.
  size_t bytes() const;
  /// What the document itself holds; asked for when bytes are counted.
  void setDocument(std::function<void(Weight&)> held) { m_held = std::move(held); }
  /// Bytes that somebody else keeps for edits, by their keys; others keep none.
  void setMatter(std::shared_ptr<const MatterBytes> bytes);

 Q_SIGNALS:
  void undoing();  ///< about to: what is in the making may still become the step that is undone
  void indexChanged(int index);
  void cleanChanged(bool clean);
  void canUndoChanged(bool can);
  void canRedoChanged(bool can);
  void undoTextChanged(const QString& text);
  void redoTextChanged(const QString& text);
  void letGo();  ///< the oldest steps

 private:
  struct Step {
    std::unique_ptr<QUndoCommand> command;
    Weight weight;
  };
  class Macro;
  void append(std::unique_ptr<QUndoCommand> command);
  void weigh(Step& step);
  void lighten(const Step& step);
  void remove(int place);
  void dropUndone();
  void trim();
  void tell();

  std::vector<Step> m_steps;
  std::vector<Macro*> m_macros;  ///< open, outermost first
  int m_index = 0, m_clean = 0;
  int64_t m_letGo = 0;
  bool m_wasClean = true;
  size_t m_limit = kEndless;
  std::function<void(Weight&)> m_held;
  struct Shared {
    size_t bytes = 0, steps = 0;
  };
  size_t m_own = 0;
  std::map<const void*, Shared> m_shared;
  std::map<MatterKey, size_t> m_named;  ///< steps that name it
  std::shared_ptr<const MatterBytes> m_matter;
};

}  // namespace ps
