#include "tests/io/json_sample.h"

#include "io/error.h"
#include "io/image_file.h"

namespace candil::test {

LoadedScene load_json(const TemporaryFolder& folder, const std::string& text) {
  write_text(folder / "scene.json", text);
  return load_scene(folder / "scene.json");
}

LoadedScene load_json(const std::string& text) { return load_json(TemporaryFolder(), text); }

std::string json_error(const TemporaryFolder& folder, const std::string& text) {
  try {
    load_json(folder, text);
  } catch (const InputError& error) {
    const std::string message = error.what(), start = folder.path().string() + "/";
    return message.starts_with(start) ? message.substr(start.size()) : message;
  }
  return {};
}

std::string json_error(const std::string& text) { return json_error(TemporaryFolder(), text); }

void write_grey_png(const std::filesystem::path& path, int width, int height, const std::vector<int>& values) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(values[i / 3]) / 255;
  write_image(path, image, false, {});
}

}  // namespace candil::test
