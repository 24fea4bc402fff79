#include "segy/pair.hpp"

#include "base/error.hpp"
#include "gather/difference.hpp"
#include "segy/geometry.hpp"

namespace slipwave::segy {
namespace {

std::int64_t samples_of(const Reader&, const Trace& trace) {
  return static_cast<std::int64_t>(trace.samples.size());
}
std::int64_t samples_of(const Reader& reader, const RawTrace& trace) {
  return static_cast<std::int64_t>(trace.samples.size()) / reader.header().format->bytes;
}

template <class AnyTrace>
SampleAxis axis_of(const Reader& reader, const AnyTrace& trace) {
  return {samples_of(reader, trace), reader.axis().interval_s, start_s(trace.words, reader.header())};
}

}  // namespace

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
  std::string differs = sampling_difference(axis_of(b_, b), axis_of(a_, a));
  if (differs.empty())
    differs = geometry_difference(si_from_words(b.words, b_.header()), si_from_words(a.words, a_.header()));
  if (!differs.empty())
    throw Error(b_.name() + ": trace " + std::to_string(b_.delivered()) + ": " + differs + " as in " +
                a_.name());
  return true;
}

template bool PairReader::next_of_both(Trace&, Trace&);
template bool PairReader::next_of_both(RawTrace&, RawTrace&);

}  // namespace slipwave::segy
