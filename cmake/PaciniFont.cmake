# The type family of the windows, which is compiled in: Roboto, Apache License 2.0, from Debian's fonts-roboto-unhinted or a
# folder of the same files. Its figures are equally wide. Without it there is no FontData.h, and windows take the system's font.
set(PACINI_FONT_DIR "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF"
    CACHE PATH "Folder of Roboto-Regular.ttf and Roboto-Medium.ttf")
mark_as_advanced(PACINI_FONT_DIR)

function(pacini_embed_font target)
    set(files "${PACINI_FONT_DIR}/Roboto-Regular.ttf" "${PACINI_FONT_DIR}/Roboto-Medium.ttf")
    foreach(file ${files})
        if(NOT EXISTS "${file}")
            message(STATUS "Pacini: ${file} is missing: windows take the system's font")
            return()
        endif()
    endforeach()
    pacini_add_binary_data(pacini_font_data fontData FontData.h ${files})
    target_link_libraries(${target} PRIVATE pacini_font_data)
endfunction()
