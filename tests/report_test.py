"""The HTML report of `pomona eval` in a real browser: it loads, sorts, opens a scene and reads out values.

Usage: report_test.py path/to/pomona [unittest arguments]
Exits with 77 if there is no Chromium. With POMONA_SCREENSHOTS set to a folder, leaves pictures there to look at.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from browser import Browser, find_browser
from cli_test import COMMAND, read_pfm

METHODS = ["fast", "balanced", "ssd"]
LAPTOP, PHONE = (1366, 800), (390, 844)


def text_of(selector):
    return f"[...document.querySelectorAll({selector!r})].map((e) => e.textContent)"


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pomona-report-")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for scene in ("boxes", "planes", "spheres"):
            subprocess.run([COMMAND, "render", scene, "--size", "160x120", "-o", cls.path(scene)], check=True,
                           stdout=subprocess.DEVNULL)
        os.rename(cls.path("planes"), cls.path("<!--<script> & planes"))  # names are text, whatever they hold
        os.truncate(cls.path("spheres", "im0.png"), 100)
        result = subprocess.run([COMMAND, "eval", cls.folder, "--methods", ",".join(METHODS), "--report",
                                 cls.path("report.html"), "--submission", cls.path("maps")],
                                capture_output=True, text=True, check=False)
        assert result.returncode == 1 and "spheres" in result.stderr, result.stderr
        cls.browser = Browser(find_browser())
        cls.addClassCleanup(cls.browser.close)

    @classmethod
    def path(cls, *leaves):
        return os.path.join(cls.folder, *leaves)

    def setUp(self):
        self.open(LAPTOP)

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])

    def open(self, size, **look):
        self.browser.show_as(*size, **look)
        self.browser.open("about:blank")
        self.browser.wait_for("location.href === 'about:blank'")
        self.browser.open("file://" + self.path("report.html"))
        self.browser.wait_for("document.body && document.body.dataset.ready === 'yes'")

    def open_scene(self, name):
        self.browser.click(f"#scenes tbody tr:nth-child({1 + self.scenes().index(name)}) a")
        self.browser.wait_for(f"document.getElementById('scene').dataset.scene === {name!r}")

    def scenes(self):
        return [name for name in self.browser.run(text_of("#scenes tbody th")) if name != "mean"]

    def column(self, table, k):
        return [float(cell) for cell in self.browser.run(text_of(f"{table} tbody tr > :nth-child({k})"))]

    def hover(self, selector):
        self.browser.mouse("mouseMoved", *self.browser.middle_of(selector))
        return self.browser.wait_for("!document.getElementById('reading').hidden && "
                                     "document.getElementById('reading').textContent")

    def test_shows_methods_scenes_and_what_was_not_measured(self):
        self.assertEqual(self.browser.run(text_of("#means tbody th")), METHODS)
        self.assertEqual(self.browser.run(text_of("#scenes thead button"))[1:], METHODS)
        self.assertEqual(set(self.scenes()), {"<!--<script> & planes", "boxes"})
        self.assertIn("spheres/im0.png", self.browser.run(text_of("#problems li"))[0])
        self.assertIn("instruction set", self.browser.run(text_of("#facts dt")))
        self.assertEqual(self.browser.run("document.querySelectorAll('#scatter circle').length"), len(METHODS))
        self.assertEqual(self.browser.run("document.getElementById('summary').textContent"), "2 scenes, 3 methods")
        self.assertEqual(self.column("#means", len(self.browser.run(text_of("#means thead th")))), [2] * len(METHODS))
        for chart in ("curves", "subpixel"):
            for kind in ("", ".dotted"):
                paths = self.browser.run(f"document.querySelectorAll('#{chart} path{kind}').length")
                self.assertEqual(paths, len(METHODS) * (1 if kind else 2), (chart, kind))

    def test_mean_curves_end_where_the_first_scene_does_and_no_line_flattens_the_others(self):
        scene = "{methods: {m: {curves: {all: %s}}}}"
        scenes = "[" + scene % "[[40, 1, 0], [80, 3, 1]]" + "," + scene % "[[50, 5, 2], [100, 5, 4]]" + "]"
        solid, dotted = self.browser.run(f"(shown.region = 'all', meanCurve('m', {scenes}))")
        self.assertEqual((solid[0], solid[-1], dotted[-1]), ([2, 3], [80, 4], [80, 2.1]))
        self.assertEqual(self.browser.run("reachOf([[[0, 1]], [[0, 2]], [[0, 100]]])"), 4 * 1.08)
        self.assertEqual(self.browser.run("reachOf([[[0, 1], [1, -3]], [[0, 2]]])"), 3 * 1.08)

    def test_the_line_joins_the_presets_and_names_who_is_below(self):
        self.assertEqual(self.browser.run("record.presets"), ["fast", "balanced"])
        self.assertEqual(self.browser.run("shown.metric"), "bad-1")
        self.assertEqual(self.browser.run("document.querySelectorAll('#scatter path.front').length"), 1)
        self.assertRegex(self.browser.run("document.querySelector('#scatter p').textContent"),
                         r"^Below our line: (none|ssd)\. Faster than all of it: (none|ssd)\.$")
        points = "[{x: 2, y: 3}, {x: 0, y: 5}, {x: 1, y: 5}, {x: 4, y: 1}, {x: 3, y: 4}]"
        self.assertEqual(self.browser.run(f"frontOf({points}).map((p) => p.x)"), [0, 2, 4])
        self.assertEqual(self.browser.run(f"[0, 1, 2, 3, 4, 9].map((x) => heightAt(frontOf({points}), x))"),
                         [5, 4, 3, 2, 1, 1])
        self.assertTrue(self.browser.run(f"[heightAt(frontOf({points}), -0.1), heightAt([], 0)].every(Number.isNaN)"))
        others = "[{method: 'under', x: 1, y: 3.9}, {method: 'over', x: 1, y: 4.1}, {method: 'quick', x: -1, y: 9}]"
        self.assertEqual(self.browser.run(f"standing(frontOf({points}), {others}).textContent"),
                         "Below our line: under. Faster than all of it: quick.")

    def test_needs_nothing_else(self):
        with open(self.path("report.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertIsNone(re.search(r"(src|href)\s*=\s*[\"'](?!#|data:)", page))
        self.assertNotIn("@import", page)

    def test_sorts(self):
        before = self.column("#means", 3)
        self.browser.click("#means thead th:nth-child(3) button")
        self.assertEqual(self.column("#means", 3), sorted(before))
        self.assertEqual(self.browser.run("document.querySelector('#means th:nth-child(3)').ariaSort"), "ascending")
        self.browser.click("#means thead th:nth-child(3) button")
        self.assertEqual(self.column("#means", 3), sorted(before, reverse=True))
        self.browser.click("#means thead th:nth-child(1) button")
        self.assertEqual(self.browser.run(text_of("#means tbody th")), sorted(METHODS))
        self.browser.click("#scenes thead th:nth-child(2) button")
        self.assertEqual(self.browser.run(text_of("#scenes tbody th"))[-1], "mean")  # stays below

    def test_regions_figures_and_columns_can_be_chosen(self):
        every = self.column("#means", 2)
        self.browser.click("#means thead th:nth-child(2) button")
        self.browser.click("[data-region=nocc]")
        self.assertNotEqual(self.column("#means", 2), sorted(every))
        self.assertEqual(self.column("#means", 2), sorted(self.column("#means", 2)))  # the order stays
        columns = len(self.browser.run(text_of("#means thead th")))
        self.browser.click("#every-column")
        self.assertGreater(len(self.browser.run(text_of("#means thead th"))), columns + 5)
        before = self.column("#scenes", 2)
        self.browser.run("""(() => { const metric = document.getElementById("metric"); metric.value = "avg";
                            metric.dispatchEvent(new Event("change")); })()""")
        self.assertNotEqual(self.column("#scenes", 2), before)

    def test_a_scene_reads_out_the_disparities_that_were_written(self):
        self.open_scene("boxes")
        self.assertEqual(self.browser.run("document.querySelectorAll('.maps canvas').length"), 2 + 2 * len(METHODS))
        truth = read_pfm(self.path("boxes", "disp0GT.pfm"))[2]
        for k, method in enumerate(METHODS):
            found = read_pfm(self.path("maps", method, "boxes", f"disp0{method}.pfm"))[2]
            for canvas in (1, 2):
                reading = self.hover(f".maps figure:nth-child({k + 2}) canvas:nth-child({canvas})")
                x, y, d, t, error = map(float, re.fullmatch(
                    r"x (\d+), y (\d+): ([\d.]+) px \(truth ([\d.]+) px, error ([\d.]+) px\)", reading).groups())
                i = int(y) * 160 + int(x)
                self.assertAlmostEqual(d, found[i], delta=0.04, msg=method)  # half of 1/16 px, and two decimals
                self.assertAlmostEqual(t, truth[i], delta=0.04)
                self.assertAlmostEqual(error, abs(found[i] - truth[i]), delta=0.08)
        self.assertIn("x 80, y 60", self.hover(".maps canvas"))

    def test_maps_can_be_enlarged(self):
        self.open_scene("<!--<script> & planes")
        self.browser.click(".maps figure:nth-child(2) canvas")
        self.browser.wait_for("document.getElementById('viewer').open")
        self.assertEqual(self.browser.run("document.getElementById('caption').textContent"), "fast: disparity")
        self.assertIn("px (truth", self.hover("#viewer canvas"))
        self.browser.click("[data-step='1']")
        self.assertEqual(self.browser.run("document.getElementById('caption').textContent"), "fast: error")
        self.browser.click("[data-close]")
        self.browser.wait_for("!document.getElementById('viewer').open")

    def test_from_scene_to_scene_and_back(self):
        first, second = self.scenes()
        self.open_scene(first)
        self.browser.click("#scene nav button:last-child")
        self.browser.wait_for(f"document.getElementById('scene').dataset.scene === {second!r}")
        self.browser.run("history.go(-2)")
        self.browser.wait_for("!document.getElementById('overview').hidden")

    def test_fits_laptop_and_phone_in_light_and_dark(self):
        papers = set()
        for size, phone in ((LAPTOP, False), (PHONE, True)):
            for dark in (False, True):
                with self.subTest(size=size, dark=dark):
                    self.open(size, dark=dark, phone=phone)
                    self.assertEqual(self.browser.run("document.documentElement.scrollWidth"), size[0])
                    papers.add(self.browser.run("getComputedStyle(document.body).backgroundColor"))
                    self.keep_screenshot(size, dark, "overview")
                    self.open_scene("boxes")
                    self.assertEqual(self.browser.run("document.documentElement.scrollWidth"), size[0])
                    self.keep_screenshot(size, dark, "scene")
        self.assertEqual(len(papers), 2)

    def keep_screenshot(self, size, dark, what):
        picture = self.browser.screenshot()
        self.assertGreater(len(picture), 10000)  # an empty page takes less
        folder = os.environ.get("POMONA_SCREENSHOTS")
        if folder:
            with open(os.path.join(folder, f"{what}-{size[0]}-{'dark' if dark else 'light'}.png"), "wb") as file:
                file.write(picture)


if __name__ == "__main__":
    if not find_browser():
        print("report_test: skipped, for there is no Chromium (package chromium)")
        sys.exit(77)
    unittest.main()
