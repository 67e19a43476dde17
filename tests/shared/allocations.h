// SPDX-License-Identifier: Apache-2.0
// Counts every call of malloc and its kin (operator new among them) on a thread that asks for it. For one unit of a
// test: it takes the place of these functions in the whole program, which is to export its names (ENABLE_EXPORTS).
#pragma once
#include <QtCore/QString>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <execinfo.h>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PS_COUNTS_ALLOCATIONS 1
#endif

namespace allocations {

inline constexpr int kDeepest = 48;

inline thread_local bool t_counting = false;
inline thread_local uint64_t t_count = 0;
inline thread_local void* t_first[kDeepest];  // who asked first, for the message
inline thread_local int t_depth = 0;
/// Whether one that is asked for by such functions is not judged; nullptr: all are.
inline bool (*spares)(void* const* stack, int depth) = nullptr;

inline void count() {
  if (!t_counting) return;
  t_counting = false;  // backtrace() may allocate
  void* stack[kDeepest];
  const int depth = backtrace(stack, kDeepest);
  if ((!spares || !spares(stack, depth)) && t_count++ == 0) {
    std::copy(stack, stack + depth, t_first);
    t_depth = depth;
  }
  t_counting = true;
}

/// How many there are while a piece of work is done.
template <class Work>
uint64_t during(const Work& work) {
  void* unused[2];
  backtrace(unused, 2);  // loads what it needs
  t_count = 0;
  t_counting = true;
  work();
  t_counting = false;
  return t_count;
}

/// Names of the functions that asked first, as far as the program tells them.
inline QString whoAsked() {
  QString names;
  char** lines = backtrace_symbols(t_first, t_depth);
  for (int k = 2; lines && k < t_depth; ++k) names += QStringLiteral("\n  ") + QString::fromLocal8Bit(lines[k]);
  std::free(lines);
  return names;
}

}  // namespace allocations

#if defined(PS_COUNTS_ALLOCATIONS)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  allocations::count();
  return __libc_malloc(size);
}
void* calloc(size_t items, size_t size) {
  allocations::count();
  return __libc_calloc(items, size);
}
void* realloc(void* old, size_t size) {
  allocations::count();
  return __libc_realloc(old, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  allocations::count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, size_t alignment, size_t size) {
  allocations::count();
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : ENOMEM;
}
}
#endif
