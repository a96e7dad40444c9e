# How our own sources are compiled: language level, warnings, sanitizers, ccache.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
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
    set(CMAKE_CXX_COMPILER_LAUNCHER "${PACINI_CCACHE}")
endif()

# Linked PRIVATE by every own target: warnings never reach people who include our headers. Files that are compiled as one
# see each other's names, which -Wshadow would mistake for their own.
add_library(pacini_warnings INTERFACE)
if(MSVC)
    target_compile_options(pacini_warnings INTERFACE /W4 $<$<BOOL:${PACINI_WARNINGS_AS_ERRORS}>:/WX>)
else()
    target_compile_options(pacini_warnings INTERFACE
        -Wall -Wextra -Wpedantic $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow> -Wconversion -Wsign-conversion -Wdouble-promotion
        # GCC 12 sees overlaps in additions of std::string that are none (its bug 105651).
        $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
        $<$<BOOL:${PACINI_WARNINGS_AS_ERRORS}>:-Werror>)
endif()

add_library(pacini_sanitizers INTERFACE)
if(PACINI_SANITIZE)
    target_compile_options(pacini_sanitizers INTERFACE
        -fsanitize=${PACINI_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(pacini_sanitizers INTERFACE -fsanitize=${PACINI_SANITIZE})
endif()
