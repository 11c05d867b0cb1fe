# 64-bit Windows by MinGW; programs run under Wine. Debian, Ubuntu: g++-mingw-w64-x86-64-posix, wine64.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
# There GCC takes the registers that its copy of an inline function spares for those that any copy does, and the linker
# may keep the copy of another file: wrong code.
set(CMAKE_CXX_FLAGS_INIT -fno-ipa-ra)
# Programs run without a search for the libraries of the compiler.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_CROSSCOMPILING_EMULATOR "sh;${CMAKE_CURRENT_LIST_DIR}/wine.sh")
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
include("${CMAKE_CURRENT_LIST_DIR}/packages.cmake")
