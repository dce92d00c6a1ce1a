# Compiler settings and the helpers that declare one target per source folder.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g1")  # the sanitisers make optimised vector code slow to compile: 75 s a file, 10 s so

find_program(TUNICA_CCACHE ccache)
if(TUNICA_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${TUNICA_CCACHE})
endif()

# Unity builds (CMAKE_UNITY_BUILD, on in the presets; CONTRIBUTING.md, "Compile time"): eight sources of a target at a
# time, 16 in the presets of scripts/test, are one to the compiler, which then reads their headers once.
if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
endif()

# Sources that are compiled each for itself even so; those with compile options of their own are in any case.
function(tunica_apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

add_library(tunica_flags INTERFACE)
set_target_properties(tunica_flags PROPERTIES EXPORT_NAME flags)
# -Wno-psabi: packs are wider than the baseline registers; they never cross a library boundary by value.
# -ffp-contract=fast is g++'s default and kept: results are compared with tolerances, not bit by bit across ISAs.
target_compile_options(tunica_flags INTERFACE $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic> -Wno-psabi)
# g++ 12 warns of vectors whose life it inlines in large units; the sanitizers watch what is freed.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_UNITY_BUILD)
  target_compile_options(tunica_flags INTERFACE $<BUILD_INTERFACE:-Wno-free-nonheap-object>)
endif()
# Tests that share a unit may call a variable as another test calls a constant.
target_compile_options(tunica_flags INTERFACE
  $<BUILD_INTERFACE:$<IF:$<BOOL:$<TARGET_PROPERTY:TUNICA_SHARED_UNIT>>,-Wshadow=local,-Wshadow>>)
# Without semantic interposition the compiler inlines our own functions into each other in shared libraries, too.
target_compile_options(tunica_flags INTERFACE
  $<BUILD_INTERFACE:$<$<BOOL:$<TARGET_PROPERTY:POSITION_INDEPENDENT_CODE>>:-fno-semantic-interposition>>)
if(TUNICA_WERROR)
  target_compile_options(tunica_flags INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(TUNICA_SANITIZE)
  target_compile_options(tunica_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(tunica_flags INTERFACE -fsanitize=address,undefined)
  # The sanitizers take a quarter of an hour over the wider copies of the hot loops, which are the same source.
  target_compile_definitions(tunica_flags INTERFACE TUNICA_BASELINE_ISA)
endif()
target_include_directories(tunica_flags INTERFACE $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/src>
  $<INSTALL_INTERFACE:include>)
target_compile_features(tunica_flags INTERFACE cxx_std_20)

if(NOT TUNICA_PURE)
  set(HDF5_PREFER_PARALLEL ON)
  find_package(MPI REQUIRED COMPONENTS CXX)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)
endif()

# <name>_<isa>.cpp holds hot loops for one instruction set, chosen at run time (assembly/isa.hpp).
function(tunica_instruction_sets)
  foreach(source ${ARGN})
    if(source MATCHES "_avx2\\.cpp$")
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma")
    elseif(source MATCHES "_avx512\\.cpp$")
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS
        "-mavx512f;-mavx512dq;-mavx512vl;-mfma;-mprefer-vector-width=512;-Wno-uninitialized;-Wno-maybe-uninitialized")  # g++ 12 warns of its own header
    elseif(source MATCHES "_sse2\\.cpp$")
      tunica_apart(${source})  # half a minute each
    endif()
  endforeach()
endfunction()

# Sources that include CGAL: its interval arithmetic needs -frounding-math, and its own assertions cost half the time.
function(tunica_cgal_sources)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-frounding-math"
    COMPILE_DEFINITIONS "NDEBUG;CGAL_USE_GMP;CGAL_USE_MPFR")
endfunction()

# tunica_folder(<name> [CALLS] [LINK <targets>...]): the library of src/tunica/<name>, header-only when it has no .cpp
# file. LINK names exactly what the include table in ARCHITECTURE.md allows. CALLS: the room reads, checks and calls, its
# loops are in other rooms: -O1, which compiles in two thirds of the time of -O3.
function(tunica_folder name)
  cmake_parse_arguments(ARG "CALLS" "" "LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  if(TUNICA_SANITIZE)
    list(FILTER sources EXCLUDE REGEX "_avx(2|512)\\.cpp$")
  endif()
  if(sources)
    tunica_instruction_sets(${sources})
    add_library(tunica_${name} STATIC ${sources})
    target_link_libraries(tunica_${name} PUBLIC tunica_flags ${ARG_LINK})
    if(ARG_CALLS)
      target_compile_options(tunica_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
    # The Python modules are shared libraries, and so may be what else is made of the rooms.
    set_target_properties(tunica_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  else()
    add_library(tunica_${name} INTERFACE)
    target_link_libraries(tunica_${name} INTERFACE tunica_flags ${ARG_LINK})
  endif()
  set_target_properties(tunica_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY TUNICA_ROOMS tunica_${name})
endfunction()

# tunica_embed(<target> <namespace> <name>=<file>...): the files become part of the target, as functions <name>() of the
# namespace. Files relative to the present folder.
function(tunica_embed target namespace)
  set(files)
  set(entries)
  foreach(entry ${ARGN})
    string(REGEX MATCH "^([^=]+)=(.+)$" _ "${entry}")
    get_filename_component(path "${CMAKE_MATCH_2}" ABSOLUTE)
    list(APPEND files ${path})
    list(APPEND entries "${CMAKE_MATCH_1}=${path}")
  endforeach()
  if(NOT TARGET tunica_embedder)
    add_executable(tunica_embedder ${CMAKE_SOURCE_DIR}/cmake/embed.cpp)
    target_compile_options(tunica_embedder PRIVATE -O1)
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}_assets.cpp)
  add_custom_command(OUTPUT ${source} DEPENDS tunica_embedder ${files} ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
    COMMAND ${CMAKE_COMMAND} -DTOOL=$<TARGET_FILE:tunica_embedder> -DOUT=${source} -DNAMESPACE=${namespace}
      "-DFILES=${entries}" -P ${CMAKE_SOURCE_DIR}/cmake/embed.cmake VERBATIM)
  target_sources(${target} PRIVATE ${source})
  tunica_apart(${source})
endfunction()
