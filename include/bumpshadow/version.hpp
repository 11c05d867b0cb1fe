#pragma once

// Version of bumpshadow. CMake reads these three numbers from this file; they stand nowhere else.
// Semantic versioning: before 1.0 a minor version may change the interface.
#define BUMPSHADOW_VERSION_MAJOR 0
#define BUMPSHADOW_VERSION_MINOR 1
#define BUMPSHADOW_VERSION_PATCH 0
