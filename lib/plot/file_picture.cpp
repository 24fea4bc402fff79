// SPDX-License-Identifier: BSD-3-Clause
#include "plot/file_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "accuracy/table.hpp"
#include "base/error.hpp"
#include "grid/grid_netcdf.hpp"
#include "grid/true_depth.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_netcdf.hpp"
#include "plot/error_picture.hpp"
#include "plot/input_file.hpp"
#include "plot/model_picture.hpp"
#include "plot/movie.hpp"
#include "plot/rock_picture.hpp"
#include "plot/snapshot_file.hpp"
#include "plot/snapshot_picture.hpp"
#include "plot/spectrum_picture.hpp"
#include "plot/three_slices.hpp"
#include "segy/reader.hpp"

namespace slipwave::plot {
namespace {

using Kind = InputFile::Kind;

SurveyMarks survey_of(const PlotOptions& options, int axis) {
  if (options.survey.empty()) return {};
  segy::Reader reader(options.survey, options.traces.read_options());
  return read_survey(reader, axis);
}

/// "fine" for "run/fine.sgy".
std::string name_beside_others(const std::string& path) {
  if (path == "-") return "standard input";
  return std::filesystem::path(path).stem().string();
}

Picture gather_picture(std::vector<InputFile>& inputs, const PlotOptions& options, const Page& page) {
  std::vector<NamedGather> gathers;
  std::vector<std::string> doubts;
  std::string text;
  TraceChoice choice{options.of};
  if (options.shot) choice.shot = std::int64_t(*options.shot);
  for (auto& input : inputs) {
    segy::Reader reader(input.path, options.traces.read_options(), {input.taken.begin(), input.taken.end()});
    auto sections = read_sections(reader, choice);
    for (auto& doubt : reader.doubts()) doubts.push_back(std::move(doubt));
    if (gathers.empty()) {  // of the others, too
      choice.of = {};
      for (const auto& section : sections) choice.of.components.push_back(section.component);
    }
    for (auto& section : sections) gathers.push_back({name_beside_others(input.path), std::move(section)});
    if (reader.header().su) continue;
    for (const auto& line : segy::shown_lines(reader.header().text)) text += line + "\n";
  }
  auto style = options.gather;
  style.overlay = options.overlay;
  auto picture = draw_gathers(std::move(gathers), style, options.look, with_history(page, text));
  picture.notes.insert(picture.notes.end(), doubts.begin(), doubts.end());
  return picture;
}

/// Returns the spectra of a choice. Throws a usage Error for several where a picture shows one.
Spectra spectra_of(const NetcdfFile& file, const ComponentChoice& choice) {
  const auto& wanted = choice.components;
  if (wanted.size() < 2) return read_spectra(file, wanted.empty() ? std::nullopt : std::optional(wanted[0]));
  Spectra all = read_spectra(file, wanted[0]);
  if (all.each())
    throw Error("--component: found several, expected one for spectra of each trace or wavenumber",
                ErrorKind::usage);
  for (std::size_t n = 1; n < wanted.size(); ++n)
    for (auto& line : read_spectra(file, wanted[n]).lines) all.lines.push_back(std::move(line));
  return all;
}

WantedPlanes wanted_planes(const PlotOptions& options) {
  WantedPlanes wanted{options.slice, options.through, {}};
  if (options.survey.empty()) return wanted;
  segy::Reader reader(options.survey, options.traces.read_options());
  wanted.source = first_source(reader);
  return wanted;
}

/// Three sections have axes of their own.
void refuse_parts(const Look& look) {
  for (const auto& [limits, name] : {std::pair(look.x, "--x"), std::pair(look.y, "--y")})
    if (limits)
      throw Error(std::string(name) + ": three sections are drawn; choose one by --slice, such as y=500",
                  ErrorKind::usage);
}

/// With the plane in its title.
Page on_plane(Page page, const std::optional<Slice>& slice) {
  if (!slice) return page;
  page.title += (page.title.empty() ? "" : ", ") + name_of(*slice);
  return page;
}

/// Returns the attenuation that sw-shoot takes for a wavelet of the frequency given, where the rock
/// attenuates; else nothing.
std::optional<Attenuation> attenuation_of(const RockAt& rock, const std::optional<double>& reference_hz) {
  constexpr int mechanisms = 3;
  if (!rock.attenuates()) return {};
  if (!reference_hz)
    throw Error("--at: the rock at " + rock.place +
                    " attenuates, expected --q-frequency F, at which it has the model's speeds, Hz",
                ErrorKind::usage);
  const double hz = *reference_hz;
  if (!(hz > 0) || !std::isfinite(hz))
    throw Error("--q-frequency: found " + shown(hz) + " Hz, expected it above 0", ErrorKind::usage);
  return Attenuation{Mechanisms(mechanisms, hz / 5, 2.5 * hz), hz};
}

template <int D>
Picture rock_picture(InputFile& input, const PlotOptions& options, const Page& page) {
  if (options.at.size() != D)
    throw Error("--at: found " + std::to_string(options.at.size()) + " numbers, expected " +
                    (D == 2 ? "X,Z" : "X,Y,Z") + " of a model in " + std::to_string(D) + "-D",
                ErrorKind::usage);
  Point<D> point{};
  std::copy(options.at.begin(), options.at.end(), point.begin());
  const auto model = read_model<D>(*input.file);
  const auto rock = in_place("--at", [&] { return rock_at(model, point); });
  return in_place(input.file->shown_name(),
                  [&] { return draw_rock(rock, attenuation_of(rock, options.reference_hz), page); });
}

Picture model_picture(InputFile& input, const PlotOptions& options, const Page& page) {
  if (!options.at.empty())
    return dimension_of(*input.file) == 2 ? rock_picture<2>(input, options, page)
                                          : rock_picture<3>(input, options, page);
  const bool as_sets = options.property == "fractures";
  const std::string property = as_sets ? "vp" : options.property;
  if (dimension_of(*input.file) == 2) {
    if (options.slice || options.through)
      throw Error(input.file->shown_name() + ": found a model in 2-D, expected one in 3-D with --slice",
                  ErrorKind::usage);
    return draw_model(read_model_section(*input.file, property), as_sets, survey_of(options, 1), options.look,
                      page);
  }
  const auto grid = read_grid<3>(*input.file);
  const auto planes =
      in_place(input.file->shown_name(), [&] { return planes_of(grid, wanted_planes(options)); });
  const auto sections = read_model_sections(*input.file, property, planes);
  std::vector<SurveyMarks> marks;
  for (const auto& plane : planes) marks.push_back(survey_of(options, plane.axis));
  if (planes.size() == 1)
    return draw_model(sections.front(), as_sets, marks.front(), options.look, on_plane(page, options.slice));
  refuse_parts(options.look);
  return draw_model_volume(sections, planes, as_sets, marks, options.look, page);
}

/// What snapshots are drawn with, whatever their time.
class SnapshotDrawing {
 public:
  SnapshotDrawing(InputFile& input, const PlotOptions& options)
      : options_(options),
        file_(std::move(*input.file), options.minus, wanted_planes(options)),
        field_(options.field.empty() ? file_.fields().front() : options.field) {
    for (std::size_t n = 0; n < file_.sections(); ++n) marks_.push_back(survey_of(options, file_.axis(n)));
    if (file_.sections() > 1) refuse_parts(options.look);
    if (!options.over.empty()) read_models();
  }

