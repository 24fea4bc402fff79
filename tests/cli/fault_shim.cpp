// SPDX-License-Identifier: BSD-3-Clause
// Loaded in front of the C library (LD_PRELOAD), it makes reads and writes go wrong as SLIPWAVE_FAULT says:
//   short        every call moves a third of what it was asked for at most, and every fifth is interrupted
//   write:N:E    the N-th write that makes a regular file longer, and all such after it, fail with errno E:
//   on a
//                full disk what is there can be written once more
//   close:N:E    likewise closing a regular file that may be written; it is closed all the same
//   rename:N:E   likewise renaming
//   read:N:E     likewise reading a regular file
//   hold:F:N     the process stops itself (SIGSTOP) once it has renamed a file to F for the N-th time
//   unit         powers of two are 1, and with them the unit of the fields: strong sources overflow
// Standard error always works.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

struct Fault {
  std::string kind, name;
  long number = 0;
  int error_number = 0;
};

const Fault& fault() {
  static const Fault wanted = [] {
    Fault found;
    const char* text = std::getenv("SLIPWAVE_FAULT");
    if (!text) return found;
    const std::string all = text;
    const auto first = all.find(':'), second = all.rfind(':');
    found.kind = all.substr(0, first);
    if (first == std::string::npos) return found;
    found.name = all.substr(first + 1, second - first - 1);
    found.number = std::atol(all.c_str() + first + 1);
    found.error_number = std::atoi(all.c_str() + second + 1);
    return found;
  }();
  return wanted;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool is_of(int descriptor, mode_t kind) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && (status.st_mode & S_IFMT) == kind;
}

/// A regular file of the test: in its directory or the one above, where its temporaries are.
bool is_regular(int descriptor) {
  if (descriptor <= 2 || !is_of(descriptor, S_IFREG)) return false;
  std::array<char, 4096> name{}, directory{};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  if (readlink(link.c_str(), name.data(), name.size() - 1) < 0) return false;
  if (!getcwd(directory.data(), directory.size())) return false;
  const std::string here = directory.data();
  const std::string above = here.substr(0, here.rfind('/') + 1);
  return std::strncmp(name.data(), above.c_str(), above.size()) == 0;
}

bool grows(int descriptor, off_t end) {
  struct stat status {};
  return is_regular(descriptor) && fstat(descriptor, &status) == 0 && end > status.st_size;
}

off_t end_of(int descriptor, std::size_t count) { return lseek(descriptor, 0, SEEK_CUR) + off_t(count); }

bool is_shortened(int descriptor) {
  return fault().kind == "short" && descriptor != 2 &&
         (is_regular(descriptor) || is_of(descriptor, S_IFIFO) || descriptor < 2);
}

bool writable(int descriptor) { return (fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY; }

/// Whether this call of a kind is the one to fail, or one after it; sets errno.
bool fails(const char* kind) {
  static std::atomic<long> calls{0};
  if (fault().kind != kind || ++calls < fault().number) return false;
  errno = fault().error_number;
  return true;
}

/// What is left of a request.
std::size_t shortened(int descriptor, std::size_t count) {
  return count > 1 && is_shortened(descriptor) ? (count + 2) / 3 : count;
}

bool interrupted(int descriptor) {
  static std::atomic<long> calls{0};
  if (!is_shortened(descriptor) || ++calls % 5 != 0) return false;
  errno = EINTR;
  return true;
}

void hold_after(const char* renamed_to) {
  static std::atomic<long> times{0};
  if (fault().kind != "hold" || fault().name != renamed_to + std::string(renamed_to).rfind('/') + 1) return;
  if (++times == fault().error_number) std::raise(SIGSTOP);
}

}  // namespace

extern "C" {

ssize_t read(int descriptor, void* to, size_t count) {
  if (interrupted(descriptor) || (is_regular(descriptor) && fails("read"))) return -1;
  return next<decltype(&read)>("read")(descriptor, to, shortened(descriptor, count));
}

ssize_t pread(int descriptor, void* to, size_t count, off_t at) {
  if (interrupted(descriptor) || (is_regular(descriptor) && fails("read"))) return -1;
  return next<decltype(&pread)>("pread")(descriptor, to, shortened(descriptor, count), at);
}

ssize_t pread64(int descriptor, void* to, size_t count, off64_t at) {
  return pread(descriptor, to, count, at);
}

ssize_t write(int descriptor, const void* from, size_t count) {
  if (interrupted(descriptor) || (grows(descriptor, end_of(descriptor, count)) && fails("write"))) return -1;
  return next<decltype(&write)>("write")(descriptor, from, shortened(descriptor, count));
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  if (interrupted(descriptor) || (is_regular(descriptor) && fails("write"))) return -1;
  return next<decltype(&writev)>("writev")(descriptor, parts, count);
}

ssize_t pwrite(int descriptor, const void* from, size_t count, off_t at) {
  if (interrupted(descriptor) || (grows(descriptor, at + off_t(count)) && fails("write"))) return -1;
  return next<decltype(&pwrite)>("pwrite")(descriptor, from, shortened(descriptor, count), at);
}

ssize_t pwrite64(int descriptor, const void* from, size_t count, off64_t at) {
  return pwrite(descriptor, from, count, at);
}

int ftruncate(int descriptor, off_t length) noexcept {
  if (grows(descriptor, length) && fails("write")) return -1;
  return next<int (*)(int, off_t)>("ftruncate")(descriptor, length);
}

int ftruncate64(int descriptor, off64_t length) noexcept { return ftruncate(descriptor, length); }

int close(int descriptor) {
  const bool failing = is_regular(descriptor) && writable(descriptor) && fails("close");
  const int error_number = errno;
  const int closed = next<decltype(&close)>("close")(descriptor);
  if (!failing) return closed;
  errno = error_number;
  return -1;
}

int rename(const char* from, const char* to) noexcept {
  if (fails("rename")) return -1;
  const int renamed = next<int (*)(const char*, const char*)>("rename")(from, to);
  hold_after(to);
  return renamed;
}

double exp2(double power) noexcept {
  static const auto library = next<double (*)(double)>("exp2");
  return fault().kind == "unit" ? 1 : library(power);
}
}
