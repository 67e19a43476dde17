// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/globjects.h"

#include <functional>
#include <vector>

namespace ps::render {

/// Spheres, sprites or triangles sorted by the graphics card into the squares of a picture that they may touch, so that
/// a program that computes finds those of a pixel. Holds one list at a time.
class Bins {
 public:
  struct Field {
    int width, height;  ///< of the picture, pixels
    int smallest = 4;   ///< power of two that the smallest squares are wide, pixels; from 3
  };
  /// A list to be sorted by a program that ends in sort.comp, which is told of the things, but for their number, each
  /// time that it is put to use. Each of them takes so many `vectors` of four numbers.
  struct Order {
    Bins& bins;
    const Program& sort;
    size_t things, vectors;
    Field field;
    std::function<void()> tell;
  };
  /// Several lists at once: each takes three short rounds, which have to wait for one another.
  static void sort(const std::vector<Order>& orders);
  /// Has a program that is in use run for each pixel with what was sorted last, `block` x `block` of them at once.
  void run(const Program& program, int block = 8) const;

 private:
  void makeRoom(const Order& order);
  void go(const Order& order, int turn) const;
  void tell(const Program& program) const;

  Buffer m_things, m_places, m_squares, m_list, m_sorted;
  Field m_field{0, 0};
  int m_sizes = 0;
  size_t m_vectors = 1, m_squareCount = 0;
};

/// Has a program that computes run once for each block of pixels, and what follows wait for it.
void computePixels(int width, int height, int block = 8);

}  // namespace ps::render
