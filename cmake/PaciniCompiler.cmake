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

if(WIN32)
    # Of <windows.h> no more than is needed: some of its macros are names of the C++ library. As flags, since JUCE writes the
    # definitions of its targets down, which must not depend on the language.
    string(APPEND CMAKE_CXX_FLAGS " -DNOMINMAX -DWIN32_LEAN_AND_MEAN")
    if(MSVC)
        add_compile_options(/utf-8 /bigobj)
    endif()
endif()

find_program(PACINI_CCACHE ccache)
if(PACINI_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # Without the sloppiness it would not store what includes a precompiled header; by the base a second checkout finds
    # what the first one compiled, also with lines for a debugger.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros
        "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1 "${PACINI_CCACHE}")
endif()

# Compiles the sources of a target together, twelve of one folder at most, where the preset asks for it. Files of different
# folders share names of helpers. CMake's own unity builds name sources by absolute paths, so that ccache would find nothing
# of what another checkout has compiled.
option(PACINI_UNITY_BUILD "Compile up to twelve sources of a folder as one" OFF)
function(pacini_compile_as_one target)
    if(PACINI_UNITY_BUILD)
        # At the end of the folder, when the properties of its sources are known.
        cmake_language(EVAL CODE "cmake_language(DEFER CALL pacini_write_unity_sources [[${target}]])")
    endif()
endfunction()

function(pacini_write_unity_sources target)
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/unity/${target}")
    get_target_property(sources ${target} SOURCES)
    set(kept "")
    set(names "")
    foreach(source IN LISTS sources)
        get_source_file_property(alone "${source}" SKIP_UNITY_BUILD_INCLUSION)
        cmake_path(ABSOLUTE_PATH source NORMALIZE OUTPUT_VARIABLE path)
        cmake_path(IS_PREFIX PROJECT_SOURCE_DIR "${path}" ours)
        cmake_path(IS_PREFIX PROJECT_BINARY_DIR "${path}" made)
        if(alone OR made OR NOT ours OR NOT source MATCHES "\\.cpp$")
            list(APPEND kept "${source}")
            continue()
        endif()
        cmake_path(RELATIVE_PATH path BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE group)
        cmake_path(GET group PARENT_PATH group)
        string(MAKE_C_IDENTIFIER "${group}" group)
        math(EXPR batch "0${count_${group}} / 12")
        math(EXPR count_${group} "0${count_${group}} + 1")
        set(name "${group}_${batch}.cpp")
        if(NOT name IN_LIST names)
            list(APPEND names "${name}")
            set(text_${name} "")
        endif()
        file(RELATIVE_PATH path "${folder}" "${path}")
        string(APPEND text_${name} "#include \"${path}\"\n")
    endforeach()
    foreach(name IN LISTS names)
        file(CONFIGURE OUTPUT "${folder}/${name}" CONTENT "${text_${name}}" @ONLY)
        list(APPEND kept "${folder}/${name}")
    endforeach()
    set_target_properties(${target} PROPERTIES SOURCES "${kept}")
endfunction()

# Linked PRIVATE by every own target: warnings never reach people who include our headers. Files that are compiled as one
# see each other's names, which -Wshadow would mistake for their own.
add_library(pacini_warnings INTERFACE)
if(MSVC)
    target_compile_options(pacini_warnings INTERFACE /W4 $<$<BOOL:${PACINI_WARNINGS_AS_ERRORS}>:/WX>)
else()
    target_compile_options(pacini_warnings INTERFACE
        -Wall -Wextra -Wpedantic $<$<NOT:$<BOOL:${PACINI_UNITY_BUILD}>>:-Wshadow> -Wconversion -Wsign-conversion
        # Clang says it of double to long double, too.
        $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
        # GCC 12 sees overlaps in additions of std::string that are none (its bug 105651), and bounds likewise.
        $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict$<SEMICOLON>-Wno-array-bounds>
        $<$<BOOL:${PACINI_WARNINGS_AS_ERRORS}>:-Werror>)
endif()

# Targets of PACINI_NOT_SANITIZED are as the release build has them, and ccache knows those; all others then have the flags of
# the preset `sanitized` by themselves.
add_library(pacini_sanitizers INTERFACE)
if(PACINI_SANITIZE)
    string(TOUPPER "${CMAKE_BUILD_TYPE}" buildType)
    set(flags "${CMAKE_CXX_FLAGS_${buildType}}")
    set(options -fsanitize=${PACINI_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    if(PACINI_NOT_SANITIZED)
        set(flags "-O1 -g1 -UNDEBUG")
        list(PREPEND options -O1 -g1 -UNDEBUG)
    endif()
    target_link_options(pacini_sanitizers INTERFACE -fsanitize=${PACINI_SANITIZE})
    # With assertions the C++ library checks indices and preconditions, too; the name of that differs.
    if(flags MATCHES "-DNDEBUG")
    elseif(NOT CMAKE_CXX_FLAGS MATCHES "-stdlib=libc\\+\\+")
        list(APPEND options -D_GLIBCXX_ASSERTIONS)
    elseif(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15)
        list(APPEND options -D_LIBCPP_DEBUG=0)
    elseif(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 18)
        list(APPEND options -D_LIBCPP_ENABLE_ASSERTIONS=1)
    else()
        list(APPEND options -D_LIBCPP_HARDENING_MODE=_LIBCPP_HARDENING_MODE_EXTENSIVE)
    endif()
    set(left $<IN_LIST:$<TARGET_PROPERTY:NAME>,${PACINI_NOT_SANITIZED}>)
    target_compile_options(pacini_sanitizers INTERFACE $<$<NOT:${left}>:${options}>)
endif()
