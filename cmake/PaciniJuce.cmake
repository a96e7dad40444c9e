# JUCE for the plugin: a checkout named by PACINI_JUCE_DIR, the system's package, or, where there is none of either on
# macOS and Windows, a download. Sets PACINI_JUCE_FOUND.
set(PACINI_JUCE_DIR "" CACHE PATH "Source of upstream JUCE 7 or 8; empty: the system's package")
set(PACINI_JUCE_TAG "8.0.4" CACHE STRING "Version of JUCE that is downloaded on macOS and Windows")
mark_as_advanced(PACINI_JUCE_TAG)

set(PACINI_JUCE_FOUND FALSE)
if(PACINI_JUCE_DIR)
    enable_language(C)
    add_subdirectory("${PACINI_JUCE_DIR}" "${CMAKE_BINARY_DIR}/juce-source" EXCLUDE_FROM_ALL SYSTEM)
    set(PACINI_JUCE_FOUND TRUE)
else()
    if(MINGW)
        # Debian's package of the machine that compiles: sources for every system, and its own program to prepare them.
        file(GLOB packages "/usr/lib/*/cmake/JUCE-7*")
        find_package(JUCE CONFIG QUIET PATHS ${packages} NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
    else()
        find_package(JUCE CONFIG QUIET)
    endif()
    if(JUCE_FOUND)
        enable_language(C)
        set(PACINI_JUCE_FOUND TRUE)
    elseif(APPLE OR WIN32)
        enable_language(C)
        if(APPLE)
            enable_language(OBJCXX)
        endif()
        include(FetchContent)
        FetchContent_Declare(juce GIT_REPOSITORY https://github.com/juce-framework/JUCE.git
            GIT_TAG "${PACINI_JUCE_TAG}" GIT_SHALLOW ON)
        FetchContent_MakeAvailable(juce)
        set(PACINI_JUCE_FOUND TRUE)
    endif()
endif()

# A library of binary data made of `files`. JUCE's own depends on the list of their names only, which each run of CMake
# writes: so an edit of one runs CMake.
function(pacini_add_binary_data target namespace header)
    juce_add_binary_data(${target} NAMESPACE ${namespace} HEADER_NAME ${header} SOURCES ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()
