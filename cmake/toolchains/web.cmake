# WebAssembly by Emscripten; programs run under Node. Debian, Ubuntu: emscripten, nodejs.
execute_process(COMMAND em-config EMSCRIPTEN_ROOT OUTPUT_VARIABLE root OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT root)
    message(FATAL_ERROR "There is no Emscripten here: install it (Debian, Ubuntu: emscripten) or put em++ on the PATH.")
endif()
# Files are those of the machine; and Node, which can fetch since 18, would look for a program beside it on the network.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-sNODERAWFS=1 -sSINGLE_FILE=1 -sALLOW_MEMORY_GROWTH=1")
# Debian's is from before parts of C++20 were there. Vectors have been in every browser since 2023.
set(CMAKE_CXX_FLAGS_INIT "-fexceptions -msimd128 -isystem \"${CMAKE_CURRENT_LIST_DIR}/web\"")
include("${root}/cmake/Modules/Platform/Emscripten.cmake")
set(CMAKE_CROSSCOMPILING_EMULATOR node)
# Where Debian keeps the modules of Node that its Emscripten links with.
if(EXISTS /usr/share/nodejs)
    set(CMAKE_CXX_LINKER_LAUNCHER "${CMAKE_COMMAND}" -E env "NODE_PATH=/usr/share/nodejs:$ENV{NODE_PATH}")
endif()
include("${CMAKE_CURRENT_LIST_DIR}/packages.cmake")
