"""The verbs around a stereo camera from the outside: rig, calibrate, rectify, check, and compute --rig.

Usage: rig_cli_test.py path/to/pomona [unittest arguments]
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

COMMAND = os.path.abspath(sys.argv.pop(1))

# A converging camera with lenses. Its size keeps the tests quick.
KALIBR = """\
cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.17, 0.03, 0.0005, -0.0004]
  distortion_model: radtan
  intrinsics: [530.1, 529.6, 322.3, 178.2]
  resolution: [640, 360]
cam1:
  T_cn_cnm1:
  - [0.9999, 0.0, 0.0141417, -0.11]
  - [0.0, 1.0, 0.0, 0.0004]
  - [-0.0141417, 0.0, 0.9999, -0.0008]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [-0.16, 0.02, -0.0003, 0.0005]
  distortion_model: radtan
  intrinsics: [528.9, 528.2, 317.9, 181.6]
  resolution: [640, 360]
"""


def run(*arguments, folder):
    return subprocess.run([COMMAND, *arguments], capture_output=True, text=True, cwd=folder, timeout=300, check=False)


class RigTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pictures = tempfile.mkdtemp(prefix="pomona-boards-")
        with open(os.path.join(cls.pictures, "camchain.yaml"), "w", encoding="ascii") as file:
            file.write(KALIBR)
        result = run("render", "chessboard", "--rig", "camchain.yaml", "--views", "12", "--square", "25", "--seed", "5",
                     "-o", "boards", folder=cls.pictures)
        assert result.returncode == 0, result.stderr

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.pictures)

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pomona-rig-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.rig = os.path.join(self.pictures, "camchain.yaml")
        self.boards = os.path.join(self.pictures, "boards")

    def command(self, *arguments):
        return run(*arguments, folder=self.folder)

    def accept(self, *arguments, status=0):
        result = self.command(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertEqual(result.stderr, "")
        return result.stdout

    def refuse(self, part, *arguments, status=1):
        result = self.command(*arguments)
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn(part, result.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def calibrate(self, *extra):
        return ("calibrate", os.path.join(self.boards, "left*.png"), os.path.join(self.boards, "right*.png"),
                "--square", "25mm", *extra)

    def board(self, name):
        return os.path.join(self.boards, name)

    def number_after(self, text, word, index=1):
        line = next(line for line in text.splitlines() if line.startswith(word))
        return float(line.split()[index].rstrip(","))

    def test_calibration_finds_the_rig_that_was_rendered(self):
        report = self.accept(*self.calibrate("-o", "rig.yml", "--coverage", "coverage.png"))
        self.assertIn("12 of 12 used", report)
        self.assertLess(self.number_after(report, "rms"), 0.15)
        self.assertLess(self.number_after(report, "epipolar", 2), 0.15)
        self.assertAlmostEqual(self.number_after(report, "baseline"), 110.0, delta=0.5)
        shown = self.accept("rig", "show", "rig.yml")
        self.assertAlmostEqual(self.number_after(shown, "left", 2), 530.1, delta=2)
        self.assertAlmostEqual(self.number_after(shown, "baseline"), 0.110, delta=0.0005)
        self.assertEqual(sorted(os.listdir(self.folder)), ["coverage.png", "rig.yml"])

        # ... and with it, the rows of a pair of pictures match, which they don't without.
        self.assertIn("not aligned", self.accept("check", self.board("left01.png"), self.board("right01.png"),
                                                 "--max-disparity", "300", status=3))
        self.accept("rectify", self.board("left01.png"), self.board("right01.png"), "--rig", "rig.yml", "-o", "pair")
        self.assertEqual(sorted(os.listdir(os.path.join(self.folder, "pair"))), ["calib.txt", "im0.png", "im1.png"])
        again = self.command("rectify", "pair/im0.png", "pair/im1.png", "--rig", "rig.yml", "-o", "pair")
        self.assertEqual(again.returncode, 1)
        self.assertIn("--output is 'pair/im0.png', which is an input", again.stderr)
        shown = self.accept("rig", "show", "pair/calib.txt")
        self.assertAlmostEqual(self.number_after(shown, "baseline"), 0.110, delta=0.0005)
        depth = ["-o", "out.pfm", "--depth", "depth.png", "--max-disparity", "128", "--preset", "fast"]
        by_rig = self.accept("compute", self.board("left01.png"), self.board("right01.png"), "--rig", "rig.yml", *depth)
        self.assertIn("640 x 360", by_rig)
        with open(os.path.join(self.folder, "depth.png"), "rb") as file:
            at_once = file.read()
        self.accept("compute", "pair/im0.png", "pair/im1.png", "--calib", "pair/calib.txt", *depth)
        with open(os.path.join(self.folder, "depth.png"), "rb") as file:
            self.assertEqual(file.read(), at_once)

    def test_convert_keeps_the_rig(self):
        before = self.accept("rig", "show", self.rig)
        self.accept("rig", "convert", self.rig, "-o", "rig.yml")
        self.assertEqual(self.accept("rig", "show", "rig.yml"), before)
        self.accept("rig", "convert", "rig.yml", "--to", "ros", "-o", "ros")
        ros = self.accept("rig", "show", "ros")
        self.assertEqual(ros, before.replace("by pomona: the file states no rectification", "as the file states"))
        self.assertEqual(self.accept("rig", "show", "ros/left.yaml", "ros/right.yaml"), ros)
        self.accept("rig", "convert", "ros", "--to", "middlebury", "-o", "calib.txt")
        self.assertEqual(before.splitlines()[-5:], self.accept("rig", "show", "calib.txt").splitlines()[-5:])

    def test_calibration_leaves_out_a_damaged_picture(self):
        for name in sorted(os.listdir(self.boards)):
            with open(self.board(name), "rb") as file:
                data = file.read()
            with open(os.path.join(self.folder, name), "wb") as file:
                file.write(b"nothing" if name == "left01.png" else data)
        report = self.accept("calibrate", "left*.png", "right*.png", "--square", "25mm", "-o", "rig.yml")
        self.assertIn("left01.png               rejected: left01.png: is not an image", report)
        self.assertIn("11 of 12 used", report)

    def test_check_of_a_rectified_pair(self):
        self.accept("render", "boxes", "--size", "480x360", "-o", "scene")
        self.assertIn("verdict   aligned", self.accept("check", "scene/im0.png", "scene/im1.png"))
        # Nothing of one scene is in the other: no verdict, and no success.
        self.accept("render", "planes", "--seed", "9", "--size", "480x360", "-o", "other")
        self.assertNotIn("verdict   aligned", self.accept("check", "scene/im0.png", "other/im1.png", status=3))

    def test_check_of_one_view_twice(self):
        left = self.board("left01.png")
        self.assertIn("too alike", self.accept("check", left, left, status=3))
        self.assertIn("nothing moves", self.accept("compute", left, left, "-o", "out.pfm", "--preset", "fast"))
        # The same picture once more, its grays a little different: 16 bits, and another gain.
        scene = ("render", "boxes", "--size", "480x360", "--bits", "16")
        self.accept(*scene, "--read-noise", "3", "--seed", "4", "-o", "scene")
        self.accept(*scene, "--read-noise", "5", "--exposure", "0.9", "--seed", "4", "-o", "again")
        self.assertIn("too alike", self.accept("check", "scene/im0.png", "again/im0.png", status=3))

    def test_calibration_of_one_camera_twice(self):
        result = run("calibrate", self.board("left*.png"), self.board("left*.png"), "--square", "25mm", "-o", "rig.yml",
                     folder=self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertIn("left01.png, left02.png, left03.png and 9 more (left and right show the board in the same place",
                      result.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_check_of_exchanged_views(self):
        self.accept("render", "boxes", "--size", "480x360", "-o", "scene")
        self.assertIn("exchanged", self.accept("check", "scene/im1.png", "scene/im0.png", status=3))
        refused = run("check", "scene/im0.png", "scene/im1.png", "--min-disparity", "5", "--max-disparity", "5",
                      folder=self.folder)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("--max-disparity is 5; allowed: above --min-disparity, 5", refused.stderr)
        few = "few pixels could be measured; pomona check"
        self.assertIn(few, self.accept("compute", "scene/im1.png", "scene/im0.png", "-o", "out.pfm"))
        self.assertNotIn(few, self.accept("compute", "scene/im0.png", "scene/im1.png", "-o", "out.pfm"))

    def test_named_rigs(self):
        shown = self.accept("rig", "show", "seed-003")
        self.assertIn("1280 x 720", shown)
        self.assertAlmostEqual(self.number_after(shown, "baseline"), 0.12, delta=1e-9)
        self.accept("rig", "convert", "seed-003-b60", "-o", "rig.yml")
        self.assertEqual(self.accept("rig", "show", "rig.yml"), self.accept("rig", "show", "seed-003-b60"))
        # They do wherever a rig's file does.
        self.accept("render", "planes", "--rig", "seed-003", "--lens", "-o", "scene")
        views = ("scene/im0.png", "scene/im1.png")
        self.accept("rectify", *views, "--rig", "seed-003", "-o", "by-name")
        self.accept("rectify", *views, "--rig", "scene/rig.yml", "-o", "by-file")
        self.accept("measure", *views, "--rig", "seed-003", "--preset", "fast", "--point", "640,360")
        self.accept("compute", "by-name/im0.png", "by-name/im1.png", "--calib", "seed-003", "--preset", "fast",
                    "-o", "out.pfm", "--depth", "depth.pfm")
        for name in ("im0.png", "im1.png", "calib.txt"):
            with open(os.path.join(self.folder, "by-name", name), "rb") as by_name, \
                    open(os.path.join(self.folder, "by-file", name), "rb") as by_file:
                self.assertEqual(by_name.read(), by_file.read(), name)

    def test_refusals(self):
        self.refuse("no file matches 'left*.jpg'", "calibrate", "left*.jpg", "right*.jpg", "--square", "2cm", "-o",
                    "r.yml")
        self.refuse("--square is '25'; allowed", *self.calibrate()[:3], "--square", "25", "-o", "r.yml")
        self.refuse("--board is '9'", *self.calibrate("--board", "9", "-o", "r.yml"))
        self.refuse("don't pair up", "calibrate", self.board("left*.png"), self.board("right0*.png"), "--square",
                    "25mm", "-o", "r.yml")
        self.refuse("views can be used", "calibrate", self.board("left01.png"), self.board("right01.png"), "--square",
                    "25mm", "--board", "8x5", "-o", "r.yml")
        self.refuse("there is no folder", *self.calibrate("-o", "no/r.yml"))
        self.refuse("--square is '20m'; allowed: a length from 1mm to 1m", *self.calibrate()[:3], "--square", "20m", "-o",
                    "r.yml")
        self.refuse("--output is 'r.png'; allowed extensions: .yml, .yaml", *self.calibrate("-o", "r.png"))
        self.refuse("--coverage is 'c.jpg'; allowed extensions: .png", *self.calibrate("-o", "r.yml", "--coverage", "c.jpg"))
        self.refuse("left01.png', which is an input",
                    *self.calibrate("-o", "r.yml", "--coverage", self.board("left01.png")))
        self.refuse("no complete board of 9x6 inner corners in either image", "calibrate", self.small_picture(),
                    self.small_picture(), "--square", "25mm", "-o", "r.yml")
        self.refuse("absent.yml: cannot be read", "rig", "show", "absent.yml")
        self.refuse("baseline is 0.00011", "rig", "show", self.rig, "--unit", "mm")
        self.refuse("exchanged", "rig", "show", self.rig, "--cameras", "1", "0")
        self.refuse("--cameras is 1 twice", "rig", "show", self.rig, "--cameras", "1", "1")
        for verb in (("rig", "show", "seed-004"), ("rectify", "a.png", "b.png", "-o", "x", "--rig", "seed-004"),
                     ("render", "planes", "-o", "x", "--rig", "seed-004")):
            self.refuse("no such file; allowed: one, or a rig's name: middlebury, seed-003, seed-003-b60", *verb)
        self.refuse("--rig is missing", "render", "chessboard", "-o", "x")
        small = self.small_picture()
        self.refuse("allowed: the rig's 640x360", "rectify", small, small, "--rig", self.rig, "-o", "x")
        self.refuse("--calib excludes --rig", "compute", self.board("left01.png"), self.board("right01.png"), "--rig",
                    self.rig, "--calib", self.rig, "-o", "out.pfm", status=2)

    def small_picture(self):
        scene = os.path.join(self.pictures, "scene")
        if not os.path.isdir(scene):
            run("render", "planes", "--size", "96x64", "-o", scene, folder=self.pictures)
        return os.path.join(scene, "im0.png")


if __name__ == "__main__":
    unittest.main()
