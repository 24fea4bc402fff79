#include "shot_output.hpp"

#include <unistd.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/parallel.hpp"
#include "base/parse.hpp"
#include "base/temporary.hpp"
#include "checkpoint/snapshot_log.hpp"
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
          (scene.slips() ? std::string(", slip: ") + name_of(n.correction) : std::string(", no slip")),
  };
  for (std::size_t begin = 0; begin < history.size();) {
    const auto end = std::min(history.find('\n', begin), history.size());
    if (end > begin) entries.push_back(history.substr(begin, end - begin));
    begin = end + 1;
  }
  return entries;
}

std::optional<SlipField> slip_field(const std::string& name) {
  if (name == "slip") return SlipField::slip;
  if (name == "slip_rate") return SlipField::slip_rate;
  if (name == "dissipated") return SlipField::dissipated;
  return std::nullopt;
}

Field<2> snapshot_of(const std::string& name, const FieldReader<2>& field) {
  if (name == "div") return divergence<2>({field(Component::vx), field(Component::vz)});
  if (name == "curl") return curl({field(Component::vx), field(Component::vz)});
  if (const auto slip = slip_field(name)) return field(*slip);
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

/// Trace files by name, opened before their shots are shot.
using TraceFiles = std::map<std::string, OutputFile>;

/// Snapshots of one shot: the file, and with a checkpoint the log that goes with it.
class Snapshots {
 public:
  Snapshots(const std::string& path, const Grid<2>& grid, const std::vector<std::string>& fields,
            const SnapshotHistory& history, const RunBook& book, std::size_t shot)
      : writer_(path, grid, fields, history) {
    if (book.keeps_checkpoints())
      log_.emplace(book.snapshot_log(shot), grid, fields.size(), book.snapshots_of(shot),
                   [this](double time_s, const auto& taken) { writer_.write(time_s, taken); });
  }
  SnapshotSink<2> sink() {
    return [this](double time_s, const FieldReader<2>& field) {
      std::vector<Field<2>> taken;
      for (const auto& name : writer_.fields()) taken.push_back(snapshot_of(name, field));
      writer_.write(time_s, taken);
      if (log_) log_->append(time_s, taken);
    };
  }
  RunBook::Mark mark() {
    if (!log_) return {};
    return [this] { return log_->synchronized(); };
  }
  void commit() { writer_.commit(); }

 private:
  SnapshotWriter<2> writer_;
  std::optional<SnapshotLog<2>> log_;
};

}  // namespace

