// SPDX-License-Identifier: BSD-3-Clause
#include "geology/well_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "base/words.hpp"
#include "io/input_bytes.hpp"
#include "io/table.hpp"
#include "rock/relations.hpp"
#include "rock/tilted_mean.hpp"

namespace slipwave {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Curves as they stand in a file.
struct Curves {
  std::vector<ColumnHeader> headers;
  std::vector<std::vector<double>> rows;
  std::vector<std::string> places;  // of rows: "line 17"
  double null = -999.25;
  bool wrapped = true;                                // a row may take several lines
  std::vector<std::pair<ColumnHeader, double>> ends;  // STRT and STOP of LAS
};

/// A text line by line.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const auto end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    ++number_;
    return true;
  }
  std::string place() const { return "line " + std::to_string(number_); }

 private:
  std::string_view rest_;
  std::int64_t number_ = 0;
};

/// "MNEM.UNIT VALUE : DESCRIPTION" of a LAS file.
struct LasItem {
  ColumnHeader header;
  std::string value;
};

LasItem las_item(std::string_view line) {
  LasItem item;
  const auto dot = line.find('.');
  if (dot == std::string_view::npos)
    throw Error("found '" + excerpt(std::string(line)) + "', expected NAME.UNIT VALUE : DESCRIPTION");
  const auto blank = std::min(line.find_first_of(" \t:", dot), line.size());
  item.header = column_header(line.substr(0, blank));
  const auto colon = std::max(line.rfind(':'), blank);
  const auto value = line.substr(blank, colon == std::string_view::npos ? colon : colon - blank);
  const auto first = value.find_first_not_of(" \t");
  if (first != std::string_view::npos)
    item.value = value.substr(first, value.find_last_not_of(" \t") - first + 1);
  return item;
}

/// Numbers of the section ~A. A row may take several lines, and ends where a line does.
void take_las_numbers(std::string_view line, const std::string& place, Curves& curves,
                      std::vector<double>& row) {
  const auto expected = ", expected " + std::to_string(curves.headers.size()) + ", as many as curves";
  while (!line.empty()) {
    const auto end = line.find_first_of(" \t,");
    const std::string word(line.substr(0, end));
    line = end == std::string_view::npos ? std::string_view() : line.substr(end);
    line.remove_prefix(std::min(line.find_first_not_of(" \t,"), line.size()));
    if (row.empty()) curves.places.push_back(place);
    row.push_back(word == "NaN" || word == "nan" ? missing : parse_number(word));
    if (row.size() < curves.headers.size()) continue;
    if (!line.empty()) throw Error("found more values in a row" + expected);
    curves.rows.push_back(std::move(row));
    row.clear();
  }
  if (!row.empty() && !curves.wrapped)
    throw Error("found " + std::to_string(row.size()) + (row.size() == 1 ? " value" : " values") + expected +
                " (WRAP is NO)");
}

void take_las_item(char section, const LasItem& item, Curves& curves) {
  const auto& name = item.header.name;
  if (section == 'C') curves.headers.push_back(item.header);
  if (section == 'W' && name == "null" && !item.value.empty()) curves.null = parse_number(item.value);
  if (section == 'W' && (name == "strt" || name == "stop") && is_number(item.value))
    curves.ends.emplace_back(item.header, parse_number(item.value));
  if (section == 'V' && name == "wrap") curves.wrapped = lower(item.value) != "no";
  if (section == 'V' && name == "vers" && item.value.rfind("1.2", 0) != 0 && item.value.rfind('2', 0) != 0)
    throw Error("found LAS version '" + excerpt(item.value) + "', expected 1.2 or 2.0");
}

Curves read_las(std::string_view text) {
  Curves curves;
  std::vector<double> row;
  Lines lines(text);
  char section = ' ';
  for (std::string_view line; lines.next(line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '~') {
      section = line.size() > 1 ? char(std::toupper(static_cast<unsigned char>(line[1]))) : ' ';
      continue;
    }
    try {
      if (section == 'A' && curves.headers.empty()) throw Error("found data before the section ~Curve");
      if (section == 'A')
        take_las_numbers(line, lines.place(), curves, row);
      else if (section == 'C' ||
               ((section == 'V' || section == 'W') && line.find('.') != std::string_view::npos))
        take_las_item(section, las_item(line), curves);
    } catch (const Error& error) {
      throw Error(lines.place() + ": " + error.what());
    }
  }
  if (!row.empty())
    throw Error("ends within a row of " + std::to_string(curves.headers.size()) + " values, begun on " +
                curves.places.back());
  return curves;
}

