# SPDX-License-Identifier: Apache-2.0
find_package(GTest REQUIRED)
include(GoogleTest)

# Programs that were built without a sanitizer must load its libraries first to open a plugin that was
# built with one; and libstdc++, which the sanitizer looks for when it starts. Leaks of Python's are not
# ours, and what runs inside libraries without instrumentation cannot be judged.
set(OSIO_SANITIZER_ENVIRONMENT "")
function(osio_preload)
  set(paths "")
  foreach(library IN LISTS ARGN)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${library}
                    OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(APPEND paths " ${path}")
  endforeach()
  string(STRIP "${paths}" paths)
  set(OSIO_SANITIZER_ENVIRONMENT "LD_PRELOAD=${paths}" PARENT_SCOPE)
endfunction()
if("address" IN_LIST OSIO_SANITIZE)
  osio_preload(libasan.so libubsan.so libstdc++.so)
  list(APPEND OSIO_SANITIZER_ENVIRONMENT
    ASAN_OPTIONS=detect_leaks=0:suppressions=${PROJECT_SOURCE_DIR}/tests/asan.supp)
elseif("thread" IN_LIST OSIO_SANITIZE)
  osio_preload(libtsan.so libstdc++.so)
  list(APPEND OSIO_SANITIZER_ENVIRONMENT TSAN_OPTIONS=halt_on_error=1:ignore_noninstrumented_modules=1)
endif()

# osio_test(NAME LABELS a b SOURCES ... LINK ... PROPERTIES key value ...): a GoogleTest program,
# each case a ctest of its own. gtest_discover_tests keeps only the first of several labels
# (CMake 3.25), so they are set by a script that ctest reads after the discovered tests.
function(osio_test name)
  cmake_parse_arguments(arg "" "" "LABELS;SOURCES;LINK;PROPERTIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE osio_flags ${arg_LINK} GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  osio_precompile(${name} <algorithm> <cmath> <functional> <gtest/gtest.h> <memory> <optional> <random> <string>
                  <tl/expected.hpp> <vector>)
  target_compile_definitions(${name} PRIVATE OSIO_TEST_DIR="${PROJECT_SOURCE_DIR}/tests")
  gtest_discover_tests(${name} TEST_LIST ${name}_list DISCOVERY_TIMEOUT 60)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake)
  file(WRITE ${script} "foreach(test IN LISTS ${name}_list)
  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${arg_LABELS}\" ${arg_PROPERTIES})
endforeach()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()

# osio_python_test(FILE LABELS a b): every test method of a unittest file as a ctest of its own, run by
# the Python that has OpenImageIO's module.
function(osio_python_test file)
  cmake_parse_arguments(arg "" "" "LABELS" ${ARGN})
  set(path ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  get_filename_component(module ${file} NAME_WE)
  file(STRINGS ${path} lines REGEX "^class |^    def test_")
  foreach(line IN LISTS lines)
    if(line MATCHES "^class ([A-Za-z]+)")
      set(class ${CMAKE_MATCH_1})
    elseif(line MATCHES "def (test_[a-z0-9_]+)")
      set(test ${module}.${class}.${CMAKE_MATCH_1})
      add_test(NAME ${test} COMMAND ${OSIO_PYTHON} ${path} ${class}.${CMAKE_MATCH_1})
      set_tests_properties(${test} PROPERTIES LABELS "${arg_LABELS}" ENVIRONMENT "${OSIO_TEST_ENVIRONMENT}"
        TIMEOUT 300 SKIP_REGULAR_EXPRESSION "OK \\(skipped")
    endif()
  endforeach()
endfunction()
