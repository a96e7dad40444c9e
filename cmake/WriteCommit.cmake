# Writes HEADER, which says of which commit the sources in SOURCE are: that of the archive that Git made of them, else that of
# the checkout, with "changed" where tracked files differ from it, else none. A header that says so already stays as it is.
cmake_minimum_required(VERSION 3.25)
file(READ "${SOURCE}/cmake/commit.txt" commit)
string(STRIP "${commit}" commit)
if(NOT commit MATCHES "^[0-9a-f]+$")
    set(commit "")
    function(git variable) # what it prints, or nothing
        # A checkout of somebody else is read, too, and nothing is written: Git may be at work there.
        execute_process(COMMAND "${CMAKE_COMMAND}" -E env GIT_OPTIONAL_LOCKS=0 git -c "safe.directory=*" ${ARGN}
            WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE code)
        if(NOT code STREQUAL "0")
            set(said "")
        endif()
        set(${variable} "${said}" PARENT_SCOPE)
    endfunction()
    # A copy within another project's checkout is none of its commits.
    git(above rev-parse --show-cdup)
    git(head rev-parse --verify HEAD)
    if(head AND above STREQUAL "")
        set(commit "${head}")
        git(changed status --porcelain --untracked-files=no)
    endif()
endif()
if(commit)
    string(SUBSTRING "${commit}" 0 12 commit)
    if(changed)
        string(APPEND commit ", changed")
    endif()
endif()
set(text "#pragma once\n\n// Made by cmake/WriteCommit.cmake.\n#define PACINI_COMMIT \"${commit}\"\n")
file(CONFIGURE OUTPUT "${HEADER}" CONTENT "@text@" @ONLY)
