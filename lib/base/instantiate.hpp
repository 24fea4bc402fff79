// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace slipwave {

/// The type of the function that a pointer points to, of a class or of none. A declaration may name it in
/// place of the signature.
template <class Pointer>
struct SignatureOf;
template <class Signature>
struct SignatureOf<Signature*> {
  using Type = Signature;
};
template <class Signature, class Class>
struct SignatureOf<Signature Class::*> {
  using Type = Signature;
};

}  // namespace slipwave

// The library's only macros. They instantiate a template of this source for every dimension and number type
// it is used with:
//
//   SLIPWAVE_INSTANTIATE_D(FUNCTION, name);           of template <int D>, for 2 and 3
//   SLIPWAVE_INSTANTIATE_REAL(FUNCTION, name);        of template <class Real>, for float and double
//   SLIPWAVE_INSTANTIATE_D_REAL(TYPE, class Name);    of template <int D, class Real>, for all four pairs
//
// FUNCTION takes a name, also Class::name, that no other template shares: overloads are told apart only by
// their signatures, written out. TYPE takes a class or struct with the word that declares it.
#define SLIPWAVE_FUNCTION(NAME, ...) \
  template slipwave::SignatureOf<decltype(&NAME<__VA_ARGS__>)>::Type NAME<__VA_ARGS__>
#define SLIPWAVE_TYPE(NAME, ...) template NAME<__VA_ARGS__>
#define SLIPWAVE_INSTANTIATE_D(WHAT, NAME) \
  SLIPWAVE_##WHAT(NAME, 2);                \
  SLIPWAVE_##WHAT(NAME, 3)
#define SLIPWAVE_INSTANTIATE_REAL(WHAT, NAME) \
  SLIPWAVE_##WHAT(NAME, float);               \
  SLIPWAVE_##WHAT(NAME, double)
#define SLIPWAVE_INSTANTIATE_D_REAL(WHAT, NAME) \
  SLIPWAVE_##WHAT(NAME, 2, float);              \
  SLIPWAVE_##WHAT(NAME, 2, double);             \
  SLIPWAVE_##WHAT(NAME, 3, float);              \
  SLIPWAVE_##WHAT(NAME, 3, double)
