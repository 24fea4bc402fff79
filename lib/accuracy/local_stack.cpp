// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/local_stack.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <sstream>

#include "base/error.hpp"
#include "base/parse.hpp"
#include "grid/locate.hpp"
#include "model/tilted_mean.hpp"

namespace slipwave {
namespace {

/// Layers at most; of more the weakest interfaces are left out.
constexpr std::size_t most_layers = 6;
/// Cells whose speeds differ by less than this belong together.
constexpr double same_rock = 0.01, same_layer = 0.1;
/// Rows of a bed too thin for its sides to be told apart everywhere.
constexpr double thin_bed = 8;
/// Cells cut by an interface, in a column.
constexpr std::int64_t most_cut = 4;

enum class Matter { empty, fluid, solid };

struct Cell {
  Matter matter;
  double vp, vs, rho;
  double stiffness() const { return rho * vp * vp; }
};

/// Columns of a model: their cells and the depths of their faces.
class Columns {
 public:
  explicit Columns(const Medium<2>& medium) : medium_(medium), grid_(medium.grid()) {}
  std::int64_t count() const { return grid_.shape[0]; }
  std::int64_t rows() const { return grid_.shape[1]; }
  double spacing() const { return grid_.spacing_m; }
  double x(std::int64_t i) const { return grid_.centre(0, i); }
  std::int64_t at(double x_m) const {
    return std::clamp<std::int64_t>(std::int64_t(std::floor(grid_.position(0, x_m) + 0.5)), 0, count() - 1);
  }
  Cell cell(std::int64_t i, std::int64_t k) const {
    const auto n = std::size_t(grid_.flat({i, k}));
    return {medium_.is_void(n)    ? Matter::empty
            : medium_.is_fluid(n) ? Matter::fluid
                                  : Matter::solid,
            medium_.vp[n], medium_.vs[n], medium_.rho[n]};
  }
  /// Whether only air lies above a row of a column.
  bool is_ground(std::int64_t i, std::int64_t row) const {
    for (std::int64_t k = 0; k < row; ++k)
      if (cell(i, k).matter != Matter::empty) return false;
    return true;
  }
  /// 1/qp or 1/qs, the mean over rows of a column.
  double loss(std::int64_t i, std::int64_t first, std::int64_t last, Property quality) const {
    double sum = 0;
    for (auto k = first; k < last; ++k) sum += 1 / medium_.value(quality, std::size_t(grid_.flat({i, k})));
    return sum / double(last - first);
  }
  /// Of the upper face of a row.
  double face(std::int64_t i, std::int64_t k) const {
    if (!grid_.rows) return grid_.origin_m[1] + double(grid_.first[1] + k) * grid_.spacing_m;
    const Index<2> at = {grid_.first[0] + i, grid_.first[1] + k};
    return (grid_.rows->corner(at) + grid_.rows->corner({at[0] + 1, at[1]})) / 2;
  }
  /// Of a row coordinate counted in cells from the first face.
  double depth(std::int64_t i, double row) const {
    const auto k = std::clamp<std::int64_t>(std::int64_t(row), 0, rows() - 1);
    const double top = face(i, k);
    return top + (row - double(k)) * (face(i, k + 1) - top);
  }

