#include "io/error.h"
#include "io/image_file.h"
#include "io/json_internal.h"

namespace candil {

void add_light(const JsonNode& light, Scene& scene) {
  PunctualLight result;
  result.name = object_name(light);
  const std::string type = light["type"].text();
  if (type == "directional") {
    result.kind = PunctualKind::directional;
    result.intensity = light.color("irradiance", Vec3(1));
  } else {
    result.position = light["position"].vec3();
    result.intensity = light.color("intensity", Vec3(1));
  }
  if (const auto power = light.find("power")) {
    if (light.has("intensity")) power->fail("must not stand beside \"intensity\"");
    result.intensity = power->color() / (4 * pi);
  }
  if (type != "point") result.direction = light["direction"].direction();
  if (type == "spot") {
    result.kind = PunctualKind::spot;
    result.outer_cone = light.radians("outer_angle", 45);
    result.inner_cone = light.radians("inner_angle", 0);
    if (result.inner_cone > result.outer_cone) light["inner_angle"].fail("must not exceed \"outer_angle\"");
  }
  scene.punctual_lights.push_back(std::move(result));
}

Environment read_environment_of(const JsonNode& environment, LoadedScene& loaded) {
  Environment result;
  if (const auto color = environment.find("color")) {
    result.tint = color->color();
    return result;
  }
  const JsonNode image = environment["image"];
  try {
    loaded.files.push_back(referenced_file(image));
    result.image = read_environment(loaded.files.back());
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.starts_with(image.file().name + ": ")) throw;
    image.fail(message);
  }
  result.tint = Vec3(environment.number("strength", 1));
  result.rotation = environment.radians("rotation", 0);
  return result;
}

}  // namespace candil
