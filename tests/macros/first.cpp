// The standard library comes first: Microsoft's withstands these macros, others do not in all of it.
#include "standard.hpp"

#include "windows.hpp"
#include "x11.hpp"

#include "everything.hpp"

// The consumer, who gets the same results.
#include "../consumer/main.cpp"  // NOLINT(bugprone-suspicious-include): its main is the test
