// SPDX-License-Identifier: BSD-3-Clause
#include "io/temporary.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "io/output_file.hpp"

namespace slipwave {
namespace {

/// A temporary's name where a signal handler can find it. Slots are reused, never freed: the handler may walk
/// the list at any moment.
struct Slot {
  std::atomic<bool> taken{true};
  std::atomic<bool> armed{false};
  std::string path;
  Slot* next = nullptr;
};

// A signal handler can reach nothing but static storage.
std::atomic<Slot*> first_slot{nullptr};

Slot* claim_slot(const std::string& path) {
  Slot* slot = first_slot.load();
  for (; slot; slot = slot->next) {
    bool taken = false;
    if (slot->taken.compare_exchange_strong(taken, true)) break;
  }
  if (!slot) {
    slot = new Slot;
    slot->next = first_slot.load();
    while (!first_slot.compare_exchange_weak(slot->next, slot)) {
    }
  }
  slot->path = path;
  slot->armed = true;
  return slot;
}

void release_slot(Slot* slot) {
  slot->armed = false;
  slot->taken = false;
}

/// The signals that end a process by default and are sent from outside, by users, terminals, timers and batch
/// systems. Those that a fault of the program raises leave a core as it was.
constexpr int ending_signals[] = {SIGINT,  SIGTERM,   SIGHUP,  SIGPIPE, SIGQUIT, SIGALRM,
                                  SIGXCPU, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2};

enum class Lock {
  held,
  elsewhere,  // somebody else holds it
  none,       // the file system has none, or none that goes together with those of the netCDF library
};

/// Open file description locks: nobody but the process that opened the file, and those it forks, holds them,
/// and they end with it. The netCDF library takes the other kind, of flock(), on what it writes. Where both
/// are one (NFS) it could write nothing.
Lock lock_of(int descriptor, const std::string& path) {
  struct flock all {};
  all.l_type = F_WRLCK;
  all.l_whence = SEEK_SET;
  if (fcntl(descriptor, F_OFD_SETLK, &all) != 0)
    return errno == EAGAIN || errno == EACCES ? Lock::elsewhere : Lock::none;
  const int again = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  const bool apart = again < 0 || flock(again, LOCK_EX | LOCK_NB) == 0;
  if (again >= 0) close(again);
  return apart ? Lock::held : Lock::none;
}

void let_go(int descriptor) {
  struct flock all {};
  all.l_type = F_UNLCK;
  all.l_whence = SEEK_SET;
  fcntl(descriptor, F_OFD_SETLK, &all);
}

bool is_called(const std::string& name, const std::string& prefix) {
  const std::string end = ".tmp";
  return name.size() == prefix.size() + 6 + end.size() && name.starts_with(prefix) && name.ends_with(end);
}

void remove_if_stray(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return;
  struct stat status {};
  const bool ours = fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid();
  // Under the lock nobody but its holder renames or unlinks it.
  if (ours && lock_of(descriptor, path) == Lock::held && has_name(descriptor, path)) unlink(path.c_str());
  close(descriptor);
}

void remove_strays(const std::string& directory, const std::string& prefix) {
  std::error_code failed;
  std::filesystem::directory_iterator entry(directory, failed);
  for (; !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed))
    if (is_called(entry->path().filename().string(), prefix)) remove_if_stray(entry->path().string());
}

extern "C" void remove_and_die(int signal_number) {
  if (note_signal(signal_number)) return;
  for (Slot* slot = first_slot.load(); slot; slot = slot->next) {
    if (slot->armed) unlink(slot->path.c_str());
  }
  die_of(signal_number);  // blocked until the handler returns, then fatal: the parent sees the signal itself
}

}  // namespace

void remove_temporaries_on_signals() {
  for (const int signal_number : ending_signals) {
    struct sigaction old_action {};
    sigaction(signal_number, nullptr, &old_action);
    if (old_action.sa_handler == SIG_IGN && signal_number != SIGPIPE) continue;
    struct sigaction action {};
    action.sa_handler = remove_and_die;
    action.sa_flags = SA_RESTART;  // a signal that is only noted interrupts no writing
    sigemptyset(&action.sa_mask);
    sigaction(signal_number, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

bool has_name(int descriptor, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::string temporary_directory() {
  const char* directory = std::getenv("TMPDIR");
  return directory && *directory ? directory : "/tmp";
}

std::string cause_of(int error_number) { return std::strerror(error_number); }

void fail_on(const std::string& path, int error_number) { throw Error(path + ": " + cause_of(error_number)); }

Temporary::Temporary(const std::string& directory, const std::string& prefix) {
  remove_strays(directory, prefix);
  const std::string pattern = (directory + '/').append(prefix).append("XXXXXX.tmp");
  while (!create(pattern)) {
  }
}

/// False when somebody has taken it for a stray before it was locked.
bool Temporary::create(const std::string& pattern) {
  path_ = pattern;
  // Signals wait until the name stands where their handler finds it.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  descriptor_ = mkostemps(path_.data(), 4, O_CLOEXEC);
  const int error_number = errno;
  if (descriptor_ >= 0) slot_ = claim_slot(path_);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (descriptor_ < 0) throw Error(cause_of(error_number));
  const Lock lock = lock_of(descriptor_, path_);
  if (lock == Lock::none) let_go(descriptor_);
  if (lock != Lock::elsewhere && has_name(descriptor_, path_)) return true;
  remove();
  return false;
}

Temporary::~Temporary() { remove(); }

void Temporary::remove() {
  if (slot_) unlink(path_.c_str());
  forget();
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
}

void Temporary::rename_to(const std::string& target) {
  const int descriptor = std::exchange(descriptor_, -1);
  if (descriptor >= 0) {
    // Closing says what could not be written. The lock stays with the copy until the name is another.
    descriptor_ = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (close(descriptor) != 0) throw Error(cause_of(errno));
  }
  if (std::rename(path_.c_str(), target.c_str()) != 0) throw Error(cause_of(errno));
  forget();
  if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
}

void Temporary::forget() {
  if (slot_) release_slot(static_cast<Slot*>(slot_));
  slot_ = nullptr;
}

}  // namespace slipwave