 private:
  const Medium<2>& medium_;
  const Grid<2>& grid_;
};

/// Cells of a column that belong together.
struct Segment {
  std::int64_t first, last;  // rows; behind the last
  Cell rock;                 // mean
  bool jumps = true;         // whether it begins with a jump, not where a gradient has come far enough
  double height(const Columns& columns, std::int64_t i) const {
    return columns.face(i, last) - columns.face(i, first);
  }
};

bool near(double a, double b, double share) { return std::abs(a - b) <= share * std::max(a, b); }
bool alike(const Cell& a, const Cell& b, double share) {
  return a.matter == b.matter && near(a.vp, b.vp, share) && near(a.vs, b.vs, share) &&
         near(a.rho, b.rho, share);
}

Segment joined(const Segment& a, const Segment& b) {
  const double n = double(a.last - a.first), m = double(b.last - b.first), all = n + m;
  Cell rock = a.rock;
  rock.vp = all / (n / a.rock.vp + m / b.rock.vp);
  if (a.rock.vs > 0 && b.rock.vs > 0) rock.vs = all / (n / a.rock.vs + m / b.rock.vs);
  rock.rho = (n * a.rock.rho + m * b.rock.rho) / all;
  return {a.first, b.last, rock, a.jumps};
}

std::vector<Segment> segments_of(const Columns& columns, std::int64_t i) {
  std::vector<Segment> segments;
  Cell before{};
  for (std::int64_t k = 0; k < columns.rows(); ++k) {
    const auto cell = columns.cell(i, k);
    if (cell.matter == Matter::empty && !segments.empty()) break;
    if (cell.matter == Matter::empty) continue;
    const bool jumps = segments.empty() || !alike(cell, before, same_rock);
    const Segment one{k, k + 1, cell, jumps};
    if (!jumps && alike(cell, segments.back().rock, same_layer))
      segments.back() = joined(segments.back(), one);
    else
      segments.push_back(one);
    before = cell;
  }
  return segments;
}

bool between(double a, double middle, double b) {
  return middle >= std::min(a, b) * (1 - 1e-6) && middle <= std::max(a, b) * (1 + 1e-6);
}

/// Takes segments out that are but cells cut by an interface between their neighbours: each half of them goes
/// to either side.
void join_cut_cells(std::vector<Segment>& segments) {
  // Where all lies on every third or fourth face, the model may have been split, and its cut cells with it.
  std::int64_t every = 0;
  for (std::size_t n = 1; n < segments.size(); ++n) every = std::gcd(every, segments[n].first);
  const std::int64_t longest = every > 0 && every % 4 == 0 ? 4 : every > 0 && every % 3 == 0 ? 3 : 2;
  for (std::size_t n = 1; n + 1 < segments.size();) {
    std::size_t end = n;
    while (end + 1 < segments.size() && segments[end].last - segments[n].first <= most_cut &&
           segments[end].last - segments[end].first <= longest)
      ++end;
    bool cut = false;
    for (; end > n && !cut; --end) {
      const auto &upper = segments[n - 1].rock, &lower = segments[end].rock;
      cut =
          upper.matter == lower.matter && segments[n].jumps && segments[n].first > segments[n - 1].first + 1;
      for (std::size_t m = n; m < end && cut; ++m)
        cut = segments[m].rock.matter == upper.matter &&
              between(upper.stiffness(), segments[m].rock.stiffness(), lower.stiffness());
      if (!cut) continue;
      const auto middle = (segments[n].first + segments[end - 1].last) / 2;
      segments[n - 1].last = segments[end].first = middle;
      segments.erase(segments.begin() + std::ptrdiff_t(n), segments.begin() + std::ptrdiff_t(end));
      break;
    }
    if (!cut) ++n;
  }
}

double ratio(double a, double b) { return a > b ? a / b : b / a; }

/// How strong the interface between two rocks is.
double contrast_of(const Cell& a, const Cell& b) {
  if (a.matter != b.matter) return 10;
  const double p = ratio(a.rho * a.vp, b.rho * b.vp);
  return a.vs > 0 ? std::max(p, ratio(a.rho * a.vs, b.rho * b.vs)) : p;
}

/// An interface that is left out: the row behind it, and the rocks on both sides.
struct Weak {
  std::int64_t row;
  Cell upper, lower;
};

/// Leaves out the weakest interfaces; the rocks on both sides are joined.
std::vector<Weak> join_weakest(std::vector<Segment>& segments) {
  std::vector<Weak> left_out;
  for (;;) {
    std::size_t weakest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n + 1 < segments.size(); ++n) {
      const auto &a = segments[n], &b = segments[n + 1];
      if (a.rock.matter != b.rock.matter) continue;
      const auto thinner = double(std::min(a.last - a.first, b.last - b.first));
      const double strength = (contrast_of(a.rock, b.rock) - 1) * std::min(1., thinner / 10);
      if (strength < least) least = strength, weakest = n;
    }
    if (std::isinf(least) || (segments.size() <= most_layers && least > 0.005)) return left_out;
    left_out.push_back({segments[weakest].last, segments[weakest].rock, segments[weakest + 1].rock});
    segments[weakest] = joined(segments[weakest], segments[weakest + 1]);
    segments.erase(segments.begin() + std::ptrdiff_t(weakest) + 1);
  }
}

/// An interface followed from column to column.
class Follower {
 public:
  Follower(const Columns& columns, const Cell& upper, const Cell& lower)
      : columns_(columns), upper_(upper), lower_(lower) {}
  /// The row coordinate of the interface in a column, near one; nothing where it is not there.
  std::optional<double> row(std::int64_t i, double near_row) const {
    const auto middle = std::int64_t(std::lround(near_row));
    const auto first = std::max<std::int64_t>(middle - reach, 0);
    const auto end = std::min(middle + reach, columns_.rows());
    if (const auto face = jump(i, first, end)) return double(*face);
    double above = 0;
    bool in_upper = true;
    for (auto k = first; k < end; ++k) {
      // Behind the first cell of the lower rock nothing counts: there may be a thin bed.
      const double share = in_upper ? share_of_upper(columns_.cell(i, k)) : 0;
      above += share;
      in_upper = share > 1e-3 || k == first;
      if (share <= 1e-3 && k == first && first > 0) return std::nullopt;
    }
    if (above >= double(end - first)) return std::nullopt;
    return double(first) + above;
  }

