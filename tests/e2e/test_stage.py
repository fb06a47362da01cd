# SPDX-License-Identifier: Apache-2.0
"""An installation in a folder of the user's, put to use by its env.sh."""

import os
import shutil
import subprocess
import unittest

from osio_case import COLORCHECKER, HOME, OsioCase


class Stage(OsioCase):
    def setUp(self):
        super().setUp()
        self.prefix = self.path("place with spaces")
        self.check("cmake", "--install", HOME, "--prefix", self.prefix)

    def in_shell(self, script, shell="sh", env=None):
        environment = {k: v for k, v in os.environ.items() if k not in ("OCIO", "OIIO_LIBRARY_PATH")}
        environment.update(env or {})
        result = subprocess.run([shell, "-euc", script], cwd=self.folder, env=environment, text=True,
                                capture_output=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def test_what_is_installed(self):
        found = sorted(os.path.relpath(os.path.join(where, name), self.prefix)
                       for where, _, names in os.walk(self.prefix) for name in names)
        self.assertEqual(found, [
            "bin/osiotool",
            "env.sh",
            "lib/osio/oiio-2.4/envi.imageio.so",
            "lib/osio/oiio-2.4/spectralexr.imageio.so",
            "lib/osio/osio_ocio.so",
            "lib/osio/osio_oiio-2.4.so",
            "share/osio/LICENSE",
            "share/osio/configs/README.md",
            "share/osio/configs/osio.ocio",
            "share/osio/data/README.md",
            "share/osio/data/sources.tsv",
        ])

    def test_one_line_puts_all_of_it_to_use(self):
        self.check(COLORCHECKER, self.path("shot.exr"), 10)
        said = self.in_shell(f'''
            . "{self.prefix}/env.sh"
            osiotool doctor
            oiiotool "shot.exr?to=xyz_d65&illuminant=D65" --tocolorspace ACEScg -o a.exr
            osiotool collapse shot.exr b.exr --to acescg --illuminant D65 --quiet
            osiotool collapse shot.exr c.png --to srgb --illuminant D65 --quiet
            idiff -q -fail 2e-5 a.exr b.exr
            osiotool collapse shot.exr d.exr --to ACEScct --illuminant A --quiet
            oiiotool "shot.exr?to=ACEScct&illuminant=A" -o e.exr
            idiff -q -fail 0 d.exr e.exr
            ociocheck >check.txt
            echo "$OCIO"''')
        self.assertIn(f"{self.prefix}/share/osio/configs/osio.ocio", said)

    def test_paths_that_were_set_stay(self):
        said = self.in_shell(f'. "{self.prefix}/env.sh"; echo $OIIO_LIBRARY_PATH',
                             env={"OIIO_LIBRARY_PATH": "/elsewhere"})
        self.assertTrue(said.strip().endswith("oiio-2.4:/elsewhere"), said)

    def test_the_folder_may_move(self):
        moved = self.path("moved")
        shutil.move(self.prefix, moved)
        self.in_shell(f'. "{moved}/env.sh"; osiotool doctor', shell="bash")
        said = subprocess.run(["sh", "-c", f'. "{moved}/env.sh"'], capture_output=True, text=True, check=True)
        self.assertIn("no osiotool in", said.stderr)


if __name__ == "__main__":
    unittest.main()
