"""conan_recipe.py RECIPE WORK VERSION CMAKE ARGUMENT...: runs the methods of a Conan 2 recipe as `conan create` does,
in its order and folders, against stand-ins for what the recipe imports of Conan. ARGUMENTs go to CMake."""
import fnmatch
import importlib.util
import os
import shutil
import subprocess
import sys
import types

recipe_path, work, version = sys.argv[1:4]
cmake_command = sys.argv[4:]
required_standards = []


def expect(what, found, expected):
    if found != expected:
        sys.exit(f"wrong: {what}: {found!r}, not {expected!r}")


# ---- What recipes import ----


class Attributes:
    """Keeps whatever is set on it."""

    def __init__(self, **values):
        self.__dict__.update(values)
        self.properties = {}

    def set_property(self, name, value):
        self.properties[name] = value


class ConanFile:
    version = None

    def __init__(self):
        self.recipe_folder = os.path.dirname(recipe_path)
        self.export_sources_folder = os.path.join(work, "export_source")
        self.source_folder = self.export_sources_folder
        self.build_folder = os.path.join(work, "build")
        self.package_folder = os.path.join(work, "package")
        self.settings = Attributes(os="Linux", arch="x86_64", compiler="gcc", build_type="Release")
        self.folders = Attributes()
        self.cpp_info = Attributes()
        self.info = Attributes(clear=lambda: None)
        self.required = {}

    def requires(self, reference, **traits):
        self.required[reference] = traits


class CMakeToolchain:
    def __init__(self, recipe):
        self.recipe = recipe
        self.cache_variables = {}

    def generate(self):
        self.recipe.cache_variables = self.cache_variables


class CMakeDeps:
    def __init__(self, recipe):
        pass

    def generate(self):
        pass


class CMake:
    def __init__(self, recipe):
        self.recipe = recipe

    def configure(self):
        definitions = [f"-D{name}={'ON' if value else 'OFF'}" for name, value in self.recipe.cache_variables.items()]
        run(cmake_command + ["-S", self.recipe.source_folder, "-B", self.recipe.build_folder] + definitions)

    def install(self):
        run([cmake_command[0], "--install", self.recipe.build_folder, "--prefix", self.recipe.package_folder])


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout}")


def copy(recipe, pattern, src, dst):
    """As Conan's: the pattern is matched against paths relative to src, and * also against a slash."""
    for folder, _, names in os.walk(src):
        relative = os.path.relpath(folder, src)
        if relative.split(os.sep)[0] in ("build", ".git", "node_modules"):
            continue
        for name in names:
            path = os.path.normpath(os.path.join(relative, name))
            if fnmatch.fnmatch(path, pattern):
                os.makedirs(os.path.dirname(os.path.join(dst, path)), exist_ok=True)
                shutil.copy2(os.path.join(src, path), os.path.join(dst, path))


def load(recipe, path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def module(name, **members):
    sys.modules[name] = types.ModuleType(name)
    sys.modules[name].__dict__.update(members)


module("conan", ConanFile=ConanFile)
module("conan.tools")
module("conan.tools.build", check_min_cppstd=lambda recipe, standard: required_standards.append(standard))
module("conan.tools.cmake", CMake=CMake, CMakeDeps=CMakeDeps, CMakeToolchain=CMakeToolchain,
       cmake_layout=lambda recipe: None)
module("conan.tools.files", copy=copy, load=load, rmdir=lambda recipe, path: shutil.rmtree(path))

# ---- conan create ----

sys.dont_write_bytecode = True
spec = importlib.util.spec_from_file_location("conanfile", recipe_path)
loaded = importlib.util.module_from_spec(spec)
spec.loader.exec_module(loaded)
recipes = [value for value in vars(loaded).values()
           if isinstance(value, type) and issubclass(value, ConanFile) and value is not ConanFile]
expect("recipes in the file", len(recipes), 1)

recipe = recipes[0]()
recipe.set_version()
expect("name", recipe.name, "bumpshadow")
expect("version", recipe.version, version)
expect("license", recipe.license, "MIT")
expect("package type", recipe.package_type, "header-library")
recipe.export_sources()
# From here on the recipe lies in the cache, without the tree around it.
recipe.recipe_folder = os.path.join(work, "export")
recipe.layout()
recipe.requirements()
expect("requirements", recipe.required, {"glm/[>=0.9.9.8 <2]": {"transitive_headers": True}})
recipe.package_id()
recipe.validate()
expect("C++ standards", required_standards, [20])
recipe.generate()
recipe.build()
recipe.package()
recipe.package_info()
expect("how CMake finds it", recipe.cpp_info.properties, {"cmake_find_mode": "none"})
for folder in recipe.cpp_info.builddirs:
    expect("files for CMake in " + folder, os.path.isfile(
        os.path.join(recipe.package_folder, folder, "bumpshadowConfig.cmake")), True)
expect("folders of binaries", recipe.cpp_info.bindirs + recipe.cpp_info.libdirs, [])
expect("system libraries", recipe.cpp_info.system_libs, ["pthread"])
