#include "bench/instance_memory.h"

#include <vector>

namespace candil {

std::optional<double> bytes_per_instance(const Scene& scene, const Accelerator& whole,
                                         const std::function<std::unique_ptr<Accelerator>(const Scene&)>& make) {
  std::vector<Instance> first;
  std::vector<bool> is_taken(scene.objects.size(), false);
  for (const Instance& instance : scene.instances) {
    if (!instance.is_world_space && is_taken[instance.object]) continue;
    is_taken[instance.object] = true;
    first.push_back(instance);
  }
  if (first.size() == scene.instances.size()) return std::nullopt;
  Scene single = scene;
  single.instances = first;
  const double bytes = static_cast<double>(whole.memory_bytes()) - static_cast<double>(make(single)->memory_bytes());
  return bytes / static_cast<double>(scene.instances.size() - first.size());
}

}  // namespace candil
