#include "core/bvh/mesh_part.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/bvh/box_test.h"

namespace candil {
namespace {

/// Triangles that one task lists.
constexpr std::size_t chunk_size = 1 << 14;

bool can_be_hit(const Corners& corners) {
  return is_finite(corners.a) && is_finite(corners.b) && is_finite(corners.c) && corners.a != corners.b &&
         corners.b != corners.c && corners.c != corners.a;
}

/// A stretch of one mesh, and where its triangles go in the list.
struct Chunk {
  std::uint32_t part, begin, end;
  std::size_t target = 0;
};

std::vector<Chunk> make_chunks(std::span<const MeshPart> parts) {
  std::vector<Chunk> chunks;
  for (std::uint32_t part = 0; part < parts.size(); ++part) {
    const std::size_t count = parts[part].mesh->triangles.size();
    for (std::size_t begin = 0; begin < count; begin += chunk_size) {
      const std::size_t end = std::min(begin + chunk_size, count);
      chunks.push_back({part, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
    }
  }
  return chunks;
}

template <typename Work>
void for_each_chunk(std::vector<Chunk>& chunks, const Work& work) {
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) { work(chunks[i]); });
}

}  // namespace

TriangleList list_triangles(std::span<const MeshPart> parts) {
  std::vector<Chunk> chunks = make_chunks(parts);
  for_each_chunk(chunks, [&](Chunk& chunk) {
    for (std::uint32_t i = chunk.begin; i < chunk.end; ++i) {
      chunk.target += can_be_hit(corners_of(*parts[chunk.part].mesh, i));
    }
  });
  std::size_t total = 0;
  for (Chunk& chunk : chunks) total += std::exchange(chunk.target, total);
  TriangleList list;
  list.ids.resize(total), list.bounds.resize(total);
  for_each_chunk(chunks, [&](const Chunk& chunk) {
    std::size_t target = chunk.target;
    for (std::uint32_t i = chunk.begin; i < chunk.end; ++i) {
      const Corners corners = corners_of(*parts[chunk.part].mesh, i);
      if (!can_be_hit(corners)) continue;
      list.ids[target] = {chunk.part, i};
      list.bounds[target++] = triangle_bounds(corners.a, corners.b, corners.c);
    }
  });
  return list;
}

}  // namespace candil
