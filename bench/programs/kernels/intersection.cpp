// Boxes and triangles, as the hand-made hierarchies test them.
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "core/bvh/compact_node.h"
#include "core/bvh/node_pair.h"
#include "core/bvh/triangle_block.h"
#include "core/bvh/triangle_group.h"
#include "core/sampler.h"
#include "core/warp.h"

namespace candil {
namespace {

/// Some hits and some misses, more than a branch predictor learns.
constexpr std::size_t case_count = 4096;

/// Of that number, in [-1, 1]^3.
Vec3 place(std::uint32_t number) {
  const FourPoints u = Sampler({4, 5}, number, 6).sample_four_2d(0);
  return 2.0f * Vec3(u[0], u[1].x) - 1.0f;
}

/// Rays from 3 m away towards the middle.
const std::vector<Ray>& rays() {
  static const std::vector<Ray> list = [] {
    std::vector<Ray> made(case_count);
    for (std::uint32_t i = 0; i < case_count; ++i) {
      made[i].origin = 3.0f * sample_sphere(Sampler({1, 2}, i, 3).sample_2d(0));
      made[i].direction = glm::normalize(0.5f * place(i) - made[i].origin);
    }
    return made;
  }();
  return list;
}

Bounds some_box(std::uint32_t number) {
  Bounds box;
  box.add(place(2 * number)), box.add(place(2 * number + 1));
  return box;
}

void box_pair(benchmark::State& state) {
  std::vector<NodePair> pairs(case_count);
  std::vector<PairRay> slabs;
  for (std::uint32_t i = 0; i < case_count; ++i) {
    for (int child = 0; child < 2; ++child) pairs[i].set(child, some_box(2 * i + child), NodeLink::leaf(0, 1));
    slabs.emplace_back(rays()[i]);
  }
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t k = i++ % case_count;
    PairRay::Entries entries = slabs[k].enter(pairs[k], infinity);
    benchmark::DoNotOptimize(entries);
  }
}
BENCHMARK(box_pair)->Name("box/pair");

void box_line(benchmark::State& state) {
  std::vector<Bounds> boxes;
  std::vector<SlabRay> slabs;
  for (std::uint32_t i = 0; i < case_count; ++i) boxes.push_back(some_box(i)), slabs.emplace_back(rays()[i]);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t k = i++ % case_count;
    bool is_met = is_met_by_line(slabs[k], boxes[k]);
    benchmark::DoNotOptimize(is_met);
  }
}
BENCHMARK(box_line)->Name("box/whole line");

template <typename Node>
void box_eight(benchmark::State& state) {
  std::vector<Node> nodes;
  std::vector<WideRay> slabs;
  const Bounds all{Vec3(-1), Vec3(1)};
  for (std::uint32_t i = 0; i < case_count; ++i) {
    WideNode wide;
    for (std::uint32_t lane = 0; lane < lane_count; ++lane) {
      const Bounds box = some_box(lane_count * i + lane);
      for (int axis = 0; axis < 3; ++axis) {
        wide.planes[2 * axis][lane] = box.low[axis], wide.planes[2 * axis + 1][lane] = box.high[axis];
      }
      wide.child[lane] = lane;
    }
    nodes.emplace_back(wide);
    slabs.emplace_back(rays()[i], all);
  }
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t k = i++ % case_count;
    unsigned missed = sign_bits(enter_children(nodes[k], slabs[k], infinity));
    benchmark::DoNotOptimize(missed);
  }
  state.SetItemsProcessed(state.iterations() * lane_count);
}
BENCHMARK(box_eight<WideNode>)->Name("box/eight");
BENCHMARK(box_eight<CompactNode>)->Name("box/eight of 8 bits");

template <typename Real>
void triangle(benchmark::State& state) {
  std::vector<std::array<Vec3, 3>> triangles;
  std::vector<RayFrame<Real>> frames;
  for (std::uint32_t i = 0; i < case_count; ++i) {
    triangles.push_back({place(3 * i), place(3 * i + 1), place(3 * i + 2)});
    frames.emplace_back(rays()[i]);
  }
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t k = i++ % case_count;
    const auto& [a, b, c] = triangles[k];
    TriangleCrossing crossing;
    bool is_hit = cross_triangle(frames[k], a, b, c, infinity, crossing);
    benchmark::DoNotOptimize(is_hit);
    benchmark::DoNotOptimize(crossing);
  }
}
BENCHMARK(triangle<float>)->Name("triangle/float");
BENCHMARK(triangle<double>)->Name("triangle/double");

void triangle_group(benchmark::State& state) {
  const auto size = static_cast<std::uint32_t>(state.range(0));
  const std::size_t floats = 9 * size;
  std::vector<float> groups(case_count * floats + group_padding);
  std::vector<GroupRay> frames;
  for (std::uint32_t i = 0; i < case_count; ++i) {
    for (std::uint32_t lane = 0; lane < size; ++lane) {
      const std::uint32_t number = 3 * (size * i + lane);
      set_in_group(&groups[i * floats], size, lane, place(number), place(number + 1), place(number + 2));
    }
    frames.emplace_back(rays()[i]);
  }
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t k = i++ % case_count;
    float nearest = infinity;
    frames[k].cross(&groups[k * floats], size, infinity, [&](std::uint32_t, const TriangleCrossing& crossing) {
      nearest = crossing.t < nearest ? crossing.t : nearest;
    });
    benchmark::DoNotOptimize(nearest);
  }
  state.SetItemsProcessed(state.iterations() * size);
}
BENCHMARK(triangle_group)->Name("triangle/group of")->Arg(1)->Arg(4);

void triangle_block(benchmark::State& state) {
  std::vector<TriangleBlock> blocks(case_count);
  std::vector<BlockRay> frames;
  for (std::uint32_t i = 0; i < case_count; ++i) {
    for (std::uint32_t lane = 0; lane < lane_count; ++lane) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const Vec3 at = place(3 * (lane_count * i + lane) + corner);
        for (int axis = 0; axis < 3; ++axis) blocks[i].vertices[corner][axis][lane] = at[axis];
      }
      blocks[i].id[lane] = lane;
    }
    frames.emplace_back(rays()[i]);
  }
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t k = i++ % case_count;
    unsigned hits = BlockCrossings(blocks[k], frames[k], infinity).hits();
    benchmark::DoNotOptimize(hits);
  }
  state.SetItemsProcessed(state.iterations() * lane_count);
}
BENCHMARK(triangle_block)->Name("triangle/block of eight");

}  // namespace
}  // namespace candil
