// Uses the installed headers and libraries as an outside project would: a ray hits a triangle made by hand, and the
// scene file named by the argument loads and renders.
#include <core/accelerator.h>
#include <core/camera.h>
#include <core/scene.h>
#include <integrators/render.h>
#include <io/load_scene.h>
#include <materials/alpha.h>

#include <cmath>
#include <cstdio>

namespace {

candil::Scene make_triangle() {
  candil::Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  candil::Scene scene;
  scene.meshes.push_back(mesh);
  scene.materials.emplace_back();
  scene.objects.push_back({"triangle", 0, 1});
  scene.instances.emplace_back();
  return scene;
}

bool triangle_is_hit() {
  const candil::Scene scene = make_triangle();
  const auto accelerator = candil::make_accelerator(scene, candil::alpha_filter());
  candil::Ray ray;
  ray.origin = {0, 0, 3};
  ray.direction = {0, 0, -1};
  const std::optional<candil::Hit> hit = accelerator->intersect(ray);
  return hit && std::abs(hit->t - 3) < 1e-5f;
}

bool file_renders(const char* path) {
  const candil::LoadedScene loaded = candil::load_scene(path);
  const candil::Scene& scene = loaded.scene;
  const auto accelerator = candil::make_accelerator(scene, candil::alpha_filter());
  const candil::LightSampler lights(scene);
  const candil::BsdfTables tables(scene);
  candil::RenderSettings settings;
  settings.width = settings.height = 8;
  settings.samples_per_pixel = 1;
  const candil::Camera camera = candil::frame_points(candil::scene_outline(scene), 0.5f, 0.3f, 1.0f);
  const candil::RenderResult result = candil::render({scene, *accelerator, lights, tables}, camera, settings);
  return result.rays.camera == 64 && result.non_finite_samples == 0;
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return 2;
  if (!triangle_is_hit()) {
    std::puts("the ray does not hit the triangle at distance 3");
    return 1;
  }
  if (!file_renders(arguments[1])) {
    std::puts("the scene does not render");
    return 1;
  }
  return 0;
}
