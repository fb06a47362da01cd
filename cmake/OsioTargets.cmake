# SPDX-License-Identifier: Apache-2.0
# How every target of the project is compiled, and where things are installed.

set(OSIO_SHARE_DIR share/osio)

add_library(osio_flags INTERFACE)
target_compile_features(osio_flags INTERFACE cxx_std_20)
target_compile_options(osio_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wcast-align
  -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion -Wformat=2 -Wimplicit-fallthrough
  -Wextra-semi -Wvla -Wundef -Wmissing-declarations
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wduplicated-branches -Wlogical-op -Wuseless-cast>)
if(OSIO_WERROR)
  target_compile_options(osio_flags INTERFACE -Werror)
endif()
foreach(sanitizer IN LISTS OSIO_SANITIZE)
  target_compile_options(osio_flags INTERFACE -fsanitize=${sanitizer} -fno-omit-frame-pointer)
  target_link_options(osio_flags INTERFACE -fsanitize=${sanitizer})
endforeach()

set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_CXX_EXTENSIONS OFF)
find_package(Threads REQUIRED)

# osio_precompile(NAME HEADERS ...): where OSIO_PRECOMPILE is set, compiles headers that most sources of a target include
# once. Builds for sanitizers do; the others show which source forgot to include what it uses.
function(osio_precompile name)
  if(OSIO_PRECOMPILE)
    target_precompile_headers(${name} PRIVATE ${ARGN})
  endif()
endfunction()

# osio_module(NAME FILE SOURCES ... LINK ...): a shared object that a program of ours opens when it is
# needed; it is called FILE.
function(osio_module name file)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} MODULE ${arg_SOURCES})
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX "" OUTPUT_NAME ${file}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${OSIO_LIB_DIR})
  target_link_libraries(${name} PRIVATE osio_flags ${arg_LINK})
  install(TARGETS ${name} LIBRARY DESTINATION ${OSIO_LIB_DIR})
endfunction()

# osio_library(NAME SOURCES ... LINK ...): a static library of the product.
function(osio_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE osio_flags PUBLIC ${arg_LINK})
  target_compile_features(${name} PUBLIC cxx_std_20)
  osio_precompile(${name} <algorithm> <cmath> <functional> <memory> <optional> <span> <string> <tl/expected.hpp>
                  <vector>)
endfunction()
