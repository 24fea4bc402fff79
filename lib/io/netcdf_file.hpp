// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slipwave {

/// The only place that calls the netCDF library (which is not thread-safe: one thread at a time). Variables
/// and dimensions are named, never numbered. Every failure is an Error that names file and variable.
class NetcdfFile {
 public:
  enum class Type { f64, f32, i32, u8, text, other };
  /// How a variable lies in the file. chunk: cells a chunk along each dimension, empty = the library's
  /// choice.
  struct Storage {
    bool compress = true;  // shuffle + deflate 1
    std::vector<std::size_t> chunk = {};
  };
  struct Variable {
    std::string name;
    Type type = Type::other;
    std::vector<std::string> dimensions;
    std::vector<std::size_t> shape;
    std::size_t size() const;
  };

  /// A new netCDF-4 file at `path`, replacing what is there; `shown_name` is what messages call it. Together
  /// with OutputFile: create(out.path_for_libraries(), out.shown_name()), ..., close(), out.commit().
  static NetcdfFile create(const std::string& path, const std::string& shown_name);
  /// Opens a file for reading, or standard input ("-") and fifos by way of memory. Refuses truncated files.
  static NetcdfFile open(const std::string& path);
  /// Opens a file that lies in memory.
  static NetcdfFile open(std::vector<char> bytes, const std::string& shown_name);

  NetcdfFile(NetcdfFile&&) noexcept;
  NetcdfFile& operator=(NetcdfFile&&) noexcept;
  ~NetcdfFile();
  /// Everything written reaches the file, or an Error says why not. The destructor closes silently.
  void close();
  /// What is written so far reaches the file.
  void flush();
  const std::string& shown_name() const;

  /// length 0: unlimited.
  void define_dimension(const std::string& name, std::size_t length);
  void define_variable(const std::string& name, Type type, const std::vector<std::string>& dimensions,
                       const Storage& storage);
  void define_variable(const std::string& name, Type type, const std::vector<std::string>& dimensions) {
    define_variable(name, type, dimensions, Storage());
  }
  /// `variable` "" means the file. _FillValue must come before the first values and have the variable's type.
  void put_attribute(const std::string& variable, const std::string& name, const std::string& text);
  void put_attribute(const std::string& variable, const std::string& name, const std::vector<double>& values);
  void put_attribute(const std::string& variable, const std::string& name, const std::vector<float>& values);
  void put_attribute(const std::string& variable, const std::string& name, const std::vector<int>& values);
  void put_attribute(const std::string& variable, const std::string& name,
                     const std::vector<std::uint8_t>& values);

  // Values. T: double, float, int, std::uint8_t; the library converts, out of range is an Error.
  /// A whole variable without unlimited dimension.
  template <class T>
  void put(const std::string& variable, const T* values);
  /// The block of `count` values along each dimension from `start` on.
  template <class T>
  void put(const std::string& variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, const T* values);
  void put_text(const std::string& variable, const std::vector<std::string>& values);

  std::vector<Variable> variables() const;
  bool has_variable(const std::string& name) const;
  Variable variable(const std::string& name) const;
  std::optional<std::size_t> dimension_length(const std::string& name) const;
  std::optional<std::string> text_attribute(const std::string& variable, const std::string& name) const;
  std::optional<std::vector<double>> number_attribute(const std::string& variable,
                                                      const std::string& name) const;
  /// All values, last dimension fastest. Absurd sizes (more than a file of this length can hold) are refused
  /// before anything is allocated.
  template <class T>
  std::vector<T> get(const std::string& variable) const;
  template <class T>
  std::vector<T> get(const std::string& variable, const std::vector<std::size_t>& start,
                     const std::vector<std::size_t>& count) const;
  std::vector<std::string> get_text(const std::string& variable) const;
  /// These read values as get<float> does, in physical units: scale_factor and add_offset applied; NaN for
  /// _FillValue, missing_value (or the library's default fill) and what lies outside valid_range, valid_min
  /// or valid_max.
  std::vector<float> get_physical(const std::string& variable) const;
  std::vector<float> get_physical(const std::string& variable, const std::vector<std::size_t>& start,
                                  const std::vector<std::size_t>& count) const;

 private:
  struct Impl;
  explicit NetcdfFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipwave
