#include "shot_output.hpp"

#include <unistd.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "io/output_file.hpp"
#include "output/snapshot_netcdf.hpp"
#include "parallel/threads.hpp"
#include "segy/writer.hpp"
#include "segy/writer_headers.hpp"
#include "shot_balance.hpp"
#include "shot_snapshots.hpp"
#include "solver/simulation.hpp"

namespace slipwave {
namespace {

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

}  // namespace

bool ShotOutput::wants_slip() const {
  const auto names = split(snapshot_fields, ',');
  return std::any_of(names.begin(), names.end(),
                     [](const auto& name) { return slip_field_named(name).has_value(); });
}

template <int D>
std::size_t ShotOutput::shots_at_once(const Scene<D>& scene) const {
  const auto shots = scene.survey.sources.size();
  if (!snapshots.empty()) return 1;
  if (shots_in_parallel > 0) return std::min(std::size_t(shots_in_parallel), shots);
  const std::int64_t fit = most_together_bytes / memory_of_a_shot_bytes(scene);
  return std::size_t(
      std::clamp<std::int64_t>(std::min<std::int64_t>(fit, parallel_threads()), 1, std::int64_t(shots)));
}

template <int D>
RunState ShotOutput::open_book(const Scene<D>& scene, const std::string& history,
                               const cli::Context& context) const {
  RunState::Settings settings;
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
    if (!slice.empty()) settings.identity.push_back({"slice", slice});
    settings.identity.push_back({"first shot", std::to_string(first_shot)});
    settings.identity.push_back({"command line or history of the model", history, false});
  }
  return RunState(std::move(settings));
}

/// Whether the files that a finished shot has to itself are where they were put.
template <int D>
bool ShotOutput::in_place_still(const Scene<D>& scene, RunState& book, std::size_t shot) const {
  const auto there = [](const std::string& path) { return path == "-" || access(path.c_str(), F_OK) == 0; };
  const std::size_t number = number_of(shot);
  bool all = snapshots.empty() || there(name_for(snapshots, number, ""));
  if (!book.gather(shot) && !scene.survey.receivers_m.empty())
    for (const Component component : scene.recording.components)
      all &= there(name_for(traces, number, name_of(component)));
  return all;
}

/// What a run works on.
template <int D>
struct ShotOutput::Underway {
  std::vector<std::string> entries;  // of the textual headers
  RunState book;
  TraceFiles files;
  std::optional<ShotSnapshots<D>> kept;
};

template <int D>
void ShotOutput::check_run(const Scene<D>& scene, const cli::Context& context) const {
  const bool any_trace = !scene.survey.receivers_m.empty();
  if (any_trace) check_sampling(scene.recording, context);
  if (any_trace && !snapshots.empty() && snapshots == traces)
    throw Error("found " + traces + " for both --output and --snapshots, expected two places",
                ErrorKind::usage);
  if (keep_unstable && ((any_trace && traces == "-") || snapshots == "-"))
    throw Error("found --keep-unstable and an output to standard output, expected the name of a file",
                ErrorKind::usage);
  in_place("--slice", [&] { cut_of(scene.subdomain.whole(scene.model.grid()), slice); });
}

template <int D>
void ShotOutput::shoot_all(const Scene<D>& scene, const std::string& history, const cli::Context& context,
                           const RankGroups* crew) const {
  // Samples are written alike whether anything was computed before, or all came from a checkpoint.
  flush_subnormals();
  Underway<D> run{entries_of(scene, history, context.version), open_book(scene, history, context), {}, {}};
  try {
    shoot_rest(scene, history, context, run, crew);
  } catch (const Unstable& error) {
    const auto number = std::to_string(number_of(error.shot()));
    const auto kept = keep(scene, error, context, run);
    throw Error((scene.survey.sources.size() > 1 ? "shot " + number + ": " : "") + error.what() +
                    (kept.empty() ? ""
                                  : "; what it recorded until t=" + shown(error.sound_until_s(), 6) +
                                        " s is in " + kept),
                ErrorKind::unstable);
  }
}

/// The traces of all shots that are in the book, taken out of it, by the names of their files.
std::map<std::string, Gather> ShotOutput::gathers_by_file(RunState& book, std::size_t shots) const {
  std::map<std::string, Gather> gathers;
  for (std::size_t shot = 1; shot <= shots; ++shot) {
    Gather* const gather = book.gather(shot);
    if (!gather) continue;
    for (auto& trace : gather->traces) {
      trace.header.shot += first_shot - 1;
      auto& collected = gathers[name_for(traces, number_of(shot), name_of(trace.header.component))];
      collected.axis = gather->axis;
      collected.traces.push_back(std::move(trace));
    }
  }
  return gathers;
}

/// What there is when a shot has become unstable: files of other shots that are whole are put in place, all
/// the rest under other names where that is wanted. These names; what can not be written is a warning.
template <int D>
std::string ShotOutput::keep(const Scene<D>& scene, const Unstable& error, const cli::Context& context,
                             Underway<D>& run) const {
  const auto shots = scene.survey.sources.size();
  std::string kept;
  try {
    if (holds(traces, "{shot}"))
      for (const auto& [name, gather] : gathers_by_file(run.book, shots)) {
        segy::write_gather(run.files.at(name), gather, {}, run.entries);
        run.files.at(name).commit();
      }
    if (!keep_unstable) return "";
    auto entries = run.entries;
    entries.push_back("shot " + std::to_string(number_of(error.shot())) +
                      " became unstable: its samples after " + shown(error.sound_until_s(), 6) +
                      " s are zero");
    for (std::size_t shot = 1; holds(traces, "{shot}") && shot <= shots; ++shot) run.book.forget(shot);
    run.book.finish(error.shot(), error.gather());
    for (const auto& [name, gather] : gathers_by_file(run.book, shots)) {
      OutputFile file(unstable_name(name), OutputFile::Content::binary);
      segy::write_gather(file, gather, {}, entries);
      file.commit();
      kept += (kept.empty() ? "" : ", ") + unstable_name(name);
    }
    if (!run.kept) return kept;
    const auto name = unstable_name(name_for(snapshots, number_of(error.shot()), ""));
    run.kept->commit_as(name);
    kept += (kept.empty() ? "" : ", ") + name;
  } catch (const Error& other) {
    context.warn(other.what());
  }
  return kept;
}

