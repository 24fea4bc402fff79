// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_file.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <netcdf.h>
#include <netcdf_mem.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>

#include "base/error.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "io/netcdf_impl.hpp"
#include "io/netcdf_probe.hpp"
#include "io/temporary.hpp"

namespace slipwave {
namespace {

/// HDF5 flushes what is open when the process exits, and crashes there after a write that failed. Our files
/// are closed before, so it need not; this must come before the library's first use. (The netCDF library
/// brings HDF5 along without offering this call.)
void keep_hdf5_from_exit_handlers() {
  using Function = int (*)();
  if (const auto function = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, "H5dont_atexit"))) function();
}

/// To be called before every file is opened. Throws std::bad_alloc where there is no room for one.
void prepare_library() {
  static const bool done = (keep_hdf5_from_exit_handlers(), true);
  (void)done;
  // HDF5 does not check whether it got the memory for a file's tables, a few MiB: without it, it crashes.
  constexpr std::size_t room = std::size_t(16) << 20;
  ::operator delete(::operator new(room));
}

}  // namespace

void NetcdfFile::Impl::fail(const std::string& variable, const std::string& sentence) const {
  throw Error(shown_name + ": " + (variable.empty() ? "" : variable + ": ") + sentence);
}

void NetcdfFile::Impl::check(int status, const std::string& variable) const {
  if (status == NC_NOERR) return;
  failed = true;
  const int system_cause = errno;
  if (status > 0 || status == NC_EHDFERR) {
    // HDF5 keeps the cause to itself, but leaves what the system said.
    for (const int cause : {ENOSPC, EDQUOT, EFBIG, EIO, EROFS, ENOMEM}) {
      if (system_cause == cause) fail("", cause_of(cause));
    }
  }
  if (status > 0) fail("", cause_of(status));
  if (status == NC_EHDFERR) fail(variable, "damaged: the HDF5 library cannot read or write it");
  if (status == NC_ENOTNC) fail(variable, "is not a netCDF file");
  std::string text = nc_strerror(status);
  const std::string prefix = "NetCDF: ";
  if (text.compare(0, prefix.size(), prefix) == 0) text.erase(0, prefix.size());
  fail(variable, text);
}

int NetcdfFile::Impl::variable_id(const std::string& name) const {
  if (name.empty()) return NC_GLOBAL;
  int variable = 0;
  if (nc_inq_varid(id, name.c_str(), &variable) != NC_NOERR) {
    throw Error(shown_name + ": found no variable '" + name + "'");
  }
  return variable;
}

void NetcdfFile::Impl::check_size(const std::string& variable, const std::vector<std::size_t>& shape,
                                  std::size_t width) const {
  // deflate reaches 1032 : 1 at most; the rest is room for values that were never written.
  const double most = 1100.0 * double(file_bytes) + double(std::size_t(16) << 20);
  double bytes = double(width);
  for (const auto length : shape) bytes *= double(length);
  if (bytes > most) {
    fail(variable, "found a size of " + shown(bytes) + " bytes in a file of " + std::to_string(file_bytes) +
                       ", which cannot hold as many");
  }
}

NetcdfFile::NetcdfFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
NetcdfFile::NetcdfFile(NetcdfFile&&) noexcept = default;
NetcdfFile& NetcdfFile::operator=(NetcdfFile&&) noexcept = default;
NetcdfFile::~NetcdfFile() = default;

NetcdfFile NetcdfFile::create(const std::string& path, const std::string& shown_name) {
  auto impl = std::make_unique<Impl>();
  impl->shown_name = shown_name;
  impl->written_path = path;
  prepare_library();
  errno = 0;
  const int status = nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &impl->id);
  // The library calls a directory that is gone "Permission denied".
  if (status != NC_NOERR && access(path.c_str(), W_OK) != 0) impl->fail("", cause_of(errno));
  impl->check(status);
  return NetcdfFile(std::move(impl));
}

NetcdfFile NetcdfFile::open(const std::string& path) {
  if (!is_regular_input(path)) return open(read_all(path), shown_input(path));
  auto impl = std::make_unique<Impl>();
  impl->shown_name = path;
  {
    const InputFile file(path);
    impl->file_bytes = file.size();
    const auto read_at = [&](std::uint64_t offset, void* to, std::size_t count) {
      return file.read_at(offset, to, count);
    };
    const bool classic = in_place(path, [&] {
      check_not_truncated(read_at, impl->file_bytes);
      std::array<char, 3> first{};
      return file.read_at(0, first.data(), first.size()) && first == std::array{'C', 'D', 'F'};
    });
    // The library takes what a short read of a classic file leaves out for zeros; ours reads on.
    if (classic) return open(read_all(path), path);
  }
  impl->open_probed([&path](int& id) { return nc_open(path.c_str(), NC_NOWRITE, &id); });
  return NetcdfFile(std::move(impl));
}

NetcdfFile NetcdfFile::open(std::vector<char> bytes, const std::string& shown_name) {
  auto impl = std::make_unique<Impl>();
  impl->shown_name = shown_name;
  impl->bytes = std::move(bytes);
  impl->file_bytes = impl->bytes.size();
  const auto& kept = impl->bytes;
  in_place(shown_name, [&] {
    const auto read_at = [&](std::uint64_t offset, void* to, std::size_t count) {
      if (count > kept.size() || offset > kept.size() - count) return false;
      std::memcpy(to, kept.data() + offset, count);
      return true;
    };
    check_not_truncated(read_at, impl->file_bytes);
  });
  // LOCKED: the library neither frees nor enlarges our bytes.
  NC_memio memory{impl->bytes.size(), impl->bytes.data(), NC_MEMIO_LOCKED};
  impl->open_probed([&memory](int& id) { return nc_open_memio("memory", NC_NOWRITE, &memory, &id); });
  return NetcdfFile(std::move(impl));
}

void NetcdfFile::Impl::open_probed(const std::function<int(int&)>& open) {
  prepare_library();
  in_place(shown_name, [&] {
    probe_netcdf([&] {
      int file = -1;
      return open(file) == NC_NOERR ? file : -1;
    });
  });
  errno = 0;
  check(open(id));
}

void NetcdfFile::Impl::settle() const {
  errno = 0;
  check(nc_sync(id));
  // Network file systems and quotas report at the first close what did not fit. All that is left to closing
  // is a flag in the first bytes, so the first of them is written once more.
  const int descriptor = ::open(written_path.c_str(), O_RDWR | O_CLOEXEC);
  char first = 0;
  const auto moves = [](auto&& call) {
    ssize_t count = 0;
    do count = call();
    while (count < 0 && errno == EINTR);
    return count == 1;
  };
  const bool rewritten = descriptor >= 0 && moves([&] { return pread(descriptor, &first, 1, 0); }) &&
                         moves([&] { return pwrite(descriptor, &first, 1, 0); });
  int error_number = rewritten ? 0 : errno;
  if (descriptor >= 0 && ::close(descriptor) != 0) error_number = errno;
  if (error_number == 0) return;
  failed = true;
  fail("", cause_of(error_number));
}

void NetcdfFile::close() {
  if (impl_->id >= 0 && !impl_->written_path.empty()) impl_->settle();
  const int id = impl_->id;
  impl_->id = -1;
  errno = 0;
  if (id >= 0) impl_->check(nc_close(id));
}

void NetcdfFile::flush() {
  errno = 0;
  impl_->check(nc_sync(impl_->id));
}

const std::string& NetcdfFile::shown_name() const { return impl_->shown_name; }

}  // namespace slipwave
