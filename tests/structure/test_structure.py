# SPDX-License-Identifier: Apache-2.0
"""The rules of the house that a compiler does not check: who may include whom, what the core may not
do, and that every table says where it comes from."""

import csv
import hashlib
import os
import re
import subprocess
import unittest

SOURCE = os.environ["OSIO_TEST_SOURCE"]

# A file includes from its own floor or from one below.
FLOORS = {
    "core/osio/base": 0, "core/osio/spectra": 1, "core/osio/data": 1, "core/osio/colour": 2,
    "core/osio/layout": 3, "core/osio/collapse": 4, "core/osio/budget": 5, "core/osio/reduce": 5, "formats": 6, "plugins": 7, "tools": 8,
    "examples": 8,
}

# Which files may include a library.
LIBRARIES = {
    r"xxhash\.h": r"formats/exr/checksum\.cpp",
    r"tl/": r"core/osio/base/result\.h",
    r"hwy/": r"core/osio/budget/magnitude_simd\.cpp|core/osio/collapse/kernel_simd\.cpp|formats/exr/zip_simd\.cpp",
    r"libdeflate\.h": r"formats/(exr/zip_codec|files/zlib_stream|tiff/strip_packer)\.cpp",
    r"OpenEXR/|Imath/": r"formats/(convert|envi|exr|image|reduce|stack|tiff|trade)/|plugins/|tools/host_module/|examples/",
    r"tiffio\.h": r"formats/tiff/",
    r"png\.h": r"formats/(files/png_output|stack/png_(pixels|writer))\.cpp",
    r"pugixml\.hpp": r"formats/tiff/(gdal_metadata|xmp_bands)\.cpp",
    r"OpenImageIO/": r"plugins/|tools/host_module/",
    r"OpenColorIO/": r"plugins/ocio/",
    r"fmt/": r"tools/osiotool/",
    r"CLI/": r"tools/osiotool/(main\.cpp|request_options\.h)",
    r"nlohmann/": r"formats/(image/certificate|reduce/reduction)_json\.cpp|tools/osiotool/json_text\.h",
}

OWN = re.compile(r"(osio|formats|plugins|tools)/")
SYSTEM = re.compile(r"[a-z_0-9]+(\.h)?$|sys/[a-z]+\.h$")


def sources(*folders):
    """Paths of C++ files below folders of the repository, relative to its root."""
    for folder in folders:
        for where, _, names in os.walk(os.path.join(SOURCE, folder)):
            for name in sorted(names):
                if name.endswith((".h", ".cpp")):
                    yield os.path.relpath(os.path.join(where, name), SOURCE)


