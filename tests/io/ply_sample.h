/// PLY files, written by tests value by value.
#pragma once

#include <string>
#include <vector>

#include "io/ply.h"

namespace candil::test {

inline const std::string ply_formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

/// Rows in one of the formats, each value in the type that it is given with.
class PlySample {
 public:
  /// `elements`: the header's lines between "format" and "end_header".
  PlySample(const std::string& format, const std::string& elements);

  PlySample& value(const std::string& type, double value);
  PlySample& values(const std::string& type, const std::vector<double>& values);
  /// The length as `count_type`, then the values.
  PlySample& list(const std::string& count_type, const std::string& type, const std::vector<double>& values);
  PlySample& end_row();

  const std::string& text() const { return text_; }

 private:
  template <typename Value>
  void append(Value value);

  std::string format_, text_;
};

/// "element vertex COUNT" with x, y, z of a type.
std::string vertex_element(std::size_t count, const std::string& type = "float");

/// An ascii file with float positions, one row each, and faces as text, one row each.
std::string ascii_ply(const std::vector<Vec3>& positions, const std::vector<std::string>& faces);

Mesh load_ply_text(const std::string& text, std::vector<std::string>& warnings, const PlyOptions& options = {});
/// The same where no warning is expected.
Mesh load_ply_text(const std::string& text, const PlyOptions& options = {});
/// The message of the InputError that the text gives, without the folder; empty if it loads.
std::string ply_error(const std::string& text);

}  // namespace candil::test
