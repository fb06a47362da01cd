# SPDX-License-Identifier: Apache-2.0
"""osiotool trade --html: the page shows what the table, the image and osiotool's other commands say, in a browser
without a network."""

import base64
import collections
import json
import os
import re
import signal
import subprocess
import time
import unittest
import zlib

import numpy as np
from chromium import PROGRAM, Chromium
from osio_case import FLOAT, HALF, OSIOTOOL, OsioCase

GRID = list(range(400, 701, 10))
SHAPE = (40, 60)
UNDEFINED = 65535


class PageCase(OsioCase):
    def page(self, source, *options, name="page.html"):
        """(text, JSON of stdout, JSON of the page) of a run."""
        self.said = self.osiotool_json("trade", source, "--runs", "1", "--quiet", "--html", name, *options)
        with open(self.path(name), encoding="utf-8") as file:
            text = file.read()
        held = re.search(r'<script type="application/json" id="trade">(.*?)</script>', text, re.S).group(1)
        return text, self.said, json.loads(held)

    def codes(self, text, shape):
        """Two-byte codes of a stream, the high bytes of all first."""
        data = np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8).astype(np.uint16)
        return (data[:data.size // 2] << 8 | data[data.size // 2:]).reshape(shape)

    def map_of(self, held, choice):
        """The map of a choice as the file holds it, NaN for no colour."""
        page = held["page"]
        view = page["choices"][[c["choice"] for c in held["choices"]].index(choice)]
        codes = self.codes(view["codes"], (page["rows"], page["columns"]))
        return np.where(codes == UNDEFINED, np.nan, codes * view["factor"]), view["factor"]

    def picture_of(self, held, choice):
        """The picture of a choice as the file holds it, 0 to 1."""
        page = held["page"]
        view = page["choices"][[c["choice"] for c in held["choices"]].index(choice)]
        kind, data = page["pictures"][view["picture"]].split(",")
        self.assertEqual(kind, "data:image/png;base64")
        with open(self.path("picture.png"), "wb") as file:
            file.write(base64.b64decode(data))
        return self.in_order("picture.png", ["R", "G", "B"])

    def rgb(self, source, *options):
        self.osiotool("collapse", source, "rgb.exr", "--to", "lin_rec709", "--quiet", *options)
        return self.in_order("rgb.exr", ["R", "G", "B"]).astype(np.float64)

    def blocks(self, plane, side, reduce):
        rows, columns = -(-plane.shape[0] // side), -(-plane.shape[1] // side)
        return np.array([[reduce(plane[r * side:(r + 1) * side, c * side:(c + 1) * side].reshape(-1, *plane.shape[2:]))
                          for c in range(columns)] for r in range(rows)])


def srgb(linear):
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0) ** (1 / 2.4) - 0.055)


class File(PageCase):
    """What the file holds, without a browser."""

    def test_it_is_one_file_and_holds_what_json_says(self):
        self.write_exr("<!--<script>.exr", self.bands(GRID, SHAPE))
        text, said, held = self.page("<!--<script>.exr", "--illuminant", "FL11")
        self.assertEqual({key: value for key, value in held.items() if key != "page"}, said)
        self.assertEqual(set(re.findall(r"https?://[^'\"\s<]+", text)), {"http://www.w3.org/2000/svg"})
        for word in (r"<link", r"@import", r"url\(", r"src=", r"\bfetch\(", r"XMLHttpRequest", r"WebSocket"):
            self.assertIsNone(re.search(word, text), word)
        self.assertIn("default-src 'none'", text)
        self.assertEqual(text.count("<script"), 2)

    def test_it_goes_with_every_report(self):
        self.write_exr("a.exr", self.bands(GRID, (8, 8)))
        for option, start in (("--csv", "choice,bands,"), ("--quiet", "a.exr: to=")):
            result = self.osiotool("trade", "a.exr", "--illuminant", "A", "--runs", "1", "--html", "page.HTM", option)
            self.assertTrue(result.stdout.startswith(start))
            self.assertEqual(self.files(), ["a.exr", "page.HTM"])
            os.remove(self.path("page.HTM"))

    def test_pictures_and_maps_are_those_of_the_squares(self):
        self.write_exr("wide.exr", self.bands(GRID, (31, 1000)), origin=(5, -3))
        _, _, held = self.page("wide.exr", "--illuminant", "A")
        page = held["page"]
        self.assertEqual((page["side"], page["columns"], page["rows"]), (3, 334, 11))
        rgb = self.rgb("wide.exr", "--illuminant", "A")
        expected = np.clip(srgb(self.blocks(rgb, 3, lambda b: b.mean(axis=0))), 0, 1)
        self.expect(self.picture_of(held, "reference"), expected, allowed=0.51 / 255, scale=1)
        proxy = np.clip(srgb(self.blocks(rgb[np.arange(31) // 2 * 2], 3, lambda b: b.mean(axis=0))), 0, 1)
        self.expect(self.picture_of(held, "rows / 2"), proxy, allowed=0.51 / 255, scale=1)
        self.osiotool("collapse", "wide.exr", "bins.exr", "--to", "lin_rec709", "--illuminant", "A", "--basis", "bins", "--quiet")
        self.osiotool("difference", "rgb.exr", "bins.exr", "--map", "map.exr", "--quiet")
        wanted = self.blocks(self.channels_of("map.exr")["deltaE"], 3, lambda b: b.max())
        found, unit = self.map_of(held, "basis bins")
        self.expect(found, wanted, allowed=unit + 1e-3, scale=1)
        self.assertTrue((found >= wanted - 1e-3).all())

    def test_clipped_and_undefined_squares(self):
        bands = self.bands(GRID, (4, 6), low=0.5, high=0.5)
        bands["T.600nm"][0, 0] = np.nan
        for name in bands:
            bands[name][1, 2:5] = 3
        self.write_exr("a.exr", bands)
        _, said, held = self.page("a.exr", "--illuminant", "D65")
        exact = [c["choice"] for c in said["choices"]].index("exact")
        self.assertEqual(said["choices"][exact]["undefined_pixels"], 1)
        self.assertEqual(held["page"]["choices"][exact]["clipped"], 3)
        found, _ = self.map_of(held, "exact")
        self.assertTrue(np.isnan(found[0, 0]))
        self.assertEqual(np.isnan(found).sum(), 1)

    def test_halves_stay_what_they_are_and_floats_lose_little(self):
        samples = np.random.default_rng(3).normal(size=(31, 5, 7)).astype(np.float32) * 10.0 ** np.arange(-4, 3).astype(np.float32)
        samples[4, 2, 1:3] = np.nan, np.inf
        for types, scale in ((HALF, 1), (FLOAT, 1e-12), (FLOAT, 1e9)):
            bands = {f"S0.{nm}nm": plane * np.float32(scale) for nm, plane in zip(GRID, samples)}
            self.write_exr("s.exr", bands, types=types)
            _, _, held = self.page("s.exr")
            spectra = held["page"]["spectra"]
            self.assertEqual(spectra["wavelengths_nm"], GRID)
            found = self.codes(spectra["codes"], samples.shape).view(np.float16).astype(np.float64) * spectra["factor"]
            stored = self.channels_of("s.exr")
            wanted = np.stack([stored[name] for name in bands]).astype(np.float64)
            if types == HALF:
                self.assertTrue(np.array_equal(found, wanted, equal_nan=True))
            else:
                self.assertTrue(np.array_equal(np.isnan(found), np.isnan(wanted)))
                largest = np.abs(wanted[np.isfinite(wanted)]).max()
                allowed = np.maximum(2.0 ** -11 * np.abs(wanted), 2.0 ** -39 * largest)
                finite = np.isfinite(wanted)
                self.assertTrue((np.abs(found[finite] - wanted[finite]) <= allowed[finite]).all())
                self.assertTrue((found[np.isinf(wanted)] == np.inf).all())

    def test_noise_stays_within_the_limit(self):
        self.write_exr("noise.exr", self.bands(range(400, 701, 20), (480, 480)), compression="none")
        text, _, held = self.page("noise.exr", "--illuminant", "FL11")
        print("bytes of the page:", len(text))
        self.assertLess(len(text), 12e6)
        self.assertGreaterEqual(held["page"]["columns"], 120)
        self.assertEqual(held["page"]["spectra"]["side"] % held["page"]["side"], 0)

    def test_what_does_not_fit_costs_no_page(self):
        self.write_exr("a.exr", self.bands(GRID, SHAPE))
        for name, code in (("page.txt", 2), ("a.exr", 2), ("no/such/page.html", 5), ("/dev/full.html/x.html", 5)):
            result = self.osiotool("trade", "a.exr", "--illuminant", "A", "--html", name, code=code)
            self.assertEqual(result.stdout, "")
            self.assertIn(name, result.stderr)
        with open(self.path("page.html"), "w") as file:
            file.write("old")
        self.osiotool("trade", "a.exr", "--html", "page.html", code=1)
        with open(self.path("a.exr"), "r+b") as file:
            file.truncate(os.path.getsize(self.path("a.exr")) // 2)
        self.osiotool("trade", "a.exr", "--illuminant", "A", "--html", "page.html", code=4)
        with open(self.path("page.html")) as file:
            self.assertEqual(file.read(), "old")
        self.assertEqual(self.files(), ["a.exr", "page.html"])

    def test_whatever_call_fails_the_old_page_stays(self):
        self.write_exr("a.exr", self.bands(GRID, (8, 8)))
        os.mkdir(self.path("out"))
        folder = os.path.realpath(self.path("out"))

        def trade(call="", at=-1):
            with open(self.path("out/page.html"), "w") as file:
                file.write("old")
            env = {"OSIO_FAULT_UNDER": folder, "OSIO_FAULT_LOG": self.path("log"), "OSIO_FAULT_CALL": call,
                   "OSIO_FAULT_AT": str(at), "OSIO_FAULT_ERRNO": "ENOSPC", "LD_PRELOAD": ":".join(filter(None, (
                       os.environ.get("LD_PRELOAD", "").replace(" ", ":"), os.environ["OSIO_TEST_FAILING_CALLS"])))}
            return self.run_program(OSIOTOOL, "trade", "a.exr", "--illuminant", "A", "--runs", "1", "--quiet", "--html",
                                    folder + "/page.html", env=env)

        self.assertEqual(trade().returncode, 0)
        with open(self.path("log")) as file:
            counts = collections.Counter(file.read().split())
        self.assertEqual(counts["rename"], 1)
        self.assertGreater(counts["write"], 0)
        for call, count in counts.items():
            for at in range(count):
                result = trade(call, at)
                self.assertEqual(result.returncode, 5, (call, at, result.stderr))
                self.assertIn("page.html", result.stderr, (call, at))
                self.assertEqual(os.listdir(folder), ["page.html"], (call, at))
                with open(self.path("out/page.html")) as file:
                    self.assertEqual(file.read(), "old", (call, at))

    def test_an_interrupt_leaves_no_page(self):
        self.write_exr("a.exr", self.bands(GRID, SHAPE))
        process = subprocess.Popen([OSIOTOOL, "trade", "a.exr", "--illuminant", "A", "--runs", "10000", "--html", "page.html"],
                                   cwd=self.folder, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while len(self.files()) == 1 and time.monotonic() < deadline:
            time.sleep(0.01)
        self.assertEqual(len(self.files()), 2)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 130)
        self.assertEqual(self.files(), ["a.exr"])


@unittest.skipUnless(PROGRAM, "chromium is not installed")
class Browser(PageCase):
    def setUp(self):
        super().setUp()
        self.write_exr("a.exr", self.bands(GRID, SHAPE), origin=(5, -3))
        self.text, self.table, self.held = self.page("a.exr", "--illuminant", "FL11")
        self.names = [choice["choice"] for choice in self.table["choices"]]

    def browser(self, width=1280, height=900, dark=False, name="page.html"):
        browser = Chromium(width, height, dark)
        self.addCleanup(browser.close)
        browser.open(self.path(name))
        browser.wait("document.querySelector('#map').dataset.choice !== undefined")
        return browser

    def choose(self, browser, selector, name):
        browser.click(selector)
        self.chosen(browser, name)

    def chosen(self, browser, name):
        self.assertEqual(browser.run("document.body.dataset.choice"), name)
        self.assertEqual(browser.run("document.querySelector('#picture').dataset.choice"), name)
        self.assertEqual(browser.run("document.querySelector('tr.chosen button').textContent"), name)
        self.assertEqual(browser.run("document.querySelector('.point.chosen').dataset.choice"), name)
        browser.wait(f"document.querySelector('#map').dataset.choice === {json.dumps(name)}")

    def test_table_has_the_numbers_of_json(self):
        browser = self.browser()
        rows = browser.run("[...document.querySelectorAll('#table tbody tr')].map(r => [...r.cells].map(c => c.textContent))")
        self.assertEqual(len(rows), len(self.names))
        difference = lambda d: "0" if d == 0 else re.sub("-0", "-", f"{d:.0e}") if d < 0.0005 else f"{d:.3f}"
        for cells, c in zip(rows, self.table["choices"]):
            expected = ["●" if c["front"] else "", c["choice"], str(c["bands"]), f"{c['seconds']:.3f}",
                        f"{c['fastest']:.3f}–{c['slowest']:.3f}", f"{c['predicted']:.3f}", c["against_exact"], f"{c['decode']:.3f}",
                        f"{c['collapse']:.3f}", f"{c['write']:.3f}", f"{c['bytes_read'] / 1e6:.1f}",
                        f"{c['bytes_written'] / 1e6:.1f}", f"{c['peak_mb']:.0f}",
                        *(difference(c[f"delta_e_{key}"]) for key in ("mean", "95", "99_9", "max"))]
            self.assertEqual(cells[:-1], expected)
            self.assertEqual(float(cells[-1]), float(f"{c['largest_xyz']:.1e}"))
        self.assertEqual(browser.complaints(), [])
        alignments = browser.run("[...new Set([...document.querySelectorAll('#table tbody td:not(:first-child)')]"
                                 ".map(c => getComputedStyle(c).textAlign))]")
        self.assertEqual(alignments, ["right"])

    def test_plot_has_a_point_for_each(self):
        browser = self.browser()
        for key in ("delta_e_max", "delta_e_99_9"):
            browser.run(f"document.querySelector('[value={key}]').click()")
            points = browser.run("[...document.querySelectorAll('#plot .point')].map(p => [p.dataset.choice, "
                                 "...['cx', 'cy'].map(a => Number(p.querySelector('.dot').getAttribute(a))), "
                                 "p.classList.contains('on-front'), p.classList.contains('same')])")
            self.assertEqual([p[0] for p in points], self.names)
            self.assertEqual([p[3] for p in points], [c["front"] for c in self.table["choices"]])
            self.assertEqual([p[4] for p in points], [c["against_exact"] == "same" for c in self.table["choices"]])
            self.assertEqual([p[1] for p in points], sorted(p[1] for p in points))
            heights = sorted((c[key], -p[2]) for c, p in zip(self.table["choices"], points))
            self.assertEqual([h for _, h in heights], sorted(h for _, h in heights))
            self.assertTrue(all(0 < p[1] < 620 and 0 < p[2] < 400 for p in points))
        browser.point(f"#plot [data-choice='{self.names[3]}'] .dot")
        self.assertEqual(browser.run("document.querySelector('tr.pointed button').textContent"), self.names[3])

    def test_choosing_changes_picture_and_map(self):
        browser = self.browser()
        self.chosen(browser, self.names[0])
        seen = {}
        for index, name in enumerate(self.names):
            self.choose(browser, f"#table tbody tr:nth-child({index + 1}) th", name)
            seen[name] = browser.run("document.querySelector('#picture').src")
            self.assertEqual(seen[name], self.held["page"]["pictures"][self.held["page"]["choices"][index]["picture"]])
            self.assertGreater(browser.run("document.querySelector('#picture').naturalWidth"), 0)
            self.assertAlmostEqual(float(browser.run("document.querySelector('#map').dataset.largest")),
                                   self.table["choices"][index]["delta_e_max"], delta=1e-9 + 1e-6 * self.table["choices"][index]["delta_e_max"])
        self.assertEqual(seen["exact"], seen["reference"])
        self.assertNotEqual(seen["three bands"], seen["reference"])
        self.choose(browser, "#plot [data-choice='plain sum'] .dot", "plain sum")
        browser.press("f")
        self.assertEqual(browser.run("document.querySelector('#picture').dataset.choice"), "reference")
        browser.press("f")
        at = self.names.index("plain sum")
        for key, step in (("ArrowUp", -1), ("ArrowDown", 1)):
            if 0 <= at + step < len(self.names):
                browser.press(key)
                at += step
                self.chosen(browser, self.names[at])
        self.assertEqual(browser.complaints(), [])

    def test_spectrum_under_the_pointer_is_that_of_the_pixel(self):
        browser = self.browser()
        self.osiotool("collapse", "a.exr", "float.exr", "--to", "lin_rec709", "--illuminant", "FL11", "--quiet")
        self.osiotool("collapse", "a.exr", "half.exr", "--to", "lin_rec709", "--illuminant", "FL11", "-d", "half", "--quiet")
        self.osiotool("difference", "float.exr", "half.exr", "--map", "map.exr", "--quiet")
        wrong = self.channels_of("map.exr")["deltaE"]
        unit = self.map_of(self.held, "half output")[1]
        self.choose(browser, f"#table tbody tr:nth-child({self.names.index('half output') + 1}) th", "half output")
        for stage, column, row in (("#reference", 0, 0), ("#picture", 17, 31), ("#map", 59, 39)):
            browser.point(stage, (column + 0.5) / SHAPE[1], (row + 0.5) / SHAPE[0])
            x, y = column + 5, row - 3
            browser.wait(f"document.querySelector('#curve').dataset.x === '{x}' && document.querySelector('#curve').dataset.y === '{y}'")
            marks = browser.run("[...document.querySelectorAll('#curve circle')].map(c => [Number(c.dataset.nm), Number(c.dataset.value)])")
            lines = self.osiotool("spectrum", "a.exr", str(x), str(y)).stdout.splitlines()[1:]
            expected = np.array([[float(n) for n in line.split(",")] for line in lines])
            self.assertEqual([nm for nm, _ in marks], list(expected[:, 0]))
            self.expect(np.array([v for _, v in marks]) / expected[:, 1], np.ones(len(GRID)), allowed=2.0 ** -11)
            self.assertAlmostEqual(float(browser.run("document.querySelector('#place').dataset.deltaE")), wrong[row, column],
                                   delta=unit + 1e-4)
            self.assertIn(f"pixel {x}, {y}", browser.run("document.querySelector('#place').textContent"))
        browser.run("document.querySelector('.stage').focus()")
        browser.press("ArrowLeft")
        browser.wait("document.querySelector('#curve').dataset.x === '63'")
        self.assertEqual(browser.complaints(), [])

    def test_squares_of_a_large_image(self):
        self.write_exr("wide.exr", self.bands(GRID, (31, 1000)), origin=(5, -3))
        _, _, held = self.page("wide.exr", "--illuminant", "A", name="wide.html")
        browser = self.browser(name="wide.html")
        spectra = held["page"]["spectra"]
        browser.point("#picture", 100.5 / held["page"]["columns"], 5.5 / held["page"]["rows"])
        browser.wait("document.querySelector('#curve').dataset.x !== undefined")
        x, y = (int(browser.run(f"document.querySelector('#curve').dataset.{axis}")) for axis in "xy")
        self.assertEqual((x - 5) // spectra["side"], 300 // spectra["side"])
        self.assertEqual((y + 3) // spectra["side"], 15 // spectra["side"])
        marks = browser.run("[...document.querySelectorAll('#curve circle')].map(c => Number(c.dataset.value))")
        lines = self.osiotool("spectrum", "wide.exr", str(x), str(y)).stdout.splitlines()[1:]
        self.expect(np.array(marks) / [float(line.split(",")[1]) for line in lines], np.ones(len(GRID)), allowed=2.0 ** -11)

    def test_widths_and_colour_schemes(self):
        grounds = set()
        for width, dark in ((1280, False), (800, False), (1280, True)):
            browser = self.browser(width, dark=dark)
            self.assertLessEqual(browser.run("document.documentElement.scrollWidth"), width)
            grounds.add(browser.run("getComputedStyle(document.body).backgroundColor"))
            self.assertEqual(browser.run("document.title"), "What accuracy costs on a.exr")
            self.assertEqual(browser.run("[...document.querySelectorAll('img')].filter(i => !i.alt).length"), 0)
            self.assertEqual(browser.complaints(), [])
        self.assertEqual(len(grounds), 2)


if __name__ == "__main__":
    unittest.main()
