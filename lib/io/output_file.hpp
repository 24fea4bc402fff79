// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace slipwave {

/// An output that appears whole or not at all.
/// For a path: a private temporary beside it, renamed over it by commit(); the destructor without commit
/// removes the temporary and leaves an older file of that name untouched. Ended by a signal (INT, TERM, HUP,
/// QUIT, PIPE, ...): the temporary is removed too; by KILL: by the next OutputFile of that path. A path that
/// exists and is no regular file (/dev/null, a fifo) is written in place. For "-": streams to stdout; binary
/// to a terminal is refused. Every failed write throws Error naming file and cause ("gather.sgy: No space
/// left on device").
class OutputFile {
 public:
  enum class Content { binary, text };
  OutputFile(const std::string& path, Content content);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(const void* bytes, std::size_t count);
  /// The temporary's path, for libraries that open files by name (netCDF). For "-" a private temporary in
  /// $TMPDIR (or /tmp) that commit() copies to stdout. Do not mix with write().
  const std::string& path_for_libraries();
  /// Flush, fsync-free close, rename. Throws when anything failed.
  void commit();
  /// Commits under another name, of the same directory; what is written in place or streamed stays there.
  void commit_as(const std::string& path);
  /// "gather.sgy" or "standard output": as messages name it.
  const std::string& shown_name() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Throws a usage Error when `output` is the same file as one of `inputs`, by whatever name: for tools whose
/// output is of another kind, where that is a slip and would cost the input. "-" and "" are no files.
void expect_other_files(const std::string& output, const std::vector<std::string>& inputs);

/// Installs the handlers that remove the temporaries of all living OutputFiles when INT, TERM, HUP, QUIT,
/// PIPE, or another signal from outside ends the process; the process then dies of that signal, so the shell
/// sees 128 + N. A signal that was ignored at start stays ignored (nohup), PIPE excepted: a closed pipe
/// always ends the process quietly. XFSZ is ignored, so a file-size limit becomes an Error of write(). Call
/// once, from main.
void remove_temporaries_on_signals();

}  // namespace slipwave
