#include "plot/file_picture.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "accuracy/table.hpp"
#include "base/error.hpp"
#include "grid/true_depth.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "plot/error_picture.hpp"
#include "plot/input_file.hpp"
#include "plot/model_picture.hpp"
#include "plot/snapshot_file.hpp"
#include "plot/snapshot_picture.hpp"
#include "plot/spectrum_picture.hpp"
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
  std::string text;
  for (auto& input : inputs) {
    segy::Reader reader(input.path, options.traces.read_options(), {input.taken.begin(), input.taken.end()});
    TraceChoice choice{options.component, std::nullopt};
    if (options.shot) choice.shot = std::int64_t(*options.shot);
    gathers.push_back({name_beside_others(input.path), read_section(reader, choice)});
    if (reader.header().su) continue;
    for (const auto& line : segy::shown_lines(reader.header().text)) text += line + "\n";
  }
  auto style = options.gather;
  style.overlay = options.overlay;
  return draw_gathers(std::move(gathers), style, options.look, with_history(page, text));
}

/// With the plane in its title.
Page on_plane(Page page, const std::optional<Slice>& slice) {
  if (!slice) return page;
  const std::string plane =
      std::string(1, axis_names<3>()[std::size_t(slice->axis)]) + " = " + shown(slice->at_m) + " m";
  page.title += (page.title.empty() ? "" : ", ") + plane;
  return page;
}

Picture model_picture(InputFile& input, const PlotOptions& options, const Page& page) {
  const bool as_sets = options.property == "fractures";
  const auto section = read_model_section(*input.file, as_sets ? "vp" : options.property, options.slice);
  return draw_model(section, as_sets, survey_of(options, options.slice ? options.slice->axis : 1),
                    options.look, on_plane(page, options.slice));
}

/// The model under the snapshots; its cells may be larger or smaller than theirs, its extent is the same.
std::optional<ModelSection> model_below(const PlotOptions& options, const SnapshotFile& snapshots) {
  const auto& grid = snapshots.grid();
  if (options.over.empty()) return std::nullopt;
  const bool as_sets = options.property == "fractures";
  auto model = read_model_section(NetcdfFile::open(options.over), as_sets ? "vp" : options.property,
                                  snapshots.slice());
  const auto extent = [](const Grid<2>& of, int axis) {
    return axis == 0 ? std::array{of.origin_m[0], of.end(0)} : depth_extent(of);
  };
  for (const int axis : {0, 1}) {
    const auto [low, high] = extent(grid, axis);
    const auto [model_low, model_high] = extent(model.grid(), axis);
    const double slack = grid.spacing_m / 2;
    if (std::fabs(model_low - low) <= slack && std::fabs(model_high - high) <= slack) continue;
    throw Error("--over: " + options.over + ": has a grid of " + shown(model.grid()) +
                ", expected the extent of the snapshots, " + shown(grid));
  }
  return model;
}

double full_of(const Magnitudes& magnitudes, const PlotOptions& options) {
  const double full = magnitudes.percentile(options.look.clip_percent);
  return full > 0 ? full : 1;  // before the wave is there
}

Picture snapshot_picture(InputFile& input, const PlotOptions& options, const Page& page) {
  const SnapshotFile snapshots(std::move(*input.file), options.minus, options.slice);
  const auto field = options.field.empty() ? snapshots.fields().front() : options.field;
  const auto time = options.time_s ? snapshots.nearest(*options.time_s) : snapshots.times_s().size() - 1;
  auto snapshot = snapshots.read(field, time);
  Magnitudes magnitudes;
  magnitudes.add({snapshot.values.data(), snapshot.values.size()});
  snapshot.extent = {magnitudes.lowest(), magnitudes.highest()};
  return draw_snapshot(snapshot, full_of(magnitudes, options), model_below(options, snapshots),
                       survey_of(options, snapshots.axis()), options.look, on_plane(page, snapshots.slice()));
}

}  // namespace

Page page_of(const PlotOptions& options) {
  return page_of(in_place("--output", [&] { return format_of(options.output); }), options.page);
}

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
  if (kind == Kind::gather) return gather_picture(inputs, options, page);
  if (kind == Kind::model) return model_picture(inputs.front(), options, page);
  if (kind == Kind::snapshots) return snapshot_picture(inputs.front(), options, page);
  if (kind == Kind::spectra) {
    std::vector<Spectra> files;
    for (const auto& input : inputs) files.push_back(read_spectra(*input.file, options.component));
    return draw_spectra(files, options.log, options.look, page);
  }
  std::vector<AccuracyTable> tables;
  for (const auto& input : inputs) tables.push_back(read_accuracy_table(*input.file));
  return draw_error(tables, options.overlay, options.look, page);
}

void draw_movie(const PlotOptions& options, const Progress& progress) {
  if (options.output == "-" || options.files.size() > 1)
    throw Error("--movie: draws one file of snapshots, and needs a name (-o NAME.png)", ErrorKind::usage);
  auto input = open_input(options.files.empty() ? "-" : options.files.front(), options.traces.su);
  if (input.kind != Kind::snapshots)
    throw Error(shown_input(input.path) + ": holds no snapshots, expected them for --movie");
  const auto page = with_history(page_of(options), input.history());
  const SnapshotFile snapshots(std::move(*input.file), options.minus, options.slice);
  const auto field = options.field.empty() ? snapshots.fields().front() : options.field;
  const auto times = snapshots.times_s().size();
  const auto done = [&](std::size_t steps) {
    if (progress) progress(std::int64_t(steps), std::int64_t(2 * times));
  };
  Magnitudes magnitudes;
  for (std::size_t n = 0; n < times; ++n) {
    const auto values = snapshots.read(field, n).values;
    magnitudes.add({values.data(), values.size()});
    done(n + 1);
  }
  const double full = full_of(magnitudes, options);
  const auto model = model_below(options, snapshots);
  const auto marks = survey_of(options, snapshots.axis());
  const auto dot = options.output.rfind('.');
  for (std::size_t n = 0; n < times; ++n) {
    char number[32];
    std::snprintf(number, sizeof number, "-%04zu", n + 1);
    OutputFile out(options.output.substr(0, dot) + number + options.output.substr(dot),
                   OutputFile::Content::binary);
    const auto picture = draw_snapshot(snapshots.read(field, n), full, model, marks, options.look,
                                       on_plane(page, snapshots.slice()));
    out.write(picture.bytes.data(), picture.bytes.size());
    out.commit();
    done(times + n + 1);
  }
}

}  // namespace slipwave::plot
