// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/room.h"
#include "core/particles/cellgrid.h"
#include "core/particles/particlestore.h"

#include <array>

namespace ps {

struct SearchGrid;

/// Cell-sorted neighbour search (counting sort into cells of the search radius, rows of 27 cells).
/// Lists hold all other particles within search radius = support + skin, in order of cell, padded to kListPad with
/// the dummy index size(). Lists of particles that follow each other lie together, but between them there are entries
/// that belong to no list: view() says how many there are in all. Where nobody has moved since the last build, nor
/// anybody around, lists stay as they are. They are valid until a particle has moved half the skin. Along a periodic
/// axis of the store pairs are found across the faces of the box; it must be three times as long as the search radius
/// (see leastPeriod()).
class Neighbours {
 public:
  static constexpr size_t kListPad = 16;

  /// `support` and `skin` in m.
  void configure(double support, double skin);
  /// Sorts the store by cell (all fields permuted) and rebuilds the lists. The order it applied is in lastOrder().
  void sortAndBuild(ParticleStore& store);
  /// Rebuilds the lists in the present order.
  void build(const ParticleStore& store);
  /// Makes the lists of the particles from `first` on, and of those that these name: for matter that has just been
  /// added, before build() or sortAndBuild() makes all. The others' may be empty.
  void buildOf(const ParticleStore& store, size_t first);
  /// Whether that takes the search for all, of whom so many are new.
  static bool searchesAll(size_t added, size_t all) { return 2 * added >= all; }
  /// True when a particle has moved more than half the skin since the last build, or their number has changed.
  bool stale(const ParticleStore& store) const;
  std::span<const uint32_t> lastOrder() const { return m_lastOrder; }

  api::NeighbourView view() const;
  double support() const { return m_support; }
  /// Whom a list may name lies in the cells around the particle's own.
  const CellGrid& grid() const { return m_grid; }
  /// m, the shortest box that may repeat itself: no particle then meets another one twice.
  static double leastPeriod(double searchRadius) { return 3 * kCellMargin * searchRadius; }
  /// Positions that the present lists were made for.
  std::span<const api::Float4> built() const { return m_built; }

  /// Those positions: the lists follow from them, to the bit. None where `valid` is false: the lists will be made anew
  /// before anything asks for them.
  void save(StateWriter& writer, bool valid) const;
  /// Makes the lists again that were there; `store` must have been restored.
  void restore(const StateReader& reader, const ParticleStore& store);

 private:
  /// Entries of the index.
  struct Room {
    uint32_t first, count;
  };
  void assignCells(std::span<const api::Float4> position, const Period& period);
  void layOut(size_t chunks);
  void giveRoom(size_t chunk, size_t entries);
  Room takeRoom(size_t entries);
  void searchEach(const SearchGrid& grid, std::span<const uint32_t> which);
  bool giveMoreRoom();
  void makeRoom(bool keepLists);
  void makeLists(std::span<const api::Float4> position, const Period& period);
  SearchGrid searchGrid(const Period& period) const;
  void findStirred(std::span<const api::Float4> position, const Period& period);
  bool renew(const SearchGrid& grid, size_t first, size_t last);
  uint32_t dummy() const { return static_cast<uint32_t>(m_begin.size()); }
  /// Puts places where the search reads them.
  void loadSlots(std::span<const api::Float4> position, const Period& period);

  double m_support = 0, m_skin = 0;
  std::vector<uint32_t> m_begin, m_last, m_end, m_slotOf, m_lastOrder;
  RoomVector<uint32_t> m_index;
  std::vector<uint32_t> m_needs;  ///< entries that each chunk of particles needed
  std::vector<Room> m_rooms;      ///< of each
  std::vector<uint8_t> m_short;   ///< 1 where that was too little
  std::vector<uint8_t>
      m_stirred;  ///< by cell: 1 where somebody has moved in it or next to it; none: lists are all made
  std::array<double, 4> m_cells{};  ///< of the lists that there are: cells of one metre, where they begin
  size_t m_slots = 0;               ///< of all
  std::vector<float> m_x, m_y, m_z;
  RoomVector<api::Float4> m_built;
  /// A hair more than the radius, so that rounding never puts two neighbours two cells apart.
  static constexpr double kCellMargin = 1.0001;
  CellGrid m_grid;
};

}  // namespace ps