 private:
  static constexpr std::int64_t reach = 6;
  /// The face at which rock changes at once by most of what these two differ by, where it hardly changes from
  /// cell to cell near it: within layers with gradients, too. A cut cell that was split changes twice.
  std::optional<std::int64_t> jump(std::int64_t i, std::int64_t first, std::int64_t end) const {
    if (upper_.matter != lower_.matter) return std::nullopt;
    const double whole = std::log(lower_.stiffness() / upper_.stiffness());
    std::optional<std::int64_t> found;
    for (auto k = first + 1; k < end; ++k) {
      const auto above = columns_.cell(i, k - 1), below = columns_.cell(i, k);
      if (above.matter != upper_.matter || below.matter != upper_.matter) continue;
      const double change = std::log(below.stiffness() / above.stiffness()) / whole;
      if (std::abs(change) < 0.05) continue;
      if (found || change < 0.5 || change > 1.5) return std::nullopt;
      found = k;
    }
    return found;
  }
  double share_of_upper(const Cell& cell) const {
    if (upper_.matter != lower_.matter) return cell.matter == upper_.matter ? 1 : 0;
    if (cell.matter != upper_.matter) return 0;
    const auto quantity = [](const Cell& c) { return 1 / c.stiffness(); };
    const double span = quantity(upper_) - quantity(lower_);
    if (std::abs(span) * upper_.stiffness() < 0.02) return 0;
    const double share = std::clamp((quantity(cell) - quantity(lower_)) / span, 0., 1.);
    // Rock changes a little within layers.
    return share > 0.97 ? 1 : share < 0.03 ? 0 : share;
  }
  const Columns& columns_;
  Cell upper_, lower_;
};

/// Its places along the columns that matter.
struct Followed {
  std::int64_t first = 0;    // column
  std::vector<double> rows;  // row coordinates
  double row(std::int64_t i) const {
    return rows[std::size_t(std::clamp<std::int64_t>(i - first, 0, std::int64_t(rows.size()) - 1))];
  }
};

Followed follow(const Follower& follower, std::int64_t start, double row, std::int64_t low,
                std::int64_t high) {
  std::vector<double> left, right;
  const double first = follower.row(start, row).value_or(row);
  double at = first;
  for (auto i = start; i-- > low;) {
    const auto next = follower.row(i, at);
    if (!next) break;
    left.push_back(at = *next);
  }
  at = first;
  for (auto i = start + 1; i <= high; ++i) {
    const auto next = follower.row(i, at);
    if (!next) break;
    right.push_back(at = *next);
  }
  Followed found{start - std::int64_t(left.size()), {left.rbegin(), left.rend()}};
  found.rows.push_back(first);
  found.rows.insert(found.rows.end(), right.begin(), right.end());
  return found;
}

double degrees(double slope) { return std::atan(slope) * 180 / std::numbers::pi; }

/// Slope of the straight line nearest to depths at columns [first, end) of what was followed.
double slope_of(const Columns& columns, const Followed& line, std::size_t first, std::size_t end) {
  double x = 0, z = 0, xx = 0, xz = 0;
  const double n = double(end - first);
  if (end < first + 3) return 0;
  for (auto m = first; m < end; ++m) {
    const double xm = double(m) * columns.spacing();
    const double zm = columns.depth(line.first + std::int64_t(m), line.rows[m]);
    x += xm, z += zm, xx += xm * xm, xz += xm * zm;
  }
  return (xz - x * z / n) / (xx - x * x / n);
}

/// Columns from step to step of an interface that is not level: a multiple of what a cell was split into.
std::int64_t block_of(const Followed& line) {
  std::int64_t block = 0, before = -1;
  for (std::size_t m = 1; m < line.rows.size(); ++m) {
    if (std::abs(line.rows[m] - line.rows[m - 1]) < 1e-3) continue;
    if (before >= 0) block = std::gcd(block, std::int64_t(m) - before);
    before = std::int64_t(m);
    block = std::gcd(block, std::int64_t(std::lround(std::abs(line.rows[m] - line.rows[m - 1]))));
  }
  return std::max<std::int64_t>(block, 1);
}

/// Whether it continues as it came, from a quarter to the next.
bool is_straight(const Followed& line) {
  const auto& rows = line.rows;
  const auto quarter = rows.size() / 4;
  if (quarter < 4) return false;
  double least = 1e30, most = -1e30;
  for (std::size_t n = 0; n < 4; ++n) {
    const double slope = (rows[(n + 1) * quarter - 1] - rows[n * quarter]) / double(quarter);
    least = std::min(least, slope);
    most = std::max(most, slope);
  }
  return most - least < 0.2;
}

/// See LocalInterface::curvature_per_m.
double curvature_of(const Columns& columns, const Followed& line) {
  const auto depth = [&](std::size_t m) { return columns.depth(line.first + std::int64_t(m), line.rows[m]); };
  const std::size_t count = line.rows.size();
  if (count < 3) return 0;
  double sum = 0;
  for (std::size_t m = 1; m + 1 < count; ++m)
    sum +=
        std::pow((depth(m - 1) - 2 * depth(m) + depth(m + 1)) / (columns.spacing() * columns.spacing()), 4);
  return std::pow(sum / double(count - 2), 0.25);
}

void describe(const Columns& columns, const Followed& line, LocalInterface& interface, bool rows_bend) {
  const auto count = line.rows.size();
  interface.dip_deg = degrees(slope_of(columns, line, 0, count));
  interface.steepest_deg = std::abs(interface.dip_deg);
  // Stairs of a gentle slope are long.
  const std::size_t window = std::max<std::size_t>(24, count / 6);
  for (std::size_t m = 0; m + window <= count; m += window / 2)
    interface.steepest_deg =
        std::max(interface.steepest_deg, std::abs(degrees(slope_of(columns, line, m, m + window))));
  interface.from_x_m = columns.x(line.first) - columns.spacing() / 2;
  interface.to_x_m = columns.x(line.first + std::int64_t(count) - 1) + columns.spacing() / 2;
  const auto [low, high] = std::minmax_element(line.rows.begin(), line.rows.end());
  interface.stairs = *high - *low;
  interface.block = block_of(line);
  interface.cut = *low - std::floor(*low);
  const bool in_one_row = *high - *low < 1e-3, on_face = std::abs(*low - std::round(*low)) < 1e-3;
  using enum Representation;
  if (in_one_row && on_face)
    interface.representation = rows_bend ? fitted : on_faces;
  else
    interface.representation = interface.kind == LocalInterface::Kind::inner ? averaged : staircase;
  if (interface.representation == fitted) interface.curvature_per_m = curvature_of(columns, line);
}

/// Depths of the level tops of layers that a command line of sw-layers in a model's history names.
std::vector<double> tops_in_history(const std::string& history) {
  std::vector<double> tops;
  const std::string option = "--layer";
  for (auto at = history.find(option); at != std::string::npos; at = history.find(option, at + 1)) {
    std::string text = history.substr(at + option.size());
    text.erase(0, text.find_first_not_of(" =\"'"));
    try {
      tops.push_back(parse_number(text.substr(0, text.find(':'))));
    } catch (const Error&) {
      // A curve or a file: it is no level top.
    }
  }
  return tops;
}

Maker maker_of(const std::string& history) {
  if (history.find("sw-marmousi") != std::string::npos) return Maker::sw_marmousi;
  return history.find("sw-import") != std::string::npos ? Maker::sw_import : Maker::sw_layers;
}

/// Whether the last sw-import in a model's history interpolated what it read (--resample to smaller cells).
bool is_interpolated(const std::string& history) {
  const auto command = history.rfind("sw-import");
  if (command == std::string::npos) return false;
  const auto number = [&](const std::string& option) {
    const auto at = history.find(option, command);
    if (at == std::string::npos) return 0.;
    std::istringstream text(history.substr(at + option.size() + 1));
    double value = 0;
    return text >> value ? value : 0.;
  };
  const double resampled_m = number("--resample");
  return resampled_m > 0 && resampled_m < number("--step");
}

/// What is followed round one source.
class Tracker {
 public:
  Tracker(const Scene<2>& scene, std::size_t shot)
      : scene_(scene),
        columns_(scene.model.medium),
        source_(scene.survey.sources[shot]),
        receivers_(scene.survey.receivers_of(shot + 1)),
        column_(columns_.at(source_.position_m[0])),
        tops_(tops_in_history(scene.model.history)),
        interpolated_(is_interpolated(scene.model.history)),
        tilted_(tilted_means(scene.model.medium) > 0) {
    stack_.maker = maker_of(scene.model.history);
    low_ = high_ = column_;
    for (const auto& receiver : receivers_) {
      low_ = std::min(low_, columns_.at(receiver.point_m[0]));
      high_ = std::max(high_, columns_.at(receiver.point_m[0]));
    }
    low_ = std::max<std::int64_t>(low_ - 12, 0);
    high_ = std::min(high_ + 12, columns_.count() - 1);
    segments_ = segments_of(columns_, column_);
    join_cut_cells(segments_);
    for (const auto& weak : join_weakest(segments_)) add_left_out(weak);
    follow_all();
    find_body();
    flatten();
  }
  void add_receivers(const std::vector<FollowedReceiver>& followed) {
    for (const auto& receiver : followed) add_receiver(receivers_[receiver.index].point_m);
  }
  LocalStack take() { return std::move(stack_); }

