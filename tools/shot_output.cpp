#include "shot_output.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "output/derivatives.hpp"
#include "output/snapshot_netcdf.hpp"
#include "segy/writer.hpp"
#include "segy/writer_headers.hpp"
#include "solver/simulation.hpp"

namespace slipwave {
namespace {

bool replace(std::string& text, const std::string& mark, const std::string& by) {
  bool found = false;
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size())) {
    text.replace(at, mark.size(), by);
    found = true;
  }
  return found;
}

std::string name_for(std::string pattern, std::size_t shot, const std::string& component) {
  replace(pattern, "{shot}", std::to_string(shot));
  replace(pattern, "{component}", component);
  return pattern;
}

/// A misspelt mark would make a file of that name.
void check_marks(const std::string& pattern) {
  for (auto at = pattern.find('{'); at != std::string::npos; at = pattern.find('{', at + 1)) {
    const auto end = pattern.find('}', at);
    if (end == std::string::npos) return;
    const std::string mark = pattern.substr(at, end - at + 1);
    if (mark != "{shot}" && mark != "{component}")
      throw Error("found " + mark + " in the name " + pattern + ", expected {shot} or {component}",
                  ErrorKind::usage);
  }
}

bool holds(std::string pattern, const std::string& mark) { return replace(pattern, mark, ""); }

/// What the textual header says of a run.
std::vector<std::string> entries_of(const Scene<2>& scene, const std::string& history,
                                    const std::string& version) {
  const auto& source = scene.survey.sources.front();
  const auto& n = scene.numerics;
  std::vector<std::string> entries = {
      version + ": synthetic seismograms",
      "source: " + std::string(name_of<2>(source.mechanism)) + ", wavelet " + source.wavelet.text() +
          ", amplitude " + shown(source.amplitude) + ", wavelet time zero at " +
          shown(source.wavelet.delay_s()) + " s",
      "scheme: grid-characteristic, order " + std::to_string(n.order) + ", time step " +
          shown(time_step_s(scene)) + " s, grid " + shown(scene.model.grid()) +
          (scene.slips() ? std::string(", slip of ") +
                               (n.correction == SlipCorrection::first ? "first" : "second") + " order"
                         : std::string(", no slip")),
  };
  for (std::size_t begin = 0; begin < history.size();) {
    const auto end = std::min(history.find('\n', begin), history.size());
    if (end > begin) entries.push_back(history.substr(begin, end - begin));
    begin = end + 1;
  }
  return entries;
}

Field<2> snapshot_of(const std::string& name, const FieldReader<2>& field) {
  if (name == "div") return divergence<2>({field(Component::vx), field(Component::vz)});
  if (name == "curl") return curl({field(Component::vx), field(Component::vz)});
  return field(component_named(name));
}

/// What the trace files can not hold is refused before anything is computed.
void check_sampling(const Recording& recording, const cli::Context& context) {
  segy::FileInfo info;
  info.axis.count = recording.samples();
  info.axis.interval_s = recording.interval_s;
  segy::checked_format(info);
  for (const auto& sentence : segy::warnings_of(info)) context.warn(sentence);
}

/// A trace file that is being collected.
struct Collected {
  std::unique_ptr<OutputFile> out;
  Gather gather;
};

}  // namespace

void ShotOutput::check(std::size_t shots) const {
  check_marks(traces);
  check_marks(snapshots);
  if (!snapshots.empty()) in_place("--fields", [&] { return parse_snapshot_fields<2>(snapshot_fields); });
  if (first_shot < 1)
    throw Error("--first-shot: found " + std::to_string(first_shot) + ", expected 1 or more",
                ErrorKind::usage);
  if (!snapshots.empty() && shots > 1 && !holds(snapshots, "{shot}"))
    throw Error("found " + std::to_string(shots) + " sources and --snapshots " + snapshots +
                    ", expected {shot} in the name",
                ErrorKind::usage);
  if (!snapshots.empty() && holds(snapshots, "{component}"))
    throw Error("found {component} in --snapshots " + snapshots + ", expected --fields to choose them",
                ErrorKind::usage);
  if (shots_in_parallel < 0)
    throw Error("--shots-in-parallel: found " + std::to_string(shots_in_parallel) + ", expected 0 or more",
                ErrorKind::usage);
  if (!snapshots.empty() && shots_in_parallel > 1)
    throw Error("found --snapshots with " + std::to_string(shots_in_parallel) +
                    " for --shots-in-parallel, expected 1: snapshots are written one after the other",
                ErrorKind::usage);
}