template <int D>
void ShotOutput::shoot_rest(const Scene<D>& scene, const std::string& history, const cli::Context& context,
                            Underway<D>& run, const RankGroups* crew) const {
  const auto& entries = run.entries;
  auto& book = run.book;
  auto& files = run.files;
  auto& kept = run.kept;
  const bool writes = !crew || crew->leads();
  const bool any_trace = writes && !scene.survey.receivers_m.empty(), a_file_a_shot = holds(traces, "{shot}");
  const auto grid = scene.subdomain.whole(scene.model.grid());
  const auto cut = cut_of(grid, slice);
  const auto shots = scene.survey.sources.size(), at_once = crew ? crew->groups() : shots_at_once(scene);
  const auto name_of_file = [&](std::size_t shot, Component component) {
    return name_for(traces, number_of(shot), name_of(component));
  };
  if (!book.continues_at().empty()) context.say("goes on from " + checkpoint + ": " + book.continues_at());
  std::vector<std::size_t> open;
  for (std::size_t shot = 1; shot <= shots; ++shot) {
    if (book.finished(shot) && !in_place_still(scene, book, shot)) book.forget(shot);
    if (!book.finished(shot)) open.push_back(shot);
  }
  const auto open_files = [&](std::size_t shot) {
    for (const Component component : scene.recording.components) {
      const auto name = name_of_file(shot, component);
      if (!any_trace || files.count(name) > 0) continue;
      files.try_emplace(name, name, OutputFile::Content::binary);
    }
  };
  // Writes the files that all shots have been shot for; each trace goes once.
  const auto write_files = [&] {
    for (std::size_t shot = 1; shot <= shots; ++shot)
      if (book.gather(shot)) open_files(shot);
    auto gathers = gathers_by_file(book, shots);
    for (auto& [name, file] : files) {
      segy::write_gather(file, gathers[name], {}, entries);
      file.commit();
    }
    files.clear();
    for (std::size_t shot = 1; shot <= shots; ++shot)
      if (book.finished(shot)) book.release(shot);
  };
  if (a_file_a_shot && writes) write_files();
  for (std::size_t first = 0; first < open.size(); first += at_once) {
    const std::span<const std::size_t> group(open.data() + first, std::min(at_once, open.size() - first));
    for (const auto shot : group) open_files(shot);
    kept.reset();
    if (writes && !snapshots.empty())
      kept.emplace(name_for(snapshots, number_of(group[0]), ""), grid, cut,
                   parse_snapshot_fields<D>(snapshot_fields),
                   SnapshotHistory{"wave fields of shot " + std::to_string(number_of(group[0])),
                                   context.version, history},
                   book, group[0]);
    const auto progress =
        context.progress("shot " + std::to_string(number_of(group.front())) +
                         (group.size() > 1 ? " to " + std::to_string(number_of(group.back())) : ""));
    std::vector<ShotReport> reports(group.size());
    if (crew) {
      const auto sink = kept                ? kept->sink()
                        : snapshots.empty() ? SnapshotSink<D>()
                                            : sink_of_helper<D>(parse_snapshot_fields<D>(snapshot_fields));
      const auto outcomes = crew->shoot(scene, group, writes ? progress : Progress(), sink);
      for (std::size_t n = 0; n < outcomes.size(); ++n) {
        book.finish(outcomes[n].shot, outcomes[n].gather);
        reports[n] = outcomes[n].report;
      }
    } else {
      parallel_jobs(std::int64_t(group.size()), int(at_once), [&](std::int64_t n) {
        const auto shot = group[std::size_t(n)];
        const auto pauses = book.pauses_of(shot, kept ? kept->mark() : RunState::Mark());
        // The first of those that run together speaks for all.
        book.finish(
            shot, shoot(scene, shot, n == 0 ? progress : Progress(), kept ? kept->sink() : SnapshotSink<D>(),
                        pauses.get(), scene.slip_diary ? &reports[std::size_t(n)] : nullptr));
      });
    }
    if (!writes) continue;
    for (std::size_t n = 0; scene.slip_diary && n < group.size(); ++n)
      context.say("shot " + std::to_string(number_of(group[n])) + ": " + sentence_of(reports[n], D));
    if (kept) kept->commit();
    if (a_file_a_shot) write_files();
    if (group.back() != open.back()) book.checkpoint_if_due();
  }
  if (!a_file_a_shot && writes) write_files();
  book.close();
}

template void ShotOutput::check_run(const Scene<2>&, const cli::Context&) const;
template void ShotOutput::check_run(const Scene<3>&, const cli::Context&) const;
template void ShotOutput::shoot_all(const Scene<2>&, const std::string&, const cli::Context&,
                                    const RankGroups*) const;
template void ShotOutput::shoot_all(const Scene<3>&, const std::string&, const cli::Context&,
                                    const RankGroups*) const;

}  // namespace slipwave