def text(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


def code(path):
    """The text without comments and string literals."""
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(\\.|[^"\\\n])*"', "", text(path), flags=re.S)


def includes(path):
    return re.findall(r'^\s*#include\s+([<"][^>"]+[>"])', text(path), re.M)


def floor(path):
    found = [number for folder, number in FLOORS.items() if path.startswith(folder + "/")]
    return found[0] if found else None


PRODUCT = ("core", "formats", "plugins", "tools", "examples")


class Layering(unittest.TestCase):
    def test_every_folder_has_a_floor(self):
        for path in sources(*PRODUCT):
            self.assertIsNotNone(floor(path), path)

    def test_a_file_includes_from_its_floor_or_below(self):
        for path in sources(*PRODUCT):
            for include in includes(path):
                name = include[1:-1]
                if not OWN.match(name):
                    continue
                self.assertEqual(include[0], "<", f"{path} includes {include}; write it from the root")
                target = f"core/{name}" if name.startswith("osio/") else name
                self.assertTrue(os.path.exists(os.path.join(SOURCE, target)), f"{path} includes {name}")
                self.assertLessEqual(floor(target), floor(path), f"{path} includes {name} from above")

    def test_the_tool_knows_no_plugin(self):
        for path in sources("tools/osiotool"):
            for include in includes(path):
                self.assertFalse(include.startswith("<plugins/"), f"{path} includes {include}")

    def test_libraries_stay_where_they_are_needed(self):
        for path in sources(*PRODUCT):
            for include in includes(path):
                name = include[1:-1]
                allowed = [where for library, where in LIBRARIES.items() if re.match(library, name)]
                if not allowed and (OWN.match(name) or SYSTEM.match(name)):
                    continue
                self.assertEqual(len(allowed), 1, f"{path} includes {name}, which no rule names")
                self.assertRegex(path, allowed[0], f"{path} includes {name}")

    def test_the_core_only_computes(self):
        forbidden = re.compile(
            r"\b(printf|fprintf|puts|cout|cerr|clog|abort|exit|terminate|assert|getenv|fopen|open|[io]?fstream|"
            r"thread|jthread|async|setlocale|system|time|rand)\b\s*[(<{]|"
            r"#include <(iostream|fstream|cstdio|thread|future|filesystem|cassert|csignal|unistd\.h)>")
        for path in sources("core"):
            found = forbidden.search(code(path))
            self.assertIsNone(found, f"{path}: {found and found.group(0)}")

    def test_numbers_do_not_depend_on_the_locale(self):
        # strtod, stod, printf and streams follow the host's locale; std::from_chars and to_chars do not.
        forbidden = re.compile(r"\b(strto[dfl]+|sto[dfil]+|ato[fil]|sscanf|[io]?stringstream)\b")
        for path in sources("core", "formats", "plugins", "tools/osiotool"):
            found = forbidden.search(code(path))
            self.assertIsNone(found, f"{path}: {found and found.group(0)}")


class Hosts(unittest.TestCase):
    def test_a_plugin_sets_nothing_that_belongs_to_its_host(self):
        # The compression threads of osiotool's own process are set by the one function that says so.
        forbidden = re.compile(r"setMaxImageSize|setMaxTileSize|exr_set_default_\w+|setGlobalThreadCount|"
                               r"OIIO::attribute\s*\(|\bsetlocale\b|\bsignal\s*\(")
        for path in sources("core", "formats", "plugins"):
            for found in forbidden.findall(code(path)):
                self.assertEqual((path, found), ("formats/exr/exr_writer.cpp", "setGlobalThreadCount"))
        for path in sources("plugins"):
            self.assertNotIn("set_compression_threads", code(path), path)


class Fuzzing(unittest.TestCase):
    def test_every_target_has_seeds(self):
        build = text("fuzz/CMakeLists.txt")
        targets = re.findall(r"^osio_fuzz_target\((\w+)", build, re.M)
        self.assertEqual(sorted(targets), sorted(os.listdir(os.path.join(SOURCE, "fuzz", "seeds"))))
        for target in targets:
            self.assertTrue(os.listdir(os.path.join(SOURCE, "fuzz", "seeds", target)), target)


class PythonTests(unittest.TestCase):
    def test_each_runs_when_it_is_run(self):
        for path in re.findall(r"osio_python_test\((\S+)", text("tests/CMakeLists.txt")):
            self.assertTrue(text("tests/" + path).endswith('if __name__ == "__main__":\n    unittest.main()\n'), path)


class Files(unittest.TestCase):
    def test_a_licence_and_a_guard(self):
        for path in sources(*PRODUCT, "tests", "fuzz"):
            self.assertTrue(text(path).startswith("// SPDX-License-Identifier: Apache-2.0\n"), path)
            if path.endswith(".h"):
                self.assertIn("#pragma once", text(path), path)

    def test_the_page_of_a_trade_is_held_to_the_same(self):
        for name in os.listdir(os.path.join(SOURCE, "tools/osiotool/trade_page")):
            content = text(f"tools/osiotool/trade_page/{name}")
            self.assertIn("SPDX-License-Identifier: Apache-2.0", content[:80], name)
            self.assertLessEqual(content.count("\n"), 400, name)

    def test_one_idea_a_file(self):
        for path in sources(*PRODUCT):
            self.assertLessEqual(text(path).count("\n"), 400, path)

    def test_nothing_is_left_for_later(self):
        for path in sources(*PRODUCT, "tests"):
            self.assertIsNone(re.search(r"\b(TODO|FIXME|XXX|HACK)\b", text(path)), path)

    def test_shell_scripts_are_sound(self):
        for where in ("scripts", ".ci"):
            for name in os.listdir(os.path.join(SOURCE, where)):
                path = os.path.join(SOURCE, where, name)
                subprocess.run(["sh", "-n", path], check=True)
                if name != "packages.sh":
                    self.assertTrue(os.access(path, os.X_OK), path)


class Data(unittest.TestCase):
    def setUp(self):
        with open(os.path.join(SOURCE, "data", "sources.tsv"), encoding="utf-8") as file:
            self.rows = list(csv.DictReader(file, delimiter="\t"))

    def test_every_table_states_its_source_licence_and_checksum(self):
        sums = {}
        for row in self.rows:
            self.assertTrue(row["source"] and row["licence"], row)
            if row["column"] == "*":
                sums[row["file"]] = row["sha256"]
        files = {os.path.join(folder, name)
                 for folder in next(os.walk(os.path.join(SOURCE, "data")))[1]
                 for name in os.listdir(os.path.join(SOURCE, "data", folder))}
        self.assertEqual(files, set(sums))
        for name, expected in sums.items():
            with open(os.path.join(SOURCE, "data", name), "rb") as file:
                self.assertEqual(hashlib.sha256(file.read()).hexdigest(), expected, name)

    def test_a_source_names_a_column_that_is_there(self):
        for row in self.rows:
            header = text(f"data/{row['file']}").split("\n", 1)[0].split(",")
            self.assertIn(row["column"], header + ["*"], row)


if __name__ == "__main__":
    unittest.main()
