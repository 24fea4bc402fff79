#pragma once

#include <cstdio>
#include <string>

namespace slipwave {

/// An output that appears whole or not at all.
/// For a path: a private temporary beside it, renamed over it by commit(); the destructor without commit
/// removes the temporary and leaves an older file of that name untouched. Ended by a signal (INT, TERM, HUP,
/// PIPE): the temporary is removed too. A path that exists and is no regular file (/dev/null, a fifo) is written in place.
/// For "-": streams to stdout; binary to a terminal is refused.
/// Every failed write throws Error naming file and cause ("gather.sgy: No space left on device").
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
  /// "gather.sgy" or "standard output": as messages name it.
  const std::string& shown_name() const;
};

}  // namespace slipwave
