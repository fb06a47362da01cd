# SPDX-License-Identifier: Apache-2.0
"""Nothing is lost in silence: damaged files are refused by every way in, and a file that is being
written is the old one or the new one."""

import collections
import json
import os
import random
import resource
import shutil
import struct
import subprocess
import time
import unittest

import numpy as np
import OpenImageIO as oiio
from osio_case import FLOAT, HALF, OSIOTOOL, OsioCase

GRID = list(range(400, 701, 10))
WORDS = ("--to", "lin_rec709", "--illuminant", "D65")
SHIM = os.environ["OSIO_TEST_FAILING_CALLS"]
COMPRESSIONS = ("none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab")


class DamageCase(OsioCase):
    def content(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def store(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data)

    def chunks(self, data):
        """Offsets of the chunks of a scanline file of one part, by the table behind its header."""
        at = 8
        while data[at]:
            for _ in range(2):
                at = data.index(b"\0", at) + 1
            at += 4 + struct.unpack_from("<i", data, at)[0]
        at += 1
        first = struct.unpack_from("<Q", data, at)[0]
        return at, [struct.unpack_from("<Q", data, i)[0] for i in range(at, first, 8)]

    def own(self, name, bands=None, **options):
        """A file by our writer, with a checksum."""
        return self.write_exr(name, bands or self.bands(GRID, shape=(70, 40)), writer="spectralexr", **options)


class Verify(DamageCase):
    def test_sound_files_of_every_compression(self):
        names = []
        for compression in COMPRESSIONS:
            for maker, ending in ((self.own, "spexr"), (self.write_exr, "exr")):
                names.append(f"{compression}.{ending}")
                bands = self.bands(GRID, shape=(70, 40))
                maker(names[-1], bands, types={n: HALF for n in bands}, compression=compression)
        report = self.osiotool_json("verify", *names)
        self.assertEqual([f["file"] for f in report["files"]], names)
        for file in report["files"]:
            self.assertTrue(file["sound"], file)
            self.assertEqual(file["checksum"], "own" if file["file"].endswith("spexr") else "none")
            self.assertEqual([p["bad_rows"] for p in file["parts"]], [[]])

    def test_the_first_bad_rows_and_why(self):
        self.write_exr("a.exr", self.bands(GRID, shape=(70, 40)), compression="zip")
        data = bytearray(self.content("a.exr"))
        _, chunks = self.chunks(data)
        data[chunks[2] + 400] ^= 16
        self.store("bad.exr", data)
        self.write_exr("good.exr", self.bands(GRID))
        result = self.osiotool("verify", "bad.exr", "good.exr", code=4)
        self.assertRegex(result.stdout, r"(?s)bad\.exr: .*part 0: damaged: 16 rows cannot be decoded \(32-47\); "
                                        r"first: rows 32 to 47: .*good\.exr: .*part 0: sound")
        bad, good = self.run_json(4, "verify", "bad.exr", "good.exr")["files"]
        self.assertEqual((bad["sound"], good["sound"]), (False, True))
        self.assertEqual(bad["parts"][0]["bad_rows"], [[32, 47]])
        self.assertIn("rows 32 to 47", bad["parts"][0]["reason"])

    def run_json(self, code, *arguments):
        return json.loads(self.osiotool(*arguments, "--json", code=code).stdout)

    def test_files_that_are_none_end_in_their_own_codes(self):
        self.store("text.exr", b"no image")
        self.assertIn("is no OpenEXR file", self.osiotool("verify", "text.exr", code=4).stdout)
        self.assertIn("No such file", self.osiotool("verify", "none.exr", code=5).stdout)
        self.osiotool("verify", "none.exr", "text.exr", code=4)

    def test_deep_parts_are_not_called_sound(self):
        deep = oiio.ImageSpec(4, 4, 1, FLOAT)
        deep.deep = True
        deep.channelnames = ("T.500nm",)
        data = oiio.DeepData()
        data.init(16, 1, (oiio.TypeDesc(FLOAT),), ("T.500nm",))
        output = oiio.ImageOutput.create("openexr")
        output.open(self.path("deep.exr"), deep)
        output.write_deep_image(data)
        output.close()
        self.assertIn("not decoded: it is deep", self.osiotool("verify", "deep.exr").stdout)
        part, = self.osiotool_json("verify", "deep.exr")["files"][0]["parts"]
        self.assertEqual((part["sound"], part["decoded"]), (None, False))


class Refusal(DamageCase):
    """Structure that contradicts itself ends in exit codes and no output, in our tool and in oiiotool."""

    def refuse(self, data, words, hosts=True):
        self.store("bad.exr", data)
        self.store("bad.spexr", data)
        result = self.osiotool("collapse", "bad.exr", "o.exr", *WORDS, code=4)
        self.assertRegex(result.stderr, words)
        self.osiotool("verify", "bad.exr", code=4)
        in_pixels = ": rows " in result.stderr
        for source, output in (("bad.spexr", "o.spexr"), ("bad.exr?to=lin_rec709&illuminant=D65", "o.exr")):
            if hosts:
                result = self.run_program("oiiotool", source, "-o", output)
                self.assertNotEqual(result.returncode, 0, source)
                if in_pixels:  # what open() says, oiiotool throws away
                    self.assertRegex(result.stdout + result.stderr, words)
        self.assertFalse([name for name in self.files() if name.startswith((".", "o."))])

    def test_tables_and_chunk_headers(self):
        for compression in ("none", "zip", "piz"):
            self.write_exr("a.exr", self.bands(GRID, shape=(70, 40)), compression=compression)
            whole = self.content("a.exr")
            table, chunks = self.chunks(whole)

            def refuse(data, words, hosts=compression == "zip"):
                self.refuse(data, words, hosts)

            def patched(at, layout, value):
                data = bytearray(whole)
                struct.pack_into(layout, data, at, value)
                return data
            entry = table + 8
            refuse(patched(entry, "<Q", 0), "never written; the file is incomplete")
            refuse(patched(entry, "<Q", len(whole) + 5), "outside the file's pixels")
            refuse(patched(entry, "<Q", 2 ** 63 + 5), "outside the file's pixels")
            refuse(patched(entry, "<Q", 16), "outside the file's pixels")
            refuse(patched(entry, "<Q", chunks[0]), "shares bytes with another chunk")
            refuse(patched(chunks[1], "<i", 7), "its header says row 7")
            refuse(patched(chunks[1] + 4, "<i", 0), "has 0 bytes, expected 1 to ")
            refuse(patched(chunks[1] + 4, "<i", -4), "bytes, expected 1 to ")
            size = struct.unpack_from("<i", whole, chunks[1] + 4)[0]
            if compression != "none":
                refuse(patched(chunks[1] + 4, "<i", size + 1), "shares bytes with another chunk|bytes, expected 1 to")
            refuse(whole[:-1], "goes on beyond the end of the file")
            refuse(whole[:chunks[1] + 20], "goes on beyond the end of the file")

    def test_what_lies_behind_the_last_chunk_is_nobodys(self):
        self.write_exr("a.exr", self.bands(GRID, shape=(70, 40)))
        self.store("b.exr", self.content("a.exr") + b"tail")
        self.osiotool("verify", "b.exr")

    def test_our_own_files_are_covered_in_every_compression(self):
        for compression in COMPRESSIONS:
            bands = self.bands(GRID, shape=(70, 40))
            self.own("a.spexr", bands, types={n: HALF for n in bands}, compression=compression)
            whole = self.content("a.spexr")
            _, chunks = self.chunks(whole)
            data = bytearray(whole)
            data[(chunks[-1] + len(data)) // 2] ^= 1
            hosts = compression == "piz"
            self.refuse(data, "does not have the checksum that was written with it", hosts)
            at = whole.index(b"T.500nm\0") + 2
            data = bytearray(whole)
            data[at] ^= 1
            self.refuse(data, "its header does not have the checksum", hosts)

    def test_a_small_file_cannot_ask_for_much(self):
        self.write_exr("a.exr", {"T.500nm": np.ones((4, 4))}, compression="zip")
        whole = self.content("a.exr")
        at = whole.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4

        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (1 << 28, 1 << 28))
        sanitized = "san" in os.environ.get("LD_PRELOAD", "")  # reserves terabytes of addresses for itself
        for window in ((0, 0, 2 ** 29, 3), (0, 0, 3, 2 ** 29), (0, 0, 2 ** 24, 2 ** 24), (0, 0, 2 ** 31 - 1, 3),
                       (-2 ** 31, 0, 3, 3), (0, 0, 40000, 40000)):
            data = bytearray(whole)
            struct.pack_into("<4i", data, at, *window)
            self.store("huge.exr", data)
            for command in (("verify", "huge.exr"), ("collapse", "huge.exr", "o.exr", *WORDS),
                            ("info", "huge.exr")):
                self.osiotool(*command, code=4, preexec_fn=None if sanitized else limit)
        self.assertEqual(self.files(), ["a.exr", "huge.exr"])


class Partial(DamageCase):
    def test_sound_rows_stay_and_the_others_are_black_and_marked(self):
        bands = dict(self.bands(GRID, shape=(70, 40)), A=np.ones((70, 40)))
        for compression, rows in (("zip", [32, 47]), ("zips", [33, 33]), ("none", [33, 33]), ("piz", [32, 63])):
            self.own("a.spexr", bands, compression=compression)
            self.osiotool("collapse", "a.spexr", "whole.exr", *WORDS)
            data = bytearray(self.content("a.spexr"))
            _, chunks = self.chunks(data)
            data[chunks[len(chunks) // 2 - 2 if compression in ("zips", "none") else rows[0] // (rows[1] - rows[0] + 1)]
                 + 30] ^= 1
            self.store("bad.spexr", data)
            self.osiotool("collapse", "bad.spexr", "part.exr", *WORDS, code=4)
            self.assertNotIn("part.exr", self.files())
            result = self.osiotool("collapse", "bad.spexr", "part.exr", *WORDS, "--allow-partial", "--json", code=4)
            self.assertIn("rows were damaged and are black in part.exr", result.stderr)
            missing = json.loads(result.stdout)["missing_rows"]
            self.assertEqual(missing, [rows])
            spec, pixels = self.read("part.exr")
            self.assertEqual(spec.get_string_attribute("spectral:missingRows"), f"{rows[0]}-{rows[1]}")
            expected = self.read("whole.exr")[1]
            expected[rows[0]:rows[1] + 1] = 0
            self.assertTrue(np.array_equal(pixels, expected))
            os.remove(self.path("part.exr"))

    def test_a_sound_file_is_what_it_always_was(self):
        self.own("a.spexr")
        self.osiotool("collapse", "a.spexr", "a.exr", *WORDS)
        self.osiotool("collapse", "a.spexr", "b.exr", *WORDS, "--allow-partial")
        self.assertEqual(self.content("a.exr"), self.content("b.exr"))

    def test_nothing_sound_is_nothing_kept(self):
        self.own("a.spexr", {"T.500nm": np.ones((3, 3)), "T.600nm": np.ones((3, 3))})
        data = bytearray(self.content("a.spexr"))
        data[-1] ^= 1
        self.store("a.spexr", data)
        result = self.osiotool("collapse", "a.spexr", "o.exr", *WORDS, "--allow-partial", code=4)
        self.assertIn("no row can be decoded", result.stderr)
        self.assertEqual(self.files(), ["a.spexr"])


class Checksum(DamageCase):
    """It stays with the file that it was made for."""

    def test_hosts_neither_see_it_nor_write_it(self):
        self.own("a.spexr")
        self.assertIsNone(self.read("a.spexr")[0].getattribute("spectral:checksum"))
        self.assertNotIn("checksum", self.check("iinfo", "-v", "a.spexr"))
        shutil.copy(self.path("a.spexr"), self.path("a.exr"))
        self.check("oiiotool", "a.exr", "--mulc", "0.5", "-o", "stock.exr")
        self.assertNotIn("spectral:checksum", self.check("exrheader", "stock.exr"))
        self.check("oiiotool", "a.spexr", "--mulc", "0.5", "-o", "ours.spexr")
        for name, sum_ in (("stock.exr", "none"), ("ours.spexr", "own")):
            file, = self.osiotool_json("verify", name)["files"]
            self.assertEqual((file["sound"], file["checksum"]), (True, sum_))

    def test_a_file_that_was_written_again_with_all_its_attributes_is_sound(self):
        self.own("a.exr")
        self.check("exrstdattr", "-owner", "me", "a.exr", "b.exr")
        self.check("exrmaketiled", "a.exr", "c.exr")
        for name in ("b.exr", "c.exr"):
            self.assertIn("spectral:checksum", self.check("exrheader", name))
            file, = self.osiotool_json("verify", name)["files"]
            self.assertEqual((file["sound"], file["checksum"]), (True, "foreign"))
        self.osiotool("collapse", "b.exr", "o.exr", *WORDS)

    def test_names_and_comments_may_be_edited_in_place(self):
        self.own("a.exr", attributes=[("Copyright", "Ada"), ("emissiveUnits", "W.m^-2.sr^-1")])
        data = self.content("a.exr")
        self.store("b.exr", data.replace(b"Ada", b"Eve"))
        file, = self.osiotool_json("verify", "b.exr")["files"]
        self.assertEqual((file["sound"], file["checksum"]), (True, "own"))
        self.store("c.exr", data.replace(b"W.m^-2.sr^-1", b"W.m^-2.sr^-2"))
        self.osiotool("verify", "c.exr", code=4)


class Writing(DamageCase):
    """Every call that stores something fails in turn."""

    def setUp(self):
        super().setUp()
        self.write_exr("a.exr", self.bands(GRID, shape=(64, 40)))
        self.scratch = self.path("log")

    def collapse(self, output, call="", at=-1, error="EIO"):
        env = {"OSIO_FAULT_UNDER": os.path.realpath(self.path("out")), "OSIO_FAULT_LOG": self.scratch,
               "OSIO_FAULT_CALL": call, "OSIO_FAULT_AT": str(at), "OSIO_FAULT_ERRNO": error,
               "LD_PRELOAD": ":".join(filter(None, (os.environ.get("LD_PRELOAD", "").replace(" ", ":"), SHIM)))}
        words = WORDS if output.endswith("exr") else ("--to", "srgb", "--illuminant", "A")
        return self.run_program(OSIOTOOL, "collapse", "a.exr", os.path.realpath(self.path("out")) + "/" + output,
                                *words, "--fsync", "--quiet", "--threads", "2", env=env)

    def test_every_failure_leaves_the_old_file_and_no_litter(self):
        os.mkdir(self.path("out"))
        for output in ("o.exr", "o.png", "o.tif"):
            self.store("out/" + output, b"")
            os.remove(self.path("out/" + output))
            open(self.scratch, "w").close()
            result = self.collapse(output)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(self.scratch) as file:
                counts = collections.Counter(file.read().split())
            for call in ("write", "fsync", "close", "rename"):
                self.assertGreater(counts[call], 0, (output, call))
            if output.endswith("exr"):
                self.assertEqual(counts["pwrite"], 1)
            new = self.content("out/" + output)
            pixels = self.read("out/" + output)[1]
            for call, count in counts.items():
                for at in range(count):
                    error = ("EIO", "ENOSPC")[at % 2]
                    self.store("out/" + output, b"old")
                    result = self.collapse(output, call, at, error)
                    where = (output, call, at, error, result.stderr)
                    if output == "o.tif" and result.returncode == 0:
                        # Of its last calls the TIFF library tells nobody; what it wrote was read again.
                        self.assertTrue(np.array_equal(self.read("out/" + output)[1], pixels), where)
                        continue
                    self.assertEqual(result.returncode, 5, where)
                    self.assertTrue(result.stderr.strip(), where)
                    self.assertEqual(os.listdir(self.path("out")), [output], where)
                    last = "its folder cannot be stored" in result.stderr
                    self.assertEqual(self.content("out/" + output), new if last else b"old", where)
            os.remove(self.path("out/" + output))

    def test_a_kill_at_any_time_leaves_the_old_file_or_the_new_one(self):
        os.mkdir(self.path("out"))
        self.write_exr("a.exr", self.bands(GRID, shape=(400, 300)))
        command = [OSIOTOOL, "collapse", "a.exr", "out/o.exr", *WORDS, "--quiet"]
        began = time.time()
        subprocess.run(command, cwd=self.folder, check=True)
        takes = time.time() - began
        new, chance, ends = self.content("out/o.exr"), random.Random(7), collections.Counter()
        for _ in range(25):
            self.store("out/o.exr", b"old")
            process = subprocess.Popen(command, cwd=self.folder)
            time.sleep(chance.uniform(0, 1.2 * takes))
            process.kill()
            process.wait()
            found = self.content("out/o.exr")
            self.assertIn(found, (b"old", new))
            ends[found == new] += 1
        self.assertGreater(ends[False], 0)


if __name__ == "__main__":
    unittest.main()