 private:
  bool fitted() const { return scene_.model.grid().rows != nullptr; }

  void add_left_out(const Weak& weak) {
    const auto &a = weak.upper, &b = weak.lower;
    stack_.left_out.push_back({contrast_of(a, b),
                               std::abs(columns_.face(column_, weak.row) - source_.position_m[1]),
                               std::min(a.vp, b.vp), std::min(a.vs, b.vs)});
  }

  /// Faces of two matters in columns that no interface below the source continues to.
  void find_body() {
    for (auto i = low_; i <= high_; ++i)
      for (std::int64_t k = 1; k < columns_.rows(); ++k) {
        const auto upper = columns_.cell(i, k - 1), lower = columns_.cell(i, k);
        if (upper.matter == lower.matter || is_followed(i, k)) continue;
        // Air above the ground is no cave.
        if (upper.matter == Matter::empty && columns_.is_ground(i, k)) continue;
        add_to_body(i, k, upper, lower);
      }
  }
  bool is_followed(std::int64_t i, std::int64_t row) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const Followed& line) {
      return line.first <= i && i < line.first + std::int64_t(line.rows.size()) &&
             std::abs(line.row(i) - double(row)) <= 2;
    });
  }
  void add_to_body(std::int64_t i, std::int64_t row, const Cell& upper, const Cell& lower) {
    const double h = columns_.spacing(), x = columns_.x(i);
    const Point<2> at = {x, columns_.face(i, row)};
    const auto way = [&](const Point<2>& to) {
      return std::hypot(to[0] - source_.position_m[0], to[1] - source_.position_m[1]);
    };
    auto& body = stack_.body;
    if (!body) body = {x - h / 2, x, at};
    body->to_x_m = x + h / 2;
    if (way(at) < way(body->nearest_m)) body->nearest_m = at;
    const bool cave = upper.matter == Matter::empty || lower.matter == Matter::empty;
    body->contrast = std::max(body->contrast, cave ? std::numeric_limits<double>::infinity()
                                                   : ratio(upper.rho * upper.vp, lower.rho * lower.vp));
  }

  void follow_all() {
    auto& places = stack_.places;
    places.duration_s = scene_.recording.duration_s;
    const Cell nothing{Matter::empty, 0, 0, 0};
    places.free_surface = scene_.edges[1][0] == EdgeLaw::free || segments_.front().first > 0;
    if (places.free_surface) add_interface(nothing, segments_.front().rock, segments_.front().first);
    for (const auto& segment : segments_) {
      places.layers.push_back({segment.rock.vp, segment.rock.vs, segment.rock.rho});
      if (scene_.attenuates())
        stack_.losses.push_back({columns_.loss(column_, segment.first, segment.last, Property::qp),
                                 columns_.loss(column_, segment.first, segment.last, Property::qs)});
      if (&segment != &segments_.front()) add_interface((&segment)[-1].rock, segment.rock, segment.first);
    }
  }
  void add_interface(const Cell& upper, const Cell& lower, std::int64_t row) {
    LocalInterface interface;
    interface.kind = upper.matter == Matter::empty  ? LocalInterface::Kind::surface
                     : upper.matter != lower.matter ? LocalInterface::Kind::fluid_solid
                                                    : LocalInterface::Kind::inner;
    interface.contrast = contrast_of(upper, lower);
    interface.sea_floor = upper.matter == Matter::fluid && lower.matter == Matter::solid &&
                          upper.rho == segments_.front().rock.rho && upper.vp == segments_.front().rock.vp;
    // The top of the grid is a surface where no cell lies above it.
    Followed line{low_, std::vector<double>(std::size_t(high_ - low_ + 1), 0)};
    if (row > 0 || interface.kind != LocalInterface::Kind::surface)
      line = follow(Follower(columns_, upper, lower), column_, double(row), low_, high_);
    // The lower side of a thin bed is where its upper side is.
    if (!lines_.empty() && double(row) - lines_.back().row(column_) < thin_bed &&
        std::abs(line.row(column_) - lines_.back().row(column_)) < thin_bed && !is_straight(line)) {
      const double below = std::max(0.5, double(row) - lines_.back().row(column_));
      line = lines_.back();
      for (auto& at : line.rows) at += below;
    }
    describe(columns_, line, interface, fitted());
    if (interface.representation == Representation::averaged && interpolated_)
      interface.representation = Representation::gradual;
    interface.tilted = interface.representation == Representation::averaged && tilted_;
    interface.depth_m = columns_.depth(column_, line.row(column_));
    interface.true_depth_m = interface.depth_m;
    if (interface.representation == Representation::on_faces && interface.kind != LocalInterface::Kind::inner)
      interface.true_depth_m += offset_of(interface.depth_m);
    if (interface.representation == Representation::averaged && interface.stairs < 1e-3)
      interface.block = cells_cut(line.row(column_));
    if (interface.kind != LocalInterface::Kind::surface)
      interface.sides = sides_of(Follower(columns_, upper, lower), double(row), interface.representation);
    stack_.interfaces.push_back(interface);
    lines_.push_back(std::move(line));
  }

  /// Where what begins at a row of the source's column leaves the model.
  std::vector<LocalInterface::Side> sides_of(const Follower& follower, double row,
                                             Representation representation) const {
    // Cut cells and stairs show a slope over many columns, rows continue that of the last few.
    const std::int64_t window = representation == Representation::fitted ? 4 : 16;
    const auto count = columns_.count();
    const auto line = follow(follower, column_, row, 0, count - 1);
    const auto size = std::int64_t(line.rows.size());
    std::vector<LocalInterface::Side> sides;
    if (size < window) return sides;
    const auto add = [&](std::int64_t i, std::size_t first) {
      const double slope = slope_of(columns_, line, first, first + std::size_t(window));
      sides.push_back({{columns_.x(i), columns_.depth(i, line.row(i))}, slope});
    };
    if (line.first == 0) add(0, 0);
    if (line.first + size == count) add(count - 1, std::size_t(size - window));
    return sides;
  }

  /// How far from a face the top of a layer lies that the model's history names.
  double offset_of(double depth_m) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double top : tops_)
      if (std::abs(top - depth_m) < std::abs(nearest)) nearest = top - depth_m;
    return std::abs(nearest) < columns_.spacing() ? nearest : 0;
  }
  /// Cells of one material in the source's column that a level interface cuts.
  std::int64_t cells_cut(double row) const {
    const auto at = std::clamp<std::int64_t>(std::int64_t(row), 0, columns_.rows() - 1);
    const auto cut = columns_.cell(column_, at);
    std::int64_t count = 1;
    for (auto k = at; k-- > 0 && alike(columns_.cell(column_, k), cut, 1e-6);) ++count;
    for (auto k = at + 1; k < columns_.rows() && alike(columns_.cell(column_, k), cut, 1e-6); ++k) ++count;
    return std::min<std::int64_t>(count, most_cut);
  }

  /// Puts all into the frame that runs along the strongest interface.
  void flatten() {
    const LocalInterface* strongest = nullptr;
    for (const auto& interface : stack_.interfaces) {
      const bool level_surface =
          interface.kind == LocalInterface::Kind::surface && std::abs(interface.dip_deg) < 0.1;
      if (level_surface && stack_.interfaces.size() > 1) continue;
      if (!strongest || interface.contrast > strongest->contrast) strongest = &interface;
    }
    stack_.dip_deg = strongest ? strongest->dip_deg : 0;
    const double angle = stack_.dip_deg * std::numbers::pi / 180;
    cosine_ = std::cos(angle), sine_ = std::sin(angle);
    auto& places = stack_.places;
    for (const auto& interface : stack_.interfaces) {
      const double own = std::cos(interface.dip_deg * std::numbers::pi / 180);
      double b = (interface.depth_m - source_.position_m[1]) * own;
      if (!places.faces_m.empty()) b = std::max(b, places.faces_m.back() + 0.01 * columns_.spacing());
      places.faces_m.push_back(b);
    }
    // The source lies in the layer that it lies in.
    if (places.free_surface && places.faces_m[0] > -1e-3 * columns_.spacing())
      places.faces_m[0] = -1e-3 * columns_.spacing();
    const auto injection = point_injection(source_);
    if (!injection) return;
    const auto& f = injection->force;
    places.force = {f[0] * cosine_ + f[1] * sine_, f[1] * cosine_ - f[0] * sine_};
    const auto& m = injection->moment_rate;
    const double c = cosine_, s = sine_;
    places.moment_rate(0, 0) = c * c * m(0, 0) + 2 * c * s * m(0, 1) + s * s * m(1, 1);
    places.moment_rate(1, 1) = s * s * m(0, 0) - 2 * c * s * m(0, 1) + c * c * m(1, 1);
    places.moment_rate(0, 1) = c * s * (m(1, 1) - m(0, 0)) + (c * c - s * s) * m(0, 1);
  }

  void add_receiver(const Point<2>& at) {
    auto& places = stack_.places;
    const double dx = at[0] - source_.position_m[0], dz = at[1] - source_.position_m[1];
    LayeredPlaces::Receiver receiver{dx * cosine_ + dz * sine_, dz * cosine_ - dx * sine_, 0};
    const auto i = columns_.at(at[0]);
    // Above or below each interface as in the model, and as far from the nearer of those round its layer.
    std::vector<double> below(lines_.size());
    for (std::size_t n = 0; n < lines_.size(); ++n) {
      const auto& interface = stack_.interfaces[n];
      const double beyond = at[0] - std::clamp(at[0], interface.from_x_m, interface.to_x_m);
      const double own = std::tan(interface.dip_deg * std::numbers::pi / 180);
      const double column_off = at[0] - columns_.x(i);
      const double depth = columns_.depth(i, lines_[n].row(i)) + (beyond != 0 ? beyond : column_off) * own;
      below[n] = (at[1] - depth) * cosine_;
      const bool surface = interface.kind == LocalInterface::Kind::surface;
      if (surface) below[n] = std::max(below[n], 0.);
      if (!surface && below[n] >= 0) receiver.layer = n + (places.free_surface ? 0 : 1);
    }
    const auto upper = std::ptrdiff_t(receiver.layer) - (places.free_surface ? 0 : 1);
    double nearest = std::numeric_limits<double>::infinity();
    for (auto n = std::max<std::ptrdiff_t>(upper, 0); n <= upper + 1 && n < std::ptrdiff_t(below.size()); ++n)
      if (const double own = below[std::size_t(n)]; std::abs(own) < std::abs(nearest)) {
        nearest = own;
        receiver.b_m = places.faces_m[std::size_t(n)] + own;
      }
    // Interfaces that cross elsewhere are in order here.
    if (upper >= 0) receiver.b_m = std::max(receiver.b_m, places.faces_m[std::size_t(upper)]);
    if (upper + 1 < std::ptrdiff_t(below.size()))
      receiver.b_m = std::min(receiver.b_m, places.faces_m[std::size_t(upper + 1)]);
    places.receivers.push_back(receiver);
  }

  const Scene<2>& scene_;
  Columns columns_;
  const Source<2>& source_;
  std::vector<Receiver<2>> receivers_;
  std::int64_t column_, low_ = 0, high_ = 0;
  std::vector<double> tops_;
  bool interpolated_, tilted_;
  std::vector<Segment> segments_;
  std::vector<Followed> lines_;
  LocalStack stack_;
  double cosine_ = 1, sine_ = 0;
};

}  // namespace

