// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <tuple>
#include <vector>

#include "solver/kernels/kernels.hpp"
#include "solver/kernels/series_kernels.hpp"
#include "solver/sweep/workspace.hpp"

namespace slipwave::solver::solver_kernels_test {
namespace {

/// Loops over one material with kernels of either kind: all they write.
template <class Real>
std::vector<Real> written(int order, bool uniform, Real scale, std::int64_t n) {
  constexpr std::int64_t gap = 16;
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> random(-1, 1);
  const auto row = [&](double size) {
    std::vector<Real> values(std::size_t(n + 2 * gap));
    for (auto& value : values) value = Real(size * random(engine));
    return values;
  };
  const auto constant = [&](double value) { return std::vector<Real>(std::size_t(n), Real(value)); };
  const auto b = constant(4.1e-8), zp = constant(1.17e7), zs = constant(5.3e6), coupling = constant(6.1e13),
             zs2 = constant(4.2e6), coupling2 = constant(5.7e13);
  const MaterialRows<Real> material{b.data(),        zp.data(),  zs.data(),
                                    coupling.data(), zs2.data(), coupling2.data()};
  auto vp = row(1e-3), sp = row(1e4), passive = row(1e4), vs = row(1e-3), ss = row(1e4);
  auto passive2 = row(1e4), vs2 = row(1e-3), ss2 = row(1e4);
  const std::int64_t pitch = n + 2 * gap;
  const auto six_rows = [&] { return std::vector<Real>(std::size_t(6 * pitch)); };
  auto left_cells = six_rows();
  const OutgoingWaves<Real> all_left{left_cells.data() + gap, pitch};
  const auto& kernel = kernels<Real>(order, uniform);
  int pair = 0;
  for (const auto& [v, s, z] : {std::tuple(&vp, &sp, &zp), {&vs, &ss, &zs}, {&vs2, &ss2, &zs}}) {
    kernel.reconstruct(n, 1, v->data() + gap, s->data() + gap, z->data(), b.data(), scale, all_left.up(pair),
                       all_left.down(pair));
    ++pair;
  }
  std::vector<std::vector<Real>> rows = {left_cells};
  for (const auto& face : {kernel.fluid_face, kernel.face[0], kernel.face[1], kernel.anisotropic_face[0],
                           kernel.anisotropic_face[1]}) {
    auto met = six_rows();
    const InterfaceStates<Real> hi{met.data() + gap, pitch}, lo = hi.at(-1);
    face.solve_riemann(n, all_left, all_left, material, material, hi);
    face.update(n, scale, lo, hi, material,
                {vp.data() + gap, sp.data() + gap, passive.data() + gap, vs.data() + gap, ss.data() + gap,
                 passive2.data() + gap, vs2.data() + gap, ss2.data() + gap});
    rows.push_back(std::move(met));
  }
  for (const auto* changed : {&vp, &sp, &passive, &passive2, &vs, &ss, &vs2, &ss2}) rows.push_back(*changed);
  std::vector<Real> all;
  for (const auto& values : rows) all.insert(all.end(), values.begin(), values.end());
  return all;
}

/// values_of(real, order, second way, scale, cells) both ways, of all orders and precisions.
template <class ValuesOf>
void expect_same_bits(const ValuesOf& values_of) {
  const auto compare = [&](auto real) {
    using Real = decltype(real);
    for (const int order : orders)
      for (const Real scale : {Real(1), Real(0.5), Real(-0.25)})
        for (const std::int64_t n : {256, 16, 37}) {
          const auto one = values_of(real, order, false, scale, n),
                     other = values_of(real, order, true, scale, n);
          EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(Real)), 0)
              << "order " << order << ", scale " << scale << ", " << n << " cells";
        }
  };
  compare(float());
  compare(double());
}

// Proves (E20).
TEST(Kernels, OfOneMaterialGiveTheSameBits) {
  expect_same_bits([](auto real, int order, bool uniform, auto scale, std::int64_t n) {
    return written<decltype(real)>(order, uniform, scale, n);
  });
}

