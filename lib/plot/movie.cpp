// SPDX-License-Identifier: BSD-3-Clause
#include "plot/movie.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "io/children_heard.hpp"
#include "io/output_file.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): not in every unistd.h

namespace slipwave::plot {
namespace {

/// What ffmpeg is told for an ending.
struct MovieKind {
  const char* ending;
  std::vector<std::string> arguments;
};

const std::vector<MovieKind>& kinds() {
  static const std::vector<MovieKind> all = {
      // Players know 4:2:0 only, which wants even sizes.
      {".mp4",
       {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-crf", "18", "-pix_fmt",
        "yuv420p", "-movflags", "+faststart", "-f", "mp4"}},
      {".gif", {"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-f", "gif"}}};
  return all;
}

const MovieKind* kind_of(const std::string& path) {
  for (const auto& kind : kinds()) {
    const std::size_t length = std::strlen(kind.ending);
    if (path.size() > length && path.compare(path.size() - length, length, kind.ending) == 0) return &kind;
  }
  return nullptr;
}

std::vector<std::string> command(const MovieKind& kind, const Movie::Settings& settings,
                                 const std::string& to) {
  std::vector<std::string> words = {"ffmpeg",     "-nostdin",   "-loglevel",
                                    "error",      "-y",         "-f",
                                    "image2pipe", "-framerate", shown(settings.frames_per_s),
                                    "-c:v",       "png",        "-i",
                                    "pipe:0"};
  words.insert(words.end(), {"-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
  words.insert(words.end(), {"-map_metadata", "-1", "-metadata", "title=" + settings.title, "-metadata",
                             "comment=" + settings.history});
  words.insert(words.end(), kind.arguments.begin(), kind.arguments.end());
  words.push_back("file:" + to);
  return words;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

bool names_movie(const std::string& path) { return kind_of(path) != nullptr; }

std::string frame_path(const std::string& movie, std::size_t number) {
  const auto dot = movie.rfind('.');
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "-%04zu", number);
  return movie.substr(0, dot) + text.data() + (names_movie(movie) ? ".png" : movie.substr(dot));
}

struct Movie::Impl {
  explicit Impl(const std::string& path) : out(path, OutputFile::Content::binary) {}

  ChildrenHeard heard;
  OutputFile out;
  std::unique_ptr<std::FILE, CloseFile> said{std::tmpfile()};  // what ffmpeg has to say
  int to_child = -1;
  pid_t child = -1;

  /// False where there is no such program.
  bool start(std::vector<std::string> words) {
    // A socket, unlike a pipe, can be written to without a signal when the reader is gone.
    std::array<int, 2> ends{};
    if (!said || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw Error(std::string("ffmpeg cannot be started: ") + std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(said.get()), STDERR_FILENO);
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int failed = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    to_child = ends[0];
    if (failed == 0) return true;
    child = -1;
    if (failed == ENOENT || failed == EACCES) return false;
    throw Error(std::string("ffmpeg cannot be started: ") + std::strerror(failed));
  }

  /// Its end; true when all went well.
  bool wait() {
    if (to_child >= 0) close(to_child);
    to_child = -1;
    int status = 0;
    while (child >= 0 && waitpid(child, &status, 0) < 0) {
      if (errno != EINTR) break;
    }
    child = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  std::string first_words() {
    std::rewind(said.get());
    std::array<char, 400> line{};
    if (!std::fgets(line.data(), int(line.size()), said.get())) return "it ended without a word";
    std::string words = line.data();
    while (!words.empty() && (words.back() == '\n' || words.back() == ' ')) words.pop_back();
    return words;
  }
};

Movie::Movie(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Movie::~Movie() { impl_->wait(); }

std::unique_ptr<Movie> Movie::begin(const std::string& path, const Settings& settings) {
  auto impl = std::make_unique<Impl>(path);
  if (!impl->start(command(*kind_of(path), settings, impl->out.path_for_libraries()))) return nullptr;
  return std::unique_ptr<Movie>(new Movie(std::move(impl)));
}

void Movie::add(const std::vector<char>& png) {
  for (std::size_t sent = 0; sent < png.size();) {
    const auto count = send(impl_->to_child, png.data() + sent, png.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      impl_->wait();
      throw Error(impl_->out.shown_name() + ": ffmpeg failed: " + impl_->first_words());
    }
    sent += std::size_t(count);
  }
}

void Movie::finish() {
  if (!impl_->wait()) throw Error(impl_->out.shown_name() + ": ffmpeg failed: " + impl_->first_words());
  impl_->out.commit();
}

}  // namespace slipwave::plot
