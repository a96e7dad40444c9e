# The readers of pictures that JUCE of Debian expects as libraries of the system, PkgConfig::juce_pictures, where Linux compiles
# for Windows.
add_library(PkgConfig::juce_pictures INTERFACE IMPORTED GLOBAL)
set(generated "${CMAKE_BINARY_DIR}/juce-pictures")

set(sources png.c)
foreach(part error get mem pread read rio rtran rutil set trans wio write wtran wutil)
    list(APPEND sources png${part}.c)
endforeach()
list(TRANSFORM sources PREPEND libpng1.6/)
pacini_windows_library(PkgConfig::juce_pictures ${sources})
configure_file("${PACINI_WINDOWS_SOURCES}/libpng1.6/scripts/pnglibconf.h.prebuilt" "${generated}/pnglibconf.h" COPYONLY)
set_target_properties(windows_juce_pictures PROPERTIES OUTPUT_NAME png)

# Without arithmetic coding and without assembly.
set(sources jsimd_none.c)
foreach(part capimin capistd ccoefct ccolor cdctmgr chuff cicc cinit cmainct cmarker cmaster comapi cparam cphuff cprepct
    csample ctrans dapimin dapistd datadst datasrc dcoefct dcolor ddctmgr dhuff dicc dinput dmainct dmarker dmaster dmerge
    dphuff dpostct dsample dtrans error fdctflt fdctfst fdctint idctflt idctfst idctint idctred quant1 quant2 utils memmgr
    memnobs)
    list(APPEND sources j${part}.c)
endforeach()
list(TRANSFORM sources PREPEND "${PACINI_WINDOWS_SOURCES}/libjpeg-turbo/")
target_sources(windows_juce_pictures PRIVATE ${sources})
set(JPEG_LIB_VERSION 62)
set(LIBJPEG_TURBO_VERSION_NUMBER 2001005)
set(VERSION 2.1.5)
set(MEM_SRCDST_SUPPORTED ON)
set(BITS_IN_JSAMPLE 8)
set(INLINE inline)
set(THREAD_LOCAL __thread)
set(SIZE_T 8)
foreach(header jconfig.h jconfigint.h jversion.h)
    configure_file("${PACINI_WINDOWS_SOURCES}/libjpeg-turbo/${header}.in" "${generated}/${header}")
endforeach()
target_include_directories(windows_juce_pictures SYSTEM PUBLIC "${PACINI_WINDOWS_SOURCES}/libjpeg-turbo" "${generated}")
find_library(PACINI_WINDOWS_ZLIB libz.a REQUIRED)
target_link_libraries(windows_juce_pictures PUBLIC "${PACINI_WINDOWS_ZLIB}")
