// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/table.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/error.hpp"
#include "io/netcdf_file.hpp"

namespace slipwave {
namespace {

using Type = NetcdfFile::Type;

constexpr const char* dimension = "setting";

/// A column of the table: its name in the file, what it is, and where it stands in a row.
template <class Value>
struct Column {
  const char* name;
  const char* long_name;
  const char* units;
  Value AccuracyRow::*place;
};

constexpr Column<int> whole_numbers[] = {
    {"order", "order of the reconstruction in space", "1", &AccuracyRow::order},
    {"time_order", "order of the splitting in time", "1", &AccuracyRow::time_order},
    {"slip_order", "order of the slip correction, 3 = exponential, 4 = centred, 0 where nothing slips", "1",
     &AccuracyRow::slip_order},
};
/// Only where a row is.
constexpr Column<int> monotone = {"monotone", "1: kept to the criterion of monotonicity", "1",
                                  &AccuracyRow::monotone};
// Counts are stored as doubles: exact to 2^53, which int is not.
constexpr Column<std::int64_t> counts[] = {
    {"cells", "cells computed, absorbing zones included", "1", &AccuracyRow::cells},
    {"steps", "time steps", "1", &AccuracyRow::steps},
};
constexpr Column<double> numbers[] = {
    {"courant", "largest speed times time step over cell size", "1", &AccuracyRow::courant},
    {"step", "cell size", "m", &AccuracyRow::spacing_m},
    {"error", "relative L2 error of all traces", "1", &AccuracyRow::error},
    {"late_error", "relative L2 error of the last quarter of the traces", "1", &AccuracyRow::late_error},
    {"seconds", "processor time, all threads together", "s", &AccuracyRow::seconds},
    {"memory", "memory of the run", "byte", &AccuracyRow::memory_bytes},
};

template <class Stored, class Value>
void put(NetcdfFile& file, const Column<Value>& column, Type type, const std::vector<AccuracyRow>& rows) {
  std::vector<Stored> values;
  for (const auto& row : rows) values.push_back(Stored(row.*column.place));
  file.define_variable(column.name, type, {dimension});
  file.put_attribute(column.name, "long_name", column.long_name);
  file.put_attribute(column.name, "units", column.units);
  file.put(column.name, values.data());
}

/// The first column makes the rows: a damaged length is refused by the file before memory is taken for it.
template <class Stored, class Value>
void get(const NetcdfFile& file, const Column<Value>& column, std::size_t count,
         std::vector<AccuracyRow>& rows) {
  if (!file.has_variable(column.name))
    throw Error(file.shown_name() + ": found no variable " + column.name +
                ", expected a table of sw-accuracy");
  const auto values = file.get<Stored>(column.name);
  if (values.size() != count)
    throw Error(file.shown_name() + ": found " + std::to_string(values.size()) + " values of " + column.name +
                ", expected " + std::to_string(count));
  rows.resize(count);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    // Where a count comes from a double: beyond 2^53 it could not have been written.
    if constexpr (std::is_same_v<Value, std::int64_t>)
      if (!(values[n] >= 0 && values[n] <= 9007199254740992.))
        throw Error(file.shown_name() + ": found " + column.name + " = " + shown(values[n]) +
                    ", expected a count");
    rows[n].*column.place = Value(values[n]);
  }
}

}  // namespace

void write_accuracy_table(OutputFile& out, const AccuracyTable& table, const std::string& version) {
  auto file = NetcdfFile::create(out.path_for_libraries(), out.shown_name());
  file.put_attribute("", "Conventions", "CF-1.10");
  file.put_attribute("", "title", table.title);
  file.put_attribute("", "source", version);
  file.put_attribute("", "history", table.history);
  file.put_attribute("", "reference", table.reference);
  if (table.reference_error)
    file.put_attribute("", "reference_error", std::vector<double>{*table.reference_error});
  if (table.wanted_error) file.put_attribute("", "wanted_error", std::vector<double>{*table.wanted_error});
  if (table.chosen) file.put_attribute("", "chosen", std::vector<int>{int(*table.chosen)});
  file.define_dimension(dimension, table.rows.size());
  for (const auto& column : whole_numbers) put<int>(file, column, Type::i32, table.rows);
  if (std::any_of(table.rows.begin(), table.rows.end(), [](const auto& row) { return row.monotone; }))
    put<int>(file, monotone, Type::i32, table.rows);
  for (const auto& column : counts) put<double>(file, column, Type::f64, table.rows);
  for (const auto& column : numbers) put<double>(file, column, Type::f64, table.rows);
  file.close();
  out.commit();
}

AccuracyTable read_accuracy_table(const std::string& path) {
  return read_accuracy_table(NetcdfFile::open(path));
}

AccuracyTable read_accuracy_table(const NetcdfFile& file) {
  const auto rows = file.dimension_length(dimension);
  if (!rows)
    throw Error(file.shown_name() + ": found no dimension " + dimension +
                ", expected a table of sw-accuracy");
  AccuracyTable table;
  for (const auto& column : whole_numbers) get<int>(file, column, *rows, table.rows);
  if (file.has_variable(monotone.name)) get<int>(file, monotone, *rows, table.rows);
  for (const auto& column : counts) get<double>(file, column, *rows, table.rows);
  for (const auto& column : numbers) get<double>(file, column, *rows, table.rows);
  table.title = file.text_attribute("", "title").value_or("");
  table.history = file.text_attribute("", "history").value_or("");
  table.reference = file.text_attribute("", "reference").value_or("");
  const auto number = [&](const char* name) -> std::optional<double> {
    const auto values = file.number_attribute("", name);
    if (!values || values->size() != 1) return std::nullopt;
    return values->front();
  };
  table.reference_error = number("reference_error");
  table.wanted_error = number("wanted_error");
  if (const auto chosen = number("chosen")) {
    if (!(*chosen >= 0 && *chosen < double(table.rows.size()) && *chosen == std::floor(*chosen)))
      throw Error(file.shown_name() + ": found chosen = " + shown(*chosen) + ", expected a row below " +
                  std::to_string(table.rows.size()));
    table.chosen = std::size_t(*chosen);
  }
  return table;
}

}  // namespace slipwave
