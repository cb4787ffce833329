#include "core/shape_light.h"

#include <algorithm>
#include <cmath>

#include "core/color.h"
#include "core/emission.h"
#include "core/frame.h"
#include "core/warp.h"

namespace candil {
namespace {

constexpr double pi_double = std::numbers::pi;

/// How far the rounding of its coordinates may have moved a point, metres: four units in the last place.
double rounding_of(Vec3 p) { return 0x1p-22 * max_component(glm::abs(p)); }

double cube(double x) { return x * x * x; }

double frobenius_norm(const glm::dmat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

}  // namespace

ShapeLight::ShapeLight(const Scene& scene, std::uint32_t id)
    : scene_(&scene),
      shape_(id),
      kind_(scene.shapes[id].kind),
      is_double_sided_(scene.materials[scene.shapes[id].material].is_double_sided),
      intersector_(scene.shapes[id]),
      to_world_(scene.shapes[id].to_world.linear),
      to_local_(glm::inverse(to_world_)),
      origin_(scene.shapes[id].to_world.translation),
      normal_(glm::normalize(glm::dvec3(0, 0, 1) * to_local_)),
      determinant_(std::abs(glm::determinant(to_world_))),
      area_(pi_double * glm::length(glm::cross(to_world_[0], to_world_[1]))) {}

Vec2 ShapeLight::coordinates_of(glm::dvec3 local) const {
  return kind_ == ShapeKind::sphere ? unit_to_octahedral(local) : Vec2(local);
}

Vec3 ShapeLight::emission_at(const SurfacePoint& on, bool is_front) const {
  const Material& material = scene_->materials[on.material];
  return emitted_radiance(*scene_, on, is_front) * alpha_coverage(*scene_, material, on.uv, on.color);
}

float ShapeLight::power(float scene_radius) const {
  if (!is_invertible(scene_->shapes[shape_].to_world)) return 0;
  constexpr int side = 8;
  double sum = 0;  // of luminance by relative area
  for (int i = 0; i < side * side; ++i) {
    const Vec2 u = (Vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
    glm::dvec3 local(u, 0);
    double area = 1;
    if (kind_ == ShapeKind::sphere) {
      local = sample_sphere(u);
      area = glm::length(local * to_local_);  // |M^-T n|
    } else if (kind_ == ShapeKind::disc) {
      local = glm::dvec3(sample_disc(u), 0);
    }
    sum += area * luminance(emission_at(shape_surface_point(*scene_, shape_, coordinates_of(local)), true));
  }
  const double mean = sum / (side * side);
  double area = 0;  // m2
  switch (kind_) {
    case ShapeKind::sphere:
      area = 4 * pi_double * determinant_;
      break;
    case ShapeKind::disc:
      area = area_;
      break;
    case ShapeKind::plane:
      // From 2 pi sr onto the disc that the scene shows to each direction. From either side a point sees one side.
      area = 2 * pi_double * scene_radius * scene_radius;
      break;
  }
  const double power = (is_double_sided_ && kind_ != ShapeKind::plane ? 2 : 1) * pi_double * area * mean;
  return power < std::numeric_limits<float>::max() ? static_cast<float>(power) : 0.0f;
}

ShapeLight::View ShapeLight::view_from(Vec3 from) const {
  View view;
  view.from = to_local_ * (glm::dvec3(from) - origin_);
  if (kind_ == ShapeKind::sphere) {
    const double squared = glm::dot(view.from, view.from);
    view.is_front = std::sqrt(squared) > 1 + rounding_of(from) * frobenius_norm(to_local_);
    // 1 - cos = sin^2 / (1 + cos), sin = 1 / distance.
    view.one_minus_cosine = view.is_front ? 1 / (squared + squared * std::sqrt(1 - 1 / squared)) : 2;
    view.is_visible = view.is_front || is_double_sided_;
  } else {
    const double height = glm::dot(glm::dvec3(from) - origin_, normal_);
    view.is_front = height > 0;
    view.height = std::abs(height);
    view.is_visible = view.height > rounding_of(from) && (view.is_front || is_double_sided_);
  }
  return view;
}

double ShapeLight::density(const View& view, glm::dvec3 towards) const {
  const double distance = glm::length(towards);
  switch (kind_) {
    case ShapeKind::sphere:
      return cube(distance / glm::length(to_local_ * towards)) / (2 * pi_double * view.one_minus_cosine * determinant_);
    case ShapeKind::disc:
      return cube(distance) / (view.height * area_);  // the cosine is height / distance
    case ShapeKind::plane:
      return 1 / (2 * pi_double);
  }
  return 0;
}

ShapeLight::Place ShapeLight::place_on_sphere(const View& view, Vec2 u) const {
  const double height = u.x * view.one_minus_cosine;  // 1 - cos of the angle to the cone's axis
  const double sine_squared = height * (2 - height), cosine = 1 - height, angle = 2 * pi_double * u.y;
  const glm::dvec2 around(std::cos(angle), std::sin(angle));
  Place place;
  if (view.is_front) {
    // The angle at the sphere's centre between the point of the sphere and the viewer (Pharr, Jakob and Humphreys 2023,
    // section 6.2.4).
    const double distance = glm::length(view.from), relative = std::min(1.0, sine_squared * distance * distance);
    const double center_cosine = relative / distance + cosine * std::sqrt(1 - relative);
    const double center_sine = std::sqrt(std::max(0.0, 1 - center_cosine * center_cosine));
    const Frame frame(Vec3(view.from / distance));
    place.local =
        glm::normalize(center_sine * (around.x * glm::dvec3(frame.tangent) + around.y * glm::dvec3(frame.bitangent)) +
                       center_cosine * glm::dvec3(frame.normal));
  } else {
    const glm::dvec3 direction(std::sqrt(sine_squared) * around, cosine);
    const double middle = -glm::dot(view.from, direction);
    const glm::dvec3 nearest = view.from + middle * direction;
    const double half = std::sqrt(std::max(0.0, 1 - glm::dot(nearest, nearest)));
    place.local = glm::normalize(nearest + half * direction);
  }
  place.towards = to_world_ * (place.local - view.from);
  return place;
}

ShapeLight::Place ShapeLight::place_on_disc(const View& view, Vec2 u) const {
  const glm::dvec3 local(sample_disc(u), 0);
  return {local, to_world_ * (local - view.from)};
}

ShapeLight::Place ShapeLight::place_on_plane(const View& view, Vec2 u) const {
  const double cosine = 1 - u.x, radius = std::sqrt(std::max(0.0, 1 - cosine * cosine)), angle = 2 * pi_double * u.y;
  const Frame frame(Vec3(view.is_front ? -normal_ : normal_));
  const glm::dvec3 towards =
      radius * (std::cos(angle) * glm::dvec3(frame.tangent) + std::sin(angle) * glm::dvec3(frame.bitangent)) +
      cosine * glm::dvec3(frame.normal);
  return {view.from + view.height / cosine * (to_local_ * towards), towards};
}

std::optional<LightSample> ShapeLight::sample(const SurfacePoint& from, Vec2 u, float choice) const {
  std::optional<LightSample> result;
  const View view = view_from(from.position);
  if (!view.is_visible) return result;
  const Place place = kind_ == ShapeKind::sphere ? place_on_sphere(view, u)
                      : kind_ == ShapeKind::disc ? place_on_disc(view, u)
                                                 : place_on_plane(view, u);
  const double distance = glm::length(place.towards);
  const auto pdf = static_cast<float>(choice * density(view, place.towards));
  const Vec2 coordinates = coordinates_of(place.local);
  if (!(distance > 0 && pdf > 0 && pdf < infinity && is_finite(Vec3(coordinates, 0)))) return result;
  const SurfacePoint on = shape_surface_point(*scene_, shape_, coordinates);
  const Vec3 wi(place.towards / distance);
  // From beside the point, still at the place that was chosen, which may be small; of a plane the direction counts.
  const Vec3 origin = offset_origin(from, wi);
  const Vec3 direction = kind_ == ShapeKind::plane ? wi : glm::normalize(on.position - origin);
  // The light must not shadow itself: the ray ends just before it, where the accelerator too would say that it is.
  const ShapeCrossings crossings = intersector_.crossings({origin, direction}, infinity);
  float end = static_cast<float>(distance);
  if (crossings.count > 0) {
    if (crossings.list[0].is_front_face != view.is_front) return result;  // the other side is in the way
    end = std::nextafter(crossings.list[0].t, 0.0f);
  } else if (kind_ == ShapeKind::plane) {
    return result;  // beyond all numbers
  }
  if (!(end > 0)) return result;
  LightSample& sample = result.emplace();
  sample.wi = wi;
  sample.radiance = emission_at(on, view.is_front);
  sample.pdf = pdf;
  sample.shadow_ray = {origin, direction, end};
  return result;
}

float ShapeLight::pdf(Vec3 from, const SurfacePoint& on) const {
  const View view = view_from(from);
  const Vec3 towards = on.position - from;
  // A sphere's other side, seen through holes, is not sampled.
  const bool is_front = glm::dot(towards, on.normal_geometric) < 0;
  if (!view.is_visible || (kind_ == ShapeKind::sphere && is_front != view.is_front)) return 0;
  const double pdf = density(view, towards);
  return pdf < std::numeric_limits<float>::max() ? static_cast<float>(pdf) : 0.0f;
}

}  // namespace candil
