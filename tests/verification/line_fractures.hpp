// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "complex_system.hpp"
#include "grid/grid.hpp"
#include "lab.hpp"

namespace slipwave::solver {

/// Fractures along lines in a full space, in 2-D (P-SV), for the frequency omega, exp(-i omega t): boundary
/// elements of constant displacement discontinuities. The static part of what an element does to another is
/// in closed form (Crouch & Starfield 1983, Boundary Element Methods in Solid Mechanics, 5.3), the rest by
/// Gauss's quadrature of derivatives of Green's tensor. Independent of the solver.
class LineFractures {
 public:
  using Complex = std::complex<double>;
  using Vector = std::array<Complex, 2>;

  LineFractures(const Rock& rock, double omega) : rock_(rock), omega_(omega) {}

  /// Of a fracture, m/Pa; infinite: free of traction.
  struct Compliance {
    double normal, tangential;
  };
  /// Adds a line in `count` elements.
  void add(const Point<2>& from, const Point<2>& to, int count, const Compliance& compliance) {
    for (int n = 0; n < count; ++n) {
      const auto at = [&](double share) {
        return Point<2>{from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
      };
      Element element{at(double(n) / count), at(double(n + 1) / count), {}, {}, {}, 0, compliance};
      const double x = element.to[0] - element.from[0], z = element.to[1] - element.from[1];
      element.length = std::hypot(x, z);
      element.middle = at((n + 0.5) / count);
      element.along = {x / element.length, z / element.length};
      element.normal = {-element.along[1], element.along[0]};
      elements_.push_back(element);
    }
  }
  /// Displacement that the fractures add at these places to that of an explosion of unit moment.
  std::vector<Vector> scattered(const Point<2>& source, const std::vector<Point<2>>& places) {
    solve([&](const Element& element) { return traction_of_explosion(source, element); });
    std::vector<Vector> all;
    for (const auto& place : places) all.push_back(radiated(place));
    return all;
  }
  /// Jumps at the elements, along them and across, for a static traction on them.
  std::vector<Vector> jumps_under(const Point<2>& traction) {
    solve([&](const Element&) { return Vector{traction[0], traction[1]}; });
    return jumps_;
  }
  Vector explosion(const Point<2>& source, const Point<2>& place) const {
    const auto of = Green(rock_, omega_, {place[0] - source[0], place[1] - source[1]});
    Vector u{};
    for (int k = 0; k < 2; ++k)
      for (int p = 0; p < 2; ++p) u[std::size_t(k)] -= of.first(k, p, p);
    return u;
  }

 private:
  struct Element {
    Point<2> from, to, middle, along, normal;
    double length;
    Compliance compliance;
  };
  static double poisson(const Rock& rock) { return rock.lambda() / (2 * (rock.lambda() + rock.mu())); }
  /// A function of the distance r and what (1/r d/dr) makes of it, again and again.
  struct Radial {
    std::array<Complex, 5> of{};
    double x[2];
    Complex second(int i, int j) const { return double(i == j) * of[1] + x[i] * x[j] * of[2]; }
    Complex third(int i, int j, int k) const {
      return (double(i == j) * x[k] + double(i == k) * x[j] + double(j == k) * x[i]) * of[2] +
             x[i] * x[j] * x[k] * of[3];
    }
    Complex fourth(int i, int j, int k, int l) const {
      const auto same = [](int a, int b) { return double(a == b); };
      const double twice = same(i, j) * same(k, l) + same(i, k) * same(j, l) + same(i, l) * same(j, k);
      const double once = same(i, j) * x[k] * x[l] + same(i, k) * x[j] * x[l] + same(i, l) * x[j] * x[k] +
                          same(j, k) * x[i] * x[l] + same(j, l) * x[i] * x[k] + same(k, l) * x[i] * x[j];
      return twice * of[2] + once * of[3] + x[i] * x[j] * x[k] * x[l] * of[4];
    }
  };
  /// G = i/(4 mu) (H_0(ks r) delta + dd (H_0(ks r) - H_0(kp r))/ks^2), less its static limit where asked for.
  class Green {
   public:
    Green(const Rock& rock, double omega, const Point<2>& x, bool less_static = false)
        : ks_(omega / rock.vs), factor_(Complex(0, 1) / (4 * rock.mu())) {
      s_ = hankel(ks_, x);
      const auto p = hankel(omega / rock.vp, x);
      difference_ = s_;
      for (std::size_t n = 0; n < 5; ++n) difference_.of[n] -= p.of[n];
      if (!less_static) return;
      static_ = true;
      const double nu = poisson(rock);
      r_ = 1 / (8 * std::numbers::pi * rock.mu() * (1 - nu));
      share_ = 4 - 4 * nu;
      const double q = x[0] * x[0] + x[1] * x[1];
      log_ = {{0, 1 / q, -2 / (q * q), 8 / (q * q * q), -48 / (q * q * q * q)}, {x[0], x[1]}};
      square_log_ = {{0, std::log(q) + 1, 2 / q, -4 / (q * q), 16 / (q * q * q)}, {x[0], x[1]}};
    }
    Complex first(int k, int p, int q) const {
      return factor_ * (double(k == p) * s_.x[q] * s_.of[1] + difference_.third(k, p, q) / (ks_ * ks_));
    }
    Complex second(int k, int p, int q, int l) const {
      const auto all =
          factor_ * (double(k == p) * s_.second(q, l) + difference_.fourth(k, p, q, l) / (ks_ * ks_));
      if (!static_) return all;
      return all - r_ * (-share_ * double(k == p) * log_.second(q, l) + 0.5 * square_log_.fourth(k, p, q, l));
    }

   private:
    static Radial hankel(double k, const Point<2>& x) {
      const double r = std::hypot(x[0], x[1]), kr = k * r;
      std::array<Complex, 5> h;
      for (const int n : {0, 1})
        h[std::size_t(n)] = {std::cyl_bessel_j(double(n), kr), std::cyl_neumann(double(n), kr)};
      for (std::size_t n = 1; n < 4; ++n) h[n + 1] = 2 * double(n) / kr * h[n] - h[n - 1];
      Radial of{{}, {x[0], x[1]}};
      double factor = 1;
      for (std::size_t n = 0; n < 5; ++n, factor *= -k / r) of.of[n] = factor * h[n];
      return of;
    }
    double ks_;
    Complex factor_;
    Radial s_, difference_;
    bool static_ = false;
    double r_ = 0, share_ = 0;
    Radial log_{}, square_log_{};
  };

  double stiffness(int i, int j, int k, int l) const {
    return rock_.lambda() * double(i == j && k == l) +
           rock_.mu() * (double(i == k && j == l) + double(i == l && j == k));
  }
  /// n_r C_mrpq: the moment of a jump.
  double moment(const Element& of, int m, int p, int q) const {
    double sum = 0;
    for (int r = 0; r < 2; ++r) sum += of.normal[std::size_t(r)] * stiffness(m, r, p, q);
    return sum;
  }
  /// Calls with(place, weight) at six points of an element.
  template <class With>
  static void each_point(const Element& of, const With& with) {
    constexpr double x[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
    constexpr double w[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    for (int n = 0; n < 3; ++n)
      for (const double side : {-0.5, 0.5})
        with(Point<2>{of.middle[0] + side * x[n] * of.length * of.along[0],
                      of.middle[1] + side * x[n] * of.length * of.along[1]},
             0.5 * w[n] * of.length);
  }
  /// Traction on the plane of an element from the gradient of displacement.
  Vector traction(const Element& on, const Complex (&gradient)[2][2]) const {
    Vector t{};
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        for (int k = 0; k < 2; ++k)
          for (int l = 0; l < 2; ++l)
            t[std::size_t(a)] += on.normal[std::size_t(b)] * stiffness(a, b, k, l) * gradient[k][l];
    return t;
  }
  Vector traction_of_explosion(const Point<2>& source, const Element& on) const {
    const Green green(rock_, omega_, {on.middle[0] - source[0], on.middle[1] - source[1]});
    Complex gradient[2][2] = {};
    for (int k = 0; k < 2; ++k)
      for (int l = 0; l < 2; ++l)
        for (int p = 0; p < 2; ++p) gradient[k][l] -= green.second(k, p, p, l);
    return traction(on, gradient);
  }
  /// Static traction on an element for a unit jump of another, [component][of the jump].
  std::array<std::array<double, 2>, 2> static_traction(const Element& on, const Element& of) const {
    const double dx = on.middle[0] - of.middle[0], dz = on.middle[1] - of.middle[1];
    const double x = dx * of.along[0] + dz * of.along[1], y = dx * of.normal[0] + dz * of.normal[1];
    const double nu = poisson(rock_);
    const double c = 1 / (4 * std::numbers::pi * (1 - nu)), a = of.length / 2, g = 2 * rock_.mu();
    const double lo = x - a, hi = x + a, r1 = lo * lo + y * y, r2 = hi * hi + y * y;
    const double xy = c * (y / r1 - y / r2), yy = -c * (lo / r1 - hi / r2),
                 xyy = c * ((lo * lo - y * y) / (r1 * r1) - (hi * hi - y * y) / (r2 * r2)),
                 yyy = 2 * c * y * (lo / (r1 * r1) - hi / (r2 * r2));
    // Stress along and across the element, for jumps of either kind; jumps there are lower less upper side.
    const double stress[2][2][2] = {
        {{g * (2 * xy + y * xyy), g * (yy + y * yyy)}, {g * (yy + y * yyy), -g * y * xyy}},
        {{g * (yy + y * yyy), -g * y * xyy}, {-g * y * xyy, g * (yy - y * yyy)}}};
    const Point<2> frame[2] = {of.along, of.normal};
    std::array<std::array<double, 2>, 2> all{};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t p = 0; p < 2; ++p)
          for (std::size_t q = 0; q < 2; ++q)
            for (std::size_t d = 0; d < 2; ++d) {
              const double n = on.normal[0] * frame[q][0] + on.normal[1] * frame[q][1];
              all[i][j] -= frame[p][i] * stress[p][q][d] * n * frame[d][j];
            }
    return all;
  }
  template <class Load>
  void solve(const Load& load) {
    const auto n = elements_.size();
    ComplexSystem a(2 * n, std::vector<Complex>(2 * n + 1));
    for (std::size_t i = 0; i < n; ++i) {
      const auto& on = elements_[i];
      const auto loaded = load(on);
      for (std::size_t k = 0; k < 2; ++k) a[2 * i + k][2 * n] = -loaded[k];
      for (std::size_t j = 0; j < n; ++j) put_influence(on, elements_[j], a, i, j);
      for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t m = 0; m < 2; ++m)
          a[2 * i + k][2 * i + m] -= on.normal[k] * on.normal[m] / on.compliance.normal +
                                     on.along[k] * on.along[m] / on.compliance.tangential;
    }
    const auto x = solved(std::move(a));
    jumps_.clear();
    for (std::size_t i = 0; i < n; ++i) jumps_.push_back({x[2 * i], x[2 * i + 1]});
  }
  void put_influence(const Element& on, const Element& of, ComplexSystem& a, std::size_t i,
                     std::size_t j) const {
    Complex gradient[2][2][2] = {};  // [of the jump]
    each_point(of, [&](const Point<2>& at, double weight) {
      const Green green(rock_, omega_, {on.middle[0] - at[0], on.middle[1] - at[1]}, true);
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          for (int p = 0; p < 2; ++p)
            for (int q = 0; q < 2; ++q) {
              const auto g = green.second(k, p, q, l) * weight;
              for (int m = 0; m < 2; ++m) gradient[m][k][l] -= moment(of, m, p, q) * g;
            }
    });
    const auto at_rest = static_traction(on, of);
    for (std::size_t m = 0; m < 2; ++m) {
      const auto t = traction(on, gradient[m]);
      for (std::size_t k = 0; k < 2; ++k) a[2 * i + k][2 * j + m] += t[k] + at_rest[k][m];
    }
  }
  Vector radiated(const Point<2>& place) const {
    Vector u{};
    for (std::size_t j = 0; j < elements_.size(); ++j)
      each_point(elements_[j], [&](const Point<2>& at, double weight) {
        const Green green(rock_, omega_, {place[0] - at[0], place[1] - at[1]});
        for (int k = 0; k < 2; ++k)
          for (int p = 0; p < 2; ++p)
            for (int q = 0; q < 2; ++q)
              for (int m = 0; m < 2; ++m)
                u[std::size_t(k)] -=
                    weight * moment(elements_[j], m, p, q) * jumps_[j][std::size_t(m)] * green.first(k, p, q);
      });
    return u;
  }

  Rock rock_;
  double omega_;
  std::vector<Element> elements_;
  std::vector<Vector> jumps_;
};

}  // namespace slipwave::solver
