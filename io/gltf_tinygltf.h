/// tinygltf's declarations, configured alike in every .cpp that reads its model: no file system, no image decoder. It
/// only turns JSON into structures; bytes come from GltfDocument. Included by .cpp files of the loader alone.
#pragma once

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>
