/// The scene as plain data: ids instead of pointers, filled by loaders, only read afterwards. What is derived from it
/// (accelerator, light sampler, closure tables) is built beside it and never stored in it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/affine.h"
#include "core/image.h"
#include "core/material.h"
#include "core/math.h"

namespace candil {

/// Triangles of one material, in object space. Every attribute vector is empty or as long as `positions`.
struct Mesh {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;       ///< Counter-clockwise seen from the front.
  std::vector<Vec3> normals;             ///< Unit length; empty: flat shading.
  std::vector<Vec4> tangents;            ///< xyz unit length; w = +1 or -1, bitangent = w cross(normal, tangent).
  std::array<std::vector<Vec2>, 2> uvs;  ///< (0, 0) is the upper left corner of an image.
  std::vector<Vec4> colors;              ///< Linear RGBA that multiplies the base colour.
  std::uint32_t material = 0;            ///< Into Scene::materials.
};

/// Surfaces given by a formula, in their own space. All have their front towards +Z or outwards.
enum class ShapeKind : std::uint8_t {
  sphere,  ///< Radius 1 around the origin.
  disc,    ///< Radius 1 around the origin, z = 0.
  plane,   ///< z = 0, without end.
};

/// One shape in the world. Any invertible transform will do: a stretched sphere is an ellipsoid. Shapes are so small
/// that each use of one is a record of its own.
struct Shape {
  std::string name;
  ShapeKind kind = ShapeKind::sphere;
  Affine to_world;
  std::uint32_t material = 0;  ///< Into Scene::materials.
};

/// The unit of instancing: meshes [first_mesh, first_mesh + mesh_count), which share one bottom-level BVH.
struct Object {
  std::string name;
  std::uint32_t first_mesh = 0, mesh_count = 0;
};

struct Instance {
  std::string name;
  std::uint32_t object = 0;  ///< Into Scene::objects.
  Affine to_world;
  /// The object's vertices already are in world space and `to_world` is the identity (see bake_single_instances()).
  bool is_world_space = false;
};

enum class CameraKind : std::uint8_t { perspective, orthographic };

/// Looks along its local -Z, +Y up.
struct Camera {
  std::string name;
  CameraKind kind = CameraKind::perspective;
  Affine to_world;           ///< Only rotation and translation are used; a scale is ignored.
  float yfov = 0.8f;         ///< Full vertical angle, radians (perspective).
  float aspect = 0;          ///< Width / height the author framed for; 0: any.
  float xmag = 1, ymag = 1;  ///< Half width and half height in metres (orthographic).
  float lens_radius = 0;     ///< Metres; 0: pinhole.
  int lens_blades = 0;       ///< Corners of the aperture, at least 3; 0: round.
  float lens_rotation = 0;   ///< Of the aperture's first corner, radians counter-clockwise from the camera's +X.
  float focus_distance = 1;  ///< Metres along the viewing axis to the plane in focus; 0: the file does not say.
};

enum class PunctualKind : std::uint8_t { point, spot, directional };

/// KHR_lights_punctual. `intensity` holds colour times intensity: candela (point, spot) or lux (directional).
struct PunctualLight {
  std::string name;
  PunctualKind kind = PunctualKind::point;
  Vec3 intensity{1.0f};
  Vec3 position{0.0f};       ///< World space, metres.
  Vec3 direction{0, 0, -1};  ///< World space, unit, the way the light travels.
  float range = infinity;    ///< Metres; the specification's window function fades the light out towards it.
  float inner_cone = 0, outer_cone = 0.78539816f;  ///< Half angles of a spot, radians.
};

/// Light from everywhere beyond the scene.
struct Environment {
  Image image;         ///< Latitude-longitude, linear RGB; its centre is seen looking along -Z, its right half lies
                       ///< towards +X, its top is +Y. Empty: `tint` alone, a constant.
  Vec3 tint{0.0f};     ///< Radiance, or a factor of the image. Black: no environment.
  float rotation = 0;  ///< Radians about +Y, counter-clockwise seen from above.
  /// What the camera sees instead of the environment (also through straight or refracted specular transmission).
  std::optional<Vec3> backdrop;

  bool is_present() const { return !is_black(tint); }
};

struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Instance> instances;
  std::vector<Shape> shapes;
  std::vector<Material> materials;  ///< Never empty when there is a mesh or a shape.
  std::vector<Texture> textures;
  std::vector<TextureImage> images;
  std::vector<Camera> cameras;
  std::vector<PunctualLight> punctual_lights;
  Environment environment;
};

struct Bounds {
  Vec3 low{infinity}, high{-infinity};

  bool is_empty() const { return !(low.x <= high.x); }
  Vec3 center() const { return 0.5f * (low + high); }
  float radius() const { return is_empty() ? 0.0f : 0.5f * glm::length(high - low); }
  /// 0 to 7; bit 0, 1, 2 picks the higher x, y, z.
  Vec3 corner(int i) const { return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}; }
  void add(Vec3 p) { low = glm::min(low, p), high = glm::max(high, p); }
};

/// Box around every instance and every finite shape in world space; exact over vertices, empty for a scene without
/// geometry. Infinite planes do not count.
Bounds scene_bounds(const Scene& scene);

/// Points in world space whose convex hull is that of the scene, for framing it: every vertex of every instance, or,
/// where these would be more than two million, the corners of each instance's box.
std::vector<Vec3> scene_outline(const Scene& scene);

/// True when the scene brings light of its own: a punctual light, an environment, or a surface that emits more than 1
/// nit. Core glTF stops at 1, the white of the screen: such surfaces glow for the viewer but are not meant to light
/// anything, and neither are unlit ones.
bool has_light(const Scene& scene);

/// Triangles counted once per instance.
std::size_t instanced_triangle_count(const Scene& scene);

/// Moves the vertices of every object that is instanced exactly once into world space, so that rays reach it without
/// the detour of an instance. Objects used several times stay as they are. Winding, normals and tangents follow the
/// transform, mirrored ones included. Loaders call it last.
void bake_single_instances(Scene& scene);

}  // namespace candil
