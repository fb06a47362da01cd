# SPDX-License-Identifier: Apache-2.0
"""Documents are true: every fenced example runs, prints what is shown beside it, and every link leads
somewhere.

A block of ```sh runs in bash, in a folder that holds shot.exr (the ColorChecker sample) and the
repository's scripts/, after env.sh of an installation; blocks of one document share the folder. A block
of ```text after it is what its last command prints; a line of ... stands for any lines, and ... inside
a line for any characters. A block of ```python runs in Debian's Python."""

import glob
import os
import re
import subprocess
import unittest

from osio_case import COLORCHECKER, CONFIG, HOME, SOURCE, OsioCase

DOCUMENTS = sorted(glob.glob(os.path.join(SOURCE, "*.md")) + glob.glob(os.path.join(SOURCE, "docs", "**", "*.md"),
                   recursive=True) + glob.glob(os.path.join(SOURCE, "*", "README.md")))

# What the run of the tests is itself a part of, or what would take it as long again.
NOT_FROM_WITHIN = ("scripts/test.sh", "scripts/sanitize.sh", "scripts/fuzz.sh", "scripts/faults.sh", "scripts/one_answer.sh", ".ci/run")


def blocks_of(text):
    """[(language, content)] of the fenced blocks, in order."""
    return re.findall(r"^```([a-z]*)\n(.*?)^```$", text, re.M | re.S)


def pattern_of(expected):
    """What a block of ```text matches."""
    lines = []
    for line in expected.rstrip("\n").split("\n"):
        lines.append("(?:.*\n)*" if line.strip() == "..." else
                     re.escape(line.rstrip()).replace(re.escape("..."), ".*") + " *\n")
    return "".join(lines)


class Documents(OsioCase):
    def setUp(self):
        super().setUp()
        self.stage = self.path("build/stage")
        os.makedirs(self.path("build"))
        self.check("cmake", "--install", HOME, "--prefix", self.stage)
        self.check(COLORCHECKER, self.path("shot.exr"), 10)
        for name in ("scripts", "bench", "configs", "tests"):
            os.symlink(os.path.join(SOURCE, name), self.path(name))

    def run_block(self, language, content, where):
        lines = []
        for line in content.splitlines():
            word = line.split(" ")[0]
            if word in NOT_FROM_WITHIN:
                self.assertTrue(os.access(os.path.join(SOURCE, word), os.X_OK), where)
                lines.append(":")
            elif word.startswith("scripts/"):
                lines.append(f"(cd '{SOURCE}' && {line}\n)")
            else:
                lines.append(line)
        command = [self.python, "-c"] if language == "python" else ["bash", "-euo", "pipefail", "-c"]
        result = subprocess.run([*command, "\n".join(lines)], cwd=self.folder, env=self.environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=280)
        self.assertEqual(result.returncode, 0, f"{where}:\n{content}\n{result.stdout}")
        return result.stdout

    @property
    def python(self):
        return "/usr/bin/python3"

    @property
    def environment(self):
        script = f'unset OIIO_LIBRARY_PATH; . "{self.stage}/env.sh"; env -0'
        said = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True).stdout
        return dict(pair.split("=", 1) for pair in said.rstrip("\0").split("\0"))

    def run_document(self, path):
        with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
            blocks = blocks_of(file.read())
        printed, ran = None, 0
        for number, (language, content) in enumerate(blocks, 1):
            where = f"{path}, block {number}"
            if language in ("sh", "python"):
                printed = self.run_block(language, content, where)
                ran += 1
            elif language == "text" and printed is not None:
                self.assertRegex(printed, re.compile(f"^{pattern_of(content)}", re.M), where)
        return ran

    def test_readme(self):
        self.assertGreater(self.run_document("README.md"), 1)
        # Its picture is the one that the demo, which has just run, makes today.
        self.check("idiff", "-fail", "0.01", os.path.join(SOURCE, "docs", "images", "contact_sheet.png"),
                   os.path.join(SOURCE, "build", "demo", "contact_sheet.png"))

    def test_cli(self):
        self.assertGreater(self.run_document("docs/cli.md"), 1)

    def test_formats(self):
        self.assertGreater(self.run_document("docs/formats.md"), 1)

    def test_every_other_document(self):
        for path in DOCUMENTS:
            name = os.path.relpath(path, SOURCE)
            if name not in ("README.md", "docs/cli.md", "docs/formats.md"):
                self.run_document(name)


