// SPDX-License-Identifier: BSD-3-Clause
#include "cli/ranks.hpp"

#include <new>

#include "base/error.hpp"

namespace slipwave::cli {
namespace {

/// A launcher ends all processes when one of them ends with an error: that must wait for the one that says
/// why, and saves what there is.
[[noreturn]] void end_together(Ranks& ranks, int status) {
  ranks.all_of({});
  throw EndSilently{status};
}

}  // namespace

void run_on_ranks(const Context& context, Ranks& ranks, const std::function<void(int status)>& end_all,
                  const std::function<void(const Context&)>& body) {
  const bool first = ranks.number() == 0;
  Context own = context;
  own.quiet = context.quiet || !first;
  own.verbose = context.verbose && first;
  if (!first) own.log = nullptr;
  try {
    return body(own);
  } catch (const CollectiveError& error) {
    if (first) say_error(context.tool, error.what());
    end_together(ranks, int(error.kind()));
  } catch (const EndedElsewhere& end) {
    end_together(ranks, int(end.kind));
  } catch (const Error& error) {
    say_error(context.tool, error.what());
    if (error.kind() == ErrorKind::unstable) end_together(ranks, int(error.kind()));
    end_all(int(error.kind()));
    throw EndSilently{int(error.kind())};
  } catch (const std::bad_alloc&) {
    say_error(context.tool, "out of memory");
    end_all(1);
    throw EndSilently{1};
  }
}

}  // namespace slipwave::cli
