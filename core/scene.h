/// The scene as plain data: ids instead of pointers, filled by loaders, only read afterwards. What is derived from it
/// (accelerator, light sampler, closure tables) is built beside it and never stored in it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/affine.h"
#include "core/image.h"
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

enum class Wrap : std::uint8_t { repeat, clamp, mirror };
enum class Filter : std::uint8_t { nearest, bilinear };

/// How an image is looked up; several textures may share one image.
struct Texture {
  std::uint32_t image = 0;  ///< Into Scene::images.
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  Filter filter = Filter::bilinear;
};

/// A material's use of a texture. `row_u` and `row_v` map (u, v, 1) to the coordinates that are looked up
/// (KHR_texture_transform as an affine map).
struct TextureSlot {
  std::uint32_t texture = invalid_id;  ///< Into Scene::textures; invalid_id: no texture.
  std::uint32_t uv_set = 0;            ///< 0 or 1.
  Vec3 row_u{1, 0, 0}, row_v{0, 1, 0};

  bool is_used() const { return texture != invalid_id; }
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Which closure a material becomes; emission, alpha, sides and normal map are common to all.
enum class MaterialModel : std::uint8_t {
  metallic_roughness,  ///< glTF 2.0 with extensions; also dielectrics, smooth and rough.
  phong,      ///< base_color / pi + specular_color (n + 2) / (2 pi) cos^n, n = phong_exponent; infinite: a mirror.
  conductor,  ///< GGX of `roughness` with Fresnel's equations of conductor_eta and conductor_k, times base_color.
};

/// glTF 2.0 metallic-roughness with extensions; the defaults are the specification's. Factors multiply textures.
struct Material {
  std::string name;
  MaterialModel model = MaterialModel::metallic_roughness;
  Vec4 base_color{1.0f};  ///< Linear RGBA.
  TextureSlot base_color_texture;
  float metallic = 1, roughness = 1;       ///< Roughness is perceptual: alpha = roughness squared.
  TextureSlot metallic_roughness_texture;  ///< G: roughness, B: metallic.
  TextureSlot normal_texture;
  float normal_scale = 1;
  TextureSlot occlusion_texture;  ///< R. Read for `info` only: light transport computes occlusion itself.
  float occlusion_strength = 1;
  Vec3 emission{0.0f};  ///< emissiveFactor times emissiveStrength; radiance, W/(sr m2) = nit.
  TextureSlot emission_texture;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool is_double_sided = false;
  bool is_unlit = false;         ///< KHR_materials_unlit: base colour is the emitted radiance.
  float ior = 1.5f;              ///< KHR_materials_ior; 0 means an infinite one (Fresnel term 1).
  float specular = 1;            ///< KHR_materials_specular.
  TextureSlot specular_texture;  ///< A.
  Vec3 specular_color{1.0f};
  TextureSlot specular_color_texture;  ///< sRGB.
  float transmission = 0;              ///< KHR_materials_transmission.
  TextureSlot transmission_texture;    ///< R.
  float thickness = 0;                 ///< KHR_materials_volume; 0: thin-walled. Rays measure it themselves.
  Vec3 attenuation_color{1.0f};
  float attenuation_distance = infinity;  ///< Metres.
  float phong_exponent = infinity;
  Vec3 conductor_eta{0.2f}, conductor_k{3.0f};  ///< Complex index of refraction, eta - i k, for red, green, blue.

  bool is_textured() const {
    // All bits are set in the id of no texture.
    return (base_color_texture.texture & metallic_roughness_texture.texture & normal_texture.texture &
            emission_texture.texture & specular_texture.texture & specular_color_texture.texture &
            transmission_texture.texture) != invalid_id;
  }
  bool is_transmissive() const { return transmission > 0; }
  bool is_volume() const { return transmission > 0 && thickness > 0; }
  bool is_emissive() const { return !is_black(emission) || is_unlit; }
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
