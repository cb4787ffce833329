# Install rules of what belongs to no single folder, and the package files for find_package(candil).
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/candil")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/candilConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/candilConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/candilConfigVersion.cmake" COMPATIBILITY SameMinorVersion)

install(EXPORT candilTargets NAMESPACE candil:: DESTINATION "${package_dir}")
install(FILES
  "${PROJECT_BINARY_DIR}/candilConfig.cmake"
  "${PROJECT_BINARY_DIR}/candilConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindCandilOpenImageIO.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindCandilZstd.cmake"
  DESTINATION "${package_dir}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenes/" DESTINATION "${CMAKE_INSTALL_DATADIR}/candil/scenes"
  PATTERN "*.py" EXCLUDE PATTERN "__pycache__" EXCLUDE
  PATTERN "golden" EXCLUDE PATTERN "suite" EXCLUDE REGEX "/(suite|must_fail|stand_ins)[.]toml$" EXCLUDE  # our own tests
  REGEX "/models/(bunny|dragon)[^/]*$" EXCLUDE)  # those of Stanford stay here
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
