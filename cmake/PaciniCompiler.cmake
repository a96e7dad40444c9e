# How our own sources are compiled: language level, warnings, sanitizers, ccache.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND NOT MSVC)
    # -O3 for the vectoriser; there is no fast-math anywhere.
    set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
    # No fused multiply-add where the source has none: GCC and Clang make them by themselves on ARM, and a clip would not
    # have the same bytes on every machine.
    add_compile_options(-ffp-contract=off)
endif()

find_program(PACINI_CCACHE ccache)
if(PACINI_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # Without the sloppiness it would not store what includes a precompiled header; by the base a second checkout finds
    # what the first one compiled.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros
        "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" "${PACINI_CCACHE}")
endif()

# Which sources are compiled as one where the preset asks for it: at most `most` of one folder, in alphabetical order. Files
# of different folders share names of helpers.
set(PACINI_UNITY_BUILD ${CMAKE_UNITY_BUILD})
function(pacini_compile_as_one target most)
    set_target_properties(${target} PROPERTIES UNITY_BUILD "${PACINI_UNITY_BUILD}" UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        if(NOT source MATCHES "\\.cpp$")
            continue()
        endif()
        cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" OUTPUT_VARIABLE path)
        cmake_path(GET path PARENT_PATH group)
        string(MAKE_C_IDENTIFIER "${group}" group)
        math(EXPR batch "0${count_${group}} / ${most}")
        math(EXPR count_${group} "0${count_${group}} + 1")
        set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}_${batch}")
    endforeach()
endfunction()

# Linked PRIVATE by every own target: warnings never reach people who include our headers. Files that are compiled as one
# see each other's names, which -Wshadow would mistake for their own.
add_library(pacini_warnings INTERFACE)
if(MSVC)
    target_compile_options(pacini_warnings INTERFACE /W4 $<$<BOOL:${PACINI_WARNINGS_AS_ERRORS}>:/WX>)
else()
    target_compile_options(pacini_warnings INTERFACE
        -Wall -Wextra -Wpedantic $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow> -Wconversion -Wsign-conversion
        # Clang says it of double to long double, too.
        $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
        # GCC 12 sees overlaps in additions of std::string that are none (its bug 105651), and bounds likewise.
        $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict$<SEMICOLON>-Wno-array-bounds>
        $<$<BOOL:${PACINI_WARNINGS_AS_ERRORS}>:-Werror>)
endif()

add_library(pacini_sanitizers INTERFACE)
if(PACINI_SANITIZE)
    target_compile_options(pacini_sanitizers INTERFACE
        -fsanitize=${PACINI_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(pacini_sanitizers INTERFACE -fsanitize=${PACINI_SANITIZE})
endif()
