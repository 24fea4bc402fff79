#include "segy/pair.hpp"

#include "base/error.hpp"
#include "gather/difference.hpp"

namespace slipwave::segy {
PairReader::PairReader(Reader& a, Reader& b) : a_(a), b_(b) {
  const std::string differs = sampling_difference(b.axis(), a.axis());
  if (!differs.empty()) throw Error(b.name() + ": " + differs + " as in " + a.name());
}

template <class AnyTrace>
bool PairReader::next_of_both(AnyTrace& a, AnyTrace& b) {
  const bool more_a = a_.next(a);
  const bool more_b = b_.next(b);
  if (more_a != more_b) {
    const Reader& shorter = more_a ? b_ : a_;
    const Reader& longer = more_a ? a_ : b_;
    throw Error(shorter.name() + ": has " + std::to_string(shorter.delivered()) + " traces, " +
                longer.name() + " has more");
  }
  if (!more_a) return false;
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
