// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_probe.hpp"

#include <fcntl.h>
#include <netcdf.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <functional>
#include <numeric>
#include <vector>

#include "base/error.hpp"
#include "io/children_heard.hpp"

namespace slipwave {
namespace {

constexpr double most_bytes = double(1 << 24);
constexpr double most_piece_bytes = double(1 << 26);
constexpr std::size_t most_attribute_bytes = std::size_t(1) << 24;

void look_at_attributes(int file, int variable, int count) {
  for (int number = 0; number < count; ++number) {
    std::array<char, NC_MAX_NAME + 1> name{};
    nc_type type = 0;
    std::size_t length = 0, width = 0;
    if (nc_inq_attname(file, variable, number, name.data()) != NC_NOERR) continue;
    if (nc_inq_att(file, variable, name.data(), &type, &length) != NC_NOERR) continue;
    if (nc_inq_type(file, type, nullptr, &width) != NC_NOERR || width == 0) continue;
    if (length > most_attribute_bytes / width) continue;  // refused by those who read it
    std::vector<char> value(std::max(length * width, std::size_t(1)));
    if (nc_get_att(file, variable, name.data(), value.data()) != NC_NOERR || type != NC_STRING) continue;
    nc_free_string(length, reinterpret_cast<char**>(value.data()));
  }
}

/// Bytes of the pieces a variable is stored in, which the library reads whole.
double piece_bytes(int file, int variable, std::size_t width, std::size_t rank) {
  std::vector<std::size_t> cells(std::max(rank, std::size_t(1)), 1);
  int storage = NC_CONTIGUOUS;
  if (nc_inq_var_chunking(file, variable, &storage, cells.data()) != NC_NOERR) return 0;
  if (storage != NC_CHUNKED) return 0;
  return std::accumulate(cells.begin(), cells.end(), double(width), std::multiplies<double>());
}

/// All values where they are few, else the last one: it needs the index of the pieces.
void look_at_values(int file, int variable, nc_type type, const std::vector<int>& dimensions) {
  std::size_t width = 0;
  if (nc_inq_type(file, type, nullptr, &width) != NC_NOERR || width == 0) return;
  if (piece_bytes(file, variable, width, dimensions.size()) > most_piece_bytes) return;
  std::vector<std::size_t> start(dimensions.size(), 0), count;
  double values = 1;
  for (const int dimension : dimensions) {
    std::size_t length = 0;
    if (nc_inq_dimlen(file, dimension, &length) != NC_NOERR || length == 0) return;
    count.push_back(length);
    values *= double(length);
  }
  if (values * double(width) > most_bytes) {
    for (std::size_t axis = 0; axis < count.size(); ++axis) start[axis] = count[axis] - 1, count[axis] = 1;
    values = 1;
  }
  std::vector<char> into(std::size_t(values) * width);
  if (nc_get_vara(file, variable, start.data(), count.data(), into.data()) != NC_NOERR || type != NC_STRING)
    return;
  nc_free_string(std::size_t(values), reinterpret_cast<char**>(into.data()));
}

void look_through(int file) {
  int variables = 0, attributes = 0;
  if (nc_inq(file, nullptr, &variables, &attributes, nullptr) != NC_NOERR) return;
  look_at_attributes(file, NC_GLOBAL, attributes);
  for (int variable = 0; variable < variables; ++variable) {
    nc_type type = 0;
    int rank = 0, count = 0;
    if (nc_inq_var(file, variable, nullptr, &type, &rank, nullptr, &count) != NC_NOERR) continue;
    std::vector<int> dimensions(std::size_t(rank), 0);
    if (nc_inq_vardimid(file, variable, dimensions.data()) != NC_NOERR) continue;
    look_at_attributes(file, variable, count);
    look_at_values(file, variable, type, dimensions);
  }
}

/// Bytes of address space that are in use, 0 where the system does not tell.
rlim_t bytes_in_use() {
  std::ifstream pages("/proc/self/statm");
  rlim_t count = 0;
  pages >> count;
  return count * rlim_t(sysconf(_SC_PAGESIZE));
}

void limit(decltype(RLIMIT_CPU) what, rlim_t most) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return;
  now.rlim_cur = std::min(now.rlim_cur, most);
  setrlimit(what, &now);
}

/// Signals do here what they do by default: the handlers would remove the parent's temporaries.
[[noreturn]] void be_the_child(const std::function<int()>& open_file, const ProbeLimits& limits) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGXCPU})
    std::signal(number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  try {
    limit(RLIMIT_CPU, limits.processor_s);
    limit(RLIMIT_CORE, 0);
    if (const rlim_t used = bytes_in_use(); used > 0) limit(RLIMIT_AS, used + limits.bytes);
    const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    if (const int file = open_file(); file >= 0) look_through(file);
  } catch (...) {  // too little memory: the parent finds out by itself
  }
  _exit(0);
}

}  // namespace

void probe_netcdf(const std::function<int()>& open_file, const ProbeLimits& limits) {
  const ChildrenHeard heard;
  const pid_t child = fork();
  if (child < 0) return;  // no room for a second process: then without
  if (child == 0) be_the_child(open_file, limits);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return;
  }
  // KILL comes from outside.
  if (WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL)
    throw Error("damaged: the HDF5 library cannot read it");
}

}  // namespace slipwave
