# SPDX-License-Identifier: Apache-2.0
# The libraries of others.

find_package(OpenEXR CONFIG REQUIRED)
find_package(tl-expected CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(DEFLATE REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(TIFF REQUIRED IMPORTED_TARGET libtiff-4>=4.5)
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng)
find_package(pugixml CONFIG REQUIRED)
pkg_check_modules(OCIO REQUIRED IMPORTED_TARGET OpenColorIO>=2.1)

# Debian 12's exported OpenImageIO targets name an OpenCV include folder that its package does not
# depend on; CMake refuses to generate. Folders that are not there cannot be needed: leave them out.
find_package(OpenImageIO CONFIG REQUIRED)
foreach(target OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
  foreach(property INTERFACE_INCLUDE_DIRECTORIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES)
    get_target_property(folders ${target} ${property})
    if(folders)
      list(FILTER folders EXCLUDE REGEX "opencv")
      set_target_properties(${target} PROPERTIES ${property} "${folders}")
    endif()
  endforeach()
endforeach()

# A plugin is bound to one minor version of OpenImageIO: one folder for each, never a shared one.
string(REGEX MATCH "^[0-9]+\\.[0-9]+" OSIO_OIIO_MINOR "${OpenImageIO_VERSION}")
set(OSIO_LIB_DIR ${CMAKE_INSTALL_LIBDIR}/osio)
set(OSIO_OCIO_MODULE osio_ocio.so)
set(OSIO_PLUGIN_DIR ${OSIO_LIB_DIR}/oiio-${OSIO_OIIO_MINOR})
