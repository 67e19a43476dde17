// SPDX-License-Identifier: Apache-2.0
#include "ui/document/history.h"

#include <algorithm>
#include <utility>

namespace ps {

/// Commands that are one step.
class History::Macro final : public WeighedCommand {
 public:
  using WeighedCommand::WeighedCommand;
  void undo() override {
    for (auto part = m_parts.rbegin(); part != m_parts.rend(); ++part) (*part)->undo();
  }
  void redo() override {
    for (const auto& part : m_parts) part->redo();
  }
  void weigh(Weight& weight) const override {
    for (const auto& part : m_parts) {
      weight.own += sizeof(*part);
      if (const auto* weighed = dynamic_cast<const WeighedCommand*>(part.get())) weighed->weigh(weight);
    }
  }
  std::vector<std::unique_ptr<QUndoCommand>>& parts() { return m_parts; }

 private:
  std::vector<std::unique_ptr<QUndoCommand>> m_parts;
};

namespace {

bool merges(QUndoCommand& last, const QUndoCommand& next) {
  return last.id() != -1 && last.id() == next.id() && last.mergeWith(&next);
}

}  // namespace

History::History(QObject* parent) : QObject(parent) {}
History::~History() = default;

void History::push(QUndoCommand* command) {
  std::unique_ptr<QUndoCommand> taken(command);
  if (!command->isObsolete()) command->redo();
  if (!m_macros.empty()) {
    auto& parts = m_macros.back()->parts();
    if (!parts.empty() && merges(*parts.back(), *command)) {
      if (parts.back()->isObsolete()) parts.pop_back();
    } else if (!command->isObsolete()) {
      parts.push_back(std::move(taken));
    }
    return;
  }
  dropUndone();
  if (m_index > 0 && m_index != m_clean && merges(*m_steps.back().command, *command)) {
    if (m_steps.back().command->isObsolete()) {
      remove(m_index - 1);
      --m_index;
    } else {
      weigh(m_steps.back());
    }
  } else if (!command->isObsolete()) {
    append(std::move(taken));
    ++m_index;
  } else {
    return tell();  // what could be redone is gone
  }
  trim();
  tell();
}

void History::append(std::unique_ptr<QUndoCommand> command) {
  m_steps.push_back({std::move(command), {}});
  weigh(m_steps.back());
}

void History::undo() {
  if (m_macros.empty()) Q_EMIT undoing();
  if (!canUndo()) return;
  const int place = m_index - 1;
  QUndoCommand& step = *command(place);
  if (!step.isObsolete()) step.undo();
  m_index = place;
  if (step.isObsolete()) remove(place);
  tell();
}

void History::redo() {
  if (!canRedo()) return;
  const int place = m_index;
  QUndoCommand& step = *command(place);
  if (!step.isObsolete()) step.redo();
  if (step.isObsolete())
    remove(place);
  else
    m_index = place + 1;
  tell();
}

void History::beginMacro(const QString& text) {
  auto macro = std::make_unique<Macro>(text);
  Macro* open = macro.get();
  if (m_macros.empty()) {
    dropUndone();
    append(std::move(macro));  // it counts as done when it ends
  } else {
    m_macros.back()->parts().push_back(std::move(macro));
  }
  m_macros.push_back(open);
  if (m_macros.size() > 1) return;
  Q_EMIT canUndoChanged(false);
  Q_EMIT undoTextChanged({});
  Q_EMIT canRedoChanged(false);
  Q_EMIT redoTextChanged({});
}

void History::endMacro() {
  if (m_macros.empty()) return;
  m_macros.pop_back();
  if (!m_macros.empty()) return;
  weigh(m_steps.back());
  ++m_index;
  trim();
  tell();
}

void History::clear() {
  m_macros.clear();
  m_steps.clear();
  m_own = 0;
  m_shared.clear();
  m_named.clear();
  m_index = m_clean = 0;
  m_letGo = 0;
  tell();
}

QString History::undoText() const { return canUndo() ? command(m_index - 1)->text() : QString(); }
QString History::redoText() const { return canRedo() ? command(m_index)->text() : QString(); }

void History::setClean() {
  if (!m_macros.empty()) return;
  m_clean = m_index;
  if (!std::exchange(m_wasClean, true)) Q_EMIT cleanChanged(true);
}

void History::resetClean() {
  m_clean = -1;
  if (std::exchange(m_wasClean, false)) Q_EMIT cleanChanged(false);
}

void History::setLimit(size_t bytes) {
  m_limit = bytes;
  trim();
}

void History::setMatter(std::shared_ptr<const MatterBytes> bytes) {
  if (bytes == m_matter) return;
  m_matter = std::move(bytes);
  trim();
}

/// Of what it is by now.
void History::weigh(Step& step) {
  lighten(step);
  step.weight = {};
  step.weight.own = sizeof(Step) + sizeof(*step.command) + 2 * static_cast<size_t>(step.command->text().size());
  if (const auto* weighed = dynamic_cast<const WeighedCommand*>(step.command.get())) weighed->weigh(step.weight);
  m_own += step.weight.own;
  for (const auto& [what, bytes] : step.weight.shared) {
    Shared& shared = m_shared[what];
    shared.bytes = bytes;
    ++shared.steps;
  }
  for (const MatterKey key : step.weight.matter) ++m_named[key];
}

void History::lighten(const Step& step) {
  m_own -= step.weight.own;
  for (const auto& [what, bytes] : step.weight.shared) {
    const auto shared = m_shared.find(what);
    if (shared != m_shared.end() && --shared->second.steps == 0) m_shared.erase(shared);
  }
  for (const MatterKey key : step.weight.matter) {
    const auto named = m_named.find(key);
    if (named != m_named.end() && --named->second == 0) m_named.erase(named);
  }
}

size_t History::bytes() const {
  size_t all = m_own;
  for (const auto& [what, shared] : m_shared) all += shared.bytes;
  if (m_matter) {
    for (const auto& [key, bytes] : *m_matter) all += m_named.contains(key) ? bytes : 0;
  }
  if (!m_held || m_shared.empty()) return all;
  Weight held;
  m_held(held);
  for (const auto& [what, bytes] : held.shared) all -= m_shared.contains(what) ? bytes : 0;
  return all;
}

void History::remove(int place) {
  lighten(m_steps[static_cast<size_t>(place)]);
  m_steps.erase(m_steps.begin() + place);
  if (m_clean > place) m_clean = -1;
}

void History::dropUndone() {
  while (count() > m_index) {
    lighten(m_steps.back());
    m_steps.pop_back();
  }
  if (m_clean > m_index) m_clean = -1;
}

/// Whoever has undone all but one step keeps what can be redone, however much that is: the next step lets it go.
void History::trim() {
  if (!m_macros.empty()) return;
  int gone = 0;
  while (m_index - gone > 1 && bytes() > m_limit) {
    lighten(m_steps[static_cast<size_t>(gone)]);
    m_steps[static_cast<size_t>(gone)].weight = {};
    m_steps[static_cast<size_t>(gone)].command.reset();
    ++gone;
  }
  if (gone == 0) return;
  m_steps.erase(m_steps.begin(), m_steps.begin() + gone);
  m_index -= gone;
  m_letGo += gone;
  m_clean = m_clean < gone ? -1 : m_clean - gone;
  Q_EMIT letGo();
}

void History::tell() {
  const bool clean = isClean();
  Q_EMIT indexChanged(m_index);
  Q_EMIT canUndoChanged(canUndo());
  Q_EMIT undoTextChanged(undoText());
  Q_EMIT canRedoChanged(canRedo());
  Q_EMIT redoTextChanged(redoText());
  if (std::exchange(m_wasClean, clean) != clean) Q_EMIT cleanChanged(clean);
}

}  // namespace ps
