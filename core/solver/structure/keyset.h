// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ps {

/// Which particles a constraint ties, by their ids in order; unused places are ~0.
struct TieKey {
  uint64_t a = kNone, b = kNone;
  bool operator==(const TieKey&) const = default;
  static constexpr uint64_t kNone = ~uint64_t{0};
};

/// A set of keys that is only asked, never walked through: open tables, each three quarters full at most. Why no
/// std::unordered_set: a node for each of ten million bonds takes seconds to be made and to be freed. Why many tables:
/// one grows at a time, so that nothing waits while all keys move.
class KeySet {
 public:
  /// False when it is there already.
  bool insert(const TieKey& key) {
    const uint64_t hash = hashOf(key);
    Table& table = tableOf(hash);
    if (4 * (table.count + 1) > 3 * table.slots.size()) grow(table);
    TieKey& slot = table.slots[find(table, key, hash)];
    if (slot == key) return false;
    slot = key;
    ++table.count;
    return true;
  }
  void erase(const TieKey& key) {
    const uint64_t hash = hashOf(key);
    Table& table = tableOf(hash);
    if (table.count == 0) return;
    const size_t mask = table.slots.size() - 1;
    size_t gap = find(table, key, hash);
    if (table.slots[gap] == TieKey{}) return;
    // What had to go on past the one that leaves moves up.
    for (size_t k = (gap + 1) & mask; !(table.slots[k] == TieKey{}); k = (k + 1) & mask) {
      const size_t home = hashOf(table.slots[k]) & mask;
      if (((k - home) & mask) < ((k - gap) & mask)) continue;
      table.slots[gap] = table.slots[k];
      gap = k;
    }
    table.slots[gap] = {};
    --table.count;
  }
  bool contains(const TieKey& key) const {
    const uint64_t hash = hashOf(key);
    const Table& table = m_tables[hash >> 58];
    return table.count > 0 && table.slots[find(table, key, hash)] == key;
  }
  size_t size() const {
    size_t sum = 0;
    for (const Table& table : m_tables) sum += table.count;
    return sum;
  }
  void clear() { m_tables = {}; }

 private:
  struct Table {
    std::vector<TieKey> slots;
    size_t count = 0;
  };
  static uint64_t hashOf(const TieKey& key) {
    const uint64_t mixed = (key.a ^ (key.b * 0x9E3779B97F4A7C15u)) * 0xD6E8FEB86659FD93u;
    return mixed ^ (mixed >> 32);
  }
  Table& tableOf(uint64_t hash) { return m_tables[hash >> 58]; }
  /// The key's slot, or the empty one where it belongs.
  static size_t find(const Table& table, const TieKey& key, uint64_t hash) {
    const size_t mask = table.slots.size() - 1;
    size_t slot = hash & mask;
    while (!(table.slots[slot] == key) && !(table.slots[slot] == TieKey{})) slot = (slot + 1) & mask;
    return slot;
  }
  static void grow(Table& table) {
    std::vector<TieKey> before(std::max<size_t>(16, 2 * table.slots.size()));
    before.swap(table.slots);
    for (const TieKey& key : before) {
      if (!(key == TieKey{})) table.slots[find(table, key, hashOf(key))] = key;
    }
  }

  std::array<Table, 64> m_tables;
};

}  // namespace ps
