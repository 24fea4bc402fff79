// SPDX-License-Identifier: BSD-3-Clause
#include "shell.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace {

const std::string await =
    "() { local n; for ((n = 0; n < 3000; ++n)); do eval \"$1\" && return; sleep 0.01; done; "
    "echo \"waited in vain for: $1\" >&2; return 1; }";
const std::string next_second = "() { local then=$(date +%s); await \"[ \\$(date +%s) -gt $then ]\"; }";

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string fresh_directory() {
  std::string name = fs::temp_directory_path().string() + "/slipwave-cli-XXXXXX";
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary directory");
  return name;
}

}  // namespace

Shell::Shell() : directory_(fresh_directory()) {
  fs::create_directory(directory_ + "/work");
  directory_ += "/work";
}

Shell::~Shell() {
  std::error_code ignored;
  fs::remove_all(fs::path(directory_).parent_path(), ignored);
}

std::string Shell::on_ranks(int count) {
  const std::string launcher = SLIPWAVE_MPIRUN;
  if (launcher.empty()) return {};
  // Where a process fails, Open MPI would give the others a second to end by themselves.
  return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
         "OMPI_MCA_odls_base_sigkill_timeout=0 " +
         launcher + " -n " + std::to_string(count) + ' ';
}

Ran Shell::run(const std::string& line) const {
  const std::string beside = fs::path(directory_).parent_path().string();
  const std::string out = beside + "/stdout", err = beside + "/stderr";
  const pid_t child = fork();
  if (child == 0) {
    const int in_fd = open("/dev/null", O_RDONLY);
    const int out_fd = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err_fd = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(in_fd, 0);
    dup2(out_fd, 1);
    dup2(err_fd, 2);
    if (chdir(directory_.c_str()) != 0) _exit(126);
    const std::string path =
        std::string(SLIPWAVE_BIN) + ":" + (getenv("PATH") ? getenv("PATH") : "/usr/bin:/bin");
    setenv("PATH", path.c_str(), 1);
    setenv("TMPDIR", beside.c_str(), 1);
    setenv("LC_ALL", "C", 1);
    // The way bash hands functions to the bash it starts.
    setenv("BASH_FUNC_await%%", await.c_str(), 1);
    setenv("BASH_FUNC_next_second%%", next_second.c_str(), 1);
    execlp("bash", "bash", "-o", "pipefail", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  Ran ran;
  ran.peak_mib = double(usage.ru_maxrss) / 1024;
  ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ran.out = content_of(out);
  ran.err = content_of(err);
  return ran;
}

std::string Shell::done(const std::string& line) const {
  const Ran ran = run(line);
  EXPECT_EQ(ran.code, 0) << line;
  EXPECT_EQ(ran.err, "") << line;
  return ran.out;
}

void Shell::expect_refused(const std::string& line, int code, const std::string& message) const {
  const Ran ran = run(line);
  EXPECT_EQ(ran.code, code) << line;
  EXPECT_EQ(ran.err, message + "\n") << line;
  EXPECT_EQ(ran.out, "") << line;
}

bool Shell::exists(const std::string& name) const { return fs::exists(path(name)); }

std::string Shell::content(const std::string& name) const { return content_of(path(name)); }

void Shell::write(const std::string& name, const std::string& content) const {
  std::ofstream(path(name), std::ios::binary) << content;
}

std::string Shell::files() const {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory_)) names.insert(entry.path().filename().string());
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}
