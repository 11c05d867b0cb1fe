#pragma once

// Version of bumpshadow. CMake reads these three numbers from this file; they stand nowhere else.
// Semantic versioning: before 1.0 a minor version may change the interface.

// Grows where the interface changes, from 1.0 on.
#define BUMPSHADOW_VERSION_MAJOR 0
// Grows where something is added; before 1.0 also where the interface changes.
#define BUMPSHADOW_VERSION_MINOR 1
// Grows with repairs.
#define BUMPSHADOW_VERSION_PATCH 0
