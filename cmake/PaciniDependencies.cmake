# Third-party libraries. Debian and Ubuntu packages, Homebrew or vcpkg all provide them; cmake/bootstrap.sh installs
# them on Debian and Ubuntu.
if(CMAKE_CROSSCOMPILING AND WIN32)
    include(WindowsDependencies)
    return()
endif()

# Eigen: small dense matrices. Its imported target marks its headers as those of a system.
find_package(Eigen3 3.3 REQUIRED NO_MODULE)

if(PACINI_BUILD_CLI OR PACINI_BUILD_LIBRARY OR PACINI_BUILD_PYTHON OR PACINI_BUILD_TESTS OR PACINI_BUILD_FUZZERS)
    find_package(nlohmann_json 3.10 REQUIRED)
    find_package(fmt REQUIRED)
    find_package(PkgConfig REQUIRED)
    pkg_check_modules(sndfile REQUIRED IMPORTED_TARGET sndfile)
    # Without expat the vibration XML of Android is written, but not read.
    pkg_search_module(expat IMPORTED_TARGET expat)
    # Without libzip there are no bundles of Pulsar.
    pkg_search_module(libzip IMPORTED_TARGET libzip)
endif()
if(PACINI_BUILD_CLI OR PACINI_BUILD_TESTS OR PACINI_BUILD_PLUGIN)
    # Headers: Boost.Math's distributions, for what studies report, and Boost.Beast, for phones.
    find_package(Boost 1.74 REQUIRED)
    # Without it nothing draws the picture that phones read; the address is shown as a text.
    find_package(PkgConfig REQUIRED)
    # Without it studies do not tell the loudness of their sounds.
    pkg_search_module(ebur128 IMPORTED_TARGET libebur128)
    pkg_search_module(qrcodegen IMPORTED_TARGET qrcodegencpp)
endif()
if(PACINI_BUILD_CLI OR PACINI_BUILD_TESTS)
    find_package(CLI11 REQUIRED)
    find_package(Threads REQUIRED)
    set(PACINI_CAIRO_REQUIRED "")
    if(PACINI_BUILD_TESTS)
        set(PACINI_CAIRO_REQUIRED REQUIRED)
    endif()
    # Without cairo, which the tests need, pictures are SVG alone, and the widths of their texts are estimated.
    pkg_check_modules(cairo ${PACINI_CAIRO_REQUIRED} IMPORTED_TARGET cairo)
    # Without hidapi the command cannot list game controllers.
    pkg_search_module(hidapi IMPORTED_TARGET hidapi-hidraw hidapi)
endif()
if(PACINI_BUILD_CLI OR PACINI_BUILD_TESTS OR PACINI_BUILD_PLUGIN)
    # Without the header of RtAudio 5 `pacini live` opens no sound device, and takes sounds from pipes and files. RtAudio 6
    # has other functions.
    pkg_check_modules(rtaudio rtaudio>=5.1 rtaudio<6)
    # Without PulseAudio's headers, which come with those of RtAudio, its devices are not listed, and a DualSense on a
    # cable plays by ALSA only.
    pkg_check_modules(pulse libpulse-simple)
endif()
if(PACINI_BUILD_TESTS)
    find_package(Catch2 REQUIRED)
endif()
if(PACINI_BUILD_BENCHMARKS)
    find_package(benchmark REQUIRED)
endif()
