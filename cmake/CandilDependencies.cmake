# Every library from outside that the targets link. All come from the distribution; nothing is downloaded.
# candilConfig.cmake.in looks for the same ones again on behalf of outside projects.

find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)

# Debian 12 has Embree 3.13, Debian 13 and Ubuntu 24.04 have 4.3. Both call their target `embree`.
find_package(embree 4 CONFIG QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.13 CONFIG REQUIRED)
endif()
string(REGEX MATCH "^[0-9]+" CANDIL_EMBREE_MAJOR "${embree_VERSION}")
message(STATUS "Embree ${embree_VERSION}")

find_package(CandilOpenImageIO REQUIRED)

# tinygltf is compiled into io/ with our own choice of its options: only its header is needed.
find_path(CANDIL_TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)
mark_as_advanced(CANDIL_TINYGLTF_INCLUDE_DIR)

# toml++ likewise: apps/check/ compiles it from its header.
find_path(CANDIL_TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
mark_as_advanced(CANDIL_TOMLPLUSPLUS_INCLUDE_DIR)

# Compressed geometry in glTF files. Without them such files are refused, or read without the compression if they can be.
option(CANDIL_DRACO "Read KHR_draco_mesh_compression, if Draco is found" ON)
if(CANDIL_DRACO)
  find_package(draco CONFIG QUIET)
  if(NOT TARGET draco::draco)
    message(STATUS "Draco not found (Debian and Ubuntu: libdraco-dev): no KHR_draco_mesh_compression")
    set(CANDIL_DRACO OFF)
  endif()
endif()
option(CANDIL_MESHOPTIMIZER "Read EXT_ and KHR_meshopt_compression, if meshoptimizer is found" ON)
if(CANDIL_MESHOPTIMIZER)
  find_package(meshoptimizer CONFIG QUIET)
  if(NOT TARGET meshoptimizer::meshoptimizer)
    message(STATUS "meshoptimizer not found (Debian and Ubuntu: libmeshoptimizer-dev): no meshopt compression")
    set(CANDIL_MESHOPTIMIZER OFF)
  endif()
endif()

# Textures in KTX2 files: those of UASTC may be packed once more.
option(CANDIL_ZSTD "Read KTX2 textures under Zstandard, if libzstd is found" ON)
if(CANDIL_ZSTD)
  find_package(CandilZstd QUIET)
  if(NOT TARGET Candil::Zstd)
    message(STATUS "libzstd not found (Debian and Ubuntu: libzstd-dev): no KTX2 textures under Zstandard")
    set(CANDIL_ZSTD OFF)
  endif()
endif()