std::string LocalInterface::name() const {
  if (kind == Kind::surface) return "free surface";
  return (sea_floor                   ? "sea floor at "
          : kind == Kind::fluid_solid ? "fluid-solid interface at "
                                      : "interface at ") +
         shown(depth_m, 4) + " m";
}

std::vector<FollowedReceiver> followed_receivers(const Scene<2>& scene, std::size_t shot, std::size_t most) {
  const auto all = scene.survey.receivers_of(shot + 1);
  const auto& from = scene.survey.sources[shot].position_m;
  std::vector<std::pair<double, std::size_t>> by_way;
  for (std::size_t n = 0; n < all.size(); ++n)
    by_way.emplace_back(std::hypot(all[n].point_m[0] - from[0], all[n].point_m[1] - from[1]), n);
  std::sort(by_way.begin(), by_way.end());
  std::vector<FollowedReceiver> followed;
  const std::size_t largest = (all.size() + most - 1) / most;
  for (std::size_t first = 0, count = 0; first < all.size(); first += count) {
    count = std::clamp<std::size_t>((first + 1) / 2, 1, largest);
    count = std::min(count, all.size() - first);
    followed.push_back({by_way[first + count / 2].second, double(count)});
  }
  std::sort(followed.begin(), followed.end(),
            [](const FollowedReceiver& a, const FollowedReceiver& b) { return a.index < b.index; });
  return followed;
}

