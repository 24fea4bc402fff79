#include "plot_kinds.hpp"

#include <cmath>
#include <cstdio>

#include "accuracy/table.hpp"
#include "base/error.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "io/netcdf_file.hpp"
#include "io/output_file.hpp"
#include "model/model_report.hpp"
#include "plot/error_picture.hpp"
#include "plot/model_picture.hpp"
#include "plot/snapshot_picture.hpp"
#include "plot/spectrum_picture.hpp"
#include "plot_snapshots.hpp"
#include "segy/reader.hpp"
#include "segy/sniff.hpp"

namespace slipwave {
namespace {

enum class Kind { gather, model, snapshots, spectra, accuracy };

/// An input, opened as far as its kind needs.
struct Input {
  std::string path;
  Kind kind = Kind::gather;
  std::optional<NetcdfFile> file;  // but for gathers
  std::vector<char> taken;         // bytes already read of a gather's pipe
};

Kind kind_of_netcdf(const NetcdfFile& file) {
  const std::string kind = kind_of(file);
  if (kind == "model") return Kind::model;
  if (kind == "snapshots") return Kind::snapshots;
  if (file.dimension_length("setting")) return Kind::accuracy;
  if (file.dimension_length("frequency")) return Kind::spectra;
  throw Error(file.shown_name() + ": is netCDF, but no model, snapshots, spectra or table of sw-accuracy");
}

Input open_input(const std::string& path, const PlotSettings& settings) {
  const InputStart start(path, 3600);
  const auto& first = start.bytes();
  Input input{path, Kind::gather, std::nullopt, start.taken()};
  if (begins_netcdf({first.data(), first.size()})) {
    input.file = start.is_regular() ? NetcdfFile::open(path)
                                    : NetcdfFile::open(read_all(path, start.taken()), shown_input(path));
    input.kind = kind_of_netcdf(*input.file);
    return input;
  }
  const std::vector<std::uint8_t> bytes(first.begin(), first.end());
  if (!settings.traces.su && !segy::looks_like_segy(bytes))
    throw Error(shown_input(path) + ": is " +
                (first.empty() ? "empty" : "not a netCDF, SEG-Y or Seismic Unix file") +
                ", expected a model, snapshots, spectra, errors or a gather");
  return input;
}

plot::SurveyMarks survey_of(const PlotSettings& settings, int axis) {
  if (settings.survey.empty()) return {};
  segy::Reader reader(settings.survey, settings.traces.read_options());
  return plot::read_survey(reader, axis);
}

plot::Picture gather_picture(Input& input, const PlotSettings& settings, const plot::Page& page) {
  segy::Reader reader(input.path, settings.traces.read_options(), {input.taken.begin(), input.taken.end()});
  plot::TraceChoice choice{settings.component, std::nullopt};
  if (settings.shot) choice.shot = std::int64_t(*settings.shot);
  auto section = plot::read_section(reader, choice);
  std::string text;
  if (!reader.header().su) {
    for (const auto& line : segy::shown_lines(reader.header().text)) text += line + "\n";
  }
  return plot::draw_gather(std::move(section), settings.gather, settings.look,
                           plot::with_history(page, text));
}

/// With the plane in its title.
plot::Page on_plane(plot::Page page, const std::optional<Slice>& slice) {
  if (!slice) return page;
  const std::string plane =
      std::string(1, axis_names<3>()[std::size_t(slice->axis)]) + " = " + shown(slice->at_m) + " m";
  page.title += (page.title.empty() ? "" : ", ") + plane;
  return page;
}

plot::Picture model_picture(Input& input, const PlotSettings& settings, const plot::Page& page) {
  const bool as_sets = settings.property == "fractures";
  const auto section =
      plot::read_model_section(*input.file, as_sets ? "vp" : settings.property, settings.slice);
  return plot::draw_model(section, as_sets, survey_of(settings, settings.slice ? settings.slice->axis : 1),
                          settings.look, on_plane(page, settings.slice));
}

/// The model under the snapshots; its cells may be larger or smaller than theirs, its extent is the same.
std::optional<plot::ModelSection> model_below(const PlotSettings& settings, const Snapshots& snapshots) {
  const auto& grid = snapshots.grid();
  if (settings.over.empty()) return std::nullopt;
  const bool as_sets = settings.property == "fractures";
  auto model = plot::read_model_section(NetcdfFile::open(settings.over), as_sets ? "vp" : settings.property,
                                        snapshots.slice());
  for (const int axis : {0, 1}) {
    const auto at = std::size_t(axis);
    const double slack = grid.spacing_m / 2;
    if (std::fabs(model.grid().origin_m[at] - grid.origin_m[at]) <= slack &&
        std::fabs(model.grid().end(axis) - grid.end(axis)) <= slack)
      continue;
    throw Error("--over: " + settings.over + ": has a grid of " + shown(model.grid()) +
                ", expected the extent of the snapshots, " + shown(grid));
  }
  return model;
}

double full_of(const plot::Magnitudes& magnitudes, const PlotSettings& settings) {
  const double full = magnitudes.percentile(settings.look.clip_percent);
  return full > 0 ? full : 1;  // before the wave is there
}

plot::Picture snapshot_picture(Input& input, const PlotSettings& settings, const plot::Page& page) {
  const Snapshots snapshots(std::move(*input.file), settings.minus, settings.slice);
  const auto field = settings.field.empty() ? snapshots.fields().front() : settings.field;
  const auto time = settings.time_s ? snapshots.nearest(*settings.time_s) : snapshots.times_s().size() - 1;
  const auto snapshot = snapshots.read(field, time);
  plot::Magnitudes magnitudes;
  magnitudes.add({snapshot.values.data(), snapshot.values.size()});
  return plot::draw_snapshot(snapshot, full_of(magnitudes, settings), model_below(settings, snapshots),
                             survey_of(settings, snapshots.axis()), settings.look,
                             on_plane(page, snapshots.slice()));
}

}  // namespace

plot::Page page_of(const PlotSettings& settings) {
  return plot::page_of(in_place("--output", [&] { return plot::format_of(settings.output); }), settings.page);
}

plot::Picture picture_of(const PlotSettings& settings, const plot::Page& given) {
  std::vector<Input> inputs;
  for (const auto& path : settings.files) inputs.push_back(open_input(path, settings));
  if (inputs.empty()) inputs.push_back(open_input("-", settings));
  const Kind kind = inputs.front().kind;
  for (const auto& input : inputs) {
    const bool together = input.kind == kind && (kind == Kind::spectra || kind == Kind::accuracy);
    if (inputs.size() > 1 && !together)
      throw Error(shown_input(input.path) +
                      ": several files can be drawn together only if all hold spectra or all hold errors",
                  ErrorKind::usage);
  }
  std::string history;
  for (const auto& input : inputs) {
    if (input.file) history += input.file->text_attribute("", "history").value_or("") + "\n";
  }
  const auto page = plot::with_history(given, history);
  if (kind == Kind::gather) return gather_picture(inputs.front(), settings, page);
  if (kind == Kind::model) return model_picture(inputs.front(), settings, page);
  if (kind == Kind::snapshots) return snapshot_picture(inputs.front(), settings, page);
  if (kind == Kind::spectra) {
    std::vector<plot::Spectra> files;
    for (const auto& input : inputs) files.push_back(plot::read_spectra(*input.file, settings.component));
    return plot::draw_spectra(files, settings.log, settings.look, page);
  }
  std::vector<AccuracyTable> tables;
  for (const auto& input : inputs) tables.push_back(read_accuracy_table(*input.file));
  return plot::draw_error(tables, settings.overlay, settings.look, page);
}

void draw_movie(const PlotSettings& settings, const Progress& progress) {
  if (settings.output == "-" || settings.files.size() > 1)
    throw Error("--movie: draws one file of snapshots, and needs a name (-o NAME.png)", ErrorKind::usage);
  auto input = open_input(settings.files.empty() ? "-" : settings.files.front(), settings);
  if (input.kind != Kind::snapshots)
    throw Error(shown_input(input.path) + ": holds no snapshots, expected them for --movie");
  const auto page =
      plot::with_history(page_of(settings), input.file->text_attribute("", "history").value_or(""));
  const Snapshots snapshots(std::move(*input.file), settings.minus, settings.slice);
  const auto field = settings.field.empty() ? snapshots.fields().front() : settings.field;
  const auto times = snapshots.times_s().size();
  const auto done = [&](std::size_t steps) {
    if (progress) progress(std::int64_t(steps), std::int64_t(2 * times));
  };
  plot::Magnitudes magnitudes;
  for (std::size_t n = 0; n < times; ++n) {
    const auto values = snapshots.read(field, n).values;
    magnitudes.add({values.data(), values.size()});
    done(n + 1);
  }
  const double full = full_of(magnitudes, settings);
  const auto model = model_below(settings, snapshots);
  const auto marks = survey_of(settings, snapshots.axis());
  const auto dot = settings.output.rfind('.');
  for (std::size_t n = 0; n < times; ++n) {
    char number[32];
    std::snprintf(number, sizeof number, "-%04zu", n + 1);
    OutputFile out(settings.output.substr(0, dot) + number + settings.output.substr(dot),
                   OutputFile::Content::binary);
    const auto picture = plot::draw_snapshot(snapshots.read(field, n), full, model, marks, settings.look,
                                             on_plane(page, snapshots.slice()));
    out.write(picture.bytes.data(), picture.bytes.size());
    out.commit();
    done(times + n + 1);
  }
}

}  // namespace slipwave
