// SPDX-License-Identifier: BSD-3-Clause
#include "plot/input_file.hpp"

#include <cstdint>

#include "base/error.hpp"
#include "io/input_bytes.hpp"
#include "io/netcdf_container.hpp"
#include "model/model_report.hpp"
#include "segy/sniff.hpp"

namespace slipwave::plot {
namespace {

InputFile::Kind kind_of_netcdf(const NetcdfFile& file) {
  const std::string kind = kind_of(file);
  if (kind == "model") return InputFile::Kind::model;
  if (kind == "snapshots") return InputFile::Kind::snapshots;
  if (file.dimension_length("setting")) return InputFile::Kind::accuracy;
  if (file.dimension_length("frequency")) return InputFile::Kind::spectra;
  throw Error(file.shown_name() + ": is netCDF, but no model, snapshots, spectra or table of sw-accuracy");
}

}  // namespace

std::string InputFile::history() const {
  return file ? file->text_attribute("", "history").value_or("") : "";
}

InputFile open_input(const std::string& path, bool su) {
  const InputStart start(path, 3600);
  const auto& first = start.bytes();
  InputFile input{path, InputFile::Kind::gather, std::nullopt, start.taken()};
  if (begins_netcdf({first.data(), first.size()})) {
    input.file = start.is_regular() ? NetcdfFile::open(path)
                                    : NetcdfFile::open(read_all(path, start.taken()), shown_input(path));
    input.kind = kind_of_netcdf(*input.file);
    return input;
  }
  const std::vector<std::uint8_t> bytes(first.begin(), first.end());
  if (!su && !segy::looks_like_segy(bytes))
    throw Error(shown_input(path) + ": is " +
                (first.empty() ? "empty" : "not a netCDF, SEG-Y or Seismic Unix file") +
                ", expected a model, snapshots, spectra, errors or a gather");
  return input;
}

}  // namespace slipwave::plot
