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
if(NOT PACINI_BUILD_PLUGIN)
    return() # what people get has it
endif()
foreach(file libjpeg-turbo/LICENSE.md libjpeg-turbo/README.ijg libpng1.6/LICENSE)
    string(REPLACE "/" "-" name ${file})
    install(FILES "${PACINI_WINDOWS_SOURCES}/${file}" DESTINATION licenses RENAME "${name}")
endforeach()
# What holds JUCE is under the GPL.
install(FILES "${PROJECT_SOURCE_DIR}/Source/plugin/LICENSE.md" DESTINATION licenses RENAME Pacini-plugin-LICENSE.md)
install(FILES /usr/share/common-licenses/GPL-3 DESTINATION licenses)
install(TARGETS pacini_editor_app)
# `pacini.exe` is the command, and to Windows `Pacini.exe` is the same name.
install(PROGRAMS "$<TARGET_FILE:pacini_plugin_Standalone>" DESTINATION bin RENAME PaciniStandalone.exe)
# Each with the library beside it. The installer puts them where hosts look for a user's plugins.
set(vst3 plugins/VST3/Pacini.vst3/Contents/x86_64-win)
set(libraries "${PACINI_SNDFILE_DLL}" $<TARGET_FILE:vcruntime140>)
install(FILES "$<TARGET_FILE:pacini_plugin_VST3>" ${libraries} DESTINATION ${vst3})
install(FILES "$<TARGET_FILE:pacini_plugin_CLAP>" ${libraries} DESTINATION plugins/CLAP/Pacini)
# CMake strips only what install(TARGETS) installs.
install(CODE "
    if(CMAKE_INSTALL_DO_STRIP)
        foreach(file bin/PaciniStandalone.exe ${vst3}/Pacini.vst3 plugins/CLAP/Pacini/Pacini.clap)
            execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-unneeded \"\${CMAKE_INSTALL_PREFIX}/\${file}\"
                COMMAND_ERROR_IS_FATAL ANY)
        endforeach()
    endif()")
find_program(PACINI_MAKENSIS makensis NO_CMAKE_FIND_ROOT_PATH REQUIRED)
add_custom_target(pacini_windows_package
    COMMAND "${CMAKE_COMMAND}" "-DBUILD=${PROJECT_BINARY_DIR}" "-DSCRIPT=${PROJECT_SOURCE_DIR}/Resources/package/pacini.nsi"
        "-DMAKENSIS=${PACINI_MAKENSIS}" -DVERSION=${PROJECT_VERSION} -P "${CMAKE_CURRENT_LIST_DIR}/WriteWindowsPackage.cmake"
    VERBATIM)
add_dependencies(pacini_windows_package pacini pacini-bench vcruntime140 pacini_library pacini_library_static
    pacini_plugin_VST3 pacini_plugin_CLAP pacini_plugin_Standalone pacini_editor_app)