std::vector<std::size_t> receivers_in_corners(const Scene<2>& scene, std::size_t shot) {
  const auto& medium = scene.model.medium;
  const auto& grid = medium.grid();
  const auto is_solid = [&](Index<2> at, std::size_t axis, std::int64_t way) {
    at[axis] += way;
    if (at[axis] < 0 || at[axis] >= grid.shape[axis]) return false;
    const auto cell = std::size_t(grid.flat(at));
    return !medium.is_fluid(cell) && !medium.is_void(cell);
  };
  const auto beside = [&](const Index<2>& at, std::size_t axis) {
    return is_solid(at, axis, -1) || is_solid(at, axis, 1);
  };
  std::vector<std::size_t> found;
  const auto all = scene.survey.receivers_of(shot + 1);
  for (std::size_t n = 0; n < all.size(); ++n) {
    const auto at = cell_of(grid, all[n].point_m);
    if (medium.is_fluid(std::size_t(grid.flat(at))) && beside(at, 0) && beside(at, 1)) found.push_back(n);
  }
  return found;
}

namespace {

/// The cell of a source and those beside it.
class CellsAtSource {
 public:
  CellsAtSource(const Scene<2>& scene, std::size_t shot)
      : medium_(scene.model.medium),
        at_(cell_of(medium_.grid(), scene.survey.sources[shot].position_m)),
        own_(std::size_t(medium_.grid().flat(at_))) {}
  std::size_t own() const { return own_; }
  const Index<2>& at() const { return at_; }
  /// What lies behind a floor or surface is another matter: then it is the source's own.
  std::size_t beside(std::size_t axis, std::int64_t way) const {
    auto place = at_;
    place[axis] = std::clamp<std::int64_t>(place[axis] + way, 0, medium_.grid().shape[axis] - 1);
    const auto cell = std::size_t(medium_.grid().flat(place));
    return medium_.is_fluid(cell) != medium_.is_fluid(own_) || medium_.is_void(cell) ? own_ : cell;
  }

