# Finds libzstd through pkg-config and defines the target Candil::Zstd: the CMake config that comes with libzstd has other
# target names from version to version. Installed beside candilConfig.cmake, since candil::io links this target.

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(CANDIL_ZSTD QUIET IMPORTED_TARGET GLOBAL libzstd>=1.4)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CandilZstd
  REQUIRED_VARS CANDIL_ZSTD_LINK_LIBRARIES
  VERSION_VAR CANDIL_ZSTD_VERSION
  REASON_FAILURE_MESSAGE "pkg-config does not know libzstd (Debian and Ubuntu: libzstd-dev, pkg-config)")

if(CandilZstd_FOUND AND NOT TARGET Candil::Zstd)
  add_library(Candil::Zstd INTERFACE IMPORTED)
  target_link_libraries(Candil::Zstd INTERFACE PkgConfig::CANDIL_ZSTD)
endif()
