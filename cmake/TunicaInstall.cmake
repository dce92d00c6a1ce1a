# cmake --install: the program with its completions and page of the manual, the libraries with their headers, a CMake
# package and a pkg-config file, and the Python package where it was built.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(TUNICA_PYTHON_INSTALL_DIR lib/python3/dist-packages CACHE STRING
  "Folder of the Python package, within the prefix or absolute")
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tunica)

get_property(rooms GLOBAL PROPERTY TUNICA_ROOMS)
install(TARGETS tunica_flags ${rooms} EXPORT tunicaTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT tunicaTargets NAMESPACE tunica:: DESTINATION ${package_dir})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/src/tunica DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
list(JOIN TUNICA_VTK_COMPONENTS " " TUNICA_VTK_COMPONENTS)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/tunicaConfig.cmake.in ${CMAKE_BINARY_DIR}/tunicaConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/tunicaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/tunicaConfig.cmake ${CMAKE_BINARY_DIR}/tunicaConfigVersion.cmake
  DESTINATION ${package_dir})

# What the program says of itself, for shells and for man.
set(texts ${CMAKE_BINARY_DIR}/texts)
file(MAKE_DIRECTORY ${texts})
add_custom_command(OUTPUT ${texts}/tunica.1 ${texts}/tunica.bash ${texts}/_tunica ${texts}/tunica.fish DEPENDS tunica
  COMMAND tunica manual > ${texts}/tunica.1
  COMMAND tunica completion bash > ${texts}/tunica.bash
  COMMAND tunica completion zsh > ${texts}/_tunica
  COMMAND tunica completion fish > ${texts}/tunica.fish)
add_custom_target(tunica_texts ALL DEPENDS ${texts}/tunica.1)
install(TARGETS tunica RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${texts}/tunica.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${texts}/tunica.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME tunica)
install(FILES ${texts}/_tunica DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${texts}/tunica.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

if(TARGET tunica_python)
  install(TARGETS tunica_python tunica_python_solver LIBRARY DESTINATION ${TUNICA_PYTHON_INSTALL_DIR}/tunica)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/tunica DESTINATION ${TUNICA_PYTHON_INSTALL_DIR}
    FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed")
endif()

# For build systems other than CMake: pkg-config --cflags --libs tunica. Libraries without a file of their own are named
# by their paths, Ceres by its name, so that the shared one is taken, which knows what it needs.
set(pc_rooms)
foreach(room ${rooms})
  get_target_property(type ${room} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    string(APPEND pc_rooms " -l${room}")
  endif()
endforeach()
set(pc_files ${METIS_LIBRARY} ${TETGEN_LIBRARY} ${GMP_LIBRARY} ${MPFR_LIBRARY})
foreach(target ${TUNICA_VTK_LIBRARIES} meshoptimizer::meshoptimizer)
  list(APPEND pc_files "$<TARGET_LINKER_FILE:${target}>")
endforeach()
list(REMOVE_ITEM pc_files optimized debug)
list(REMOVE_DUPLICATES pc_files)
list(JOIN pc_files " " pc_files)
file(RELATIVE_PATH pc_include /${CMAKE_INSTALL_LIBDIR}/pkgconfig /${CMAKE_INSTALL_INCLUDEDIR})
file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/tunica.pc CONTENT
"Name: tunica
Description: ${PROJECT_DESCRIPTION}
Version: ${PROJECT_VERSION}
Requires: PETSc ompi-cxx fmt yaml-cpp muparser expat zlib librsvg-2.0
Cflags: -I\${pcfiledir}/${pc_include} -std=c++20 -DFMT_SHARED
Libs: -L\${pcfiledir}/.. -Wl,--copy-dt-needed-entries -Wl,--start-group${pc_rooms} -Wl,--end-group ${pc_files} -lceres -lglog
")
install(FILES ${CMAKE_BINARY_DIR}/tunica.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# cpack -G TGZ: all of this as one archive, to be unpacked where Debian 12 has the libraries that `tunica --version` names.
set(CPACK_PACKAGE_VENDOR "The tunica developers")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR TGZ)
set(CPACK_STRIP_FILES ON)
include(CPack)
