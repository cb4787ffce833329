# Finds OpenImageIO through pkg-config and defines the target Candil::OpenImageIO. The CMake config that Debian 12 ships
# with OpenImageIO names files of packages that it does not depend on (OpenCV, the command-line tools) and fails.
# Installed beside candilConfig.cmake, since the libraries link this target.

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(CANDIL_OPENIMAGEIO QUIET IMPORTED_TARGET GLOBAL OpenImageIO>=2.4)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CandilOpenImageIO
  REQUIRED_VARS CANDIL_OPENIMAGEIO_LINK_LIBRARIES
  VERSION_VAR CANDIL_OPENIMAGEIO_VERSION
  REASON_FAILURE_MESSAGE "pkg-config does not know OpenImageIO 2.4 or newer (Debian and Ubuntu: libopenimageio-dev, pkg-config)")

if(CandilOpenImageIO_FOUND AND NOT TARGET Candil::OpenImageIO)
  add_library(Candil::OpenImageIO INTERFACE IMPORTED)
  target_link_libraries(Candil::OpenImageIO INTERFACE PkgConfig::CANDIL_OPENIMAGEIO)
endif()
