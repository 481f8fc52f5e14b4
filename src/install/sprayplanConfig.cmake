# sprayplan::sprayplan, the shared library; with COMPONENTS static sprayplan::static as well, which needs the development
# files of what it is made from.
include(CMakeFindDependencyMacro)
include(${CMAKE_CURRENT_LIST_DIR}/sprayplanTargets.cmake)

if(static IN_LIST sprayplan_FIND_COMPONENTS)
  find_dependency(OpenMP COMPONENTS C)
  find_dependency(ZLIB)
  find_dependency(PkgConfig)
  pkg_check_modules(FYAML REQUIRED IMPORTED_TARGET libfyaml)
  pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson)
  pkg_check_modules(MD REQUIRED IMPORTED_TARGET libmd)
  pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
  include(${CMAKE_CURRENT_LIST_DIR}/sprayplanStaticTargets.cmake)
  set(sprayplan_static_FOUND TRUE)
endif()

foreach(component IN LISTS sprayplan_FIND_COMPONENTS)
  if(NOT component STREQUAL "static" AND sprayplan_FIND_REQUIRED_${component})
    set(sprayplan_FOUND FALSE)
    set(sprayplan_NOT_FOUND_MESSAGE "sprayplan has no component ${component}")
  endif()
endforeach()
