# SPDX-License-Identifier: Apache-2.0
find_package(GTest REQUIRED)
include(GoogleTest)

# osio_test(NAME LABELS a b SOURCES ... LINK ... PROPERTIES key value ...): a GoogleTest program,
# each case a ctest of its own. gtest_discover_tests keeps only the first of several labels
# (CMake 3.25), so they are set by a script that ctest reads after the discovered tests.
function(osio_test name)
  cmake_parse_arguments(arg "" "" "LABELS;SOURCES;LINK;PROPERTIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE osio_flags ${arg_LINK} GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE OSIO_TEST_DIR="${PROJECT_SOURCE_DIR}/tests")
  gtest_discover_tests(${name} TEST_LIST ${name}_list DISCOVERY_TIMEOUT 60)
  set(script ${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake)
  file(WRITE ${script} "foreach(test IN LISTS ${name}_list)
  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${arg_LABELS}\" ${arg_PROPERTIES})
endforeach()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()
