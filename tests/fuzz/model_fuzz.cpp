// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "accuracy/table.hpp"
#include "base/error.hpp"
#include "build/import.hpp"
#include "io/netcdf_file.hpp"
#include "io/netcdf_probe.hpp"
#include "memory_file.hpp"
#include "model/model_netcdf.hpp"
#include "model/model_report.hpp"
#include "model_file.hpp"
#include "output/snapshot_reader.hpp"

// What we make of netCDF files that the library finds in order. Damaged ones are the library's business: it
// does not survive them, which is why a child process looks first.

namespace slipwave {

/// In place of the library's: nothing is damaged here, and a process for each input would take most of the
/// time.
void probe_netcdf(const std::function<int()>&, const ProbeLimits&) {}

}  // namespace slipwave

namespace {

using namespace slipwave;
using fuzz::fail;

const std::string name = "m.nc";

/// Runs `body` and says whether it came to its end; an Error must name the file, and nothing else may be
/// thrown.
template <class Body>
bool answers(Body&& body) {
  try {
    body();
    return true;
  } catch (const Error& error) {
    const std::string said = error.what();
    if (!said.starts_with(name + ": ")) fail("names no file: " + said);
    return false;
  }
}

void expect(bool holds, const std::string& what) {
  if (!holds) fail(what);
}

/// A model that is let through is one that can be computed.
template <int D>
bool read_models(const NetcdfFile& file) {
  return answers([&] {
    const auto model = read_model<D>(file);
    in_place(name, [&] { check(model, {}); });
    report_of(model);
    const auto& grid = model.grid();
    expect(grid.spacing_m > 0 && std::isfinite(grid.spacing_m), "the step is no length");
    const auto cells = std::size_t(grid.size());
    const auto& medium = model.medium;
    expect(medium.vs.size() == cells && medium.rho.size() == cells, "fields of several sizes");
    for (std::size_t n = 0; n < cells; ++n) {
      const double vp = medium.vp[n], vs = medium.vs[n], rho = medium.rho[n];
      expect(std::isfinite(vp) && std::isfinite(rho) && vs >= 0 && vs <= vp && rho >= 0, "no medium");
    }
    expect(model.fracture.size() == 0 || model.fracture.size() == cells, "fractures of another size");
    for (const auto code : model.fracture) expect(code <= model.fracture_sets.size(), "a set that is not");
    for (const auto& set : model.fracture_sets)
      for (const auto& system : set.systems)
        expect(system.friction >= 0 && system.viscosity_s >= 0 && std::isfinite(system.strength_pa),
               "a law that is none");
  });
}

template <int D>
bool read_snapshots(NetcdfFile file) {
  return answers([&] {
    const SnapshotReader<D> reader(std::move(file));
    for (const auto& field : reader.fields()) {
      const auto snapshot = reader.read(field, reader.nearest(0.1));
      expect(snapshot.grid() == reader.grid(), "a snapshot of another grid");
      reader.unit(field);
    }
  });
}

bool read_tables(const NetcdfFile& file) {
  return answers([&] {
    const auto table = read_accuracy_table(file);
    expect(!table.chosen || *table.chosen < table.rows.size(), "a row that is not");
    text_of(table);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* first, std::size_t size) {
  auto file = NetcdfFile::open(fuzz::model_file({first, size}), name);
  answers([&] { kind_of(file); });
  answers([&] { report_of(file); });
  const bool plane = read_models<2>(file), deep = read_models<3>(file), table = read_tables(file);
  for (const Property property : {Property::vp, Property::rho})
    answers([&] { field_from_netcdf(file, row_of(property), property == Property::vp ? "" : "rho", {}); });
  // Opening takes most of the time: once is enough.
  const bool shots =
      file.has_variable("y") ? read_snapshots<3>(std::move(file)) : read_snapshots<2>(std::move(file));
  // Else nothing but refusals would be tried.
  if (size < 2) expect((plane || deep) && table && shots, "the good file is refused");
  return 0;
}
