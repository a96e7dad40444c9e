# Toolchain of WebAssembly: Debian's clang, lld, libc++ and wasi-libc.
set(CMAKE_SYSTEM_NAME Generic) # WASI is no system that CMake knows
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(PACINI_WASM_CLANG 22)
set(CMAKE_CXX_COMPILER clang++-${PACINI_WASM_CLANG})
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi) # wasip1, which a warning suggests, finds no headers
set(CMAKE_CXX_FLAGS_INIT "-Wno-deprecated -fno-exceptions -fno-rtti -msimd128")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
