# Installs BUILD into BUILD/package/pacini-VERSION-windows, and packs that as a zip and by SCRIPT as an installer. Dates, the
# order of files and the zone of time are the same everywhere.
cmake_minimum_required(VERSION 3.25)
set(ENV{TZ} UTC)
set(ENV{SOURCE_DATE_EPOCH} 315532800) # 1980, before which a zip has no dates
set(name pacini-${VERSION}-windows)
set(package "${BUILD}/package")
file(REMOVE_RECURSE "${package}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --strip --prefix "${package}/${name}" OUTPUT_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE files RELATIVE "${package}/${name}" "${package}/${name}/*")
list(SORT files)

# zip, as CMake's own tar would also write when a file was read and by whom.
list(TRANSFORM files PREPEND "${name}/" OUTPUT_VARIABLE lines)
execute_process(COMMAND touch -d "@$ENV{SOURCE_DATE_EPOCH}" ${lines} WORKING_DIRECTORY "${package}" COMMAND_ERROR_IS_FATAL ANY)
list(JOIN lines "\n" lines)
file(WRITE "${package}/files" "${lines}\n")
execute_process(COMMAND zip -qX9 "${name}.zip" -@ WORKING_DIRECTORY "${package}" INPUT_FILE "${package}/files"
    COMMAND_ERROR_IS_FATAL ANY)

# The place of a file or folder of the package on the machine: of plugins, where hosts look for those of one user.
function(place_of file result)
    if(file MATCHES "^plugins(/.*)?$")
        set(place "$LOCALAPPDATA/Programs/Common${CMAKE_MATCH_1}")
    else()
        set(place "$INSTDIR/${file}")
    endif()
    string(REPLACE "/" "\\" place "${place}")
    set(${result} "${place}" PARENT_SCOPE)
endfunction()

# What the installer puts there, and its removal: files of people in these folders stay.
set(install "")
set(remove "")
set(folders "")
foreach(file IN LISTS files)
    cmake_path(GET file PARENT_PATH folder)
    if(NOT folder STREQUAL last)
        place_of("${folder}" place)
        string(APPEND install "SetOutPath \"${place}\"\n")
        set(last "${folder}")
    endif()
    place_of("${file}" place)
    string(APPEND install "File \"${package}/${name}/${file}\"\n")
    string(APPEND remove "Delete \"${place}\"\n")
    while(folder AND NOT folder IN_LIST folders)
        list(APPEND folders "${folder}")
        cmake_path(GET folder PARENT_PATH folder)
    endwhile()
endforeach()
list(SORT folders ORDER DESCENDING)
foreach(folder IN LISTS folders)
    place_of("${folder}" place)
    string(APPEND remove "RMDir \"${place}\"\n")
endforeach()
file(WRITE "${package}/install.nsh" "${install}")
file(WRITE "${package}/remove.nsh" "${remove}")
execute_process(COMMAND "${MAKENSIS}" -V2 "-DVERSION=${VERSION}" "-DFOLDER=${package}" "-DOUTPUT=${package}/${name}-setup.exe"
    "${SCRIPT}" COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE "${package}/files" "${package}/install.nsh" "${package}/remove.nsh")
