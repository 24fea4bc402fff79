#include <algorithm>

#include "base/error.hpp"
#include "output/snapshot_netcdf.hpp"
#include "shot_output.hpp"

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

}  // namespace

std::string name_for(std::string pattern, std::size_t shot, const std::string& component) {
  replace(pattern, "{shot}", std::to_string(shot));
  replace(pattern, "{component}", component);
  return pattern;
}

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

template <int D>
void ShotOutput::check(std::size_t shots) const {
  check_marks(traces);
  check_marks(snapshots);
  if (!snapshots.empty()) in_place("--fields", [&] { return parse_snapshot_fields<D>(snapshot_fields); });
  if (!slice.empty() && D == 2)
    throw Error("found --slice with a model in 2-D, expected one in 3-D", ErrorKind::usage);
  if (first_shot < 1)
    throw Error("--first-shot: found " + std::to_string(first_shot) + ", expected 1 or more",
                ErrorKind::usage);
  if (!snapshots.empty() && shots > 1 && !holds(snapshots, "{shot}"))
    throw Error("found " + std::to_string(shots) + " sources and --snapshots " + snapshots +
                    ", expected {shot} in the name",
                ErrorKind::usage);
  if (!snapshots.empty() && holds(snapshots, "{component}"))
    throw Error(
        "{component} is for traces, found it in --snapshots " + snapshots + "; choose fields with --fields",
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
      throw Error("--checkpoint and an output both name " + checkpoint + "; give them different names",
                  ErrorKind::usage);
  if (shots_in_parallel < 0)
    throw Error("--shots-in-parallel: found " + std::to_string(shots_in_parallel) + ", expected 0 or more",
                ErrorKind::usage);
  if (!snapshots.empty() && shots_in_parallel > 1)
    throw Error("--snapshots needs --shots-in-parallel 1, found " + std::to_string(shots_in_parallel) +
                    ": snapshots are written one shot after the other",
                ErrorKind::usage);
}

template <int D>
std::vector<std::string> entries_of(const Scene<D>& scene, const std::string& history,
                                    const std::string& version) {
  const auto& source = scene.survey.sources.front();
  const auto& n = scene.numerics;
  std::vector<std::string> entries = {
      version + ": synthetic seismograms",
      "source: " + std::string(name_of<D>(source.mechanism)) + ", wavelet " + source.wavelet.text() +
          ", amplitude " + shown(source.amplitude) + ", wavelet time zero at " +
          shown(source.wavelet.delay_s()) + " s",
      "scheme: grid-characteristic, order " + std::to_string(n.order) + ", time step " +
          shown(time_step_s(scene)) + " s, grid " + shown(scene.subdomain.whole(scene.model.grid())) +
          (scene.slips() || scene.subdomain.slips ? std::string(", slip: ") + name_of(n.correction)
                                                  : std::string(", no slip")),
  };
  for (std::size_t begin = 0; begin < history.size();) {
    const auto end = std::min(history.find('\n', begin), history.size());
    if (end > begin) entries.push_back(history.substr(begin, end - begin));
    begin = end + 1;
  }
  return entries;
}

std::string unstable_name(std::string pattern) { return pattern.insert(pattern.rfind('/') + 1, "unstable-"); }

template void ShotOutput::check<2>(std::size_t) const;
template void ShotOutput::check<3>(std::size_t) const;
template std::vector<std::string> entries_of(const Scene<2>&, const std::string&, const std::string&);
template std::vector<std::string> entries_of(const Scene<3>&, const std::string&, const std::string&);

}  // namespace slipwave