bool ShotOutput::wants_slip() const {
  const auto names = split(snapshot_fields, ',');
  return std::any_of(names.begin(), names.end(),
                     [](const auto& name) { return slip_field(name).has_value(); });
}

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
  if (checkpoint_every_s && checkpoint.empty())
    throw Error("found --checkpoint-every without --checkpoint, expected where to write it",
                ErrorKind::usage);
  if (checkpoint_every_s && !(*checkpoint_every_s > 0))
    throw Error("--checkpoint-every: found " + shown(*checkpoint_every_s) + ", expected it above 0",
                ErrorKind::usage);
  if (checkpoint == "-") throw Error("--checkpoint: found -, expected the name of a file", ErrorKind::usage);
  for (const auto& output : {traces, snapshots})
    if (!checkpoint.empty() && checkpoint == output)
      throw Error("found " + checkpoint + " for both --checkpoint and an output, expected two places",
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

RunBook ShotOutput::open_book(const Scene<2>& scene, const std::string& history,
                              const cli::Context& context) const {
  RunBook::Settings settings;
  settings.path = checkpoint;
  settings.shots = scene.survey.sources.size();
  settings.first_shot = std::size_t(first_shot);
  settings.say = [&context](const std::string& sentence) { context.say(sentence); };
  settings.warn = [&context](const std::string& sentence) { context.warn(sentence); };
  if (!checkpoint.empty()) {
    settings.every_s = checkpoint_every_s.value_or(usual_checkpoint_every_s);
    settings.identity = identity_of(scene);
    settings.identity.push_back({"program", context.version});
    if (!snapshots.empty()) settings.identity.push_back({"fields", snapshot_fields});
    settings.identity.push_back({"first shot", std::to_string(first_shot)});
    settings.identity.push_back({"history", history, false});
  }
  return RunBook(std::move(settings));
}

/// Whether the files that a finished shot has to itself are where they were put.
bool ShotOutput::in_place_still(const Scene<2>& scene, RunBook& book, std::size_t shot) const {
  const auto there = [](const std::string& path) { return path == "-" || access(path.c_str(), F_OK) == 0; };
  const std::size_t number = shot + std::size_t(first_shot - 1);
  bool all = snapshots.empty() || there(name_for(snapshots, number, ""));
  if (!book.gather(shot) && !scene.survey.receivers_m.empty())
    for (const Component component : scene.recording.components)
      all &= there(name_for(traces, number, name_of(component)));
  return all;
}

void ShotOutput::shoot_all(const Scene<2>& scene, const std::string& history,
                           const cli::Context& context) const {
  const auto entries = entries_of(scene, history, context.version);
  const bool any_trace = !scene.survey.receivers_m.empty(), a_file_a_shot = holds(traces, "{shot}");
  if (any_trace) check_sampling(scene.recording, context);
  if (any_trace && !snapshots.empty() && snapshots == traces)
    throw Error("found " + traces + " for both --output and --snapshots, expected two places",
                ErrorKind::usage);
  const auto shots = scene.survey.sources.size(), at_once = shots_at_once(scene);
  const auto number_of = [&](std::size_t shot) { return shot + std::size_t(first_shot - 1); };
  const auto name_of_file = [&](std::size_t shot, Component component) {
    return name_for(traces, number_of(shot), name_of(component));
  };
  // Samples are written alike whether anything was computed before, or all came from a checkpoint.
  flush_subnormals();
  RunBook book = open_book(scene, history, context);
  const bool goes_on = !book.goes_on_at().empty();
  if (goes_on) context.say("goes on from " + checkpoint + ": " + book.goes_on_at());
  std::vector<std::size_t> open;
  for (std::size_t shot = 1; shot <= shots; ++shot) {
    if (book.finished(shot) && !in_place_still(scene, book, shot)) book.forget(shot);
    if (!book.finished(shot)) open.push_back(shot);
    if (goes_on && !snapshots.empty()) remove_strays(name_for(snapshots, number_of(shot), ""));
  }
  TraceFiles files;
  const auto open_files = [&](std::size_t shot) {
    for (const Component component : scene.recording.components) {
      const auto name = name_of_file(shot, component);
      if (!any_trace || files.count(name) > 0) continue;
      if (goes_on) remove_strays(name);
      files.try_emplace(name, name, OutputFile::Content::binary);
    }
  };
  // Writes the files that all shots have been shot for; each trace goes once.
  const auto write_files = [&] {
    std::map<std::string, Gather> gathers;
    for (std::size_t shot = 1; shot <= shots; ++shot) {
      Gather* const gather = book.gather(shot);
      if (!gather) continue;
      open_files(shot);
      for (auto& trace : gather->traces) {
        trace.header.shot += first_shot - 1;
        auto& collected = gathers[name_of_file(shot, trace.header.component)];
        collected.axis = gather->axis;
        collected.traces.push_back(std::move(trace));
      }
    }
    for (auto& [name, file] : files) {
      segy::write_gather(file, gathers[name], {}, entries);
      file.commit();
    }
    files.clear();
    for (std::size_t shot = 1; shot <= shots; ++shot)
      if (book.finished(shot)) book.put_away(shot);
  };
  if (a_file_a_shot) write_files();
  for (std::size_t first = 0; first < open.size(); first += at_once) {
    const std::span<const std::size_t> group(open.data() + first, std::min(at_once, open.size() - first));
    for (const auto shot : group) open_files(shot);
    std::optional<Snapshots> kept;
    if (!snapshots.empty())
      kept.emplace(name_for(snapshots, number_of(group[0]), ""), scene.model.grid(),
                   parse_snapshot_fields<2>(snapshot_fields),
                   SnapshotHistory{"wave fields of shot " + std::to_string(number_of(group[0])),
                                   context.version, history},
                   book, group[0]);
    const auto progress =
        context.progress("shot " + std::to_string(number_of(group.front())) +
                         (group.size() > 1 ? " to " + std::to_string(number_of(group.back())) : ""));
    parallel_jobs(std::int64_t(group.size()), int(at_once), [&](std::int64_t n) {
      const auto shot = group[std::size_t(n)];
      const auto pauses = book.pauses_of(shot, kept ? kept->mark() : RunBook::Mark());
      // The first of those that run together speaks for all.
      book.finish(shot, shoot(scene, shot, n == 0 ? progress : Progress(),
                              kept ? kept->sink() : SnapshotSink<2>(), pauses.get()));
    });
    if (kept) kept->commit();
    if (a_file_a_shot) write_files();
    if (group.back() != open.back()) book.turn_page();
  }
  if (!a_file_a_shot) write_files();
  book.close();
}

}  // namespace slipwave
