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

# Release builds optimise the render loop across its files. The libraries it is made of hold ordinary code as well, for
# tests and other projects to link as ever; only programs that render make use of the rest.
option(CANDIL_LTO "Optimise the render loop across files (release builds with GCC)" OFF)
if(CANDIL_LTO AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
  set(lto_compile_options $<$<CONFIG:Release>:-flto=auto> $<$<CONFIG:Release>:-ffat-lto-objects>)
  set(lto_link_options $<$<CONFIG:Release>:-flto=auto>)
endif()

# For the libraries of the render loop.
function(candil_offer_lto target)
  target_compile_options(${target} PRIVATE ${lto_compile_options})
endfunction()

# For programs that render.
function(candil_use_lto target)
  target_link_options(${target} PRIVATE ${lto_link_options})
endfunction()

# candil_library(NAME [PUBLIC target...] [PRIVATE target...]): the static library candil_NAME, alias candil::NAME, of all
# .cpp files of the calling folder. PUBLIC targets appear in its headers.
function(candil_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE")
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
endfunction()
