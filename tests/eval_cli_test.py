"""`pomona eval` and `pomona compare` from the outside, on rendered scenes.

Usage: eval_cli_test.py path/to/pomona [unittest arguments]
"""

import csv
import json
import math
import os
import pty
import re
import shutil
import struct
import subprocess
import tempfile
import unittest

from cli_test import COMMAND, CommandTest, png, read_pfm, read_png_header

METHODS = "fast,balanced"
SIZE = (96, 64)


class DatasetTest(CommandTest):
    """Each test has a folder with two scenes, Boxes and Planes, below data/trainingQ."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.tree = tempfile.mkdtemp(prefix="pomona-eval-")
        os.mkdir(os.path.join(cls.tree, "trainingQ"))
        for scene in ("Boxes", "Planes"):
            subprocess.run([COMMAND, "render", scene.lower(), "--seed", "3", "--size", "96x64", "-o",
                            os.path.join(cls.tree, "trainingQ", scene)], check=True, stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.tree)
        super().tearDownClass()

    def setUp(self):
        super().setUp()
        shutil.copytree(self.tree, self.path("data"))

    def path(self, *leaves):
        return os.path.join(self.folder, *leaves)

    def scene_file(self, scene, leaf):
        return self.path("data", "trainingQ", scene, leaf)

    def eval(self, *extra, methods=METHODS, **options):
        return self.run_command("eval", "data", "--methods", methods, *extra, **options)

    def json(self, leaf="out.json"):
        return json.loads(self.bytes_of(leaf))


def expected_figures(found, truth):
    """bad-1, average error and coverage, from two lists of disparities; a hole or unknown is infinite."""
    known = [(d, t) for d, t in zip(found, truth) if math.isfinite(t)]
    errors = [abs(d - t) for d, t in known if math.isfinite(d)]
    bad = len(known) - sum(error <= 1 for error in errors)
    return 100 * bad / len(known), sum(errors) / len(errors), 100 * len(errors) / len(known)


class Eval(DatasetTest):
    def test_table_json_and_csv_agree_with_the_maps(self):
        for mode, suffix in (("dense", ""), ("sparse", "_s")):
            with self.subTest(mode=mode):
                result = self.eval("--json", "out.json", "--csv", "out.csv", "--submission", "maps", "--mode", mode)
                self.assert_accepted(result)
                rows = {(r["scene"], r["method"]): r for r in self.json()["scenes"]}
                self.assertEqual(set(rows), {(s, m) for s in ("Boxes", "Planes") for m in METHODS.split(",")})
                for (scene, method), row in rows.items():
                    truth = read_pfm(self.scene_file(scene, "disp0GT.pfm"))[2]
                    found = self.pfm(os.path.join("maps", method, "trainingQ", scene, f"disp0{method}{suffix}.pfm"))
                    self.assertEqual(found[:2], SIZE)
                    for column, value in zip(("bad-1", "avg", "coverage"), expected_figures(found[2], truth)):
                        self.assertAlmostEqual(row["all"][column], value, places=3, msg=(scene, method, column))
                with open(self.path("out.csv"), encoding="utf-8") as file:
                    table = list(csv.DictReader(file))
                self.assertEqual(len(table), 8)  # two scenes, two methods, all and non-occluded pixels
                for line in table:
                    value = rows[line["scene"], line["method"]][line["region"]]["bad-1"]
                    self.assertAlmostEqual(float(line["bad-1"]), value, places=5)
                mean = self.json()["means"]["fast"]["all"]["bad-1"]
                self.assertAlmostEqual(mean, sum(rows[s, "fast"]["all"]["bad-1"] for s in ("Boxes", "Planes")) / 2)
                lines = result.stdout.splitlines()
                self.assertEqual(len(lines), 1 + 4 + 2)
                self.assertEqual(lines[-2].split()[:2] + [lines[-2].split()[3]], ["mean", "fast", f"{mean:.2f}"])

    def test_checks_can_be_chosen(self):
        coverage = []
        for extra in ((), ("--left-right", "-1", "--speckle", "0", "--median", "0")):
            self.assert_accepted(self.eval("--json", "out.json", "--mode", "sparse", *extra, methods="ssd,fast"))
            coverage.append([row["all"]["coverage"] for row in self.json()["scenes"]])
        for checked, unchecked in zip(*coverage):
            self.assertLess(checked, unchecked)
        self.assertIn("--left-right -1, --speckle 0, --median 0", self.json()["facts"]["maps"])
        result = self.eval("--median", "4", methods="ssd")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--median", result.stderr)

    def test_mask(self):
        every = self.eval("--json", "out.json").stdout.splitlines()[1].split()
        seen_by_both = self.eval("--mask", "nocc").stdout.splitlines()[1].split()
        row = self.json()["scenes"][0]
        self.assertEqual(every[2], f"{row['all']['bad-0.5']:.2f}")
        self.assertEqual(seen_by_both[2], f"{row['nocc']['bad-0.5']:.2f}")
        self.assertNotEqual(every[2], seen_by_both[2])
        os.remove(self.scene_file("Boxes", "mask0nocc.png"))
        table = [line.split() for line in self.eval("--mask", "nocc").stdout.splitlines()]
        self.assertEqual(table[1][2], "-")
        self.assertEqual(table[5][:3], ["mean", "of", "1"])  # over the scenes that have the figure
        self.assertEqual(table[5][4], table[3][2])

    def test_means_tell_how_many_scenes_are_behind_them(self):
        os.remove(self.scene_file("Boxes", "mask0nocc.png"))
        self.assert_accepted(self.eval("--json", "out.json"))
        means = self.json()["means"]["fast"]
        self.assertEqual((means["all"]["scenes"], means["nocc"]["scenes"]), (2, 1))

    def test_subpixel_bins_are_those_of_the_maps(self):
        self.assert_accepted(self.eval("--json", "out.json", "--submission", "maps", methods="fast"))
        truth = read_pfm(self.scene_file("Boxes", "disp0GT.pfm"))[2]
        found = self.pfm("maps/fast/trainingQ/Boxes/disp0fast.pfm")[2]
        bins = [[] for _ in range(10)]
        for d, t in zip(found, truth):
            if math.isfinite(t) and abs(d - t) <= 1:
                bins[min(9, int(10 * (t - math.floor(t))))].append(d - t)
        written = self.json()["scenes"][0]["subpixel"]
        self.assertEqual([count for count, _, _ in written], [len(errors) for errors in bins])
        for errors, (count, bias, rms) in zip(bins, written):
            if count:
                self.assertAlmostEqual(bias, sum(errors) / count, places=6)
                self.assertAlmostEqual(rms, math.sqrt(sum(e * e for e in errors) / count), places=6)
            else:
                self.assertIsNone(bias)

    def test_times_are_those_of_the_submission(self):
        self.assert_accepted(self.eval("--json", "out.json", "--submission", "maps"))
        for row in self.json()["scenes"]:
            seconds = float(self.bytes_of("maps", row["method"], "trainingQ", row["scene"], f"time{row['method']}.txt"))
            self.assertAlmostEqual(row["all"]["ms"], 1000 * seconds, delta=0.01 * row["all"]["ms"])
            self.assertAlmostEqual(row["all"]["s/MP"], seconds / (96 * 64 / 1e6), delta=0.01 * row["all"]["s/MP"])

    def test_results_do_not_depend_on_threads(self):
        maps = []
        for threads in ("1", "3"):
            self.assert_accepted(self.eval("--threads", threads, "--submission", threads))
            maps.append(self.bytes_of(threads, "balanced", "trainingQ", "Boxes", "disp0balanced.pfm"))
        self.assertEqual(*maps)

    def test_the_other_layouts(self):
        kitti = self.path("kitti", "training")
        for part in ("image_2", "image_3", "disp_occ_0", "disp_noc_0"):
            os.makedirs(os.path.join(kitti, part))
        for frame in ("000000_10", "000001_10"):
            shutil.copy(self.left, os.path.join(kitti, "image_2", frame + ".png"))
            shutil.copy(self.right, os.path.join(kitti, "image_3", frame + ".png"))
            self.assert_accepted(self.compute("-o", os.path.join(kitti, "disp_occ_0", frame + ".png")))
            shutil.copy(os.path.join(kitti, "disp_occ_0", frame + ".png"), os.path.join(kitti, "disp_noc_0"))
        shutil.copytree(self.path("data", "trainingQ"), self.path("two_view_training"))
        with open(self.path("data", "manifest.csv"), "w", encoding="utf-8") as file:
            file.write("name,left,right,gt,max_disparity\n")
            file.write("listed,trainingQ/Boxes/im0.png,trainingQ/Boxes/im1.png,trainingQ/Boxes/disp0GT.pfm,24\n")
        result = self.run_command("eval", "kitti", "two_view_training", "data", "--methods", "balanced", "--json",
                                  "out.json", "--submission", "maps")
        self.assert_accepted(result)
        rows = {row["scene"]: row for row in self.json()["scenes"]}
        self.assertEqual(list(rows), ["000000_10", "000001_10", "Boxes", "Planes", "listed"])
        self.assertLess(rows["000000_10"]["all"]["D1-all"], 5)  # its truth is that very method's map
        self.assertEqual(rows["listed"]["num_disparities"], 24)
        for path in ("disp_0/000001_10.png", "low_res_two_view/Boxes.pfm", "low_res_two_view/Planes.txt",
                     "listed/disp0balanced.pfm"):
            self.assertTrue(os.path.exists(self.path("maps", "balanced", path)), path)
        self.assertRegex(self.bytes_of("maps", "balanced", "low_res_two_view", "Planes.txt"), rb"^runtime [0-9.e-]+\n$")

    def test_kitti_counts_outliers_of_the_filled_map_and_of_non_occluded_pixels(self):
        kitti, truth = self.path("kitti", "training"), 8
        for part in ("image_2", "image_3", "disp_occ_0", "disp_noc_0"):
            os.makedirs(os.path.join(kitti, part))
        shutil.copy(self.left, os.path.join(kitti, "image_2", "000000_10.png"))
        shutil.copy(self.right, os.path.join(kitti, "image_3", "000000_10.png"))
        with open(os.path.join(kitti, "disp_occ_0", "000000_10.png"), "wb") as file:
            file.write(png(96, 64, 0, 16, struct.pack(">H", 256 * truth)))
        for path in (os.path.join(kitti, "disp_noc_0", "000000_10.png"), "seen.pfm"):
            self.assert_accepted(self.compute("-o", path, "--mode", "sparse"))
        os.mkdir(self.path("listed"))
        with open(self.path("listed", "manifest.csv"), "w", encoding="utf-8") as file:
            file.write(f"name,left,right,max_disparity\npair,{self.left},{self.right},16\n")
        result = self.run_command("eval", "kitti", "listed", "--methods", "fast", "--mode", "sparse", "--json",
                                  "out.json", "--submission", "maps")
        self.assertEqual(result.returncode, 0, result.stderr)
        width, height, found = self.pfm("maps/fast/pair/disp0fast_s.pfm")
        seen = self.pfm("seen.pfm")[2]
        wrong = []
        for y in range(height):
            row = found[y * width:(y + 1) * width]
            self.assertTrue(any(map(math.isfinite, row)))
            for x in range(width):
                nearest = [next(filter(math.isfinite, side), math.inf) for side in (row[x::-1], row[x:])]
                wrong.append(abs(min(nearest) - truth) > 3)
        figures = self.json()["scenes"][0]
        self.assertAlmostEqual(figures["all"]["D1-all"], 100 * sum(wrong) / len(wrong))
        wrong_seen = [w for w, d in zip(wrong, seen) if math.isfinite(d)]
        self.assertAlmostEqual(figures["nocc"]["D1-all"], 100 * sum(wrong_seen) / len(wrong_seen))
        self.assertNotAlmostEqual(figures["nocc"]["D1-all"], figures["all"]["D1-all"])
        self.assertGreater(figures["all"]["invalid"], 0)

    def test_scenes_without_truth_run_for_a_submission_only(self):
        os.remove(self.scene_file("Boxes", "disp0GT.pfm"))
        result = self.eval("--submission", "maps", "--json", "out.json")
        said = "pomona: note: 1 scene has no ground truth: "
        self.assertEqual((result.returncode, result.stderr), (0, said + "matched, not scored (Boxes)\n"))
        self.assertTrue(os.path.exists(self.path("maps/fast/trainingQ/Boxes/disp0fast.pfm")))
        row = self.json()["scenes"][0]
        self.assertEqual((row["scene"], set(row["all"])), ("Boxes", {"ms", "s/MP", "s/GD"}))
        result = self.eval("--json", "out.json")
        said += "passed over; --submission would match (Boxes)\n"
        self.assertEqual((result.returncode, result.stderr), (0, said))
        self.assertEqual([row["scene"] for row in self.json()["scenes"]], ["Planes"] * 2)
        self.assertEqual(["pomona: note: " + remark + "\n" for remark in self.json()["remarks"]], [said])
        os.remove(self.scene_file("Planes", "disp0GT.pfm"))
        self.assert_refused(self.eval(), "none of the 2 scenes has ground truth; --submission would")

    def test_a_range_that_is_too_small_for_the_truth_is_remarked(self):
        calib = self.scene_file("Boxes", "calib.txt")
        with open(calib, encoding="utf-8") as file:
            text = file.read()
        self.assertIn("ndisp=", text)
        with open(calib, "w", encoding="utf-8") as file:
            file.write(re.sub(r"ndisp=\d+", "ndisp=3", text))
        result = self.eval()
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r"^pomona: note: .*Boxes/calib.txt: ndisp is 3, .* truth reaches [0-9.]+\n$")

    def test_a_broken_scene_is_named_and_passed_over(self):
        breakages = {"im1.png": lambda path: os.remove(path),
                     "disp0GT.pfm": lambda path: os.truncate(path, 100),
                     "mask0nocc.png": lambda path: shutil.copy(self.path("data", "small.png"), path)}
        self.assert_accepted(self.run_command("render", "boxes", "--size", "32x32", "-o", "small"))
        shutil.move(self.path("small", "mask0nocc.png"), self.path("data", "small.png"))
        for leaf, spoil in breakages.items():
            with self.subTest(leaf=leaf):
                saved = self.path("saved")
                shutil.copy(self.scene_file("Boxes", leaf), saved)
                spoil(self.scene_file("Boxes", leaf))
                result = self.eval("--json", "out.json", "--report", "out.html")
                shutil.move(saved, self.scene_file("Boxes", leaf))
                self.assertEqual(result.returncode, 1)
                lines = result.stderr.splitlines()
                self.assertEqual(len(lines), 2, result.stderr)
                self.assertTrue(lines[0].startswith("pomona: error: Boxes: data/trainingQ/Boxes/" + leaf), lines[0])
                self.assertIn("1 of 2 scenes could not be measured", lines[1])
                self.assertEqual([row["scene"] for row in self.json()["scenes"]], ["Planes"] * 2)
                self.assertIn(leaf, self.json()["problems"][0])
                self.assertIn(b"Planes", self.bytes_of("out.html"))

    def test_views_that_no_method_takes_do_not_stop_the_others(self):
        for color_type, channels in ((4, 2), (6, 4)):  # gray and alpha; colour and alpha
            for leaf in ("im0.png", "im1.png"):
                with open(self.scene_file("Boxes", leaf), "wb") as file:
                    file.write(png(96, 64, color_type, 8, b"\x80" * channels))
            said = "Boxes/im0.png: has 4 channels of 8 bits; allowed: 1 or 3 channels of 8 or 16 bits"
            result = self.eval("--json", "out.json", "--report", "out.html")
            self.assertEqual(result.returncode, 1)
            self.assertIn(said, result.stderr)
            self.assertEqual([row["scene"] for row in self.json()["scenes"]], ["Planes"] * 2)
            self.assertIn(b"Planes", self.bytes_of("out.html"))
            self.assert_refused(self.run_command("compare", "data", "-o", "s.png", "--methods", METHODS), said)

    def test_a_map_that_does_not_fit_its_submission_is_named(self):
        kitti = self.path("testing")
        for part in ("image_2", "image_3"):
            os.makedirs(os.path.join(kitti, part))
        wide = subprocess.run([COMMAND, "render", "planes", "--size", "1200x40", "--disparities", "500", "-o",
                               self.path("wide")], capture_output=True, check=False)
        self.assertEqual(wide.returncode, 0, wide.stderr)
        shutil.copy(self.path("wide", "im0.png"), os.path.join(kitti, "image_2", "000000_10.png"))
        shutil.copy(self.path("wide", "im1.png"), os.path.join(kitti, "image_3", "000000_10.png"))
        result = self.run_command("eval", "testing", "--methods", "fast", "--submission", "maps", "--json", "out.json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("000000_10, fast: disparity at x", result.stderr)
        self.assertEqual([row["scene"] for row in self.json()["scenes"]], ["000000_10"])  # measured all the same

    def test_a_submission_folder_that_cannot_be_is_refused_before_any_work(self):
        result = self.eval("--submission", self.truth + "/maps", "--json", "out.json")
        self.assert_refused(result, "disp0GT.pfm/maps': Not a directory")
        self.assertFalse(os.path.exists(self.path("out.json")))

    def test_bad_arguments(self):
        before = sorted(os.listdir(self.folder))
        for part, arguments, status in (
                ("method", ("data", "--methods", "fats"), 1), ("'fast' twice", ("data", "--methods", "fast,fast"), 1),
                ("absent: there is no such folder", ("absent",), 1), ("no scene found", (".ssh-like",), 1),
                ("'out.txt'", ("data", "--json", "out.txt"), 1), ("'manifest.csv'", ("data", "--csv", "manifest.csv"), 1),
                ("no/out.html", ("data", "--report", "no/out.html"), 1), ("--threads is -1", ("data", "--threads", "-1"), 1),
                ("which is no folder", ("data", "--submission", "data/trainingQ/Boxes/im0.png"), 1),
                ("--mask", ("data", "--mask", "some"), 1), ("--mode", ("data", "--mode", "thick"), 1),
                ("--left-right is nan", ("data", "--left-right", "nan"), 1),
                ("--median", ("data", "--median", "4"), 1), ("--speckle", ("data", "--speckle", "-1"), 1),
                ("--json: is empty", ("data", "--json", ""), 1), ("--submission: is empty", ("data", "--submission", ""), 1),
                ("folders", (), 2)):
            if ".ssh-like" in arguments:
                os.mkdir(self.path(".ssh-like"))
            with self.subTest(part=part):
                self.assert_refused(self.run_command("eval", *arguments), part, status)
            if ".ssh-like" in arguments:
                os.rmdir(self.path(".ssh-like"))
        self.assert_left_alone(before)

    def test_the_progress_bar_is_for_terminals(self):
        controller, terminal = pty.openpty()
        result = subprocess.run([COMMAND, "eval", "data", "--methods", "fast"], stdout=subprocess.PIPE, stderr=terminal,
                                cwd=self.folder, text=True, check=True)
        os.close(terminal)
        shown = os.read(controller, 1 << 16).decode()
        os.close(controller)
        self.assertIn("Planes, fast", shown)
        self.assertIn("1/2", shown)
        self.assertTrue(shown.endswith("\r\x1b[K"))  # and it leaves nothing behind
        self.assertEqual(len(result.stdout.splitlines()), 4)


class Compare(DatasetTest):
    def test_a_pair(self):
        self.assert_accepted(self.run_command("compare", self.left, self.right, "-o", "sheet.png", "--methods", METHODS))
        width, height, bits, color = read_png_header(self.path("sheet.png"))
        self.assertEqual((bits, color), (8, 2))
        self.assertGreater(width, 2 * 500)  # three cells, two in a row
        self.assertGreater(height, 2 * 300)

    def test_scenes(self):
        result = self.run_command("compare", "data", "-o", "sheet.png", "--methods", METHODS)
        self.assert_accepted(result)
        self.assertIn("2 scenes, 2 methods", result.stdout)
        width, height = read_png_header(self.path("sheet.png"))[:2]
        self.assertEqual(width, 10 + 4 * 410)  # left, truth and two maps of 400, with gaps of 10
        self.assertEqual(height, 10 + 2 * (26 + 267 + 10))

    def test_bad_input(self):
        before = sorted(os.listdir(self.folder))
        for part, arguments, status in (
                ("absent.png: cannot be read", (self.left, "absent.png", "-o", "s.png"), 1),
                ("'s.jpg'", (self.left, self.right, "-o", "s.jpg"), 1), ("no/s.png", ("data", "-o", "no/s.png"), 1),
                ("which is an input", ("data", "-o", "data/trainingQ/Boxes/im0.png"), 1),
                ("method", ("data", "-o", "s.png", "--methods", "fats"), 1),
                ("there is no such folder", (self.left, "-o", "s.png"), 1), ("--output", ("data",), 2)):
            with self.subTest(part=part):
                self.assert_refused(self.run_command("compare", *arguments), part, status)
        os.truncate(self.scene_file("Boxes", "im1.png"), 50)
        self.assert_refused(self.run_command("compare", "data", "-o", "s.png", "--methods", METHODS), "Boxes/im1.png")
        self.assert_left_alone(before)


if __name__ == "__main__":
    unittest.main()