 private:
  const Medium<2>& medium_;
  Index<2> at_;
  std::size_t own_;
};

}  // namespace

double change_at_source(const Scene<2>& scene, std::size_t shot) {
  const auto& medium = scene.model.medium;
  const CellsAtSource cells(scene, shot);
  const auto injection = point_injection(scene.survey.sources[shot]);
  const bool force = injection && (injection->force[0] != 0 || injection->force[1] != 0);
  const auto strength = [&](std::size_t cell) {
    return std::log(double(medium.rho[cell]) * (force ? 1 : std::pow(double(medium.vp[cell]), 3)));
  };
  double most = 0;
  for (const std::size_t axis : {0, 1})
    most = std::max(most, std::abs(strength(cells.beside(axis, 1)) - strength(cells.beside(axis, -1))));
  return most / 12;
}

double unevenness_at_source(const Scene<2>& scene, std::size_t shot) {
  constexpr double share = 0.3, reach_cells = 0.45;
  const auto& medium = scene.model.medium;
  const CellsAtSource cells(scene, shot);
  const auto stiffness = [&](std::size_t cell) {
    return double(medium.rho[cell]) * double(medium.vp[cell]) * double(medium.vp[cell]);
  };
  const auto place = medium.grid().row_coordinates(scene.survey.sources[shot].position_m);
  double most = 0;
  for (const std::size_t axis : {0, 1})
    for (const std::int64_t way : {-1, 1}) {
      const double softer = std::log(stiffness(cells.own()) / stiffness(cells.beside(axis, way)));
      const double off = medium.grid().position(int(axis), place[axis]) - double(cells.at()[axis]);
      const double away = 0.5 - double(way) * off;
      most = std::max(most, share * softer * std::exp(-std::max(away, 0.) / reach_cells));
    }
  return most;
}

LocalStack local_stack(const Scene<2>& scene, std::size_t shot,
                       const std::vector<FollowedReceiver>& receivers) {
  Tracker tracker(scene, shot);
  tracker.add_receivers(receivers);
  return tracker.take();
}

}  // namespace slipwave
