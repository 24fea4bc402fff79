#include "base/netcdf_probe.hpp"

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
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/error.hpp"

namespace slipwave {
namespace {

// Far more than reading what is below takes, on any machine.
constexpr rlim_t most_seconds = 20;
constexpr double most_values = double(1 << 24);
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

/// All values where they are few, else the last one: it needs the index of the pieces.
void look_at_values(int file, int variable, nc_type type, const std::vector<int>& dimensions) {
  std::size_t width = 0;
  if (nc_inq_type(file, type, nullptr, &width) != NC_NOERR || width == 0) return;
  std::vector<std::size_t> start(dimensions.size(), 0), count;
  double values = 1;
  for (const int dimension : dimensions) {
    std::size_t length = 0;
    if (nc_inq_dimlen(file, dimension, &length) != NC_NOERR || length == 0) return;
    count.push_back(length);
    values *= double(length);
  }
  if (values * double(width) > most_values) {
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

/// Signals do here what they do by default: the handlers would remove the parent's temporaries.
[[noreturn]] void be_the_child(const std::function<int()>& open_file) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGXCPU})
    std::signal(number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit seconds{most_seconds, most_seconds + 1}, no_core{0, 0};
  setrlimit(RLIMIT_CPU, &seconds);
  setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  try {
    if (const int file = open_file(); file >= 0) look_through(file);
  } catch (...) {  // too little memory: the parent finds out by itself
  }
  _exit(0);
}

}  // namespace

void probe_netcdf(const std::function<int()>& open_file) {
  const pid_t child = fork();
  if (child < 0) return;  // no room for a second process: then without
  if (child == 0) be_the_child(open_file);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return;
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL)
    throw Error("damaged: the HDF5 library cannot read it");
}

}  // namespace slipwave
