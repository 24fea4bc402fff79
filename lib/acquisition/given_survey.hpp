// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "acquisition/place.hpp"
#include "acquisition/wavelet.hpp"

namespace slipwave {

/// How places on a map lie to the model's axes: from the origin, the model's x axis runs along the azimuth
/// (degrees clockwise from the map's y axis, north; 90 is along its x axis), the y axis a quarter turn
/// counter-clockwise of it. A model in 2-D is a section: what lies beside it is moved onto it.
struct MapFrame {
  std::array<double, 2> origin_m{};
  double azimuth_deg = 90;
  bool is_identity() const { return origin_m == std::array<double, 2>{} && azimuth_deg == 90; }
  /// Along the model's x and y axes.
  std::array<double, 2> model_m(double map_x, double map_y) const;
};

/// A source as it was given; what is left out is as the options say.
struct GivenSource {
  Place place;
  std::string kind, wavelet;          // empty: left out
  std::optional<Wavelet> recorded{};  // instead of `wavelet`: the samples of a trace
  std::optional<double> amplitude;
  double factor = 1;  // on the amplitude
  double delay_s = 0;
  std::string from;  // where it was given: "shots.csv: line 3"; empty: an option
};

/// Receivers that follow each other among the places of a survey and have channels in equal steps.
struct ReceiverRun {
  std::uint32_t first_place = 0, count = 0;
  std::int32_t channel = 1, channel_step = 1;
  std::int64_t first_bin = -1;  // among the bins of the survey; -1: not given
};

struct GivenShot {
  std::int64_t number = 0;           // of the field record
  std::vector<GivenSource> sources;  // those after the first are blended with it
  std::size_t first_run = 0, last_run = 0;
};

/// A survey as it was given by options, tables or files. Receivers that several shots have are held once.
struct GivenSurvey {
  std::vector<GivenShot> shots;
  std::vector<Place> places;  // of receivers
  std::vector<ReceiverRun> runs;
  std::vector<std::int32_t> bins;  // midpoint bins (cdp) of traces
  MapFrame frame;
  double rounding_m = 0;    // depths are known so far: what is nearer to ground or sea floor lies on it
  bool numbered = false;    // shots have numbers of their own
  bool distinct = true;     // and no two have the same
  bool told_apart = false;  // shots have receivers of their own
  bool in_files = false;    // any of it comes from a table or another file
  bool from_map = false;    // of a file that knows nothing of the model
  std::string doubt;        // what may be wrong with its coordinates; empty: nothing

  std::span<const ReceiverRun> runs_of(std::size_t shot) const {
    return {runs.data() + shots[shot].first_run, shots[shot].last_run - shots[shot].first_run};
  }
};

/// The frame in which a survey on a map begins at the origin of a model and runs along its x axis: by the
/// line that fits its places best; of a model in 3-D from their lowest coordinates, unturned.
MapFrame fitting_frame(const GivenSurvey& survey, int dimension);

/// Puts the receivers of one shot after the other into a survey.
class ReceiverCollector {
 public:
  explicit ReceiverCollector(GivenSurvey& survey) : survey_(survey) {}
  /// Receivers that are added now belong to that shot.
  void begin(std::size_t shot);
  void add(const Place& place, std::int64_t channel, std::optional<std::int64_t> bin = {});
  /// Places that are there already.
  void add(const ReceiverRun& run);
  void end();
  /// Number of a place that is held, added where it is not.
  std::uint32_t place_of(const Place& place);

 private:
  struct Hash {
    std::size_t operator()(const Place& place) const;
  };
  bool continues(std::uint32_t place, std::int64_t channel, bool with_bin) const;

  GivenSurvey& survey_;
  std::size_t shot_ = 0;
  std::unordered_map<Place, std::uint32_t, Hash> numbers_;
};

/// Sets numbered and distinct by the numbers of the shots; all of them 0: not numbered.
void settle_numbers(GivenSurvey& survey);

}  // namespace slipwave
