#include "tests/support/brute_force.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace candil::test {
namespace {

double frobenius_norm(const glm::dmat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

std::string describe(const Ray& ray) {
  std::ostringstream text;
  text.precision(9);
  text << "ray from " << ray.origin.x << ' ' << ray.origin.y << ' ' << ray.origin.z << " along " << ray.direction.x
       << ' ' << ray.direction.y << ' ' << ray.direction.z << " up to " << ray.t_max << ": ";
  return text.str();
}

}  // namespace

BruteForce::BruteForce(const Scene& scene, BackFaces back_faces) {
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const glm::dmat3 linear(instance.to_world.linear);
    const glm::dvec3 translation(instance.to_world.translation);
    const double condition = frobenius_norm(linear) * frobenius_norm(glm::inverse(linear));
    const Object& object = scene.objects[instance.object];
    for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
      const Mesh& mesh = scene.meshes[m];
      const Material& material = scene.materials[mesh.material];
      const bool is_back_invisible =
          back_faces == BackFaces::as_materials_say && !material.is_double_sided && !material.is_transmissive();
      const auto world = [&](std::uint32_t vertex) {
        return linear * glm::dvec3(mesh.positions[vertex]) + translation;
      };
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle triangle = mesh.triangles[t];
        const bool is_world_space = instance.is_world_space;
        faces_.push_back({world(triangle.x), world(triangle.y), world(triangle.z), is_back_invisible,
                          glm::determinant(linear) < 0, is_world_space ? 1 : condition * condition,
                          is_world_space ? 0 : glm::length(translation), is_world_space, i, m, t});
      }
    }
  }
}

// Moeller and Trumbore 1997. The error bounds are of a float implementation that subtracts the ray's origin from the
// vertices. With u = 2^-24, L the largest distance of a vertex from the origin, E the longest edge, N = cross of two
// edges and d the ray's unit direction:
// - Edge functions that are products of edges, vertices and direction (Embree): subtracting moves a vertex by u L; the
//   three functions, sums of products of size E L, are off by a few u E L; divided by their sum |d . N|, barycentric
//   coordinates are off by k u E L / |d . N|.
// - Shearing along the largest component d_z first (core/bvh/triangle_test.h): a vertex moves by at most 6.3 u L in the
//   plane (2 u |a| + 4 u |s c| along both axes, s <= 1). There edges are at most E / |d_z| long and the triangle has
//   |d . N| / |d_z| of twice the area, so that barycentric coordinates are off by 6.3 u E L / |d . N|. The edge
//   functions' own rounding is 3 u times the square of the longest edge there, which gives 3 u E^2 / |d_z| / |d . N|,
//   at most 10.4 u E L / |d . N| since E <= 2 L and |d_z| >= 1 / sqrt(3). Hence k = 17.
// - t = (v . N) / (d . N), or the mean of the vertices' t by the barycentric coordinates: off by k u E L (L + t) /
//   |d . N|, where t <= L.
// An instance is intersected in object space: the transformed origin is off by a few u times the condition number times
// what went into it (origin and translation, which join L), and lengths and N may there be stretched against each other
// by the squared condition number.
std::optional<Crossing> BruteForce::cross(const Ray& ray, const Face& face) const {
  const glm::dvec3 origin(ray.origin), direction(ray.direction);
  const glm::dvec3 edge_b = face.b - face.a, edge_c = face.c - face.a, from_a = origin - face.a;
  const glm::dvec3 normal = glm::cross(edge_b, edge_c);
  const double determinant = -glm::dot(direction, normal);
  if (determinant == 0) return std::nullopt;
  const glm::dvec3 moment = glm::cross(from_a, direction);
  const double u = glm::dot(edge_c, moment) / determinant, v = -glm::dot(edge_b, moment) / determinant;

  Crossing crossing;
  crossing.t = glm::dot(from_a, normal) / determinant;
  double reach = std::max({glm::length(from_a), glm::length(face.b - origin), glm::length(face.c - origin)});
  if (!face.is_world_space) reach += glm::length(origin) + face.instance_translation;
  const double longest_edge = std::max({glm::length(edge_b), glm::length(edge_c), glm::length(face.c - face.b)});
  constexpr double factor = 17 * 0x1p-24;
  const double error = factor * face.conditioning * longest_edge * reach / std::abs(determinant);
  crossing.barycentric = Vec2(u, v);
  crossing.barycentric_error = error;
  crossing.t_error = error * (reach + std::abs(crossing.t));
  crossing.instance = face.instance, crossing.mesh = face.mesh, crossing.triangle = face.triangle;

  const bool is_front = (determinant > 0) != face.is_mirrored;
  if (face.is_back_invisible && !is_front && error < 1) return std::nullopt;
  const double inside = std::min({u, v, 1 - u - v});
  const double within = std::min(crossing.t, ray.t_max - crossing.t);
  if (inside < -error || within < -crossing.t_error) return std::nullopt;
  crossing.is_certain = error < 1 && inside > error && within > crossing.t_error;
  return crossing;
}

std::vector<Crossing> BruteForce::crossings(const Ray& ray) const {
  std::vector<Crossing> found;
  for (const Face& face : faces_) {
    if (const std::optional<Crossing> crossing = cross(ray, face)) found.push_back(*crossing);
  }
  return found;
}

namespace {

const Crossing* nearest_certain_of(const std::vector<Crossing>& crossings) {
  const Crossing* nearest = nullptr;
  for (const Crossing& crossing : crossings) {
    if (crossing.is_certain && (!nearest || crossing.t < nearest->t)) nearest = &crossing;
  }
  return nearest;
}

}  // namespace

bool BruteForce::is_decided(const std::vector<Crossing>& crossings) {
  const Crossing* nearest = nearest_certain_of(crossings);
  return std::all_of(crossings.begin(), crossings.end(), [&](const Crossing& crossing) {
    if (&crossing == nearest) return true;
    return nearest && crossing.t - crossing.t_error > nearest->t + nearest->t_error;
  });
}

std::string BruteForce::complaint(const Ray& ray, const std::vector<Crossing>& crossings,
                                  const std::optional<Hit>& answer) {
  const Crossing* nearest = nearest_certain_of(crossings);
  std::ostringstream text;
  text.precision(9);
  if (!answer) {
    if (nearest) {
      text << "missed triangle " << nearest->triangle << " of mesh " << nearest->mesh << " of instance "
           << nearest->instance << " at " << nearest->t;
    }
  } else {
    const auto named = std::find_if(crossings.begin(), crossings.end(), [&](const Crossing& crossing) {
      return crossing.instance == answer->instance && crossing.mesh == answer->mesh &&
             crossing.triangle == answer->triangle;
    });
    if (named == crossings.end()) {
      text << "does not cross triangle " << answer->triangle << " of mesh " << answer->mesh << " of instance "
           << answer->instance << ", hit at " << answer->t;
    } else if (std::abs(answer->t - named->t) > named->t_error) {
      text << "t is " << answer->t << ", not " << named->t << " within " << named->t_error;
    } else if (glm::length(answer->barycentric - named->barycentric) > 2 * named->barycentric_error + 1e-6) {
      text << "barycentric coordinates are off by " << glm::length(answer->barycentric - named->barycentric);
    } else if (nearest && nearest->t + nearest->t_error < answer->t - named->t_error) {
      text << "hit at " << answer->t << ", but there is a nearer one at " << nearest->t;
    }
  }
  return text.str().empty() ? "" : describe(ray) + text.str();
}

}  // namespace candil::test