std::size_t ShotOutput::shots_at_once(const Scene<2>& scene) const {
  const auto shots = scene.survey.sources.size();
  if (!snapshots.empty()) return 1;
  if (shots_in_parallel > 0) return std::min(std::size_t(shots_in_parallel), shots);
  const std::int64_t fit = most_together_bytes / memory_of_a_shot_bytes(scene);
  return std::size_t(
      std::clamp<std::int64_t>(std::min<std::int64_t>(fit, parallel_threads()), 1, std::int64_t(shots)));
}

void ShotOutput::shoot_all(const Scene<2>& scene, const std::string& history,
                           const cli::Context& context) const {
  const auto entries = entries_of(scene, history, context.version);
  const bool any_trace = !scene.survey.receivers_m.empty();
  if (any_trace) check_sampling(scene.recording, context);
  if (any_trace && !snapshots.empty() && snapshots == traces)
    throw Error("found " + traces + " for both --output and --snapshots, expected two places",
                ErrorKind::usage);
  std::map<std::string, Collected> files;
  const auto shots = scene.survey.sources.size(), at_once = shots_at_once(scene);
  const auto number_of = [&](std::size_t shot) { return shot + std::size_t(first_shot - 1); };
  const auto name_of_file = [&](std::size_t shot, Component component) {
    return name_for(traces, number_of(shot), name_of(component));
  };
  for (std::size_t first = 1; first <= shots; first += at_once) {
    const auto count = std::min(at_once, shots - first + 1);
    for (std::size_t shot = first; shot < first + count; ++shot)
      for (const Component component : scene.recording.components) {
        const auto name = name_of_file(shot, component);
        auto& file = files[name];
        if (!file.out && any_trace)
          file.out = std::make_unique<OutputFile>(name, OutputFile::Content::binary);
      }
    std::optional<SnapshotWriter<2>> writer;
    SnapshotSink<2> sink;
    if (!snapshots.empty()) {
      writer.emplace(name_for(snapshots, number_of(first), ""), scene.model.grid(),
                     parse_snapshot_fields<2>(snapshot_fields),
                     SnapshotHistory{"wave fields of shot " + std::to_string(number_of(first)),
                                     context.version, history});
      sink = [&](double time_s, const FieldReader<2>& field) {
        std::vector<Field<2>> fields;
        for (const auto& name : writer->fields()) fields.push_back(snapshot_of(name, field));
        writer->write(time_s, fields);
      };
    }
    std::vector<Gather> gathers(count);
    const auto progress =
        context.progress("shot " + std::to_string(number_of(first)) +
                         (count > 1 ? " to " + std::to_string(number_of(first + count - 1)) : ""));
    parallel_jobs(std::int64_t(count), int(at_once), [&](std::int64_t n) {
      // The first of those that run together speaks for all.
      gathers[std::size_t(n)] = shoot(scene, first + std::size_t(n), n == 0 ? progress : Progress(), sink);
    });
    for (std::size_t n = 0; n < count; ++n)
      for (auto& trace : gathers[n].traces) {
        trace.header.shot += first_shot - 1;
        auto& collected = files[name_of_file(first + n, trace.header.component)].gather;
        collected.axis = gathers[n].axis;
        collected.traces.push_back(std::move(trace));
      }
    if (writer) writer->commit();
    // With {shot} in the name nothing more comes for these files.
    if (!holds(traces, "{shot}") && first + count <= shots) continue;
    for (auto& [name, file] : files) {
      if (!file.out) continue;
      segy::write_gather(*file.out, file.gather, {}, entries);
      file.out->commit();
    }
    files.clear();
  }
}

}  // namespace slipwave
