// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>

// Plain types of the plugin interface. Nothing here needs Qt, Eigen or the standard containers, and every struct may
// only grow at its end: a plugin built for 1.0 loads in every 1.x.
namespace ps::api {

inline constexpr int kVersionMajor = 1;
inline constexpr int kVersionMinor = 0;

/// A view of `size` values of T owned by somebody else.
template <class T>
struct Span {
  T* data = nullptr;
  size_t size = 0;
  T& operator[](size_t i) const { return data[i]; }
  T* begin() const { return data; }
  T* end() const { return data + size; }
};

/// Elements lie `stride` bytes apart, so that the element type may grow in a later 1.x.
template <class T>
struct List {
  const T* first = nullptr;
  size_t count = 0;
  size_t stride = sizeof(T);
  const T& operator[](size_t i) const {
    return *reinterpret_cast<const T*>(reinterpret_cast<const char*>(first) + i * stride);
  }
};
template <class T, size_t N>
constexpr List<T> listOf(const T (&values)[N]) {
  return {values, N, sizeof(T)};
}

struct alignas(16) Float4 {
  float x, y, z, w;
};
struct Double3 {
  double x, y, z;
};

/// What a particle's phase fractions amount to. Melting and boiling are the two plateaus (or the melting range).
enum class Phase : uint8_t { Solid, Melting, Liquid, Boiling, Gas };

/// How a particle moves: held by structure, free liquid, vapour parcel, or not at all.
enum class Motion : uint8_t { Solid, Liquid, Gas, Static };
/// Whether matter that moves so keeps its shape.
inline bool holds(Motion motion) { return motion == Motion::Solid || motion == Motion::Static; }

enum class FieldType : uint32_t { Float32, Float64, UInt8, UInt32, Float4 };

/// A per-particle field that a plugin owns. The host stores, sorts, hashes, records and saves it.
struct FieldDeclaration {
  const char* name;  ///< unique; a plugin's own names start with its id, "org.example.rust.depth"
  const char* unit;  ///< SI, "" for none
  const char* help;
  FieldType type;
};

}  // namespace ps::api
