// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace slipwave::plot {

/// Is it the name of a movie: does it end with .mp4 or .gif?
bool names_movie(const std::string& path);
/// "wave-0007.png" for frame 7 of wave.mp4 or wave.png; other endings stay.
std::string frame_path(const std::string& movie, std::size_t number);

/// A movie made by the program ffmpeg of pictures in PNG. It appears whole or not at all. The same frames
/// give the same bytes, whatever ffmpeg's number of threads.
class Movie {
 public:
  struct Settings {
    double frames_per_s = 10;
    std::string title, history;  // kept in the file
  };
  /// Starts ffmpeg; nothing where it is not installed. Throws Error when the path cannot be written.
  static std::unique_ptr<Movie> begin(const std::string& path, const Settings& settings);
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  void add(const std::vector<char>& png);
  /// Throws Error with what ffmpeg said when it failed.
  void finish();

 private:
  struct Impl;
  explicit Movie(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipwave::plot
