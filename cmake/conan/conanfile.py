# Conan 2 recipe of the tree that it lies in: conan create cmake/conan
# Checked without Conan, which needs the network: tests/roads/conan_recipe.py runs its methods against stand-ins for
# what they import, and a consumer finds what they install. Conan itself has not run it.
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir


class BumpshadowConan(ConanFile):
    name = "bumpshadow"
    description = "Horizon maps from height maps: bumps that cast shadows on the surface they are drawn on"
    license = "MIT"
    topics = ("graphics", "shadows", "horizon-map", "bump-mapping", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    @property
    def _top(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._top, "include", "bumpshadow", "version.hpp"))
        numbers = re.findall(r"^#define BUMPSHADOW_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, re.MULTILINE)
        self.version = ".".join(numbers)

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*"):
            copy(self, pattern, src=self._top, dst=self.export_sources_folder)

    def layout(self):
        self.folders.root = os.path.join("..", "..")
        cmake_layout(self)

    def requirements(self):
        self.requires("glm/[>=0.9.9.8 <2]", transitive_headers=True)

    def package_id(self):
        self.info.clear()

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for option, value in (("BUILD_TESTS", False), ("BUILD_EXAMPLES", False), ("INSTALL", True)):
            toolchain.cache_variables["BUMPSHADOW_" + option] = value
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()

    def package(self):
        cmake = CMake(self)
        cmake.install()
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        rmdir(self, os.path.join(self.package_folder, "share", "doc"))

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        # The package's own files for CMake, so that targets and components are the same by every road.
        self.cpp_info.builddirs = [os.path.join("share", "cmake", "bumpshadow")]
        self.cpp_info.set_property("cmake_find_mode", "none")
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread"]
