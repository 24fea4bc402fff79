// SPDX-License-Identifier: BSD-3-Clause
#include "segy/pair.hpp"

#include "base/error.hpp"
#include "gather/difference.hpp"

namespace slipwave::segy {
PairReader::PairReader(Reader& a, Reader& b) : a_(a), b_(b) {
  const std::string differs = sampling_difference(b.axis(), a.axis());
  if (!differs.empty()) throw Error(b.name() + ": " + differs + " as in " + a.name());
}

/// Whether headers have the same words that mean the same: most pairs need no further comparison.
template <class AnyTrace>
bool PairReader::equal_headers(const AnyTrace& a, const AnyTrace& b) const {
  const FileHeader& of_a = a_.header();
  const FileHeader& of_b = b_.header();
  return of_a.su == of_b.su && of_a.major == of_b.major && of_a.feet == of_b.feet && a.words == b.words &&
         a.extensions == b.extensions && a.extensions.empty() && a_.axis_of(a).count == b_.axis_of(b).count;
}

template <class AnyTrace>
bool PairReader::next_of_both(AnyTrace& a, AnyTrace& b) {
  const bool more_a = a_.next(a);
  const bool more_b = b_.next(b);
  if (more_a != more_b) {
    const Reader& shorter = more_a ? b_ : a_;
    const Reader& longer = more_a ? a_ : b_;
    if (shorter.damage()) throw Error(*shorter.damage());
    throw Error(shorter.name() + ": has " + std::to_string(shorter.delivered()) + " traces, " +
                longer.name() + " has more");
  }
  if (!more_a) return false;
  if (equal_headers(a, b)) return true;
  std::string differs = sampling_difference(b_.axis_of(b), a_.axis_of(a));
  if (differs.empty()) differs = geometry_difference(b_.si_header(b), a_.si_header(a));
  if (!differs.empty())
    throw Error(b_.name() + ": trace " + std::to_string(b_.delivered()) + ": " + differs + " as in " +
                a_.name());
  return true;
}

template bool PairReader::next_of_both(Trace&, Trace&);
template bool PairReader::next_of_both(RawTrace&, RawTrace&);

}  // namespace slipwave::segy
