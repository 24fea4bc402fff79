#include "acquisition/source_kind.hpp"

#include <gtest/gtest.h>

#include "base/parse.hpp"

namespace slipwave {
namespace {

template <int D>
Source<D> source_of(const std::string& kind) {
  return {{}, parse_mechanism<D>(kind), parse_wavelet("ricker:30"), 1};
}

/// The kind with numbers 1, 2, ... for its parameters.
template <int D>
std::string typed(const SourceKind<D>& kind) {
  std::string text = kind.name;
  if (*kind.parameters != '\0')
    for (std::size_t n = 0; n < split(kind.parameters, ',').size(); ++n)
      text += (n == 0 ? ':' : ',') + std::to_string(n + 1);
  return text;
}

template <int D>
void expect_rows_agree() {
  for (const auto& kind : source_kinds<D>()) {
    const auto source = source_of<D>(typed(kind));
    const auto& mechanism = source.mechanism;
    const bool shear = std::string(kind.name) == "plane-s";
    EXPECT_STREQ(name_of<D>(mechanism), shear ? kind.name : source_kinds<D>()[mechanism.index()].name);
    EXPECT_EQ(point_injection(source).has_value(), kind.inject != nullptr) << kind.name;
  }
}

TEST(SourceKinds, AreReadAsTheyAreWritten) {
  expect_rows_agree<2>();
  expect_rows_agree<3>();
}

TEST(SourceKinds, SayTheirUnits) {
  EXPECT_EQ(
      amplitude_help(),
      "explosion, moment, double-couple: N m/s per m; force: N/m; plane, plane-s: m/s; in 3-D N m/s and N");
}

TEST(SourceKinds, AreIsotropicWhereAllDirectionsAreAlike) {
  EXPECT_TRUE(point_injection(source_of<2>("explosion"))->isotropic);
  EXPECT_FALSE(point_injection(source_of<2>("moment:1,1,0"))->isotropic);
}

}  // namespace
}  // namespace slipwave
