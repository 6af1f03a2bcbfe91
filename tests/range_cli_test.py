"""`pomona range` and `pomona plugins` from the outside, with the plugins that the tests build.

Usage: range_cli_test.py path/to/pomona FOLDER [unittest arguments]; FOLDER has the subfolders good and broken.
"""

import csv
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

COMMAND = os.path.abspath(sys.argv.pop(1))
PLUGINS = os.path.abspath(sys.argv.pop(1))


class Range(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.scene_folder = tempfile.TemporaryDirectory()
        cls.scene = os.path.join(cls.scene_folder.name, "scene")
        subprocess.run([COMMAND, "render", "planes", "--size", "160x120", "-o", cls.scene], check=True,
                       capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.scene_folder.cleanup()

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def run_command(self, *arguments, path=os.path.join(PLUGINS, "good")):
        return subprocess.run([COMMAND, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=300,
                              env={**os.environ, "POMONA_PLUGIN_PATH": path})

    def range(self, *arguments):
        done = self.run_command("range", *self.pair(), "--plugin", "middle", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def pair(self):
        return (os.path.join(self.scene, "im0.png"), os.path.join(self.scene, "im1.png"), "--calib",
                os.path.join(self.scene, "calib.txt"))

    def refuse(self, reason, *arguments, status=1):
        done = self.run_command(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertTrue(done.stderr.startswith("pomona: error: "), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(reason, done.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def refuse_range(self, reason, *arguments, status=1):
        self.refuse(reason, "range", *self.pair(), "--plugin", "middle", "-o", "out.csv", "--draw", "out.png",
                    *arguments, status=status)

    def open(self, name, mode="r", **options):
        return open(os.path.join(self.folder, name), mode, **options)

    def test_pictures_spare_the_inputs(self):
        left, right, _, calibration = self.pair()
        shutil.copy(left, os.path.join(self.folder, "own-gray.png"))
        done = self.run_command("range", "own-gray.png", right, "--calib", calibration, "--plugin", "middle", "--pictures",
                                "own")
        self.assertEqual(done.returncode, 1)
        self.assertIn("--pictures is 'own-gray.png', which is an input", done.stderr)

    def test_list(self):
        done = self.run_command("plugins")
        self.assertEqual(done.returncode, 0)
        for text in ("middle: The point in the middle", "sigma_px = 0.25  (0 to 10)", "points = 1  (whole numbers, 0 to 100)",
                     "fails = never  (never, error, number, object, picture)",
                     "variant = faithful  As it was published: sigma_px=1 points=3"):
            self.assertIn(text, done.stdout)

    def test_list_names_what_cannot_be_loaded(self):
        done = self.run_command("plugins", path=":".join([os.path.join(PLUGINS, p) for p in ("good", "broken")]))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("middle: The point", done.stdout)
        refused = [line for line in done.stdout.splitlines() if line.startswith("not loaded: ")]
        self.assertEqual(len(refused), 19)
        self.assertTrue(any("ThrowsInCreate.so: no luck" in line for line in refused))

    def test_csv_json_and_ply_tell_the_same(self):
        text = self.range("-o", "out.csv", "-o", "out.json", "-o", "out.ply", "--set", "points=2", "--set",
                          'label=a "b", c')
        with self.open("out.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        with self.open("out.json") as file:
            result = json.load(file)
        with self.open("out.ply", "rb") as file:
            header, vertices = file.read().split(b"end_header\n")
        self.assertEqual(len(rows), 2)
        self.assertEqual(rows[0]["object"], 'a "b", c')
        self.assertEqual((rows[0]["left_x_px"], rows[0]["left_y_px"], rows[0]["sigma_px"]), ("80", "60", "0.25"))
        self.assertEqual(rows[0]["sigma_z_m"], "", "unknown is empty")
        point = result["points"][1]
        self.assertEqual(point["left_px"], [80, 60])
        self.assertIsNone(point["sigma_z_m"])
        self.assertAlmostEqual(float(rows[1]["z_m"]), point["point_m"][2], places=6)
        self.assertIn(b"element vertex 2\n", header)
        x, y, z, *color = struct.unpack("<fffBBB", vertices[15:])
        for value, expected in zip((x, y, z), point["point_m"]):
            self.assertAlmostEqual(value, expected, places=6)
        self.assertEqual(len(vertices), 30)
        self.assertNotEqual(color, [0, 0, 0])
        self.assertEqual(result["plugin"], "middle")
        self.assertEqual(result["settings"]["points"], "2")
        self.assertEqual(result["objects"][0]["label"], 'a "b", c')
        self.assertTrue(result["objects"][0]["found"])
        self.assertEqual(result["figures"], [{"name": "runs", "value": 1.0, "unit": ""}])
        self.assertIn("points    2, Z from", text)

    def test_pictures(self):
        self.range("--draw", "drawn.png", "--pictures", "own")
        with self.open("drawn.png", "rb") as file:
            self.assertEqual(struct.unpack(">II", file.read(24)[16:]), (160, 120))
        with self.open("own-gray.png", "rb") as file:
            self.assertEqual(struct.unpack(">II", file.read(24)[16:]), (6, 4))

    def test_variant_first_then_the_others(self):
        self.range("--set", "points=2", "--set", "variant=faithful", "-o", "out.json")
        with self.open("out.json") as file:
            settings = json.load(file)["settings"]
        self.assertEqual((settings["points"], settings["sigma_px"]), ("2", "1"))

    def test_not_found_is_a_result(self):
        text = self.range("--set", "found=off", "--set", "points=0", "-o", "out.json", "-o", "out.csv", "-o", "out.ply")
        self.assertIn("object    middle: not found: told not to", text)
        self.assertIn("points    none found", text)
        with self.open("out.json") as file:
            result = json.load(file)
        self.assertEqual(result["points"], [])
        self.assertEqual((result["objects"][0]["found"], result["objects"][0]["why_not"]), (False, "told not to"))
        self.assertIsNone(result["objects"][0]["distance_m"])

    def test_a_rig_in_place_of_a_calibration(self):
        left, right, _, calibration = self.pair()
        done = self.run_command("range", left, right, "--rig", calibration, "--plugin", "middle")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines()[0], self.range().splitlines()[0])

    def test_refusals(self):
        self.refuse_range("--output is 'out.txt'; allowed extensions: .csv, .ply, .json", "-o", "out.txt")
        self.refuse_range("which is another output already", "-o", "out.csv")
        self.refuse_range("there is no folder", "-o", "no/out.json")
        self.refuse_range("there is no folder", "--pictures", "no/own")
        self.refuse_range("middle: points is '101'; allowed: whole numbers, 0 to 100", "--set", "points=101")
        self.refuse_range("middle: parameter is 'color'; allowed: fails, sigma_px", "--set", "color=1")
        self.refuse_range("middle: variant is 'x'; allowed: default, faithful", "--set", "variant=x")
        self.refuse_range("middle: told to fail", "--set", "fails=error")
        self.refuse_range("no std::exception", "--set", "fails=number")
        self.refuse_range("belongs to object 1", "--set", "fails=object")
        # Between the build's own plugins, if it has any.
        self.refuse("--plugin is 'muddle'; allowed: ", "range", *self.pair(), "--plugin", "muddle")
        self.refuse("middle", "range", *self.pair(), "--plugin", "muddle")
        self.refuse("--calib or --rig", "range", *self.pair()[:2], "--plugin", "middle", status=2)


if __name__ == "__main__":
    unittest.main()