Curves read_columns(const std::string& name, std::string text) {
  Table table(name, std::move(text));
  if (table.columns().empty())
    throw Error(
        name + ": found no header line, expected names above the columns, as DEPTH.M VP.M/S VS.M/S RHO.G/CC");
  Curves curves;
  for (std::size_t n = 0; n < table.width(); ++n)
    curves.headers.push_back({table.columns()[n], table.unit(n)});
  while (table.next()) {
    auto& row = curves.rows.emplace_back();
    for (std::size_t n = 0; n < table.width(); ++n) {
      const auto word = table.text(n);
      row.push_back(word.empty() || word == "NaN" || word == "nan" ? missing : table.number(n));
    }
    curves.places.push_back("line " + std::to_string(table.line()));
  }
  return curves;
}

/// A curve that is looked for: its names, those that are sought first before others.
struct Sought {
  const char* what;
  std::vector<std::string> names, sonics;
  std::string unit;
};

const std::vector<Sought>& sought_curves() {
  static const std::vector<Sought> curves = {
      {"depth", {"tvd", "depth", "dept", "md", "z"}, {}, "m"},
      {"vp", {"vp", "pvel", "vpvel"}, {"dt", "dtc", "dtco", "dtp", "ac"}, "m s-1"},
      {"vs", {"vs", "svel", "vsvel"}, {"dts", "dtsm", "dtcs"}, "m s-1"},
      {"rho", {"rho", "rhob", "rhoz", "den", "dens", "density", "zden"}, {}, "kg m-3"}};
  return curves;
}

/// One of them in a file.
struct Found {
  std::size_t column = 0;
  UnitConversion conversion;
};

std::optional<Found> find_curve(const Curves& curves, const Sought& sought, const InputUnits& units,
                                std::string& said) {
  const auto find = [&](const std::vector<std::string>& names) -> std::optional<std::size_t> {
    std::optional<std::size_t> found;
    for (const auto& name : names) {
      for (std::size_t n = 0; n < curves.headers.size(); ++n) {
        if (curves.headers[n].name != name) continue;
        if (found) throw Error("found curve " + name + " twice, expected it once");
        found = n;
      }
      if (found) break;
    }
    return found;
  };
  auto column = find(sought.names);
  const bool is_sonic = !column;
  if (!column) column = find(sought.sonics);
  if (!column) return {};
  const auto& header = curves.headers[*column];
  if (is_sonic && header.unit.empty())
    throw Error("column " + header.name + ": found no unit, expected one, as us/ft or us/m");
  auto conversion = header.conversion(sought.unit);
  if (is_sonic && !conversion.inverse)
    throw Error("column " + header.name + ": found the unit '" + excerpt(header.unit) +
                "', expected one of slowness, as us/ft or us/m");
  if (header.unit.empty() && sought.what != std::string("depth"))
    conversion.factor = units.factor(*find_property(sought.what));
  said += (said.empty() ? "" : ", ") + std::string(sought.what) +
          (header.name == sought.what ? "" : " from " + header.name) +
          (header.unit.empty() ? "" : " (" + header.unit + ")");
  return Found{*column, conversion};
}

void refuse_missing(const std::string& name, const Curves& curves, const Sought& sought) {
  std::vector<std::string> there, wanted = sought.names;
  for (const auto& header : curves.headers) there.push_back(header.name);
  wanted.insert(wanted.end(), sought.sonics.begin(), sought.sonics.end());
  const std::string remedy = sought.what == std::string("vs")    ? ", or --vs-from-vp castagna"
                             : sought.what == std::string("rho") ? ", or --rho-from-vp gardner"
                                                                 : "";
  throw Error(name + ": found no curve of " + sought.what + " among " + joined(there) +
              ", expected one called " + joined(wanted, " or ") + remedy);
}

/// STRT and STOP say the numbers of the depth curve: in another unit one of both is wrong.
void check_ends(const Curves& curves, const Found& depth) {
  if (curves.rows.empty()) return;
  const auto& header = curves.headers[depth.column];
  for (const auto& [end, value] : curves.ends) {
    if (value == 0 || end.unit.empty() || header.unit.empty()) continue;
    const auto said = in_place("~Well: " + end.name, [&, &of = end] { return of.conversion("m"); });
    if (said(value) == depth.conversion(value)) continue;
    for (const auto& row : {curves.rows.front(), curves.rows.back()})
      if (row[depth.column] == value)
        throw Error("found " + shown(value) + " " + excerpt(end.unit) + " in ~Well and " + shown(value) +
                    " " + excerpt(header.unit) + " in the curve " + header.name +
                    ", expected one unit of depths");
  }
}

