// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace ps {

class Engine;
struct RunContent;

struct Opening {
  std::shared_ptr<const Project> project;
  bool play = false;
};
struct SingleStep {};
/// To a recorded frame, or to the end of an earlier run, to go on from there.
struct GoBack {
  uint64_t frame = 0, run = 0;  ///< one of them; runs count from 1
  bool play = false;
};
/// A run that was recorded elsewhere, to go on from its end. `same`: the project is the one that it is of.
struct Adoption {
  std::shared_ptr<const RunContent> content;
  bool same = true;
  std::function<void()> adopted{};
};
using Question = std::function<void(const Engine&)>;
/// Values of parameters that wait side by side, one of each address.
using ParameterBatch = std::vector<SetParameter>;
using QueueEntry = std::variant<ParameterBatch, Command, Question, Opening, SingleStep, GoBack, Adoption>;

/// What waits for the engine's thread. Values for parameters that wait side by side become one entry, in which a newer
/// value replaces a waiting one of its address; a whole project, and a list of tracks or probes, replaces what it
/// would overwrite. Everything else keeps its place. Not for two threads at a time.
class CommandQueue {
 public:
  bool empty() const { return m_entries.empty(); }
  /// Whether another scene waits to be opened.
  bool opens() const {
    return std::any_of(m_entries.begin(), m_entries.end(),
                       [](const QueueEntry& entry) { return std::holds_alternative<Opening>(entry); });
  }
  void push(Command command) {
    if (auto* edit = std::get_if<SetParameter>(&command)) {
      set(std::move(*edit));
      return;
    }
    if (std::holds_alternative<UpdateProject>(command)) {  // it says what those before it would have said
      while (!empty() && (waitsValuesAlone() || waitsLast<UpdateProject>() || waitsLast<SetTracks>()))
        m_entries.pop_back();
    }
    if (auto* moved = std::get_if<MoveBody>(&command); moved && joinsMove(*moved)) return;
    if (std::holds_alternative<SetTracks>(command) && waitsLast<SetTracks>()) m_entries.pop_back();
    if (std::holds_alternative<SetProbes>(command) && waitsLast<SetProbes>()) m_entries.pop_back();
    m_entries.emplace_back(std::move(command));
  }
  void push(Question question) { m_entries.emplace_back(std::move(question)); }
  void push(Opening opening) { m_entries.emplace_back(std::move(opening)); }
  void push(SingleStep step) { m_entries.emplace_back(step); }
  void push(Adoption recording) { m_entries.emplace_back(std::move(recording)); }
  void push(GoBack to) { m_entries.emplace_back(to); }
  std::optional<QueueEntry> pop() {
    if (empty()) return std::nullopt;
    QueueEntry first = std::move(m_entries.front());
    m_entries.pop_front();
    return first;
  }

 private:
  /// Values that carry matter along do more than a project says.
  bool waitsValuesAlone() const {
    const auto* batch = std::get_if<ParameterBatch>(&m_entries.back());
    return batch && std::none_of(batch->begin(), batch->end(),
                                 [](const SetParameter& one) { return one.address.owner == Owner::Shape; });
  }
  template <class Kind>
  bool waitsLast() const {
    const auto* command = empty() ? nullptr : std::get_if<Command>(&m_entries.back());
    return command && std::holds_alternative<Kind>(*command);
  }
  /// Several bodies may be on their way at once: a further step of one goes on from the one that waits.
  bool joinsMove(const MoveBody& next) {
    for (auto entry = m_entries.rbegin(); entry != m_entries.rend(); ++entry) {
      auto* command = std::get_if<Command>(&*entry);
      auto* waiting = command ? std::get_if<MoveBody>(command) : nullptr;
      if (!waiting) return false;
      if (waiting->body->id != next.body->id) continue;
      if (waiting->led != next.led) return false;
      *waiting = {next.body, next.move.after(waiting->move), next.led};
      return true;
    }
    return false;
  }
  void set(SetParameter edit) {
    if (empty() || !std::holds_alternative<ParameterBatch>(m_entries.back())) m_entries.emplace_back(ParameterBatch{});
    ParameterBatch& batch = std::get<ParameterBatch>(m_entries.back());
    std::erase_if(batch, [&](const SetParameter& waiting) { return waiting.address == edit.address; });
    batch.push_back(std::move(edit));
  }
  std::deque<QueueEntry> m_entries;
};

}  // namespace ps
