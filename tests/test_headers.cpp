// SPDX-License-Identifier: BSD-3-Clause
// Holds nothing: CMake wants a source to compile headers for.