/// Samples of the curves, in SI; NaN of those that are to be computed.
void take_samples(const Curves& curves, const std::array<std::optional<Found>, 4>& found,
                  const MediumLimits& limits, WellLog& log) {
  for (std::size_t n = 0; n < curves.rows.size(); ++n) {
    std::array<double, 4> values{};
    bool whole = true;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!found[k]) continue;
      const double given = curves.rows[n][found[k]->column];
      whole = whole && std::isfinite(given) && given != curves.null;
      values[k] = found[k]->conversion(given);
    }
    if (!whole || !std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
      ++log.left_out;
      continue;
    }
    const auto refuse = [&](const std::string& sentence) {
      throw Error(log.name + ": " + curves.places[n] + ": " + sentence);
    };
    for (const auto& [k, positive] : {std::pair(1, true), std::pair(2, false), std::pair(3, true)})
      if (found[std::size_t(k)] && !(positive ? values[std::size_t(k)] > 0 : values[std::size_t(k)] >= 0))
        refuse("found " + std::string(sought_curves()[std::size_t(k)].what) + " " +
               shown(values[std::size_t(k)], 6) + ", expected it " + (positive ? "above 0" : "not below 0") +
               "; missing values are " + shown(curves.null) + " (NULL), NaN or nothing");
    if (found[1] && found[2] && !limits.allow_auxetic && values[2] > values[1] / std::sqrt(2.0))
      refuse("found vs " + shown(values[2], 6) + " with vp " + shown(values[1], 6) +
             " m/s, expected vs at most vp/sqrt(2) or a missing value, " + shown(curves.null) +
             " (--allow-auxetic takes it)");
    if (!log.depths_m.empty() && values[0] == log.depths_m.back())
      refuse("found depth " + shown(values[0]) + " m twice, expected each once");
    log.depths_m.push_back(values[0]);
    log.materials.push_back({values[1], values[2], values[3]});
  }
  if (log.depths_m.size() < 2)
    throw Error(log.name + ": found " + std::to_string(log.depths_m.size()) +
                " samples with values of all curves, expected at least 2");
  if (log.depths_m.back() < log.depths_m.front()) {
    std::reverse(log.depths_m.begin(), log.depths_m.end());
    std::reverse(log.materials.begin(), log.materials.end());
  }
  if (log.depths_m.back() <= 0)
    throw Error(log.name + ": found depths from " + shown(log.depths_m.front()) + " to " +
                shown(log.depths_m.back()) +
                " m, expected them to count downwards from the surface; heights change sign");
  for (std::size_t n = 1; n < log.depths_m.size(); ++n)
    if (!(log.depths_m[n] > log.depths_m[n - 1]))
      throw Error(log.name + ": found a depth of " + shown(log.depths_m[n]) + " m beside " +
                  shown(log.depths_m[n - 1]) + " m, expected depths in order");
}

/// vs and density by their relations with vp.
void complete(WellLog& log, const LogChoice& choice) {
  if (!choice.vs_from_vp && !choice.rho_from_vp) return;
  Grid<2> column;
  column.shape = {1, std::int64_t(log.materials.size())};
  column.spacing_m = 1;
  Field<2> vp(column), vs(column);
  for (std::size_t n = 0; n < log.materials.size(); ++n) {
    vp[n] = float(log.materials[n].vp);
    vs[n] = float(log.materials[n].vs);
  }
  if (choice.vs_from_vp) vs = vs_by_castagna(vp, choice.fluid_vp);
  const auto rho = choice.rho_from_vp ? rho_by_gardner(vp, vs) : Field<2>();
  for (std::size_t n = 0; n < log.materials.size(); ++n) {
    if (choice.vs_from_vp) log.materials[n].vs = double(vs[n]);
    if (choice.rho_from_vp) log.materials[n].rho = double(rho[n]);
  }
}

/// The mean of flat layers without the anisotropy that is rounding.
Material layered(const MaterialMean& mean) {
  auto material = mean.of_layers();
  for (double* of : {&material.epsilon, &material.delta, &material.gamma})
    if (std::abs(*of) < least_anisotropy) *of = 0;
  return material;
}

/// The sample from `first` on that is nearest to a depth.
std::size_t nearest_sample(const std::vector<double>& depths_m, std::size_t first, double depth_m) {
  const auto next = std::lower_bound(depths_m.begin() + std::ptrdiff_t(first), depths_m.end(), depth_m);
  const auto n = std::size_t(next - depths_m.begin());
  if (n == depths_m.size()) return n - 1;
  return n > first && depth_m - depths_m[n - 1] <= depths_m[n] - depth_m ? n - 1 : n;
}

}  // namespace

