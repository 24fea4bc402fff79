#include "base/temporary.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/output_file.hpp"

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

extern "C" void remove_and_die(int signal_number) {
  if (note_signal(signal_number)) return;
  for (Slot* slot = first_slot.load(); slot; slot = slot->next) {
    if (slot->armed) unlink(slot->path.c_str());
  }
  die_of(signal_number);  // blocked until the handler returns, then fatal: the parent sees the signal itself
}

}  // namespace

void remove_temporaries_on_signals() {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
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

std::string temporary_directory() {
  const char* directory = std::getenv("TMPDIR");
  return directory && *directory ? directory : "/tmp";
}

std::string cause_of(int error_number) { return std::strerror(error_number); }

Temporary::Temporary(const std::string& directory, const std::string& prefix) {
  path_ = directory + '/' + prefix + "XXXXXX.tmp";
  // Signals wait until the name stands where their handler finds it.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  descriptor_ = mkostemps(path_.data(), 4, O_CLOEXEC);
  const int error_number = errno;
  if (descriptor_ >= 0) slot_ = claim_slot(path_);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (descriptor_ < 0) throw Error(cause_of(error_number));
}

Temporary::~Temporary() {
  if (descriptor_ >= 0) close(descriptor_);
  if (slot_) unlink(path_.c_str());
  forget();
}

void remove_strays(const std::string& path) {
  const std::filesystem::path at(path);
  const std::string begin = '.' + at.filename().string() + '.', end = ".tmp";
  std::error_code failed;
  for (const auto& entry :
       std::filesystem::directory_iterator(at.has_parent_path() ? at.parent_path() : ".", failed)) {
    const auto name = entry.path().filename().string();
    if (name.size() == begin.size() + 6 + end.size() && name.compare(0, begin.size(), begin) == 0 &&
        name.compare(begin.size() + 6, end.size(), end) == 0)
      unlink(entry.path().c_str());
  }
}

void Temporary::rename_to(const std::string& target) {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (descriptor >= 0 && close(descriptor) != 0) throw Error(cause_of(errno));
  if (std::rename(path_.c_str(), target.c_str()) != 0) throw Error(cause_of(errno));
  forget();
}

void Temporary::forget() {
  if (slot_) release_slot(static_cast<Slot*>(slot_));
  slot_ = nullptr;
}

}  // namespace slipwave
