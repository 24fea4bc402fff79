#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <tuple>
#include <vector>

#include "solver/kernels.hpp"
#include "solver/workspace.hpp"

namespace slipwave::solver {
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
  const auto b = constant(4.1e-8), zp = constant(1.17e7), zs = constant(5.3e6);
  const MaterialRows<Real> material{b.data(), zp.data(), zs.data()};
  auto vp = row(1e-3), sp = row(1e4), passive = row(1e4), vs = row(1e-3), ss = row(1e4);
  auto passive2 = row(1e4), vs2 = row(1e-3), ss2 = row(1e4);
  std::vector<std::vector<Real>> rows(6, row(0));
  const auto leaving = [&](int number) { return rows[std::size_t(number)].data() + gap; };
  const auto& kernel = kernels<Real>(order, uniform);
  int left = 0;
  for (const auto& [v, s, z] : {std::tuple(&vp, &sp, &zp), {&vs, &ss, &zs}, {&vs2, &ss2, &zs}}) {
    kernel.leave(n, 1, v->data() + gap, s->data() + gap, z->data(), b.data(), scale, leaving(left),
                 leaving(left + 1));
    left += 2;
  }
  const Leaving<Real> all_left{leaving(0), leaving(1), leaving(2), leaving(3), leaving(4), leaving(5)};
  for (const auto& of_dimension : kernel.face)
    for (const auto& face : of_dimension) {
      std::vector<std::vector<Real>> met(6, row(0));
      const auto at = [&](int number) { return met[std::size_t(number)].data() + gap; };
      const Faces<Real> hi{at(0), at(1), at(2), at(3), at(4), at(5)}, lo = hi.at(-1);
      face.meet(n, all_left, all_left, material, material, hi);
      face.update(n, scale, lo, hi, material,
                  {vp.data() + gap, sp.data() + gap, passive.data() + gap, vs.data() + gap, ss.data() + gap,
                   passive2.data() + gap, vs2.data() + gap, ss2.data() + gap});
      rows.insert(rows.end(), met.begin(), met.end());
    }
  for (const auto* changed : {&vp, &sp, &passive, &passive2, &vs, &ss, &vs2, &ss2}) rows.push_back(*changed);
  std::vector<Real> all;
  for (const auto& values : rows) all.insert(all.end(), values.begin(), values.end());
  return all;
}

TEST(Kernels, OfOneMaterialGiveTheSameBits) {
  const auto compare = [](auto real) {
    using Real = decltype(real);
    for (const int order : orders)
      for (const Real scale : {Real(1), Real(0.5), Real(-0.25)})
        for (const std::int64_t n : {256, 16, 37}) {
          const auto any = written<Real>(order, false, scale, n), one = written<Real>(order, true, scale, n);
          EXPECT_EQ(std::memcmp(any.data(), one.data(), any.size() * sizeof(Real)), 0)
              << "order " << order << ", scale " << scale << ", " << n << " cells";
        }
  };
  compare(float());
  compare(double());
}

/// Fields after a sweep across some rows of random material, the first of them by loops of their own.
template <class Real>
std::vector<Real> swept_across(int order, bool at_once, Real scale, std::int64_t n) {
  constexpr std::int64_t rows = 12, gap = 16;
  constexpr int field_rows = 5;
  const std::int64_t reach = reach_of(order), behind = std::max<std::int64_t>(reach, 1), pitch = n + gap;
  std::mt19937 engine(11);
  const auto values = [&](std::int64_t count, double least, double most) {
    std::uniform_real_distribution<double> random(least, most);
    std::vector<Real> all(std::size_t(count * pitch));
    for (auto& value : all) value = Real(random(engine));
    return all;
  };
  auto fields = values((rows + 2 * max_reach) * field_rows, -1, 1);
  // Those of one line follow each other: b, then both impedances.
  auto material = values(rows * 3, 0.4, 0.8);
  const std::int64_t stride = field_rows * pitch;
  const auto field = [&](std::int64_t row, int number) {
    return fields.data() + (row + max_reach) * stride + number * pitch;
  };
  const auto rows_of = [&](std::int64_t row) {
    const Real* const b = material.data() + 3 * row * pitch;
    return MaterialRows<Real>{b, b + pitch, b + 2 * pitch};
  };
  const auto swept = [&](std::int64_t row) {
    return SweptRows<Real>{field(row, 1), field(row, 3), field(row, 2), field(row, 0), field(row, 4)};
  };
  Ring<Real> ring(0, n, int(behind) + 1);
  const auto& kernel = kernels<Real>(order, false);
  for (std::int64_t row = 0; row < rows; ++row) {
    const auto here = ring.leaving(row, 0), above = ring.leaving(row + 1, 0);
    const auto of = rows_of(row);
    const auto done = row - behind;
    if (at_once && done >= 0) {
      const auto faces = ring.faces(row, 0);
      kernel.across(n, scale,
                    {swept(row), stride, pitch, here.up_s - here.up_p, faces.s_p - faces.v_p,
                     rows_of(row - 1).b, of.b, rows_of(done).b, above.up_p, here.up_p, faces.v_p,
                     ring.faces(done, 0).v_p, ring.faces(done + 1, 0).v_p});
      continue;
    }
    kernel.leave(n, stride, field(row, 1), field(row, 3), of.zp, of.b, scale, here.up_p, here.down_p);
    kernel.leave(n, stride, field(row, 0), field(row, 4), of.zs, of.b, scale, here.up_s, here.down_s);
    if (row == 0) continue;
    kernel.face[0][1].meet(n, above, here, rows_of(row - 1), of, ring.faces(row, 0));
    if (done >= 0)
      kernel.face[0][1].update(n, scale, ring.faces(done, 0), ring.faces(done + 1, 0), rows_of(done),
                               swept(done));
  }
  return fields;
}

TEST(Kernels, OfARowAcrossAtOnceGiveTheSameBits) {
  const auto compare = [](auto real) {
    using Real = decltype(real);
    for (const int order : orders)
      for (const Real scale : {Real(1), Real(0.5), Real(-0.25)})
        for (const std::int64_t n : {256, 16, 37}) {
          const auto apart = swept_across<Real>(order, false, scale, n);
          const auto at_once = swept_across<Real>(order, true, scale, n);
          EXPECT_EQ(std::memcmp(apart.data(), at_once.data(), apart.size() * sizeof(Real)), 0)
              << "order " << order << ", scale " << scale << ", " << n << " cells";
        }
  };
  compare(float());
  compare(double());
}

}  // namespace
}  // namespace slipwave::solver
