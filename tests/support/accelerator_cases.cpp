#include "tests/support/accelerator_cases.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>

#include "core/warp.h"
#include "materials/alpha.h"
#include "tests/support/brute_force.h"
#include "tests/support/scene_builder.h"

namespace candil::test {

AcceleratorOptions AcceleratorChoice::options() const {
  AcceleratorOptions options;
  options.kind = kind, options.quality = quality, options.is_compact = is_compact, options.isa = isa;
  return options;
}

std::string AcceleratorChoice::name() const {
  std::string instruction_set;
  std::ranges::copy_if(isa, std::back_inserter(instruction_set), [](unsigned char c) { return std::isalnum(c) != 0; });
  return accelerator_name(kind) + (quality == BuildQuality::high ? "_high" : "") + (is_compact ? "_compact" : "") +
         (isa.empty() ? "" : "_" + instruction_set);
}

std::vector<AcceleratorChoice> accelerator_choices() {
  std::vector<AcceleratorChoice> choices;
  for (const std::string& name : accelerator_names()) choices.push_back({*accelerator_from_name(name)});
  choices.push_back({AcceleratorKind::wide, BuildQuality::high, false});
  choices.push_back({AcceleratorKind::wide, BuildQuality::medium, true});
  std::vector<std::string> instruction_sets = wide_instruction_sets();
  instruction_sets.pop_back();  // the best is the default
  for (const std::string& isa : instruction_sets) {
    for (const bool is_compact : {false, true})
      choices.push_back({AcceleratorKind::wide, BuildQuality::medium, is_compact, isa});
  }
  return choices;
}

std::unique_ptr<Accelerator> make_accelerator_of(const AcceleratorChoice& choice, const Scene& scene) {
  return make_accelerator(scene, alpha_filter(), choice.options());
}

Vec3 random_in_cube(Random& random) {
  const Vec2 xy = random.next_2d();
  return 2.0f * Vec3(xy, random.next_1d()) - 1.0f;
}

Vec3 random_direction(Random& random) { return glm::normalize(sample_sphere(random.next_2d())); }

std::size_t random_index(Random& random, std::size_t first, std::size_t end) {
  return first + static_cast<std::size_t>(random.next_1d() * static_cast<float>(end - first));
}

Mesh random_soup(Random& random, int triangle_count, float scale) {
  Mesh mesh;
  for (int i = 0; i < triangle_count; ++i) {
    const Vec3 center = random_in_cube(random);
    const float size = 0.02f + 0.4f * random.next_1d();
    for (int corner = 0; corner < 3; ++corner)
      mesh.positions.push_back(scale * (center + size * random_in_cube(random)));
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Scene mixed_soup(float scale, std::uint32_t seed) {
  Random random(seed);
  SceneBuilder builder;
  Material transmissive;
  transmissive.transmission = 1;
  for (const std::uint32_t material :
       {builder.add_material(Material{}), builder.add_diffuse(Vec3(0.5f)), builder.add_material(transmissive)}) {
    builder.add_mesh(random_soup(random, 100, scale), material);
  }
  return builder.scene;
}

Ray random_ray(Random& random, float scale) {
  Ray ray{1.5f * scale * random_in_cube(random), random_direction(random)};
  if (random.next_1d() < 0.5f) ray.t_max = 2 * scale * random.next_1d();
  return ray;
}

Ray random_axis_parallel_ray(Random& random, float scale) {
  Ray ray{1.5f * scale * random_in_cube(random), Vec3(0)};
  ray.direction[static_cast<int>(3 * random.next_1d())] = random.next_1d() < 0.5f ? -1.0f : 1.0f;
  return ray;
}

Ray ray_at_edge(Random& random, const Mesh& mesh, std::size_t triangle) {
  const Triangle t = mesh.triangles[triangle];
  const Vec3 origin = 1.5f * random_in_cube(random);
  const Vec3 at = glm::mix(mesh.positions[t.x], mesh.positions[t.y], random.next_1d());
  return {origin, glm::normalize(at - origin)};
}

Mesh closed_ball(int rows) {
  Mesh mesh;
  const int columns = 2 * rows;
  mesh.positions = {Vec3(0, 1, 0), Vec3(0, -1, 0)};
  for (int i = 1; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const float theta = pi * static_cast<float>(i) / static_cast<float>(rows);
      const float phi = pi * static_cast<float>(j) / static_cast<float>(rows);
      mesh.positions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
    }
  }
  const auto vertex = [&](int i, int j) -> std::uint32_t {
    if (i == 0 || i == rows) return i == 0 ? 0 : 1;
    return static_cast<std::uint32_t>(2 + (i - 1) * columns + j % columns);
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (i > 0) mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      if (i + 1 < rows) mesh.triangles.push_back({vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j + 1)});
    }
  }
  return mesh;
}

Mesh closed_box(Vec3 half_extent, int n) {
  Mesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;  // by the place on the grid of n steps per axis
  const auto vertex = [&](std::array<int, 3> place) {
    const auto [found, is_new] = known.emplace(place, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) {
      const Vec3 step(static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2]));
      mesh.positions.push_back(half_extent * (2.0f * step / static_cast<float>(n) - 1.0f));
    }
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
    for (const int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> place{};
            place[static_cast<std::size_t>(axis)] = side, place[u] = i + di, place[v] = j + dj;
            return vertex(place);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (side > 0) {
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
          } else {
            mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
          }
        }
      }
    }
  }
  return mesh;
}

void expect_agreement(const Scene& scene, int ray_count, double decided_share,
                      const std::function<Ray(Random&)>& make_ray, double least_share) {
  for (const bool is_filtered : {false, true}) {
    SCOPED_TRACE(is_filtered ? "alpha filter" : "no filter");
    struct Contestant {
      std::string name;
      std::unique_ptr<Accelerator> accelerator;
      int complaints = 0, hits = 0;
    };
    std::vector<Contestant> contestants;
    for (const AcceleratorChoice& choice : accelerator_choices()) {
      const HitFilter filter = is_filtered ? alpha_filter() : HitFilter{};
      contestants.push_back({choice.name(), make_accelerator(scene, filter, choice.options())});
    }
    const BruteForce judge(scene,
                           is_filtered ? BruteForce::BackFaces::as_materials_say : BruteForce::BackFaces::visible);
    Random random(42);
    int decided = 0;
    for (int i = 0; i < ray_count; ++i) {
      const Ray ray = make_ray(random);
      const std::vector<Crossing> crossings = judge.crossings(ray);
      decided += BruteForce::is_decided(crossings);
      for (Contestant& contestant : contestants) {
        if (contestant.complaints >= 5) continue;
        const std::optional<Hit> hit = contestant.accelerator->intersect(ray);
        const std::string complaint = BruteForce::complaint(ray, crossings, hit);
        EXPECT_EQ(complaint, "") << contestant.name;
        contestant.complaints += !complaint.empty();
        contestant.hits += hit.has_value();
        // Where rounding decides, the two kinds of queries may round differently.
        if (BruteForce::is_decided(crossings)) {
          EXPECT_EQ(contestant.accelerator->occluded(ray), hit.has_value()) << contestant.name << ", ray " << i;
        }
      }
    }
    EXPECT_GE(decided, decided_share * ray_count) << "bounds too wide to tell";
    for (const Contestant& contestant : contestants) {
      EXPECT_GE(contestant.hits, least_share * ray_count) << contestant.name << ": too few hits to tell";
      EXPECT_GE(ray_count - contestant.hits, least_share * ray_count) << contestant.name << ": too few misses to tell";
    }
  }
}

}  // namespace candil::test
