#include "tests/io/ply_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "io/error.h"
#include "tests/support/temporary_folder.h"

namespace candil::test {

PlySample::PlySample(const std::string& format, const std::string& elements)
    : format_(format), text_("ply\nformat " + format + " 1.0\n" + elements + "end_header\n") {}

template <typename Value>
void PlySample::append(Value value) {
  char bytes[sizeof(Value)];
  std::memcpy(bytes, &value, sizeof(Value));
  const bool is_big = format_ == "binary_big_endian";
  if (is_big != (std::endian::native == std::endian::big)) std::reverse(std::begin(bytes), std::end(bytes));
  text_.append(bytes, sizeof(Value));
}

PlySample& PlySample::value(const std::string& type, double value) {
  if (format_ == "ascii") {
    std::string number = std::to_string(value);
    if (number.ends_with(".000000")) number.resize(number.size() - 7);
    text_ += number + " ";
  } else if (type == "char" || type == "int8") {
    append(static_cast<std::int8_t>(value));
  } else if (type == "uchar" || type == "uint8") {
    append(static_cast<std::uint8_t>(value));
  } else if (type == "short" || type == "int16") {
    append(static_cast<std::int16_t>(value));
  } else if (type == "ushort" || type == "uint16") {
    append(static_cast<std::uint16_t>(value));
  } else if (type == "int" || type == "int32") {
    append(static_cast<std::int32_t>(value));
  } else if (type == "uint" || type == "uint32") {
    append(static_cast<std::uint32_t>(value));
  } else if (type == "float" || type == "float32") {
    append(static_cast<float>(value));
  } else {
    append(value);
  }
  return *this;
}

PlySample& PlySample::values(const std::string& type, const std::vector<double>& values) {
  for (const double each : values) value(type, each);
  return *this;
}

PlySample& PlySample::list(const std::string& count_type, const std::string& type, const std::vector<double>& values) {
  return value(count_type, static_cast<double>(values.size())).PlySample::values(type, values);
}

PlySample& PlySample::end_row() {
  if (format_ == "ascii") text_ += '\n';
  return *this;
}

std::string vertex_element(std::size_t count, const std::string& type) {
  return "element vertex " + std::to_string(count) + "\nproperty " + type + " x\nproperty " + type + " y\nproperty " +
         type + " z\n";
}

std::string ascii_ply(const std::vector<Vec3>& positions, const std::vector<std::string>& faces) {
  PlySample sample("ascii", vertex_element(positions.size()) + "element face " + std::to_string(faces.size()) +
                                "\nproperty list uchar int vertex_indices\n");
  for (const Vec3 p : positions) sample.values("float", {p.x, p.y, p.z}).end_row();
  std::string text = sample.text();
  for (const std::string& face : faces) text += face + "\n";
  return text;
}

Mesh load_ply_text(const std::string& text, std::vector<std::string>& warnings, const PlyOptions& options) {
  const TemporaryFolder folder;
  write_text(folder / "mesh.ply", text);
  return load_ply(folder / "mesh.ply", options, warnings);
}

Mesh load_ply_text(const std::string& text, const PlyOptions& options) {
  std::vector<std::string> warnings;
  Mesh mesh = load_ply_text(text, warnings, options);
  EXPECT_EQ(warnings, std::vector<std::string>{});
  return mesh;
}

std::string ply_error(const std::string& text) {
  try {
    std::vector<std::string> warnings;
    load_ply_text(text, warnings);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(std::min(message.find("mesh.ply"), message.size()));
  }
  return {};
}

}  // namespace candil::test