/// Fields after a sweep across some rows of random material, the first of them by separate loops.
template <class Real>
std::vector<Real> swept_across(int order, bool at_once, Real scale, std::int64_t n,
                               MaterialKind kind = MaterialKind::isotropic, int dimension = 2) {
  const bool anisotropic = kind == MaterialKind::anisotropic, fluid = kind == MaterialKind::fluid;
  constexpr std::int64_t rows = 12, gap = 16;
  const int pairs = dimension, field_rows = 3 * pairs - 1;
  const std::int64_t reach = reach_of(order), behind = std::max<std::int64_t>(reach, 1), pitch = n + gap;
  std::mt19937 engine(11);
  const auto values = [&](std::int64_t count, double least, double most) {
    std::uniform_real_distribution<double> random(least, most);
    std::vector<Real> all(std::size_t(count * pitch));
    for (auto& value : all) value = Real(random(engine));
    return all;
  };
  auto fields = values((rows + 2 * max_reach) * field_rows, -1, 1);
  // Those of one line follow each other: b, both impedances, and what couples the stresses of anisotropic
  // rock; in 3-D the same of the second S pair.
  constexpr std::int64_t of_line = 6;
  auto material = values(rows * of_line, 0.4, 0.8);
  const std::int64_t stride = field_rows * pitch;
  const auto field = [&](std::int64_t row, int number) {
    return fields.data() + (row + max_reach) * stride + number * pitch;
  };
  const auto rows_of = [&](std::int64_t row) {
    const Real* const b = material.data() + of_line * row * pitch;
    return MaterialRows<Real>{b, b + pitch, b + 2 * pitch, b + 3 * pitch, b + 4 * pitch, b + 5 * pitch};
  };
  const auto swept = [&](std::int64_t row) {
    const auto of = [&](int number) { return field(row, std::min(number, field_rows - 1)); };
    return SweptRows<Real>{of(1), of(3), of(2), of(0), of(4), of(5), of(6), of(7)};
  };
  Ring<Real> ring(0, n, 2, int(behind) + 1, pairs);
  const auto& kernel = kernels<Real>(order, false);
  const auto& face = anisotropic ? kernel.anisotropic_face[pairs - 2]
                     : fluid     ? kernel.fluid_face
                                 : kernel.face[pairs - 2];
  const auto fused = anisotropic ? kernel.fused_anisotropic_row[pairs - 2]
                     : fluid     ? kernel.fused_fluid_row
                                 : kernel.fused_row[pairs - 2];
  for (std::int64_t row = 0; row < rows; ++row) {
    const auto here = ring.outgoing(row, 0), above = ring.outgoing(row + 1, 0);
    const auto of = rows_of(row);
    const auto done = row - behind;
    if (at_once && done >= 0) {
      const auto faces = ring.faces(row, 0);
      fused(n, scale,
            {swept(row), stride, pitch, here.up(1) - here.up(0), faces.pitch, rows_of(row - 1).b, of.b,
             rows_of(done).b, above.up(0), here.up(0), faces.first, ring.faces(done, 0).first,
             ring.faces(done + 1, 0).first, rows_of(done).coupling, rows_of(done).coupling2, pitch, 2 * pitch,
             4 * pitch});
      continue;
    }
    kernel.reconstruct(n, stride, field(row, 1), field(row, 3), of.zp, of.b, scale, here.up(0), here.down(0));
    kernel.reconstruct(n, stride, field(row, 0), field(row, 4), of.zs, of.b, scale, here.up(1), here.down(1));
    if (pairs > 2)
      kernel.reconstruct(n, stride, field(row, 6), field(row, 7), anisotropic ? of.zs2 : of.zs, of.b, scale,
                         here.up(2), here.down(2));
    if (row == 0) continue;
    face.solve_riemann(n, above, here, rows_of(row - 1), of, ring.faces(row, 0));
    if (done >= 0)
      face.update(n, scale, ring.faces(done, 0), ring.faces(done + 1, 0), rows_of(done), swept(done));
  }
  return fields;
}

/// Weighed sums are the bits of four plain sums on every machine: nothing is fused.
template <class Real>
void expect_plain_sums() {
  constexpr std::int64_t cells = 48;
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> random(-1, 1);
  std::vector<std::vector<Real>> steps(steps_together, std::vector<Real>(std::size_t(cells)));
  std::array<const Real*, steps_together> rows;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    for (auto& value : steps[n]) value = Real(random(engine));
    rows[n] = steps[n].data();
  }
  Buffer<double> together(cells * steps_together);
  const auto& kernels = series_kernels<Real>();
  kernels.bring_together(cells, rows.data(), together.data());
  const std::vector<SeriesTerm> terms = {{3, 8}, {17, 1}, {20, 11}};
  std::vector<double> weights(20);
  for (auto& weight : weights) weight = random(engine);
  std::array<double, steps_together> sums;
  kernels.weigh(together.data(), terms.data(), terms.data() + terms.size(), weights.data(), 0.25,
                sums.data());
  std::vector<double> wide(21), combined(21);
  const double* wides[] = {wide.data(), wide.data(), wide.data()};
  for (auto& value : wide) value = random(engine);
  kernels.combine(21, 3, weights.data(), wides, combined.data());
  for (std::size_t step = 0; step < steps.size(); ++step) {
    volatile double lanes[4] = {};
    std::size_t next = 0;
    for (const auto& term : terms)
      for (std::int64_t n = 0; n < term.count; ++n) {
        const auto lane = n < term.count / 4 * 4 ? n % 4 : 0;
        const volatile double product = weights[next++] * double(steps[step][std::size_t(term.value + n)]);
        lanes[lane] = lanes[lane] + product;
      }
    EXPECT_EQ(sums[step], ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) * 0.25);
  }
  for (std::size_t i = 0; i < wide.size(); ++i) {
    volatile double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const volatile double product = weights[k] * wide[i];
      sum = sum + product;
    }
    EXPECT_EQ(combined[i], sum);
  }
}

TEST(Kernels, OfRecordsAreThePlainSumsToTheLastBit) {
  expect_plain_sums<float>();
  expect_plain_sums<double>();
}

