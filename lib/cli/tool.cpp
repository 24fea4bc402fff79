// SPDX-License-Identifier: BSD-3-Clause
#include "cli/tool.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <mutex>
#include <new>

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "cli/parser.hpp"
#include "cli/progress_bar.hpp"
#include "cli/version.hpp"
#include "io/output_file.hpp"
#include "parallel/threads.hpp"

namespace slipwave::cli {
namespace {

/// One line, whatever the sentence holds: a file name may contain a line break.
void say(const std::string& tool, const std::string& sentence) {
  const char* clear = isatty(STDERR_FILENO) ? "\r\033[K" : "";  // a progress bar may stand there
  std::fprintf(stderr, "%s%s: %s\n", clear, tool.c_str(), printable(sentence).c_str());
  leave_line_open(false);
}

/// The largest part of memory that this process has taken, bytes.
double peak_memory() {
  struct rusage used {};
  getrusage(RUSAGE_SELF, &used);
  return 1024 * double(used.ru_maxrss);
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A stream that the parent closed would be the number of the next file opened: messages would go into an
/// output. Put in its place is one that refuses what the tool wants of it.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    const int opened = open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    if (opened >= 0 && opened != stream) close(opened);  // cannot be: the lowest free number is taken
  }
}

void print(const std::string& text) {
  OutputFile out("-", OutputFile::Content::text);
  out.write(text.data(), text.size());
  out.commit();
}

}  // namespace

struct Log::Impl {
  std::FILE* file = nullptr;
  std::string first;
  std::mutex one_at_a_time;

  void line(const std::string& sentence) const {
    const std::time_t now = std::time(nullptr);
    std::array<char, 32> time{};
    struct tm local {};
    std::strftime(time.data(), time.size(), "%Y-%m-%d %H:%M:%S", localtime_r(&now, &local));
    std::fprintf(file, "%s %s\n", time.data(), printable(sentence).c_str());
    std::fflush(file);  // a run that is killed has said so much
  }
};

Log::Log(const std::string& path, std::string first) : impl_(std::make_unique<Impl>()) {
  impl_->file = std::fopen(path.c_str(), "ae");
  if (!impl_->file) throw Error("--log: " + path + ": " + std::strerror(errno));
  impl_->first = std::move(first);
}

Log::~Log() { std::fclose(impl_->file); }

void Log::write(const std::string& sentence) {
  const std::lock_guard lock(impl_->one_at_a_time);
  if (!impl_->first.empty()) impl_->line(impl_->first);
  impl_->first.clear();
  impl_->line(sentence);
}

void Context::warn(const std::string& sentence) const { say("warning: " + sentence); }

void Context::say(const std::string& sentence) const {
  if (!quiet) cli::say(tool, sentence);
  if (log) log->write(sentence);
}

void Context::note(const std::string& sentence) const {
  if (verbose && !quiet) cli::say(tool, sentence);
  if (log) log->write(sentence);
}

void Context::close(const std::function<std::string()>& sentence) const {
  const bool watched = !quiet && (verbose || isatty(STDERR_FILENO));
  if (!watched && !log) return;
  const double seconds = seconds_since(began);
  const std::string line = sentence() + duration_in_words(seconds) + ", " + bytes_in_words(peak_memory());
  if (watched) cli::say(tool, line);
  if (log) log->write(line);
}

Messages Context::messages() const {
  return {[own = *this](const std::string& sentence) { own.say(sentence); },
          [own = *this](const std::string& sentence) { own.warn(sentence); },
          [own = *this](const std::function<std::string()>& sentence) { own.close(sentence); },
          [own = *this](const std::string& what, const std::string& things) {
            return own.progress(what, things);
          },
          !quiet || log};
}

void say_error(const std::string& tool, const std::string& sentence) { cli::say(tool, sentence); }

int run_tool(int argc, char** argv, const ToolInfo& info, const std::function<void(Options&)>& declare,
             const std::function<void(const Context&)>& run) {
  occupy_closed_streams();
  remove_temporaries_on_signals();
  const std::string version = std::string("slipwave ") + cli::version();
  std::unique_ptr<Log> log;
  const auto fail = [&](const std::string& sentence) {
    say(info.name, sentence);
    if (log) log->write(sentence);
  };
  try {
    Parser parser(info);
    declare(parser.options());
    parser.declare_common();
    parser.parse(argc, argv);
    if (parser.common().help || parser.common().help_all) {
      print(parser.help());
      return 0;
    }
    if (parser.common().version) {
      print(info.name + " (" + version + ")\n");
      return 0;
    }
    const ThreadLimit limit(parser.common().threads);
    if (!parser.common().log.empty())
      log = std::make_unique<Log>(parser.common().log, parser.command_line() + " (" + version + ")");
    Context context;
    context.command_line = parser.command_line();
    context.tool = info.name;
    context.version = version;
    context.quiet = parser.common().quiet;
    context.verbose = parser.common().verbose;
    context.threads = parser.common().threads;
    context.log = log.get();
    run(context);
    return 0;
  } catch (const Error& error) {
    fail(error.what());
    return int(error.kind());
  } catch (const EndSilently& end) {
    return end.status;
  } catch (const Interrupted& interrupted) {
    die_of(interrupted.signal_number);
    return 128 + interrupted.signal_number;
  } catch (const std::bad_alloc&) {
    fail("out of memory");
    return 1;
  } catch (const std::exception& error) {
    fail(error.what());
    return 1;
  }
}

}  // namespace slipwave::cli
