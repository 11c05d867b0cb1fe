// GLM removes min and max, so the library meets them where GLM was there before they were.
#include "standard.hpp"

#include <glm/glm.hpp>

#include "windows.hpp"
#include "x11.hpp"

#include "everything.hpp"

#if !defined(min) || !defined(max) || !defined(None)
#error "macros of others are not as they were"
#endif