// Proves (E20).
TEST(Kernels, OfAFusedRowGiveTheSameBits) {
  expect_same_bits([](auto real, int order, bool at_once, auto scale, std::int64_t n) {
    return swept_across<decltype(real)>(order, at_once, scale, n);
  });
  expect_same_bits([](auto real, int order, bool at_once, auto scale, std::int64_t n) {
    return swept_across<decltype(real)>(order, at_once, scale, n, MaterialKind::anisotropic);
  });
  expect_same_bits([](auto real, int order, bool at_once, auto scale, std::int64_t n) {
    return swept_across<decltype(real)>(order, at_once, scale, n, MaterialKind::anisotropic, 3);
  });
  expect_same_bits([](auto real, int order, bool at_once, auto scale, std::int64_t n) {
    return swept_across<decltype(real)>(order, at_once, scale, n, MaterialKind::fluid);
  });
  expect_same_bits([](auto real, int order, bool at_once, auto scale, std::int64_t n) {
    return swept_across<decltype(real)>(order, at_once, scale, n, MaterialKind::isotropic, 3);
  });
}

/// Fields after a sweep in cells of one material, by way of faces or without; all computed from the
/// same single-precision numbers.
template <class Real>
std::vector<double> brought_forward(int dimensions, bool shear, bool faces, Real scale, float zs_value,
                                    unsigned seed) {
  constexpr std::int64_t n = 160, gap = 16, pitch = n + 2 * gap;
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> random(-1, 1);
  const float stiffer = 1 + random(engine) / 2;
  const auto rows = [&](int count, float size) {
    std::vector<Real> values(std::size_t(count * pitch));
    for (auto& value : values) value = Real(size * random(engine));
    return values;
  };
  const auto b = std::vector<Real>(n + 1, Real(4.1e-8F)),
             zp = std::vector<Real>(n + 1, Real(1.17e7F * stiffer)),
             zs = std::vector<Real>(n + 1, Real(zs_value * stiffer));
  const MaterialRows<Real> material{b.data(), zp.data(), zs.data()};
  auto of_p = rows(2, 1e4F), of_s = rows(4, zs_value > 0 ? 1e4F : 0.F), all = of_p;
  all.insert(all.end(), of_s.begin(), of_s.end());
  const OutgoingWaves<Real> here{all.data() + gap, pitch};
  auto fields = rows(8, 1e3F);
  for (const int velocity : {0, 3, 6})
    for (std::int64_t i = 0; i < pitch; ++i) fields[std::size_t(velocity * pitch + i)] *= Real(1e-7F);
  const auto row = [&](int number) { return fields.data() + number * pitch + gap; };
  const SweptRows<Real> swept{row(0), row(1), row(2), row(3), row(4), row(5), row(6), row(7)};
  const auto& all_kernels = kernels<Real>(5, true);
  const auto& kernel = shear ? all_kernels.face[dimensions - 2] : all_kernels.fluid_face;
  if (faces) {
    std::vector<Real> met(std::size_t(6 * pitch));
    const InterfaceStates<Real> at{met.data() + gap, pitch};
    kernel.solve_riemann(n + 1, here.at(-1), here, material, material, at);
    kernel.update(n, scale, at, at.at(1), material, swept);
  } else {
    kernel.update_uniform(n, scale, here.at(-1), here, here.at(1), material, swept);
  }
  return {fields.begin(), fields.end()};
}

/// Mean square of how far rows 0 to 7 are from what they ought to be, over that of what they are.
double error_of(const std::vector<double>& found, const std::vector<double>& exact) {
  double sum = 0;
  const std::size_t length = exact.size() / 8;
  for (std::size_t first = 0; first < exact.size(); first += length) {
    double squares = 0, size = 0;
    for (std::size_t i = first; i < first + length; ++i) {
      squares += std::pow(found[i] - exact[i], 2);
      size += std::pow(exact[i], 2);
    }
    sum += squares / size / 8;
  }
  return sum;
}

// Proves (E9a).
TEST(Kernels, OfUniformRunsGiveWhatFacesDoAndRoundNoMore) {
  for (const int dimensions : {2, 3})
    for (const bool shear : {false, true})
      for (const float zs : {5.3e6F, 0.F})
        for (const float scale : {1.F, 0.5F, -0.25F}) {
          double by_faces = 0, inside = 0;
          for (unsigned seed = 1; seed <= 40; ++seed) {
            const auto with = [&](auto real, bool faces) {
              return brought_forward<decltype(real)>(dimensions, shear, faces, scale, zs, seed);
            };
            const auto exact = with(double(), true);
            EXPECT_LT(error_of(with(double(), false), exact), 1e-30);
            by_faces += error_of(with(float(), true), exact);
            inside += error_of(with(float(), false), exact);
          }
          EXPECT_LE(inside, by_faces)
              << dimensions << "-D, shear " << shear << ", zs " << zs << ", " << scale;
          EXPECT_LT(by_faces, 40 * 1e-14);
        }
}

}  // namespace
}  // namespace slipwave::solver::solver_kernels_test