class Accuracy(OsioCase):
    def test_its_tables_are_what_the_programs_give(self):
        self.check("/usr/bin/python3", os.path.join(SOURCE, "bench", "accuracy.py"), "--check", HOME, timeout=280)


class Reference(OsioCase):
    """docs/cli.md names every option, every key of JSON, every name that a word takes."""

    def setUp(self):
        super().setUp()
        with open(os.path.join(SOURCE, "docs", "cli.md"), encoding="utf-8") as file:
            self.text = file.read()
        self.colorchecker("shot.exr")

    def names(self, words):
        for word in words:
            self.assertRegex(self.text, rf"`(--?)?{re.escape(word)}`", word)

    def keys_of(self, value):
        if isinstance(value, dict):
            for key, inner in value.items():
                yield key
                yield from self.keys_of(inner)
        elif isinstance(value, list):
            for inner in value:
                yield from self.keys_of(inner)

    def test_every_key_of_json(self):
        words = ("--to", "srgb", "--illuminant", "A")
        self.names(self.keys_of(self.osiotool_json("info", "shot.exr")))
        self.names(self.keys_of(self.osiotool_json("audit", "shot.exr")))
        self.names(self.keys_of(self.osiotool_json("plan", "shot.exr", *words)))
        self.names(self.keys_of(self.osiotool_json("verify", "shot.exr")))
        self.names(self.keys_of(self.osiotool_json("collapse", "shot.exr", "o.exr", *words)))
        self.names(self.keys_of(self.osiotool_json("difference", "o.exr", "shot.exr", "--illuminant", "A")))
        self.names(self.keys_of(self.osiotool_json("convert", "shot.exr", "cube.hdr")))
        self.write_exr("shot.1.exr", self.bands([450, 550]))
        self.names(self.keys_of(self.osiotool_json("convert", "shot.%d.exr", "out.%d.exr", "--frames", "1")))
        self.names(self.keys_of(self.osiotool_json("photometry", "--illuminant", "A")))
        self.names(self.keys_of(self.osiotool_json("plan", "shot.exr", "--to", "ACEScct", "--config", CONFIG,
                                                   "--illuminant", "A")))
        self.names(self.keys_of(self.osiotool_json("reduce", "shot.exr", "r.exr", "--lights", "A", "--max-delta-e", "1")))
        self.names(self.keys_of(self.osiotool_json("list", "spaces", "--config", CONFIG)))
        self.names(self.keys_of(self.osiotool_json("bake", "relight", "m.clf", "--from", "A", "--to", "D65")))
        self.write_exr("radiance.exr", self.bands([450, 550, 650], prefix="S0"))
        self.names(self.keys_of(self.osiotool_json("photometry", "radiance.exr")))

    def test_every_option(self):
        for command in ("info", "audit", "collapse", "plan", "convert", "verify", "difference", "photometry", "bake", "weights",
                        "spectrum", "trade", "reduce", "list"):
            text = self.osiotool(command, "--help").stdout
            self.names(set(re.findall(r"^  --?([a-z][a-z-]*)", text, re.M)) - {"h"})

    def test_every_space_and_observer(self):
        for what in ("spaces", "observers", "bases"):
            lines = self.osiotool("list", what).stdout.splitlines()[1:]
            self.names(line.split()[0] for line in lines)


class Links(unittest.TestCase):
    def test_links_lead_somewhere(self):
        self.assertGreater(len(DOCUMENTS), 8)
        for path in DOCUMENTS:
            with open(path, encoding="utf-8") as file:
                text = re.sub(r"^```.*?^```$", "", file.read(), flags=re.M | re.S)
            for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text):
                if not target.startswith("http"):
                    self.assertTrue(os.path.exists(os.path.join(os.path.dirname(path), target)),
                                    f"{os.path.relpath(path, SOURCE)} links to {target}")

    def test_paths_in_prose_exist(self):
        roots = "|".join(sorted(name for name in next(os.walk(SOURCE))[1] if name not in ("build", ".git")))
        for path in DOCUMENTS:
            with open(path, encoding="utf-8") as file:
                text = re.sub(r"^```.*?^```$", "", file.read(), flags=re.M | re.S)
            for name in re.findall(rf"`((?:{roots})/[A-Za-z0-9_./-]*)`", text):
                self.assertTrue(os.path.exists(os.path.join(SOURCE, name)),
                                f"{os.path.relpath(path, SOURCE)} names {name}")


if __name__ == "__main__":
    unittest.main()
