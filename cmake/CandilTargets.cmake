# How every target of the project is compiled, and the function that makes the library of a folder.

if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(default_march x86-64-v3)
else()
  set(default_march "")
endif()
set(CANDIL_MARCH "${default_march}" CACHE STRING "-march of our own code (Embree dispatches by itself); empty: the compiler's default")

# The language, the warnings and the arithmetic, alike for libraries, programs and tests. Floating-point results must not
# depend on how the compiler inlines: no contraction, nothing of -ffast-math that changes values.
function(candil_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${CANDIL_WARNINGS_AS_ERRORS}>:-Werror>
    -ffp-contract=off -fno-math-errno -fno-trapping-math)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # Warns about `"text" + std::string` in the standard library itself (GCC bug 105329).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(CANDIL_MARCH)
    target_compile_options(${target} PRIVATE -march=${CANDIL_MARCH})
  endif()
endfunction()

# candil_library(NAME [PUBLIC target...] [PRIVATE target...] [FOLDERS folder...]): the static library candil_NAME, alias
# candil::NAME, of all .cpp files of the calling folder and of the named ones in it. PUBLIC targets appear in its headers.
function(candil_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE;FOLDERS")
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  file(GLOB headers CONFIGURE_DEPENDS *.h)
  set(target candil_${name})
  add_library(${target} STATIC ${sources} ${headers})
  add_library(candil::${name} ALIAS ${target})
  candil_compile_options(${target})
  target_include_directories(${target} PUBLIC
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/candil>")
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT candilTargets)
  install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/candil/${name}")
  foreach(folder IN LISTS arg_FOLDERS)
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    file(GLOB headers CONFIGURE_DEPENDS ${folder}/*.h)
    target_sources(${target} PRIVATE ${sources} ${headers})
    install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/candil/${name}/${folder}")
  endforeach()
endfunction()