WellLog read_well_log(const std::string& path, const LogChoice& choice) {
  WellLog log;
  log.name = shown_input(path);
  const auto text = read_text(path);
  const auto first = text.find_first_not_of(" \t\r\n");
  const bool is_las =
      first != std::string::npos && (text[first] == '~' || text.find("\n~") != std::string::npos);
  const auto curves =
      is_las ? in_place(log.name, [&] { return read_las(text); }) : read_columns(log.name, text);
  std::array<std::optional<Found>, 4> found;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& sought = sought_curves()[k];
    const bool computed = (k == 2 && choice.vs_from_vp) || (k == 3 && choice.rho_from_vp);
    if (!computed)
      found[k] = in_place(log.name, [&] { return find_curve(curves, sought, choice.units, log.curves); });
    if (!found[k] && !computed) refuse_missing(log.name, curves, sought);
    if (computed) log.curves += k == 2 ? ", vs by Castagna's line" : ", rho by Gardner's relation";
  }
  in_place(log.name, [&] { check_ends(curves, *found[0]); });
  take_samples(curves, found, choice.limits, log);
  complete(log, choice);
  return log;
}

void fill_from_log(Layer& layer, double spacing_m) {
  const auto& [depths, materials, block_m, flat_layers] = *layer.log;
  const double thickness = std::max(block_m.value_or(spacing_m), spacing_m);
  const double top = std::round(depths.front() / spacing_m) * spacing_m;
  const auto blocks =
      std::max<std::int64_t>(1, std::int64_t(std::ceil((depths.back() - top) / thickness - 0.5)));
  layer.profile.clear();
  std::size_t first = 0;
  for (std::int64_t block = 0; block < blocks; ++block) {
    const double from = top + double(block) * thickness, to = from + thickness;
    while (first + 1 < depths.size() && (depths[first] + depths[first + 1]) / 2 <= from) ++first;
    MaterialMean mean(materials[nearest_sample(depths, first, (from + to) / 2)]);
    for (std::size_t n = first; n < depths.size(); ++n) {
      const double upper = n == 0 ? from : std::max(from, (depths[n - 1] + depths[n]) / 2);
      const double lower = n + 1 == depths.size() ? to : std::min(to, (depths[n] + depths[n + 1]) / 2);
      if (upper >= to) break;
      if (lower > upper) mean.add(materials[n], lower - upper);
    }
    layer.profile.push_back({double(block + 1) * thickness, flat_layers ? layered(mean) : mean.mean()});
  }
  layer.top = Horizon(top);
  layer.material = layer.profile.front().material;
}

Layer layer_of_log(const WellLog& log, double spacing_m, bool in_3d, const LogChoice& choice) {
  if (choice.block_m && !(*choice.block_m >= spacing_m * (1 - 1e-9)))
    throw Error("found blocks of " + shown(*choice.block_m) + " m, expected at least a cell, " +
                    shown(spacing_m) + " m",
                ErrorKind::usage);
  for (std::size_t n = 1; n < log.depths_m.size(); ++n)
    if ((log.materials[n].vs == 0) != (log.materials[0].vs == 0))
      throw Error(log.name + ": found fluid beside rock (vs 0) at " + shown(log.depths_m[n]) +
                  " m, expected a log of one of them; give water as a --layer");
  Layer layer;
  layer.log = {log.depths_m, log.materials, choice.block_m, choice.layered};
  fill_from_log(layer, spacing_m);
  double from = layer.top.depth_m();
  for (const auto& block : layer.profile) {
    const double to = layer.top.depth_m() + block.to_m, middle = (from + to) / 2;
    if (std::abs(log.depths_m[nearest_sample(log.depths_m, 0, middle)] - middle) > to - from)
      throw Error(log.name + ": found no values of all curves from " + shown(from, 8) + " to " +
                  shown(to, 8) + " m, expected some in each block of " + shown(to - from) +
                  " m: fill the gap or cut the log there");
    from = to;
  }
  if (!choice.layered) return layer;
  for (const auto property : {Property::epsilon, Property::delta}) layer.others.emplace_back(property, 0);
  if (in_3d) layer.others.emplace_back(Property::gamma, 0);
  return layer;
}

std::string report_of_log(const WellLog& log, const Layer& layer, const LogChoice& choice) {
  double least = std::numeric_limits<double>::infinity(), largest = 0, anisotropy = 0;
  for (const auto& block : layer.profile) {
    least = std::min(least, block.material.vp);
    largest = std::max(largest, block.material.vp);
    anisotropy = std::max(anisotropy, block.material.epsilon);
  }
  return log.name + ": " + std::to_string(log.depths_m.size()) + " samples from " +
         shown(log.depths_m.front()) + " to " + shown(log.depths_m.back()) + " m" +
         (log.left_out == 0 ? ""
                            : " (" + std::to_string(log.left_out) + " rows without all values left out)") +
         ", " + log.curves + ": " + std::to_string(layer.profile.size()) +
         (choice.layered ? " Backus averages" : " blocks") + " from " + layer.top.name() + " on, vp " +
         shown(least, 5) + " to " + shown(largest, 5) + " m/s" +
         (choice.layered ? ", epsilon up to " + shown(anisotropy, 3) : "") + "; the last continues below";
}

}  // namespace slipwave
