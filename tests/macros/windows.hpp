// <windows.h> without NOMINMAX, or what it does to the names of others, as far as that matters to a library.
#pragma once

#ifdef _WIN32

#include <windows.h>
// MinGW keeps these from C++, Microsoft does not.
#undef min
#undef max
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))

#else

#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define near
#define far
#define small char
#define hyper __int64
#define interface struct
#define pascal __stdcall
#define cdecl __cdecl

#define IN
#define OUT
#define OPTIONAL
#define CONST const
#define VOID void
#define TRUE 1
#define FALSE 0
#define STRICT 1
#define ERROR 0
#define NO_ERROR 0L
#define DELETE 0x00010000L
#define IGNORE 0
#define INFINITE 0xFFFFFFFF
#define ABSOLUTE 1
#define RELATIVE 2
#define OPAQUE 2
#define TRANSPARENT 1
#define DIFFERENCE 11
#define DOMAIN 1
#define OVERFLOW 3
#define UNDERFLOW 4
#define SEVERITY_ERROR 1
#define THIS_ INTERFACE FAR *This,
#define PURE = 0
#define FAR
#define NEAR
#define PASCAL __stdcall
#define CALLBACK __stdcall
#define rad1 0x0420
#define rad2 0x0421
#define chx1 0x0410
#define edt1 0x0480
#define lst1 0x0460
#define stc1 0x0440
#define grp1 0x0430

// One for each function that comes in two character sets.
#define CreateWindow(...) CreateWindowA(__VA_ARGS__)
#define CreateFile CreateFileA
#define DrawText DrawTextA
#define GetMessage GetMessageA
#define GetObject GetObjectA
#define LoadImage LoadImageA
#define SendMessage SendMessageA

#endif
