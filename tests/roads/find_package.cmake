# find_package on the installed package, in a folder that it was moved to: what is found and what is refused.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")
set(moved "${WORK}/a folder elsewhere")
file(COPY "${PREFIX}/" DESTINATION "${moved}")

# find(WANTED ARGUMENT...): sets code, output and `result`.
macro(find wanted)
    empty_folder("${WORK}/build")
    run(${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}/find" -B "${WORK}/build" -G "${GENERATOR}"
        "-DCMAKE_PREFIX_PATH=${moved}" "-DWANTED=${wanted}" ${ARGN})
    string(REGEX MATCH "result: [^\n]*" result "${output}")
    string(REGEX REPLACE "[ \n]+" " " output "${output}")  # CMake breaks lines
endmacro()

# The component that needs no language and no GLM, for what is the same with all.
set(shaders "COMPONENTS\\;shaders")
foreach(version "" 0.1 0.1.0 0.1...<0.2 "0.1.0\\;EXACT")
    find("${version}\\;${shaders}" -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON)
    expect("${version} is found" code EQUAL 0 AND result STREQUAL
        "result: found=1 version=${VERSION} targets=bumpshadow::shaders")
endforeach()
string(FIND "${output}" "shaders: ${moved}/include/bumpshadow/shader" at)
expect("the shaders are where the package was moved to" NOT at EQUAL -1)
find("0.1\\;${shaders}" -DPOINTER_BYTES=4)
expect("the package has no architecture" code EQUAL 0 AND result MATCHES "found=1")

# Before 1.0 another minor version is another interface; an older patch may lack what is asked for.
foreach(version 0.0 0.0.9 0.1.99 0.2 1.0 99.0)
    find("${version}\\;${shaders}")
    expect("${version} is not found" code EQUAL 0 AND result MATCHES "found=0 .*targets=$")
    expect("${version}: the version that is there is named" output MATCHES "requested version.*version: ${VERSION}")
    find("${version}\\;REQUIRED\\;${shaders}")
    expect("${version} is refused" NOT code EQUAL 0 AND NOT result)
endforeach()

set(no_component "bumpshadow has no component \"nonsense\"; there are headers and shaders.")
find("0.1\\;COMPONENTS\\;shaders\\;nonsense")
string(FIND "${output}" "${no_component}" at)
expect("an unknown component is named" code EQUAL 0 AND result MATCHES "found=0 .*targets=$" AND NOT at EQUAL -1)
find("0.1\\;REQUIRED\\;COMPONENTS\\;nonsense")
string(FIND "${output}" "${no_component}" at)
expect("an unknown component is refused" NOT code EQUAL 0 AND NOT at EQUAL -1)
find("0.1\\;QUIET\\;COMPONENTS\\;nonsense")
expect("QUIET is quiet" code EQUAL 0 AND result MATCHES "found=0" AND NOT output MATCHES "Warning|no component")
find("0.1\\;QUIET\\;OPTIONAL_COMPONENTS\\;shaders\\;nonsense")
expect("an unknown component may be optional" code EQUAL 0 AND result MATCHES "found=1 .*targets=bumpshadow::shaders$")

# One sentence where GLM is missing.
find("0.1" -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON)
expect("a missing GLM is a warning" code EQUAL 0 AND result MATCHES "found=0" AND output MATCHES "bumpshadow needs GLM")
find("0.1\\;REQUIRED" -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON)
expect("a missing GLM is an error" NOT code EQUAL 0 AND output MATCHES "bumpshadow needs GLM 0.9.9.8 or newer: install it")
find("0.1\\;QUIET" -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON)
expect("a missing GLM, quiet" code EQUAL 0 AND result MATCHES "found=0" AND NOT output MATCHES "needs GLM")
find("0.1\\;COMPONENTS\\;shaders\\;OPTIONAL_COMPONENTS\\;headers" -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON)
expect("the library may be optional" code EQUAL 0 AND result MATCHES "found=1 .*targets=bumpshadow::shaders$")

# A consumer with the policies of an old CMake is none; an old CMake is told what to do.
find("0.1\\;REQUIRED\\;${shaders}" -DPOLICIES_OF=3.1)
expect("the policies of an old CMake" code EQUAL 0 AND result MATCHES "found=1")
find("0.1\\;REQUIRED\\;${shaders}" -DPRETENDED_VERSION=3.16.3)
expect("an old CMake is refused" NOT code EQUAL 0
    AND output MATCHES "bumpshadow needs CMake 3.20 or newer, this is 3.16.3: install a newer one.")
