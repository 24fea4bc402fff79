#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "solver/kernels.hpp"

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
  std::vector<std::vector<Real>> rows(12, row(0));
  const auto at = [&](int number) { return rows[std::size_t(number)].data() + gap; };
  const auto& kernel = kernels<Real>(order, uniform);
  kernel.leave(n, 1, vp.data() + gap, sp.data() + gap, zp.data(), b.data(), scale, at(0), at(1));
  kernel.leave(n, 1, vs.data() + gap, ss.data() + gap, zs.data(), b.data(), scale, at(2), at(3));
  kernel.meet(n, at(0), at(1), at(2), at(3), material, material, {at(4), at(5), at(6), at(7)});
  kernel.meet_p(n, at(0), at(1), material, material, {at(8), at(9), nullptr, nullptr});
  const Faces<Real> lo{at(4), at(5), at(6), at(7)}, hi{at(5), at(8), at(7), at(9)};
  const SweptRows<Real> swept{vp.data() + gap, sp.data() + gap, passive.data() + gap, vs.data() + gap,
                              ss.data() + gap};
  kernel.update(n, scale, lo, hi, material, swept);
  kernel.update_p(n, scale, lo, hi, material, swept);
  for (const auto* changed : {&vp, &sp, &passive, &vs, &ss}) rows.push_back(*changed);
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

}  // namespace
}  // namespace slipwave::solver
