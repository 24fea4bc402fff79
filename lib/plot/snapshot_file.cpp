// SPDX-License-Identifier: BSD-3-Clause
#include "plot/snapshot_file.hpp"

#include <cmath>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "model/model_netcdf.hpp"

namespace slipwave::plot {

SnapshotFile::Reader SnapshotFile::open(NetcdfFile file) {
  if (dimension_of(file) == 3) return SnapshotReader<3>(std::move(file));
  return SnapshotReader<2>(std::move(file));
}

SnapshotFile::SnapshotFile(NetcdfFile file, const std::string& minus, const WantedPlanes& wanted)
    : of_(open(std::move(file))) {
  if (const auto* deep = std::get_if<SnapshotReader<3>>(&of_)) {
    const auto planes = in_place(deep->name(), [&] { return planes_of(deep->grid(), wanted); });
    for (const auto& plane : planes) layers_.push_back(layer_on(deep->grid(), plane));
    for (const auto& layer : layers_) grids_.push_back(section_grid(deep->grid(), layer));
  } else {
    const auto& flat = std::get<SnapshotReader<2>>(of_);
    if (wanted.slice || wanted.through)
      throw Error(flat.name() + ": found snapshots in 2-D, expected them in 3-D with --slice",
                  ErrorKind::usage);
    grids_ = {flat.grid()};
  }
  if (minus.empty()) return;
  minus_.emplace(open(NetcdfFile::open(minus)));
  std::visit(
      [](const auto& one, const auto& other) {
        if constexpr (std::is_same_v<decltype(one), decltype(other)>) {
          if (one.grid() == other.grid()) return;
          if (shown(one.grid()) == shown(other.grid()) && (one.grid().rows || other.grid().rows))
            throw Error(other.name() + ": its rows lie at other depths than those of " + one.name() +
                        ", expected the same grid");
        }
        throw Error(other.name() + ": has a grid of " + shown(other.grid()) + ", expected that of " +
                    one.name() + ", " + shown(one.grid()));
      },
      of_, *minus_);
}

const std::vector<double>& SnapshotFile::times_s() const {
  return std::visit(
      [](const auto& reader) -> const auto& { return reader.times_s(); }, of_);
}

const std::vector<std::string>& SnapshotFile::fields() const {
  return std::visit(
      [](const auto& reader) -> const auto& { return reader.fields(); }, of_);
}

std::size_t SnapshotFile::nearest(double time_s) const {
  return std::visit([&](const auto& reader) { return reader.nearest(time_s); }, of_);
}

std::vector<Field<2>> SnapshotFile::values(const Reader& reader, const std::string& field,
                                           std::size_t time) const {
  const auto* deep = std::get_if<SnapshotReader<3>>(&reader);
  if (!deep) return {std::get<SnapshotReader<2>>(reader).read(field, time)};
  const auto volume = deep->read(field, time);
  std::vector<Field<2>> sections;
  for (const auto& layer : layers_) sections.push_back(section_of(volume, layer));
  return sections;
}

std::vector<Snapshot> SnapshotFile::read(const std::string& field, std::size_t time) const {
  const double time_s = times_s()[time];
  const auto unit = std::visit([&](const auto& reader) { return reader.unit(field); }, of_);
  std::vector<Snapshot> snapshots;
  for (auto& section : values(of_, field, time)) {
    snapshots.push_back({field, shown_unit(unit), time_s, std::move(section), {"x", "depth"}});
    if (!layers_.empty()) snapshots.back().axes = section_axes(layers_[snapshots.size() - 1].axis);
  }
  if (!minus_) return snapshots;
  const auto other = std::visit(
      [&](const auto& reader) {
        const auto nearest = reader.nearest(time_s);
        if (std::fabs(reader.times_s()[nearest] - time_s) > 1e-9)
          throw Error(reader.name() + ": has no snapshot at " + shown(time_s) + " s, the nearest is at " +
                      shown(reader.times_s()[nearest]) + " s");
        return nearest;
      },
      *minus_);
  const auto subtrahend = values(*minus_, field, other);
  for (std::size_t section = 0; section < snapshots.size(); ++section)
    for (std::size_t n = 0; n < subtrahend[section].size(); ++n)
      snapshots[section].values[n] -= subtrahend[section][n];
  return snapshots;
}

std::optional<Slice> SnapshotFile::plane(std::size_t section) const {
  const auto* deep = std::get_if<SnapshotReader<3>>(&of_);
  if (!deep) return std::nullopt;
  return plane_of(deep->grid(), layers_[section]);
}

}  // namespace slipwave::plot
