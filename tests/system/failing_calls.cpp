// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program (LD_PRELOAD): one call to the system fails once, as on a full disk, without memory, without
// file descriptors or without threads. A place is a function of the system with the addresses in the project's own
// programs that it is called from.
//   FAILING_CALLS_LIST=FILE   appends a line for each place where a call is made: "ID FUNCTION PROGRAM+ADDRESS…"
//   FAILING_CALLS_AT=ID       the first call of this place fails, in whichever process of a run comes first
//   FAILING_CALLS_DONE=FILE   is made when it has failed
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

constexpr int kOwnAddresses = 3;

struct Place {
  std::uint64_t id = 1469598103934665603u;  // FNV-1a of the text
  std::array<char, 400> text{};
};

thread_local bool inside = false;
std::atomic_flag listing = ATOMIC_FLAG_INIT;
std::array<std::atomic<std::uint64_t>, 4096> listed;

// Without a stack of the loader's own, the first backtrace() would open libgcc in the middle of a call.
__attribute__((constructor)) void Warm() {
  void* addresses[2];
  ::backtrace(addresses, 2);
}

Place Here(const char* function) {
  Place place;
  int length = std::snprintf(place.text.data(), place.text.size(), "%s", function);
  void* addresses[48];
  const int depth = ::backtrace(addresses, 48);
  int own = 0;
  for (int i = 1; i < depth && own < kOwnAddresses; ++i) {
    Dl_info info{};
    if (::dladdr(addresses[i], &info) == 0 || info.dli_fname == nullptr) continue;
    const char* slash = std::strrchr(info.dli_fname, '/');
    const char* program = slash == nullptr ? info.dli_fname : slash + 1;
    if (std::strncmp(program, "rodeira", 7) != 0) continue;
    length += std::snprintf(
        place.text.data() + length, place.text.size() - static_cast<std::size_t>(length), " %s+0x%lx", program,
        static_cast<unsigned long>(static_cast<char*>(addresses[i]) - static_cast<char*>(info.dli_fbase)));
    ++own;
  }
  if (own == 0) place.text[0] = '\0';  // the loader's and libraries' own, outside of any call of the project
  for (const char* c = place.text.data(); *c != '\0'; ++c)
    place.id = (place.id ^ static_cast<unsigned char>(*c)) * 1099511628211u;
  return place;
}

