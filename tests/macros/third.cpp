// <windows.h> as it is, before anything else.
#ifdef _WIN32
#include <windows.h>
#endif

#include "everything.hpp"
