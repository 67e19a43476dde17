// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

// Plain types of the plugin interface. Nothing here needs Qt, Eigen or the standard containers.
//
// How the interface grows, so that a binary built once goes on loading:
// - A struct that crosses grows at its end only, and has no padding there. Span, List, Double3, Float4, Cell,
//   ResponsePoint and ResponseSpec never change: they are held by others by value.
// - Arrays of structs cross as List, which says how far apart its elements lie. Whoever reads a list that the other
// side
//   has made takes elements with at(), which copes with elements smaller or larger than those it was built for.
// - A struct that a plugin fills in begins with its own size; the host holds it out with its size and its defaults, and
//   fill() writes what both sides know.
// - Classes with virtual functions are frozen. What comes later is asked for by name: Plugin::extension(),
//   Host::extension().
// Until version 1.0 anything may still change; kLayout then says that binaries of another layout are refused.
namespace ps::api {

inline constexpr int kVersionMajor = 0;
inline constexpr int kVersionMinor = 9;
/// Of what crosses. Raised by every change that is no growth in the manner above.
inline constexpr int kLayout = 3;

/// A view of `size` values of T owned by somebody else. T is a number, a pointer or a struct that never changes.
template <class T>
struct Span {
  T* data = nullptr;
  size_t size = 0;
  T& operator[](size_t i) const { return data[i]; }
  T* begin() const { return data; }
  T* end() const { return data + size; }
};

/// Elements lie `stride` bytes apart, so that the element type may grow.
template <class T>
struct List {
  const T* first = nullptr;
  size_t count = 0;
  size_t stride = sizeof(T);
  /// Of a list made by the same binary.
  const T& operator[](size_t i) const {
    return *reinterpret_cast<const T*>(reinterpret_cast<const char*>(first) + i * stride);
  }
  /// Of any list: what an older maker does not know has its default.
  T at(size_t i) const {
    T element{};
    std::memcpy(static_cast<void*>(&element), reinterpret_cast<const char*>(first) + i * stride,
                stride < sizeof(T) ? stride : sizeof(T));
    return element;
  }
};
template <class T, size_t N>
constexpr List<T> listOf(const T (&values)[N]) {
  return {values, N, sizeof(T)};
}
template <class T>
constexpr List<T> listOf(const T* values, size_t count) {
  return {values, count, sizeof(T)};
}

/// Writes `value` into the struct that the host holds out, as far as both sides know it; true, for the caller to
/// return.
template <class T>
bool fill(T* out, const T& value) {
  const size_t bytes = out->structSize < sizeof(T) ? out->structSize : sizeof(T);
  std::memcpy(static_cast<void*>(out), &value, bytes);
  out->structSize = bytes;
  return true;
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

/// A per-particle field that a plugin owns. The host stores, sorts, hashes and saves it. One with a label, of any type
/// but Float4, is shown to people as the program's own are: as colours with a legend, as probes, in recordings.
struct FieldDeclaration {
  const char* name;  ///< unique; begins with the plugin's id and a dot: "org.example.rust.depth"
  const char* unit;  ///< SI, "" for none
  const char* help;
  FieldType type;
  const char* label = "";           ///< "Depth of rust", at most 40 letters; "": nobody but the plugin needs to see it
  double minimum = 0, maximum = 0;  ///< ends of its colours' scale, in its unit; equal: as far as its values go
};

}  // namespace ps::api
