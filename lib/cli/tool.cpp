// SPDX-License-Identifier: BSD-3-Clause
#include "cli/tool.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <new>

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "cli/parser.hpp"
#include "cli/version.hpp"
#include "io/output_file.hpp"
#include "parallel/threads.hpp"

namespace slipwave::cli {
namespace {

/// One line, whatever the sentence holds: a file name may contain a line break.
void say(const std::string& tool, const std::string& sentence) {
  const char* clear = isatty(STDERR_FILENO) ? "\r\033[K" : "";  // a progress bar may stand there
  std::fprintf(stderr, "%s%s: %s\n", clear, tool.c_str(), printable(sentence).c_str());
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

void Context::warn(const std::string& sentence) const {
  if (!quiet) cli::say(tool, "warning: " + sentence);
}

void Context::say(const std::string& sentence) const {
  if (!quiet) cli::say(tool, sentence);
}

void Context::note(const std::string& sentence) const {
  if (verbose && !quiet) cli::say(tool, sentence);
}

Messages Context::messages() const {
  return {[own = *this](const std::string& sentence) { own.say(sentence); },
          [own = *this](const std::string& sentence) { own.warn(sentence); },
          [own = *this](const std::string& what) { return own.progress(what); }};
}

void say_error(const std::string& tool, const std::string& sentence) { cli::say(tool, sentence); }

int run_tool(int argc, char** argv, const ToolInfo& info, const std::function<void(Options&)>& declare,
             const std::function<void(const Context&)>& run) {
  occupy_closed_streams();
  remove_temporaries_on_signals();
  const std::string version = std::string("slipwave ") + cli::version();
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
    Context context;
    context.command_line = parser.command_line();
    context.tool = info.name;
    context.version = version;
    context.quiet = parser.common().quiet;
    context.verbose = parser.common().verbose;
    context.threads = parser.common().threads;
    run(context);
    return 0;
  } catch (const Error& error) {
    say(info.name, error.what());
    return int(error.kind());
  } catch (const EndSilently& end) {
    return end.status;
  } catch (const Interrupted& interrupted) {
    die_of(interrupted.signal_number);
    return 128 + interrupted.signal_number;
  } catch (const std::bad_alloc&) {
    say(info.name, "out of memory");
    return 1;
  } catch (const std::exception& error) {
    say(info.name, error.what());
    return 1;
  }
}

}  // namespace slipwave::cli