  const SnapshotFile& file() const { return file_; }
  /// Before draw(), of all times that shall be on one scale.
  void add_to_scale(std::size_t time) {
    for (const auto& snapshot : file_.read(field_, time))
      magnitudes_.add({snapshot.values.data(), snapshot.values.size()});
  }
  Picture draw(std::size_t time, const Page& page) const {
    auto snapshots = file_.read(field_, time);
    for (auto& snapshot : snapshots) snapshot.extent = {magnitudes_.lowest(), magnitudes_.highest()};
    double full = magnitudes_.percentile(options_.look.clip_percent);
    if (full == 0) full = 1;  // before the wave is there
    if (snapshots.size() > 1)
      return draw_snapshot_volume({std::move(snapshots), planes()}, full, models_, marks_, options_.look,
                                  page);
    const auto model = models_.empty() ? std::nullopt : std::optional(models_.front());
    return draw_snapshot(snapshots.front(), full, model, marks_.front(), options_.look,
                         on_plane(page, file_.plane(0)));
  }

 private:
  std::vector<Slice> planes() const {
    std::vector<Slice> all;
    for (std::size_t n = 0; n < file_.sections(); ++n) all.push_back(*file_.plane(n));
    return all;
  }

  /// The model under the snapshots; its cells may be larger or smaller than theirs, its extent is the same.
  void read_models() {
    const auto model = NetcdfFile::open(options_.over);
    const std::string property = options_.property == "fractures" ? "vp" : options_.property;
    if (file_.sections() > 1)
      models_ = read_model_sections(model, property, planes());
    else
      models_.push_back(read_model_section(model, property, file_.plane(0)));
    for (std::size_t n = 0; n < models_.size(); ++n) check_extent(models_[n].grid(), file_.grid(n));
  }

