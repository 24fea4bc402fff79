// SPDX-License-Identifier: BSD-3-Clause
#include "shooting/shot_snapshots.hpp"

#include "base/instantiate.hpp"
#include "output/derivatives.hpp"

namespace slipwave {
namespace {

template <int D>
std::array<Field<D>, std::size_t(D)> velocity_of(const FieldReader<D>& field) {
  if constexpr (D == 2)
    return {field(Component::vx), field(Component::vz)};
  else
    return {field(Component::vx), field(Component::vy), field(Component::vz)};
}

template <int D>
Field<D> derivative_of(Derivative derivative, const FieldReader<D>& field) {
  if (derivative == Derivative::divergence) return divergence<D>(velocity_of<D>(field));
  if constexpr (D == 2)
    return curl(velocity_of<D>(field));
  else
    return curl(velocity_of<D>(field))[std::size_t(derivative) - std::size_t(Derivative::curl_x)];
}

template <int D>
Field<D> snapshot_of(const std::string& name, const FieldReader<D>& field) {
  const auto& content = snapshot_field<D>(name).content;
  if (const auto* component = std::get_if<Component>(&content)) return field(*component);
  if (const auto* slip = std::get_if<SlipField>(&content)) return field(*slip);
  return derivative_of<D>(std::get<Derivative>(content), field);
}

template <int D>
Grid<D> cut_grid(const Grid<D>& grid, const std::optional<CellLayer>& cut) {
  if constexpr (D == 3)
    if (cut) return layer_of(grid, *cut);
  return grid;
}

}  // namespace

std::optional<CellLayer> cut_of(const Grid<2>&, const std::string&) { return std::nullopt; }

std::optional<CellLayer> cut_of(const Grid<3>& grid, const std::string& slice) {
  if (slice.empty()) return std::nullopt;
  return layer_on(grid, parse_slice(slice));
}

template <int D>
SnapshotSink<D> sink_of_helper(const std::vector<std::string>& fields) {
  return [fields](double, const FieldReader<D>& field) {
    for (const auto& name : fields) snapshot_of<D>(name, field);
  };
}

template <int D>
ShotSnapshots<D>::ShotSnapshots(const std::string& path, const Grid<D>& grid,
                                const std::optional<CellLayer>& cut, const std::vector<std::string>& fields,
                                const SnapshotHistory& history, const RunState& state, std::size_t shot)
    : cut_(cut), writer_(path, cut_grid(grid, cut), fields, history) {
  if (state.keeps_checkpoints())
    log_.emplace(state.snapshot_log(shot), cut_grid(grid, cut), fields.size(), state.snapshots_of(shot),
                 [this](double time_s, const auto& taken) { writer_.write(time_s, taken); });
}

template <int D>
Field<D> ShotSnapshots<D>::taken(const std::string& name, const FieldReader<D>& field) const {
  auto whole = snapshot_of<D>(name, field);
  if constexpr (D == 3)
    if (cut_) return layer_of(whole, *cut_);
  return whole;
}

template <int D>
SnapshotSink<D> ShotSnapshots<D>::sink() {
  return [this](double time_s, const FieldReader<D>& field) {
    std::vector<Field<D>> all;
    for (const auto& name : writer_.fields()) all.push_back(taken(name, field));
    writer_.write(time_s, all);
    if (log_) log_->append(time_s, all);
  };
}

template <int D>
RunState::Mark ShotSnapshots<D>::mark() {
  if (!log_) return {};
  return [this] { return log_->synchronized(); };
}

SLIPWAVE_INSTANTIATE_D(FUNCTION, sink_of_helper);
SLIPWAVE_INSTANTIATE_D(TYPE, class ShotSnapshots);

}  // namespace slipwave
