# What is installed besides the core, and the Debian package of all of it: `cmake --install` and `cpack -G DEB` give the
# same tree. On Linux: Windows has WindowsPackage.cmake, and elsewhere plugins and programs have other places.
if(WIN32 AND TARGET pacini)
    include(WindowsPackage)
endif()
if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR CMAKE_CROSSCOMPILING OR PACINI_SANITIZE OR NOT TARGET pacini)
    return()
endif()
set(resources "${PROJECT_SOURCE_DIR}/Resources")
set(texts "${PROJECT_BINARY_DIR}/package")
set(share "${CMAKE_INSTALL_DATADIR}")
set(PACINI_DESKTOP_PROGRAMS OFF)
if(TARGET pacini_plugin_Standalone)
    set(PACINI_DESKTOP_PROGRAMS ON)
endif()

# Manual pages and completions are what the programs say of themselves.
set(pages "${texts}/pacini.1.gz" "${texts}/pacini-bench.1.gz")
add_custom_command(OUTPUT ${pages} "${texts}/pacini.bash" "${texts}/_pacini" "${texts}/pacini.fish"
    COMMAND ${CMAKE_COMMAND} "-DPACINI=$<TARGET_FILE:pacini>" "-DFOLDER=${texts}" -P "${CMAKE_CURRENT_LIST_DIR}/WriteTexts.cmake"
    DEPENDS pacini "${CMAKE_CURRENT_LIST_DIR}/WriteTexts.cmake" VERBATIM)
function(pacini_manual_of target name)
    add_custom_command(OUTPUT "${texts}/${name}.1.gz"
        COMMAND ${CMAKE_COMMAND} "-DPROGRAM=$<TARGET_FILE:${target}>" -DNAME=${name} -DVERSION=${PROJECT_VERSION}
            "-DFOLDER=${texts}" -P "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/WriteTexts.cmake"
        DEPENDS ${target} "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/WriteTexts.cmake" VERBATIM)
    set(pages "${pages}" "${texts}/${name}.1.gz" PARENT_SCOPE)
endfunction()
if(PACINI_DESKTOP_PROGRAMS)
    pacini_manual_of(pacini_editor_app PaciniEditor)
    pacini_manual_of(pacini_plugin_Standalone PaciniStandalone)
endif()
add_custom_target(pacini_texts ALL DEPENDS ${pages})

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME programs)
install(TARGETS pacini pacini-bench)
install(FILES ${pages} DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${share}/doc/pacini")
install(FILES "${texts}/pacini.bash" DESTINATION "${share}/bash-completion/completions" RENAME pacini)
install(FILES "${texts}/pacini.fish" DESTINATION "${share}/fish/vendor_completions.d")
# Debian's zsh looks in a place of its own.
if(EXISTS /etc/debian_version)
    set(zsh vendor-completions)
else()
    set(zsh site-functions)
endif()
install(FILES "${texts}/_pacini" DESTINATION "${share}/zsh/${zsh}")
install(FILES "${resources}/package/lintian-overrides" DESTINATION "${share}/lintian/overrides" RENAME pacini)
install(FILES "${resources}/udev/70-pacini.rules" DESTINATION lib/udev/rules.d)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/profiles" "${resources}/schema" "${resources}/demo" DESTINATION "${share}/pacini")

if(PACINI_DESKTOP_PROGRAMS)
    install(TARGETS pacini_editor_app)
    # Beside the command `pacini` its own name, Pacini, would be a trap.
    install(PROGRAMS "$<TARGET_FILE:pacini_plugin_Standalone>" DESTINATION "${CMAKE_INSTALL_BINDIR}" RENAME PaciniStandalone)
    install(FILES "${resources}/package/pacini.desktop" "${resources}/package/pacini-editor.desktop"
        DESTINATION "${share}/applications")
    install(FILES "${resources}/package/pacini.svg" DESTINATION "${share}/icons/hicolor/scalable/apps")
    # Where every host looks, below /usr as below /usr/local: not CMAKE_INSTALL_LIBDIR.
    install(DIRECTORY "${PROJECT_BINARY_DIR}/plugins/VST3/Pacini.vst3" DESTINATION lib/vst3)
    install(DIRECTORY "${PROJECT_BINARY_DIR}/plugins/LV2/Pacini.lv2" DESTINATION lib/lv2)
    install(FILES "$<TARGET_FILE:pacini_plugin_CLAP>" DESTINATION lib/clap)
    # CMake strips only what install(TARGETS) installs.
    install(CODE "
        if(CMAKE_INSTALL_DO_STRIP)
            set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
            file(GLOB_RECURSE plugins \"\${prefix}/lib/vst3/Pacini.vst3/*.so\" \"\${prefix}/lib/lv2/Pacini.lv2/*.so\"
                \"\${prefix}/lib/clap/Pacini.clap\")
            execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-unneeded \${plugins}
                \"\${prefix}/${CMAKE_INSTALL_BINDIR}/PaciniStandalone\" COMMAND_ERROR_IS_FATAL ANY)
        endif()")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pacini)
set(CPACK_PACKAGE_VENDOR "The Pacini developers")
set(CPACK_PACKAGE_CONTACT "The Pacini developers <developers@pacini.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "audio-to-haptics encoder, editor and plugins")
set(CPACK_PACKAGE_DESCRIPTION
"Pacini turns recordings into haptic clips and clips into the signal that
drives an actuator: for games, music, wearables and research.
.
The package holds the command pacini, which encodes, renders, converts,
compares and measures; the live translator as a VST3, an LV2 and a CLAP plugin
and as a program of its own; the clip editor; profiles of actuators, demo
sounds, libpacini, which plays clips in games and other programs, shared and
static with its C header; and the headers of the DSP core for C++20.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz) # as the packages of Debian
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION sound)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "https://pacini.example")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Programs that are packaged with libpacini depend on this package, and the linker's list is made anew.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev, librtaudio6, ffmpeg, speech-dispatcher") # what `pacini live` opens at run time, what decodes films, and what speaks for the editor
if(PACINI_DESKTOP_PROGRAMS)
    # What JUCE opens at run time, which dpkg-shlibdeps cannot see.
    set(CPACK_DEBIAN_PACKAGE_DEPENDS "libx11-6, libxcursor1, libxext6, libxinerama1, libxrandr2, libxss1")
    set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fonts-dejavu-core, libjack-jackd2-0 | libjack-0.125, xdg-utils")
    string(APPEND CPACK_DEBIAN_PACKAGE_SUGGESTS ", zenity | kdialog")
endif()
include(CPack)