void List(const Place& place, const char* file) {
  for (std::size_t i = 0; i < listed.size(); ++i) {
    std::uint64_t none = 0;
    auto& slot = listed[(place.id + i) % listed.size()];
    if (slot.load() == place.id) return;
    if (slot.compare_exchange_strong(none, place.id)) break;
    if (none == place.id) return;
  }
  while (listing.test_and_set()) {
  }
  const int fd =
      static_cast<int>(::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  if (fd >= 0) {
    std::array<char, 440> line{};
    const int length =
        std::snprintf(line.data(), line.size(), "%016lx %s\n", static_cast<unsigned long>(place.id), place.text.data());
    ::syscall(SYS_write, fd, line.data(), static_cast<std::size_t>(length));
    ::syscall(SYS_close, fd);
  }
  listing.clear();
}

// Whether this call is the one that fails.
bool Fails(const char* function) {
  static const char* const list = std::getenv("FAILING_CALLS_LIST");
  static const char* const at = std::getenv("FAILING_CALLS_AT");
  static const char* const done = std::getenv("FAILING_CALLS_DONE");
  if (inside || (list == nullptr && at == nullptr)) return false;
  inside = true;
  const int error = errno;
  const Place place = Here(function);
  bool fails = false;
  if (place.text[0] != '\0') {
    if (list != nullptr) List(place, list);
    if (at != nullptr && done != nullptr && place.id == std::strtoull(at, nullptr, 16)) {
      const int fd =
          static_cast<int>(::syscall(SYS_openat, AT_FDCWD, done, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
      fails = fd >= 0;
      if (fails) ::syscall(SYS_close, fd);
    }
  }
  errno = error;
  inside = false;
  return fails;
}

template <class Function>
Function Next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// A function of the system with this signature, which returns `failed` with this errno where it fails.
#define FAILING(result, name, parameters, arguments, failed, error) \
  extern "C" result name parameters {                               \
    static const auto next = Next<result(*) parameters>(#name);     \
    if (Fails(#name)) {                                             \
      errno = error;                                                \
      return failed;                                                \
    }                                                               \
    return next arguments;                                          \
  }

FAILING(ssize_t, write, (int fd, const void* bytes, size_t count), (fd, bytes, count), -1, ENOSPC)
FAILING(ssize_t, writev, (int fd, const struct iovec* parts, int count), (fd, parts, count), -1, ENOSPC)
FAILING(ssize_t, pwrite, (int fd, const void* bytes, size_t count, off_t at), (fd, bytes, count, at), -1, ENOSPC)
FAILING(ssize_t, pwrite64, (int fd, const void* bytes, size_t count, off64_t at), (fd, bytes, count, at), -1, ENOSPC)
FAILING(ssize_t, read, (int fd, void* bytes, size_t count), (fd, bytes, count), -1, EIO)
FAILING(ssize_t, pread64, (int fd, void* bytes, size_t count, off64_t at), (fd, bytes, count, at), -1, EIO)
FAILING(int, fsync, (int fd), (fd), -1, EIO)
FAILING(int, fdatasync, (int fd), (fd), -1, EIO)
FAILING(int, syncfs, (int fd), (fd), -1, EIO)
FAILING(int, ftruncate, (int fd, off_t size), (fd, size), -1, ENOSPC)
FAILING(int, ftruncate64, (int fd, off64_t size), (fd, size), -1, ENOSPC)
FAILING(int, posix_fallocate, (int fd, off_t at, off_t size), (fd, at, size), ENOSPC, ENOSPC)
FAILING(int, posix_fallocate64, (int fd, off64_t at, off64_t size), (fd, at, size), ENOSPC, ENOSPC)
FAILING(int, rename, (const char* from, const char* to), (from, to), -1, EIO)
FAILING(int, mkdir, (const char* path, mode_t mode), (path, mode), -1, ENOSPC)
FAILING(FILE*, fopen64, (const char* path, const char* mode), (path, mode), nullptr, EMFILE)
FAILING(FILE*, fopen, (const char* path, const char* mode), (path, mode), nullptr, EMFILE)
FAILING(FILE*, fdopen, (int fd, const char* mode), (fd, mode), nullptr, ENOMEM)
FAILING(void*, mmap, (void* at, size_t size, int protection, int flags, int fd, off_t offset),
        (at, size, protection, flags, fd, offset), MAP_FAILED, ENOMEM)
FAILING(void*, mmap64, (void* at, size_t size, int protection, int flags, int fd, off64_t offset),
        (at, size, protection, flags, fd, offset), MAP_FAILED, ENOMEM)
FAILING(int, socket, (int domain, int type, int protocol), (domain, type, protocol), -1, EMFILE)
FAILING(int, bind, (int fd, const struct sockaddr* address, socklen_t size), (fd, address, size), -1, ENOBUFS)
FAILING(int, listen, (int fd, int waiting), (fd, waiting), -1, EADDRINUSE)
FAILING(int, accept4, (int fd, struct sockaddr* address, socklen_t* size, int flags), (fd, address, size, flags), -1,
        EMFILE)
FAILING(int, connect, (int fd, const struct sockaddr* address, socklen_t size), (fd, address, size), -1, ENETUNREACH)
FAILING(int, pipe2, (int ends[2], int flags), (ends, flags), -1, EMFILE)
FAILING(int, pipe, (int ends[2]), (ends), -1, EMFILE)
FAILING(int, eventfd, (unsigned value, int flags), (value, flags), -1, EMFILE)
FAILING(pid_t, fork, (), (), -1, EAGAIN)
FAILING(int, pthread_create,
        (pthread_t * thread, const pthread_attr_t* attributes, void* (*begin)(void*), void* argument),
        (thread, attributes, begin, argument), EAGAIN, EAGAIN)

// The mode follows only where a file may be made.
#define FAILING_OPEN(name, first_parameters, first_arguments)                                    \
  extern "C" int name first_parameters {                                                         \
    va_list more;                                                                                \
    va_start(more, flags);                                                                       \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : mode_t{0}; \
    va_end(more);                                                                                \
    if (Fails(#name)) {                                                                          \
      errno = EMFILE;                                                                            \
      return -1;                                                                                 \
    }                                                                                            \
    return static_cast<int>(::syscall first_arguments);                                          \
  }

FAILING_OPEN(open, (const char* path, int flags, ...), (SYS_openat, AT_FDCWD, path, flags, mode))
FAILING_OPEN(open64, (const char* path, int flags, ...), (SYS_openat, AT_FDCWD, path, flags | O_LARGEFILE, mode))
FAILING_OPEN(openat, (int folder, const char* path, int flags, ...), (SYS_openat, folder, path, flags, mode))
FAILING_OPEN(openat64, (int folder, const char* path, int flags, ...),
             (SYS_openat, folder, path, flags | O_LARGEFILE, mode))
