#include "apps/environment_choice.h"

#include "core/studio.h"
#include "io/image_file.h"

namespace candil {
namespace {

Environment wanted_environment(const Scene& scene, const EnvironmentOptions& options, bool is_lit) {
  Environment environment;
  if (!options.image.empty()) {
    environment.image = read_environment(options.image);
    environment.tint = Vec3(1.0f);
    return environment;
  }
  if (options.color) {
    environment.tint = *options.color;
    return environment;
  }
  return is_lit || has_light(scene) ? scene.environment : make_studio_environment();
}

}  // namespace

Environment choose_environment(const Scene& scene, const EnvironmentOptions& options, bool is_lit) {
  Environment environment = wanted_environment(scene, options, is_lit);
  environment.rotation += options.rotation;
  environment.tint *= options.strength;
  return environment;
}

}  // namespace candil
