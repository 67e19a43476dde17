// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"
#include "core/simulation/hand.h"
#include "core/simulation/snapshot.h"
#include "core/solver/matter.h"

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ps {

class Engine;

/// What keys of commands name: particles have moved since an edit made them, so only their ids tell them apart. A reset
/// gives all particles new ids, and nothing is named then.
class NamedMatter {
 public:
  NamedMatter() = default;
  explicit NamedMatter(const MatterIds& named);
  /// What keys name, without those of which something is out of the scene or was heated: that is in no state.
  MatterIds present() const;
  /// The keys of those.
  std::vector<MatterKey> outside() const;
  /// Without those of which something is out of the scene, and without hands: what holds of a state in this program.
  NamedMatter inScene() const;
  std::vector<MatterKey> keys() const;
  std::vector<MatterKey> keysInScene() const;  ///< those of inScene()
  /// The keys of those that took cells out of a scene that had begun, or painted them, and still do.
  std::vector<MatterKey> erasedOrPainted() const;
  /// Bytes that each key keeps, so that what it names can be undone and redone. Never changed; another one after edits
  /// alone.
  std::shared_ptr<const MatterBytes> bytes() const;
  /// The keys of hands that are in matter: neither is that in a state.
  std::vector<MatterKey> hands() const;
  /// How hard hands work by now, called as contactOf() says; also those that have just done so.
  std::vector<ToolContact> contacts() const;
  /// What hands do in a frame, before it.
  void act(Engine& engine);
  /// Does what a command that names matter says.
  template <class Command, class Self = NamedMatter>
  auto apply(Engine& engine, const Command& command) -> decltype(std::declval<Self&>().obey(engine, command)) {
    m_bytes.reset();
    obey(engine, command);
  }

 private:
  void obey(Engine& engine, const AddCells& command);
  void obey(Engine& engine, const TakeCells& command);
  void obey(Engine& engine, const TakeBody& command);
  void obey(Engine& engine, const TakeMatter& command);
  void obey(Engine& engine, const PutBack& command);
  void obey(Engine& engine, const PaintCells& command);
  void obey(Engine& engine, const NameMatter& command);
  void obey(Engine& engine, const ReturnBody& command);
  void obey(Engine& engine, const ForgetMatter& command);
  void obey(Engine& engine, const TouchMatter& command);
  void obey(Engine& engine, const UndoTouch& command);
  void obey(Engine& engine, const RedoTouch& command);
  /// Particles, the material that they become or the colour that they get, and what they were while they are so.
  struct Coat {
    std::vector<uint32_t> ids;
    std::string material;
    PaintedMatter was{};
    std::vector<std::pair<uint32_t, uint32_t>> colours{};  ///< by their ids, where it is a colour
    bool isNothing() const { return was.before.id.empty() && colours.empty(); }
  };
  struct Entry {
    std::vector<uint32_t> ids;               ///< born by the edit, or taken by it
    std::vector<ExtractedMatter> extracted;  ///< what is out of the scene now
    bool afterStart = false;                 ///< of cells: the scene had begun
    std::optional<Hand> hand;
    HeatById heat, taken;                 ///< what it gave, and what of it was taken back
    std::vector<TieChange> ties, untied;  ///< likewise what it cut and welded
    std::vector<Coat> painted, bare;      ///< one after the other: what it painted, and what of it was taken back
    /// What it had painted before a reset, with the material that undo gives, and what undo has given it.
    std::vector<Coat> before, stripped;
    bool erasedOrPainted() const { return afterStart && !(extracted.empty() && painted.empty()); }
    bool isPresent() const {
      return extracted.empty() && heat.empty() && taken.empty() && ties.empty() && untied.empty() && !hand &&
             painted.empty() && bare.empty() && before.empty() && stripped.empty();
    }
  };
  void act(Engine& engine, Entry& entry);
  void finishHands(Engine& engine);
  static void extract(Engine& engine, Entry& entry, const std::vector<uint32_t>& ids);
  static void putBack(Engine& engine, Entry& entry);
  static void paint(Engine& engine, std::vector<Coat>& coats, std::vector<Coat>& painted);
  static void unpaint(Engine& engine, std::vector<Coat>& painted, std::vector<Coat>& coats);
  static void undoTies(Engine& engine, Entry& entry);
  static void redoTies(Engine& engine, Entry& entry);
  static uint64_t bytesOf(const Entry& entry);
  std::map<MatterKey, Entry> m_entries;
  mutable std::shared_ptr<const MatterBytes> m_bytes;  ///< nullptr: something has changed
  std::vector<MatterKey> m_settled;                    ///< of erasedOrPainted(), forgotten since: nobody can undo them
};

}  // namespace ps
