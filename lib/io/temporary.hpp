// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace slipwave {

/// A private file (mode 0600) of a name nobody else has, unlinked by the destructor unless renamed before,
/// and by the signals of remove_temporaries_on_signals(). One that a process left which was killed is
/// unlinked by the next of its directory and prefix: who lives holds a lock on his.
class Temporary {
 public:
  /// Creates `directory`/`prefix`XXXXXX.tmp, open for reading and writing. Throws Error with the bare cause
  /// ("Permission denied").
  Temporary(const std::string& directory, const std::string& prefix);
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary();

  const std::string& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  /// Closes the file and renames it over `target`. Throws Error with the bare cause.
  void rename_to(const std::string& target);

 private:
  bool create(const std::string& pattern);
  void remove();
  void forget();

  std::string path_;
  int descriptor_ = -1;
  void* slot_ = nullptr;
};

/// Whether an open file is still the one of that name.
bool has_name(int descriptor, const std::string& path);

/// $TMPDIR, or /tmp.
std::string temporary_directory();

/// What errno says, as a sentence part: "No space left on device".
std::string cause_of(int error_number);
/// Throws an Error that says so of a file.
[[noreturn]] void fail_on(const std::string& path, int error_number);

}  // namespace slipwave
