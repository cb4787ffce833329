#include "apps/versions.h"

#include "core/accelerator.h"
#include "io/image_file.h"

namespace candil {

std::string candil_version() { return CANDIL_VERSION; }

std::string version_line() {
  return "candil " + candil_version() + ", Embree " + embree_version() + ", OpenImageIO " + openimageio_version();
}

}  // namespace candil
