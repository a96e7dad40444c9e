# What is installed on Windows besides the core and libpacini, and the target pacini_windows_package: all of it as an installer
# for NSIS and as a zip, with the same bytes whenever the same programs are packed.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME programs)
install(TARGETS pacini pacini-bench)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION .)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/profiles" "${PROJECT_SOURCE_DIR}/Resources/schema" "${PROJECT_SOURCE_DIR}/Resources/demo"
    DESTINATION share/pacini)
if(NOT PACINI_SNDFILE_DLL)
    return() # another compiler's package manager has its own ways
endif()
install(FILES "${PACINI_SNDFILE_DLL}" $<TARGET_FILE:vcruntime140> DESTINATION bin)
install(FILES "${PACINI_WINDOWS_SOURCES}/_soundfile_data/COPYING" DESTINATION licenses RENAME libsndfile-COPYING)
foreach(file expat/expat/COPYING hidapi/LICENSE-bsd.txt libzip/LICENSE)
    string(REGEX REPLACE "/.*/|/" "-" name ${file})
    install(FILES "${PACINI_WINDOWS_SOURCES}/${file}" DESTINATION licenses RENAME "${name}")
endforeach()
find_program(PACINI_MAKENSIS makensis NO_CMAKE_FIND_ROOT_PATH REQUIRED)
add_custom_target(pacini_windows_package
    COMMAND "${CMAKE_COMMAND}" "-DBUILD=${PROJECT_BINARY_DIR}" "-DSCRIPT=${PROJECT_SOURCE_DIR}/Resources/package/pacini.nsi"
        "-DMAKENSIS=${PACINI_MAKENSIS}" -DVERSION=${PROJECT_VERSION} -P "${CMAKE_CURRENT_LIST_DIR}/WriteWindowsPackage.cmake"
    VERBATIM)
add_dependencies(pacini_windows_package pacini pacini-bench vcruntime140 pacini_library pacini_library_static)