  void check_extent(const Grid<2>& model, const Grid<2>& grid) const {
    const auto extent = [](const Grid<2>& of, int axis) {
      return axis == 0 ? std::array{of.origin_m[0], of.end(0)} : depth_extent(of);
    };
    for (const int axis : {0, 1}) {
      const auto [low, high] = extent(grid, axis);
      const auto [model_low, model_high] = extent(model, axis);
      const double slack = grid.spacing_m / 2;
      if (std::fabs(model_low - low) <= slack && std::fabs(model_high - high) <= slack) continue;
      throw Error("--over: " + options_.over + ": has a grid of " + shown(model) +
                  ", expected the extent of the snapshots, " + shown(grid));
    }
  }

  const PlotOptions& options_;
  SnapshotFile file_;
  std::string field_;
  std::vector<SurveyMarks> marks_;
  std::vector<ModelSection> models_;
  Magnitudes magnitudes_;
};

Picture snapshot_picture(InputFile& input, const PlotOptions& options, const Page& page) {
  SnapshotDrawing drawing(input, options);
  const auto& file = drawing.file();
  const auto time = options.time_s ? file.nearest(*options.time_s) : file.times_s().size() - 1;
  drawing.add_to_scale(time);
  return drawing.draw(time, page);
}

}  // namespace

Page page_of(const PlotOptions& options) {
  if (names_movie(options.output))
    throw Error("--output: found '" + options.output +
                    "', expected a name that ends with .png, .pdf or .svg, or --movie",
                ErrorKind::usage);
  return page_of(in_place("--output", [&] { return format_of(options.output); }), options.page);
}

namespace {

/// An option that means nothing to files of that kind is a slip.
void refuse_options_of_others(const PlotOptions& options, Kind kind, const std::string& path) {
  struct Owned {
    const char* option;
    bool given;
    std::vector<Kind> by;
  };
  const std::vector<Kind> fields = {Kind::model, Kind::snapshots};
  const Owned all[] = {
      {"--time", options.time_s.has_value(), {Kind::snapshots}},
      {"--field", !options.field.empty(), {Kind::snapshots}},
      {"--over", !options.over.empty(), {Kind::snapshots}},
      {"--minus", !options.minus.empty(), {Kind::snapshots}},
      {"--slice", options.slice || options.through, fields},
      {"--survey", !options.survey.empty(), fields},
      {"--gain-power", options.gather.gain_power != 0, {Kind::gather}},
      {"--axis", options.gather.axis != TraceAxis::automatic, {Kind::gather}},
      {"--style", options.gather.wiggle || !options.gather.density, {Kind::gather}},
      {"--su", options.traces.su, {Kind::gather}},
      {"--endian", options.traces.endian != "auto", {Kind::gather}},
      {"--format", options.traces.format != "auto", {Kind::gather}},
      {"--overlay", options.overlay, {Kind::gather, Kind::accuracy}},
      {"--at", !options.at.empty(), {Kind::model}},
      {"--shot", options.shot.has_value(), {Kind::gather}},
      {"--difference", options.gather.difference, {Kind::gather}},
      {"--component", options.of.all || !options.of.components.empty(), {Kind::gather, Kind::spectra}},
      {"--log", options.log, {Kind::spectra}}};
  for (const auto& owned : all)
    if (owned.given && std::find(owned.by.begin(), owned.by.end(), kind) == owned.by.end())
      throw Error(shown_input(path) + ": " + owned.option + " does not apply to this kind of file",
                  ErrorKind::usage);
}

}  // namespace

Picture picture_of(const PlotOptions& options, const Page& given) {
  std::vector<InputFile> inputs;
  for (const auto& path : options.files) inputs.push_back(open_input(path, options.traces.su));
  if (inputs.empty()) inputs.push_back(open_input("-", options.traces.su));
  const Kind kind = inputs.front().kind;
  for (const auto& input : inputs) {
    const bool together = input.kind == kind && kind != Kind::model && kind != Kind::snapshots;
    if (inputs.size() > 1 && !together)
      throw Error(shown_input(input.path) +
                      ": several files can be drawn together only if all hold gathers, all spectra or all "
                      "errors",
                  ErrorKind::usage);
  }
  std::string history;
  for (const auto& input : inputs) {
    if (input.file) history += input.history() + "\n";
  }
  const auto page = with_history(given, history);
  refuse_options_of_others(options, kind, inputs.front().path);
  if (kind == Kind::gather) return gather_picture(inputs, options, page);
  if (kind == Kind::model) return model_picture(inputs.front(), options, page);
  if (kind == Kind::snapshots) return snapshot_picture(inputs.front(), options, page);
  if (kind == Kind::spectra) {
    std::vector<Spectra> files;
    for (const auto& input : inputs) files.push_back(spectra_of(*input.file, options.of));
    return draw_spectra(files, options.log, options.look, page);
  }
  std::vector<AccuracyTable> tables;
  for (const auto& input : inputs) tables.push_back(read_accuracy_table(*input.file));
  return draw_error(tables, options.overlay, options.look, page);
}

void take_movie_name(PlotOptions& options) {
  const auto last = std::find_if(options.files.begin(), options.files.end(), names_movie);
  if (last == options.files.end()) return;
  if (options.output != "-")
    throw Error("--movie: found " + *last + " and -o " + options.output + ", expected one of them",
                ErrorKind::usage);
  options.output = *last;
  options.files.erase(last);
}

std::vector<std::string> draw_movie(const PlotOptions& options, const Progress& progress) {
  if (options.output == "-" || options.files.size() > 1)
    throw Error("--movie: draws one file of snapshots, and needs a name (-o NAME.mp4 or NAME.png)",
                ErrorKind::usage);
  if (!(options.frames_per_s >= 0.1 && options.frames_per_s <= 240))
    throw Error("--fps: found " + shown(options.frames_per_s) + ", expected 0.1 to 240", ErrorKind::usage);
  auto input = open_input(options.files.empty() ? "-" : options.files.front(), options.traces.su);
  if (input.kind != Kind::snapshots)
    throw Error(shown_input(input.path) + ": --movie does not apply to this kind of file", ErrorKind::usage);
  const bool wanted = names_movie(options.output);
  const auto page =
      with_history(wanted ? page_of(Format::png, options.page) : page_of(options), input.history());
  SnapshotDrawing drawing(input, options);
  const auto times = drawing.file().times_s().size();
  const auto done = [&](std::size_t steps) {
    if (progress) progress(std::int64_t(steps), std::int64_t(2 * times));
  };
  for (std::size_t n = 0; n < times; ++n) {
    drawing.add_to_scale(n);
    done(n + 1);
  }
  const auto movie =
      wanted ? Movie::begin(options.output, {options.frames_per_s, page.title, page.history}) : nullptr;
  for (std::size_t n = 0; n < times; ++n) {
    const auto picture = drawing.draw(n, page);
    if (movie) {
      movie->add(picture.bytes);
    } else {
      OutputFile out(frame_path(options.output, n + 1), OutputFile::Content::binary);
      out.write(picture.bytes.data(), picture.bytes.size());
      out.commit();
    }
    done(times + n + 1);
  }
  if (movie) movie->finish();
  if (movie || !wanted) return {};
  return {"ffmpeg, which makes " + options.output + ", is not installed: wrote " +
          frame_path(options.output, 1) + " to " + frame_path(options.output, times) + " instead"};
}

}  // namespace slipwave::plot
