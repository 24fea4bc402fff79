#include "model/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/input_bytes.hpp"
#include "model/noise.hpp"
#include "model/points_file.hpp"

namespace slipwave {
namespace {

/// A place, two lengths, and the direction of the first of them.
struct Frame {
  Point<2> centre{};
  double along_m = 0, across_m = 0;
  double cosine = 1, sine = 0;

  Frame(const Point<2>& centre, double along_m, double across_m, double dip_deg)
      : centre(centre),
        along_m(along_m),
        across_m(across_m),
        cosine(std::cos(dip_deg * std::numbers::pi / 180)),
        sine(std::sin(dip_deg * std::numbers::pi / 180)) {}
  /// Along and across, counted from the centre.
  Point<2> seen(const Point<2>& at) const {
    const double x = at[0] - centre[0], z = at[1] - centre[1];
    return {cosine * x + sine * z, cosine * z - sine * x};
  }
  bool in_slab(const Point<2>& at) const {
    const auto local = seen(at);
    return std::abs(local[0]) <= along_m / 2 && std::abs(local[1]) <= across_m / 2;
  }
  bool in_ellipse(const Point<2>& at) const {
    const auto local = seen(at);
    return std::hypot(local[0] / along_m, local[1] / across_m) <= 1;
  }
  Box<2> box(double half_x, double half_z) const {
    return {{centre[0] - half_x, centre[1] - half_z}, {centre[0] + half_x, centre[1] + half_z}};
  }
  Box<2> slab_bounds() const {
    return box((along_m * std::abs(cosine) + across_m * std::abs(sine)) / 2,
               (along_m * std::abs(sine) + across_m * std::abs(cosine)) / 2);
  }
};

Frame parse_frame(std::string_view text, const std::string& expected) {
  const auto parts = split(text, ':');
  if (parts.size() != 2 && parts.size() != 3) {
    throw Error("found '" + std::string(text) + "', expected " + expected, ErrorKind::usage);
  }
  return in_place('\'' + std::string(text) + "'", [&] {
    const auto centre = parse_point<2>(parts[0]);
    const auto sizes = parse_numbers(parts[1], ',');
    const double dip_deg = parts.size() == 3 ? parse_number(parts[2]) : 0;
    if (sizes.size() != 2 || !(sizes[0] > 0 && sizes[1] > 0)) {
      throw Error("found '" + parts[1] + "', expected two lengths above zero", ErrorKind::usage);
    }
    return Frame(centre, sizes[0], sizes[1], dip_deg);
  });
}

/// Slabs, sorted into strips of x so that a point is held against few of them.
class Slabs {
 public:
  Slabs(std::vector<Frame> slabs, const Box<2>& bounds) : slabs_(std::move(slabs)), low_m_(bounds.low_m[0]) {
    double width = 0;
    for (const auto& slab : slabs_) width += slab.slab_bounds().high_m[0] - slab.slab_bounds().low_m[0];
    strip_m_ = width / double(slabs_.size());
    const double length = bounds.high_m[0] - low_m_;
    strips_.resize(std::size_t(std::clamp(length / strip_m_, 1., 1e5)) + 1);
    strip_m_ = std::max(strip_m_, length / double(strips_.size() - 1));
    for (std::size_t n = 0; n < slabs_.size(); ++n) {
      const auto box = slabs_[n].slab_bounds();
      for (std::size_t k = strip(box.low_m[0]); k <= strip(box.high_m[0]); ++k) strips_[k].push_back(n);
    }
  }
  bool contain(const Point<2>& at) const {
    const auto& near = strips_[strip(at[0])];
    return std::any_of(near.begin(), near.end(), [&](std::size_t n) { return slabs_[n].in_slab(at); });
  }

 private:
  std::size_t strip(double x_m) const {
    return std::size_t(std::clamp((x_m - low_m_) / strip_m_, 0., double(strips_.size() - 1)));
  }

  std::vector<Frame> slabs_;
  double low_m_ = 0, strip_m_ = 1;
  std::vector<std::vector<std::size_t>> strips_;
};

}  // namespace

Region region_of_box(const Box<2>& box) {
  return {box, [box](const Point<2>& at) { return box.contains(at); }};
}

Region region_of_polygon(std::vector<Point<2>> vertices) {
  if (vertices.size() < 3) {
    throw Error("found " + std::to_string(vertices.size()) + " vertices, expected at least 3");
  }
  Box<2> bounds{vertices.front(), vertices.front()};
  for (const auto& vertex : vertices) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      bounds.low_m[axis] = std::min(bounds.low_m[axis], vertex[axis]);
      bounds.high_m[axis] = std::max(bounds.high_m[axis], vertex[axis]);
    }
  }
  return {bounds, [vertices = std::move(vertices)](const Point<2>& at) {
            bool inside = false;
            for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++) {
              const auto &a = vertices[i], &b = vertices[j];
              if ((a[1] > at[1]) == (b[1] > at[1])) continue;
              if (at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1])) inside = !inside;
            }
            return inside;
          }};
}

Region read_polygon(const std::string& path) {
  std::vector<Point<2>> vertices;
  for (const auto& point : read_points(path)) vertices.push_back(point.at);
  return in_place(shown_input(path), [&] { return region_of_polygon(std::move(vertices)); });
}

Region parse_ellipse(std::string_view text) {
  const auto frame = parse_frame(text, "an ellipse X,Z:A,B[:DIP]");
  const double a = frame.along_m, b = frame.across_m;
  return {
      frame.box(std::hypot(a * frame.cosine, b * frame.sine), std::hypot(a * frame.sine, b * frame.cosine)),
      [frame](const Point<2>& at) { return frame.in_ellipse(at); }};
}

Region parse_slab(std::string_view text) {
  const auto frame = parse_frame(text, "a slab X,Z:LENGTH,THICKNESS[:DIP]");
  return {frame.slab_bounds(), [frame](const Point<2>& at) { return frame.in_slab(at); }};
}

Region scattered_in(const Region& region, const Scatter& scatter) {
  if (scatter.count < 1) {
    throw Error("found a count of " + std::to_string(scatter.count) + ", expected at least 1",
                ErrorKind::usage);
  }
  if (!(scatter.length_m > 0 && scatter.thickness_m > 0)) {
    throw Error("found slabs of " + shown(scatter.length_m) + " by " + shown(scatter.thickness_m) +
                    " m, expected both above zero",
                ErrorKind::usage);
  }
  const auto& low = region.bounds.low_m;
  const auto& high = region.bounds.high_m;
  std::vector<Frame> slabs;
  constexpr std::int64_t tries_a_slab = 10000;
  // Each try draws four numbers of its own, so that a slab does not depend on how many there are.
  for (std::int64_t n = 0; slabs.size() < std::size_t(scatter.count); n += 4) {
    if (n / 4 > tries_a_slab * (std::int64_t(slabs.size()) + 1)) {
      throw Error("found no place for a slab in the region, expected it to fill more of its bounds");
    }
    const Point<2> centre{uniform(scatter.seed, n, low[0], high[0]),
                          uniform(scatter.seed, n + 1, low[1], high[1])};
    if (!region.contains(centre)) continue;
    slabs.emplace_back(centre, scatter.length_m * uniform(scatter.seed, n + 2, 0.5, 1.5),
                       scatter.thickness_m * uniform(scatter.seed, n + 3, 0.5, 1.5), scatter.dip_deg);
  }
  return {region.bounds, [whole = region.contains, slabs = Slabs(std::move(slabs), region.bounds)](
                             const Point<2>& at) { return whole(at) && slabs.contain(at); }};
}

}  // namespace slipwave
