# The libraries of PaciniDependencies.cmake where Linux compiles for Windows: headers alone of the system's packages, and what
# `cmake/bootstrap.sh windows` has put into PACINI_WINDOWS_SOURCES. Without cairo and RtAudio there are neither PNG nor PDF
# nor sound devices.
set(PACINI_WINDOWS_SOURCES "${PROJECT_SOURCE_DIR}/build/windows-sources" CACHE PATH "Sources of libraries for Windows")
if(NOT EXISTS "${PACINI_WINDOWS_SOURCES}/complete")
    message(FATAL_ERROR "${PACINI_WINDOWS_SOURCES} is not complete: run 'bash cmake/bootstrap.sh windows'")
endif()
enable_language(C)
set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})

# Beside these headers there are those of another C library: links keep them apart.
set(headers "${CMAKE_BINARY_DIR}/dependencies")
file(MAKE_DIRECTORY "${headers}")
foreach(path eigen3/Eigen eigen3/unsupported nlohmann fmt CLI boost sndfile.h)
    get_filename_component(name ${path} NAME)
    if(NOT EXISTS "/usr/include/${path}")
        message(FATAL_ERROR "/usr/include/${path} is missing: run 'bash cmake/bootstrap.sh windows'")
    endif()
    file(CREATE_LINK "/usr/include/${path}" "${headers}/${name}" SYMBOLIC)
endforeach()
foreach(target Eigen3::Eigen nlohmann_json::nlohmann_json CLI11::CLI11 Boost::headers fmt::fmt fmt::fmt-header-only
    PkgConfig::sndfile PkgConfig::expat PkgConfig::libzip PkgConfig::hidapi PkgConfig::qrcodegen)
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} INTERFACE "${headers}")
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_HEADER_ONLY=1)
target_compile_definitions(Boost::headers INTERFACE _WIN32_WINNT=0x0A00)
target_link_libraries(Boost::headers INTERFACE ws2_32 mswsock)
find_package(Threads REQUIRED)

# Sounds: a library of its own, whose licence asks that users can replace it. Programs look for it by the name that it was
# linked with.
set(PACINI_SNDFILE_DLL "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/sndfile.dll")
file(MAKE_DIRECTORY "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
file(COPY_FILE "${PACINI_WINDOWS_SOURCES}/_soundfile_data/libsndfile_x64.dll" "${PACINI_SNDFILE_DLL}" ONLY_IF_DIFFERENT)
execute_process(COMMAND "${CMAKE_OBJDUMP}" -p "${PACINI_SNDFILE_DLL}" OUTPUT_VARIABLE functions COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " sf_[a-z_]+" functions "${functions}")
list(JOIN functions "\n" functions)
file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/sndfile.def" CONTENT "LIBRARY sndfile.dll\nEXPORTS\n${functions}\n")
execute_process(COMMAND "${CMAKE_DLLTOOL}" -d sndfile.def --output-delaylib sndfile-later.a # names are part of it
    WORKING_DIRECTORY "${CMAKE_BINARY_DIR}" COMMAND_ERROR_IS_FATAL ANY)
# A plugin looks for it itself, Source/plugin/mingw/SoundLibrary.cpp.
target_link_libraries(PkgConfig::sndfile
    INTERFACE "$<IF:$<BOOL:$<TARGET_PROPERTY:PACINI_FINDS_SNDFILE>>,${CMAKE_BINARY_DIR}/sndfile-later.a,${PACINI_SNDFILE_DLL}>")
set(runtime "${PROJECT_SOURCE_DIR}/Source/cli/windows/vcruntime140")
add_library(vcruntime140 SHARED "${runtime}.c" "${runtime}.def")
set_target_properties(vcruntime140 PROPERTIES PREFIX "" OUTPUT_NAME VCRUNTIME140)
target_compile_options(vcruntime140 PRIVATE -fno-builtin)
target_link_options(vcruntime140 PRIVATE -nostdlib -Wl,--entry=DllMainCRTStartup)

# Compiled here, each with the folder of its first source as that of its headers.
function(pacini_windows_library target) # sources
    list(TRANSFORM ARGN PREPEND "${PACINI_WINDOWS_SOURCES}/" OUTPUT_VARIABLE sources)
    string(REPLACE "PkgConfig::" windows_ name ${target})
    add_library(${name} STATIC EXCLUDE_FROM_ALL ${sources})
    target_compile_options(${name} PRIVATE -w)
    list(GET sources 0 first)
    get_filename_component(folder "${first}" DIRECTORY)
    target_include_directories(${name} SYSTEM PUBLIC "${folder}")
    target_link_libraries(${target} INTERFACE ${name})
endfunction()
pacini_windows_library(PkgConfig::expat expat/expat/lib/xmlparse.c expat/expat/lib/xmlrole.c expat/expat/lib/xmltok.c)
file(WRITE "${CMAKE_BINARY_DIR}/expat/expat_config.h" "") # its Makefiles write one
target_include_directories(windows_expat PRIVATE "${CMAKE_BINARY_DIR}/expat")
target_compile_definitions(windows_expat PUBLIC XML_STATIC=1 PRIVATE XML_NS=1 XML_DTD=1 XML_CONTEXT_BYTES=1024 BYTEORDER=1234)
pacini_windows_library(PkgConfig::hidapi hidapi/windows/hid.c)
target_include_directories(windows_hidapi SYSTEM PUBLIC "${PACINI_WINDOWS_SOURCES}/hidapi/hidapi")
pacini_windows_library(PkgConfig::qrcodegen qr-code-generator/cpp/qrcodegen.cpp)
file(CREATE_LINK "${PACINI_WINDOWS_SOURCES}/qr-code-generator/cpp" "${headers}/qrcodegen" SYMBOLIC) # as where it is installed

# zlib is a package.
find_library(PACINI_WINDOWS_ZLIB libz.a REQUIRED)
set(ZLIB_LIBRARY "${PACINI_WINDOWS_ZLIB}" CACHE FILEPATH "")
foreach(part COMMONCRYPTO GNUTLS MBEDTLS OPENSSL WINDOWS_CRYPTO BZIP2 LZMA)
    set(ENABLE_${part} OFF CACHE BOOL "")
endforeach()
foreach(part BUILD_TOOLS BUILD_REGRESS BUILD_EXAMPLES BUILD_DOC BUILD_SHARED_LIBS LIBZIP_DO_INSTALL)
    set(${part} OFF CACHE BOOL "")
endforeach()
set(CMAKE_POLICY_DEFAULT_CMP0063 NEW) # it is of an older CMake
add_subdirectory("${PACINI_WINDOWS_SOURCES}/libzip" "${CMAKE_BINARY_DIR}/libzip" EXCLUDE_FROM_ALL SYSTEM)
target_compile_options(zip PRIVATE -w)
target_link_libraries(PkgConfig::libzip INTERFACE zip)
