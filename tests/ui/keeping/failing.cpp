// SPDX-License-Identifier: Apache-2.0
// Preloaded before a program: its PS_FAIL_AT-th call that writes, syncs, renames or opens for writing below the folder
// PS_FAIL_UNDER fails with the error number PS_FAIL_CODE, and the file PS_FAIL_MARK says that it came to that. With
// PS_FAIL_ON so do all later ones. "Below" is what begins with that name, so that it may be a file and what is made
// beside it.
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

namespace {

bool below(const char* path) {
  const char* folder = std::getenv("PS_FAIL_UNDER");
  return folder && path && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool below(int fd) {
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t count = ::readlink(link, path, sizeof path - 1);
  if (count < 0) return false;
  path[count] = '\0';
  return below(path);
}

bool due() {
  static std::atomic<long> calls{0};
  const char *at = std::getenv("PS_FAIL_AT"), *code = std::getenv("PS_FAIL_CODE"), *mark = std::getenv("PS_FAIL_MARK");
  if (!at || !code || !mark) return false;
  const long call = ++calls, first = std::atol(at);
  if (call < first || (call > first && !std::getenv("PS_FAIL_ON"))) return false;
  const long fd = ::syscall(SYS_openat, AT_FDCWD, mark, O_WRONLY | O_CREAT, 0644);
  ::syscall(SYS_close, fd);
  errno = std::atoi(code);
  return true;
}

template <class Function>
Function real(Function, const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

bool failsToOpen(const char* path, int flags) { return (flags & (O_WRONLY | O_RDWR)) && below(path) && due(); }

mode_t modeOf(int flags, va_list list) { return flags & O_CREAT ? static_cast<mode_t>(va_arg(list, int)) : 0; }

}  // namespace

extern "C" {

#define PS_OPEN(name)                             \
  int name(const char* path, int flags, ...) {    \
    va_list list;                                 \
    va_start(list, flags);                        \
    const mode_t mode = modeOf(flags, list);      \
    va_end(list);                                 \
    if (failsToOpen(path, flags)) return -1;      \
    return real(&name, #name)(path, flags, mode); \
  }
PS_OPEN(open)
PS_OPEN(open64)
#undef PS_OPEN

int mkostemp(char* path, int flags) { return below(path) && due() ? -1 : real(&mkostemp, "mkostemp")(path, flags); }
int mkostemp64(char* path, int flags) {
  return below(path) && due() ? -1 : real(&mkostemp64, "mkostemp64")(path, flags);
}
ssize_t write(int fd, const void* bytes, size_t count) {
  return below(fd) && due() ? -1 : real(&write, "write")(fd, bytes, count);
}
int fsync(int fd) { return below(fd) && due() ? -1 : real(&fsync, "fsync")(fd); }
int rename(const char* from, const char* to) noexcept {
  return below(to) && due() ? -1 : real(&rename, "rename")(from, to);
}
}
