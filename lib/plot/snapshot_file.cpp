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

SnapshotFile::SnapshotFile(NetcdfFile file, const std::string& minus, const std::optional<Slice>& slice)
    : of_(open(std::move(file))) {
  if (const auto* deep = std::get_if<SnapshotReader<3>>(&of_)) {
    layer_ = in_place(deep->name(), [&] { return layer_to_show(deep->grid(), slice); });
    grid_ = section_grid(deep->grid(), *layer_);
  } else {
    const auto& flat = std::get<SnapshotReader<2>>(of_);
    if (slice)
      throw Error(flat.name() + ": found snapshots in 2-D, expected them in 3-D with --slice",
                  ErrorKind::usage);
    grid_ = flat.grid();
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

Field<2> SnapshotFile::values(const Reader& reader, const std::string& field, std::size_t time) const {
  if (const auto* deep = std::get_if<SnapshotReader<3>>(&reader))
    return section_of(deep->read(field, time), *layer_);
  return std::get<SnapshotReader<2>>(reader).read(field, time);
}

Snapshot SnapshotFile::read(const std::string& field, std::size_t time) const {
  const double time_s = times_s()[time];
  const auto unit = std::visit([&](const auto& reader) { return reader.unit(field); }, of_);
  Snapshot snapshot{field, shown_unit(unit), time_s, values(of_, field, time), {"x", "depth"}};
  if (layer_) snapshot.axes = section_axes(layer_->axis);
  if (!minus_) return snapshot;
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
  for (std::size_t n = 0; n < subtrahend.size(); ++n) snapshot.values[n] -= subtrahend[n];
  return snapshot;
}

std::optional<Slice> SnapshotFile::slice() const {
  const auto* deep = std::get_if<SnapshotReader<3>>(&of_);
  if (!deep) return std::nullopt;
  return plane_of(deep->grid(), *layer_);
}

}  // namespace slipwave::plot
