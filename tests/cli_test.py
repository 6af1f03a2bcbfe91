"""The pomona command from the outside: what it writes, and how it refuses bad input.

Usage: cli_test.py path/to/pomona [unittest arguments]
Every refusal must be one line on the error stream that starts with "pomona: error:" and names the culprit, with exit
status 1 (bad input, bad values) or 2 (bad usage), and must leave no output behind.
"""

import array
import json
import math
import os
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

COMMAND = os.path.abspath(sys.argv.pop(1))
OUTPUTS = ["out.pfm", "color.png", "state.png", "confidence.png", "depth.png", "cloud.ply", "error.png"]


def png(width, height, color_type, bits, pixel):
    """A PNG whose pixels are all `pixel` (bytes)."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = (b"\0" + pixel * width) * height
    header = struct.pack(">IIBBBBB", width, height, bits, color_type, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def gray(width, height, value=128):
    return png(width, height, 0, 8, bytes([value]))


def read_pfm(path):
    """Width, height and samples (rows from the top) of a little-endian one-channel PFM."""
    with open(path, "rb") as file:
        assert file.readline() == b"Pf\n"
        width, height = map(int, file.readline().split())
        assert float(file.readline()) < 0
        samples = array.array("f")
        samples.frombytes(file.read())
    if sys.byteorder == "big":
        samples.byteswap()
    assert len(samples) == width * height
    rows = [samples[y * width:(y + 1) * width] for y in reversed(range(height))]
    return width, height, [value for row in rows for value in row]


def read_png_header(path):
    """Width, height, bits per sample and colour type (0 gray, 2 colour)."""
    with open(path, "rb") as file:
        head = file.read(26)
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">IIBB", head[16:26])


class CommandTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = tempfile.mkdtemp(prefix="pomona-cli-scene-")
        subprocess.run([COMMAND, "render", "planes", "--seed", "3", "--size", "96x64", "-o", cls.scene], check=True,
                       stdout=subprocess.DEVNULL)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.scene)

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pomona-cli-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.left, self.right = self.of_scene("im0.png"), self.of_scene("im1.png")
        self.calib, self.truth = self.of_scene("calib.txt"), self.of_scene("disp0GT.pfm")

    def of_scene(self, leaf):
        return os.path.join(self.scene, leaf)

    def put(self, leaf, content):
        path = os.path.join(self.folder, leaf)
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def bytes_of(self, *leaves):
        with open(os.path.join(self.folder, *leaves), "rb") as file:
            return file.read()

    def pfm(self, leaf):
        return read_pfm(os.path.join(self.folder, leaf))

    def run_command(self, *arguments, **options):
        return subprocess.run([COMMAND, *arguments], capture_output=True, text=True, cwd=self.folder, timeout=300,
                              check=False, **options)

    def all_outputs(self):
        return ["-o", "out.pfm", "--color", "color.png", "--state", "state.png", "--confidence", "confidence.png",
                "--depth", "depth.png", "--cloud", "cloud.ply", "--error", "error.png"]

    def compute(self, *extra, left=None, right=None, **options):
        return self.run_command("compute", left or self.left, right or self.right, *extra, **options)

    def assert_refused(self, result, part, status=1):
        self.assertEqual(result.returncode, status, result.stderr)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("pomona: error: "), result.stderr)
        self.assertIn(part, lines[0])
        self.assertEqual(result.stdout, "")

    def assert_accepted(self, result):
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")

    def assert_left_alone(self, before):
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(before))

    def refuse(self, part, *extra, status=1, **views):
        """Runs compute with every output asked for, and expects a refusal that leaves the folder as it was."""
        before = os.listdir(self.folder)
        arguments = list(extra)
        for option, value in (("--calib", self.calib), ("--gt", self.truth)):
            if option not in arguments:
                arguments += [option, value]
        outputs = self.all_outputs()
        for i in range(0, len(outputs), 2):
            if outputs[i] not in arguments:
                arguments += outputs[i:i + 2]
        with self.subTest(part=part, extra=extra, views=views):
            self.assert_refused(self.compute(*arguments, **views), part, status)
            self.assert_left_alone(before)


class GoodInput(CommandTest):
    def test_every_output_is_written(self):
        result = self.compute("--calib", self.calib, "--gt", self.truth, "--timings", *self.all_outputs())
        self.assert_accepted(result)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(OUTPUTS))
        self.assertEqual(self.pfm("out.pfm")[:2], (96, 64))
        for leaf, bits, color_type in (("color.png", 8, 2), ("state.png", 8, 2), ("confidence.png", 8, 0),
                                       ("depth.png", 16, 0), ("error.png", 8, 2)):
            self.assertEqual(read_png_header(os.path.join(self.folder, leaf)), (96, 64, bits, color_type), leaf)
        for word in ("96 x 64", "ndisp of", "coverage", "balanced", "ms", "ground truth: 6144 known pixels"):
            self.assertIn(word, result.stdout)

    def test_score_is_that_of_the_written_map(self):
        result = self.compute("--gt", self.truth, "--mode", "sparse", "-o", "out.pfm")
        self.assert_accepted(result)
        found = self.pfm("out.pfm")[2]
        truth = read_pfm(self.truth)[2]
        pairs = [(d, t) for d, t in zip(found, truth) if math.isfinite(t)]
        errors = [abs(d - t) for d, t in pairs if math.isfinite(d)]
        bad = [100 * (1 - sum(e <= limit for e in errors) / len(pairs)) for limit in (1, 2)]
        self.assertIn(f"bad-1 {bad[0]:.2f} %, bad-2 {bad[1]:.2f} %", result.stdout)
        self.assertIn(f"average error {sum(errors) / len(errors):.3f} px", result.stdout)
        self.assertIn(f"coverage {100 * len(errors) / len(pairs):.2f} %", result.stdout.splitlines()[-1])

    def test_adaptive_range_is_a_stage_of_its_own(self):
        arguments = ("--calib", self.calib, "-o", "out.pfm", "--timings")
        self.assertNotIn("search range", self.compute(*arguments).stdout)
        result = self.compute(*arguments, "--adaptive-range")
        self.assert_accepted(result)
        self.assertIn("search range", result.stdout)

    def test_depth_is_focal_length_times_baseline_over_disparity(self):
        self.assert_accepted(self.compute("--calib", self.calib, "-o", "out.pfm", "--depth", "depth.pfm"))
        disparity = self.pfm("out.pfm")[2]
        depth = self.pfm("depth.pfm")[2]
        for d, z in zip(disparity, depth):
            if math.isfinite(d) and d > 0:
                self.assertAlmostEqual(z * d / (96 * 0.12), 1, places=5)
            else:
                self.assertEqual(z, math.inf)

    def test_depth_sigma_grows_with_the_square_of_depth(self):
        self.assert_accepted(self.compute("--calib", self.calib, "-o", "out.pfm", "--sigma", "sigma.pfm",
                                          "--depth-sigma", "depth_sigma.pfm"))
        for d, sigma, depth_sigma in zip(self.pfm("out.pfm")[2], self.pfm("sigma.pfm")[2],
                                         self.pfm("depth_sigma.pfm")[2]):
            if math.isfinite(d) and d > 0:
                self.assertAlmostEqual(depth_sigma / (96 * 0.12 / d / d * sigma), 1, places=4)
            else:
                self.assertEqual(depth_sigma, math.inf)

    def test_clouds_hold_the_same_points(self):
        for leaf in ("cloud.ply", "cloud.pcd"):
            self.assert_accepted(self.compute("--calib", self.calib, "-o", "out.pfm", "--cloud", leaf))
        head, body = self.bytes_of("cloud.pcd").split(b"DATA binary\n")
        self.assertIn(b"\nWIDTH 96\nHEIGHT 64\n", head)
        pcd = [p for p in struct.iter_unpack("<3fI", body)]
        self.assertEqual(len(pcd), 96 * 64)
        ply = list(struct.iter_unpack("<3f3B", self.bytes_of("cloud.ply").split(b"end_header\n")[1]))
        self.assertEqual([(x, y, z, rgb >> 16, rgb >> 8 & 255, rgb & 255) for x, y, z, rgb in pcd if z == z], ply)

    def test_open3d_reads_clouds(self):
        try:
            import open3d  # pylint: disable=import-outside-toplevel
        except ImportError:
            self.skipTest("python3-open3d is not there")
        counts = []
        for leaf in ("cloud.ply", "cloud.pcd"):
            self.assert_accepted(self.compute("--calib", self.calib, "-o", "out.pfm", "--cloud", leaf))
            cloud = open3d.io.read_point_cloud(os.path.join(self.folder, leaf), remove_nan_points=True)
            self.assertTrue(cloud.has_colors())
            counts.append(len(cloud.points))
        self.assertGreater(counts[0], 96 * 64 // 2)
        self.assertEqual(counts[0], counts[1])

    def test_rows_that_do_not_match_are_said(self):
        self.assert_accepted(self.run_command("render", "boxes", "--size", "480x320", "--right-shift", "2",
                                              "-o", "off"))
        lines = self.run_command("compute", "off/im0.png", "off/im1.png", "-o", "off.pfm").stdout.splitlines()
        rows = next(line for line in lines if line.startswith("rows"))
        self.assertRegex(rows, "right view -[12][.][0-9]+ px.*; matched after moving it; warning: .* new calibration$")

    def test_measure_says_how_far(self):
        self.assert_accepted(self.run_command("render", "boxes", "--seed", "2", "--size", "320x240", "--disparities",
                                              "48", "-o", "boxes"))
        width, height, truth = self.pfm("boxes/disp0GT.pfm")

        def spread(place):  # of the disparities around a place
            x, y = place
            window = [truth[row * width + column] for row in range(y - 12, y + 13) for column in range(x - 12, x + 13)]
            return max(window) - min(window) if min(window) > 20 else math.inf

        x, y = min(((x, y) for x in range(60, width - 12, 8) for y in range(12, height - 12, 8)), key=spread)
        views = ("measure", "boxes/im0.png", "boxes/im1.png", "--calib", "boxes/calib.txt")
        box = f"{x - 12},{y - 12},25,25"
        polygon = f"{x - 9},{y - 9},{x + 9},{y - 9},{x + 9},{y + 9},{x - 9},{y + 9}"
        arguments = (*views, "--shape", "surface", "--box", box, "--circle", f"{x},{y},12", "--polygon", polygon,
                     "--point", f"{x},{y}")
        with open(os.path.join(self.folder, "boxes", "calib.txt"), encoding="ascii") as file:
            focal = float(file.read().split("cam0=[")[1].split()[0])
        true_m = focal * 0.12 / truth[y * width + x]
        result = self.run_command(*arguments, "--json")
        self.assert_accepted(result)
        entries = json.loads(result.stdout)
        self.assertEqual([entry["region"].split()[0] for entry in entries], ["box", "circle", "polygon", "point"])
        for entry in entries:
            self.assertAlmostEqual(entry["near_point_m"][2] / true_m, 1, delta=0.03)
            self.assertGreater(entry["distance_sigma_m"], 0)
        lines = self.run_command(*arguments).stdout.splitlines()
        self.assertEqual(len(lines), 4)
        self.assertTrue(lines[0].startswith(f"box {box}: {entries[0]['distance_m']:.4f} +- "), lines[0])
        azimuth, elevation = (math.degrees(entries[0][key]) for key in ("azimuth_rad", "elevation_rad"))
        self.assertIn(f", {abs(azimuth):.2f} deg {'left' if azimuth < 0 else 'right'}, "
                      f"{abs(elevation):.2f} deg {'down' if elevation < 0 else 'up'}, ", lines[0])
        exchanged = self.run_command("measure", views[2], views[1], *views[3:], "--box", box, "--json")
        self.assertRegex(exchanged.stderr, "^pomona: warning: whether the views' rows match is unknown.*\n$")
        self.assertEqual(len(json.loads(exchanged.stdout)), 1)
        self.assert_accepted(self.run_command("render", "boxes", "--size", "640x480", "--right-shift", "2", "-o", "off"))
        off = self.run_command("measure", "off/im0.png", "off/im1.png", "--calib", "off/calib.txt", "--point", "320,240")
        self.assertRegex(off.stderr, "^pomona: warning: the right view is -[12][.][0-9]+ rows off.*; it was moved: .*\n$")
        corners = self.run_command(*views, *(f"--box={width * i // 4 - 15},{height * j // 4 - 15},31,31"
                                             for i in (1, 3) for j in (1, 3)), "--shape", "surface").stdout
        for side in (" deg left", " deg right", " deg up", " deg down"):
            self.assertIn(side, corners)
        self.assertNotRegex(corners, "-[0-9.]+ deg")
        outside = self.run_command(*views, "--box", "500,500,9,9")
        self.assertEqual(outside.stdout, "box 500,500,9,9: not measured: the region holds no pixel of the image\n")
        self.assertEqual((outside.returncode, outside.stderr), (3, ""))
        self.assertEqual(self.run_command(*views, "--point", f"{x},{y}", "--box", "500,500,9,9", "--json").returncode, 0)
        scattered = self.run_command(*views, "--box", box, "--radius", "3.8,0.6")  # centimetres
        self.assertEqual(scattered.returncode, 3)
        self.assertIn("agree on one surface, a sphere's of radius 3.8 +- 0.6 mm", scattered.stdout)

    def test_formats_by_extension_and_flag(self):
        self.assert_accepted(self.compute("-o", "kitti.png", "--state", "state.pgm", "--confidence", "c.pfm"))
        self.assert_accepted(self.compute("-o", "x16.png", "--opencv-png"))
        for leaf in ("kitti.png", "x16.png"):
            self.assertEqual(read_png_header(os.path.join(self.folder, leaf)), (96, 64, 16, 0))
        self.assertNotEqual(self.bytes_of("kitti.png"), self.bytes_of("x16.png"))
        self.assertTrue(set(self.bytes_of("state.pgm")[-96 * 64:]) <= {0, 1, 2, 3, 4, 16, 17, 18, 19, 20, 21})
        self.assertEqual(self.pfm("c.pfm")[:2], (96, 64))

    def test_range_is_estimated_and_printed_without_calibration(self):
        result = self.compute("-o", "out.pfm")
        self.assert_accepted(result)
        self.assertIn("(estimate)", result.stdout)

    def test_range_holds_the_disparities_from_min_to_below_max(self):
        result = self.compute("-o", "out.pfm", "--min-disparity", "-3", "--max-disparity", "5")
        self.assert_accepted(result)
        self.assertIn("-3 to 4 px", result.stdout)
        known = [d for d in self.pfm("out.pfm")[2] if math.isfinite(d)]
        self.assertTrue(all(-4 < d < 5 for d in known))

    def test_masked_pixels_stay_unknown(self):
        mask = self.put("mask.png", gray(96, 64, 0))
        self.assert_accepted(self.compute("-o", "out.pfm", "--mask", mask))
        self.assertEqual(set(self.pfm("out.pfm")[2]), {math.inf})

    def test_existing_outputs_are_replaced(self):
        self.put("out.pfm", "old")
        self.assert_accepted(self.compute("-o", "out.pfm"))
        self.assertEqual(self.pfm("out.pfm")[:2], (96, 64))
        self.assert_left_alone(["out.pfm"])

    def test_same_bytes_for_any_thread_count(self):
        maps = []
        for threads in ("1", "2", "3", "7"):
            self.assert_accepted(self.compute("-o", "out.pfm", "--threads", threads))
            maps.append(self.bytes_of("out.pfm"))
        self.assertEqual(len(set(maps)), 1)

    def test_tiny_and_constant_images_give_a_map_or_a_clear_error(self):
        for width, height in ((1, 1), (1, 40), (40, 1), (2, 2), (96, 64)):
            with self.subTest(width=width, height=height):
                image = self.put("tiny.png", gray(width, height))
                result = self.compute("-o", "out.pfm", left=image, right=image)
                if result.returncode == 0:
                    self.assertEqual(self.pfm("out.pfm")[:2], (width, height))
                    os.remove(os.path.join(self.folder, "out.pfm"))
                else:
                    self.assert_refused(result, "")
                    self.assert_left_alone(["tiny.png"])

    def test_version_info_and_help(self):
        self.assertRegex(self.run_command("--version").stdout, r"^pomona \d+\.\d+\.\d+\n$")
        info = self.run_command("info")
        self.assert_accepted(info)
        for word in ("CPU", "scalar", "chosen", "threads"):
            self.assertIn(word, info.stdout)
        text = self.run_command("compute", "--help")
        self.assert_accepted(text)
        self.assertIn("[min, max)", text.stdout)

    def test_rendered_scene_is_complete_and_repeatable(self):
        for folder in ("a", "b"):
            self.assert_accepted(self.run_command("render", "trees", "--seed", "9", "--size", "48x32", "-o", folder))
        leaves = sorted(os.listdir(os.path.join(self.folder, "a")))
        self.assertEqual(leaves, ["calib.txt", "disp0GT.pfm", "disp1GT.pfm", "im0.png", "im1.png", "mask0nocc.png",
                                  "mask1nocc.png"])
        for leaf in leaves:
            self.assertEqual(self.bytes_of("a", leaf), self.bytes_of("b", leaf), leaf)

    def test_rendered_orchard_lists_its_fruits(self):
        self.assert_accepted(self.run_command(
            "render", "orchard", "--rig", "seed-003-b60", "--size", "96x54", "--distance", "1..1.2", "--fruits", "4",
            "--shot-noise", "3", "--read-noise", "1", "--blur", "0.5", "--vignetting", "0.2", "--exposure", "0.9",
            "--right-gain", "1.05", "--right-shift", "0.5", "--lens", "--bits", "16", "-o", "orchard"))
        self.assertEqual(read_png_header(os.path.join(self.folder, "orchard", "im0.png"))[:3], (96, 54, 16))
        self.assertEqual(read_png_header(os.path.join(self.folder, "orchard", "fruits0.png"))[:3], (96, 54, 16))
        fruits = json.loads(self.bytes_of("orchard", "fruits.json"))["fruits"]
        self.assertEqual([fruit["id"] for fruit in fruits], [1, 2, 3, 4])
        for fruit in fruits:
            self.assertTrue(1 <= fruit["center_m"][2] <= 1.2)
            self.assertAlmostEqual(fruit["distance_m"], math.dist(fruit["center_m"], (0, 0, 0)))
            self.assertTrue(0.02 < fruit["distance_m"] - fruit["near_distance_m"] <= fruit["radius_m"])
            self.assertTrue(0 <= fruit["visible_share"] <= 1)
        # What was written are views of the rig beside them, which rectify to the truth's geometry.
        self.assert_accepted(self.run_command("rectify", "orchard/im0.png", "orchard/im1.png", "--rig",
                                              "orchard/rig.yml", "-o", "rectified"))

    def test_rendered_storefront_lists_its_signs(self):
        self.assert_accepted(self.run_command("render", "storefront", "--size", "96x54", "--walls", "1", "--yaw", "-30",
                                              "--distance", "3", "-o", "street"))
        signs = json.loads(self.bytes_of("street", "signs.json"))["signs"]
        self.assertEqual(len(signs), 3)
        for sign in signs:
            self.assertEqual(sign["yaw_deg"], -30)
            left, top, width, height = sign["box_px"]
            for x, y in sign["corners_px"]:
                self.assertTrue(left - 1 <= x <= left + width and top - 1 <= y <= top + height)


class BadViews(CommandTest):
    def test_missing_empty_truncated_foreign(self):
        whole = self.bytes_of(self.left)
        damaged = bytearray(whole)
        damaged[len(damaged) // 2] ^= 0xff
        self.refuse("absent.png", left="absent.png")
        self.refuse("absent.png", right="absent.png")
        self.refuse(self.folder, left=self.folder)
        self.refuse("empty.png: byte 0", left=self.put("empty.png", b""))
        for size in (9, 40, len(whole) // 2, len(whole) - 5):
            self.refuse(f"cut.png: byte {size}", right=self.put("cut.png", whole[:size]))
        self.refuse("damaged.png", left=self.put("damaged.png", bytes(damaged)))
        self.refuse("text.png", left=self.put("text.png", "this is no image\n" * 9))

    def test_sizes_and_types(self):
        self.refuse("narrow.png: is 95x64", right=self.put("narrow.png", png(95, 64, 2, 8, b"abc")))
        self.refuse("low.png: is 96x63", right=self.put("low.png", png(96, 63, 2, 8, b"abc")))
        self.refuse("alpha.png: has 4 channels", left=self.put("alpha.png", png(96, 64, 6, 8, b"abcd")))
        self.refuse("gray.png: has 1 channel", right=self.put("gray.png", gray(96, 64)))
        self.refuse("deep.png: has 3 channels of 16", right=self.put("deep.png", png(96, 64, 2, 16, b"abcdef")))
        self.refuse("disp0GT.pfm: has 1 channel of 32-bit floats", left=self.truth)

    def test_mask(self):
        self.refuse("absent.png", "--mask", "absent.png")
        self.refuse("mask.png: is 10x64", "--mask", self.put("mask.png", gray(10, 64)))
        self.refuse("bgr.png: has 3 channels", "--mask", self.put("bgr.png", png(96, 64, 2, 8, b"abc")))


class BadSideFiles(CommandTest):
    def test_calibration(self):
        cam0 = "cam0=[96 0 47.5; 0 96 31.5; 0 0 1]\ndoffs=0\n"
        self.refuse("absent.txt", "--calib", "absent.txt")
        for text, part in (("", "no known calibration"), (cam0, "line 2: the file ends without 'baseline='"),
                           (cam0 + "baseline=-1\n", "line 3: baseline is '-1'"),
                           (cam0 + "baseline=120\nwidth=1482\nheight=64\n", "is for images of 1482x64"),
                           (cam0 + "baseline=120\nwidth=96\n", "line 4: the file ends without 'height='"),
                           (cam0 + "baseline=120\nndisp=97\n", "ndisp of"),
                           ("\x00\xff\x01", "control character")):
            self.refuse(part, "--calib", self.put("calib.txt", text))

    def test_ground_truth(self):
        whole = self.bytes_of(self.truth)
        self.refuse("absent.pfm", "--gt", "absent.pfm")
        self.refuse("gt.pfm: byte 0", "--gt", self.put("gt.pfm", b""))
        self.refuse("gt.pfm: byte 1000", "--gt", self.put("gt.pfm", whole[:1000]))
        self.refuse("gt.pfm: byte 14", "--gt", self.put("gt.pfm", "Pf\n2000000000 2000000000\n-1\n"))
        self.refuse("gt.pfm: is 1x1", "--gt", self.put("gt.pfm", b"Pf\n1 1\n-1\n\0\0\0\0"))
        self.refuse("gt.tif", "--gt", self.put("gt.tif", whole))


class BadOptions(CommandTest):
    def test_range(self):
        self.refuse("--max-disparity", "--max-disparity", "0")
        self.refuse("holds -20 disparities; allowed: 1 to 96", "--max-disparity", "-20")
        self.refuse("holds 97 disparities", "--max-disparity", "97")
        self.refuse("holds 2147483647", "--max-disparity", "2147483647")
        self.refuse("holds 0 disparities", "--min-disparity", "5", "--max-disparity", "5")
        self.refuse("holds 4294967295", "--min-disparity", "-2147483648", "--max-disparity", "2147483647")

    def test_values_the_engine_refuses(self):
        self.refuse("best", "--preset", "best")
        self.refuse("sse9", "--isa", "sse9")
        self.refuse("threads is -1", "--threads", "-1")
        self.refuse("threads is 5000", "--threads", "5000")
        self.refuse("adaptive_range is on", "--adaptive-range", "--preset", "paper")

    def test_usage(self):
        self.refuse("--mode", "--mode", "thick")
        self.refuse("allowed: sparse", "--min-confidence", "0.9")
        self.refuse("validation.min_confidence is nan", "--mode", "sparse", "--min-confidence", "nan")
        self.refuse("--max-disparity", "--max-disparity", "many")
        self.refuse("--max-disparity = nan; allowed: a number", "--max-disparity", "nan")
        self.refuse("--max-disparity", "--max-disparity", "99999999999")
        self.refuse("--nonsense", "--nonsense", status=2)
        self.assert_refused(self.run_command(), "compute, measure, eval, compare, range, plugins, calibrate, rig, rectify, check, "
                            "render", 2)
        self.assert_refused(self.run_command("guess", "-o", "x"), "there is no verb 'guess'; allowed: compute,", 2)
        self.assert_refused(self.run_command("compute"), "left", 2)
        self.assert_refused(self.run_command("compute", self.left, self.right), "--output", 2)
        self.assert_refused(self.compute("-o", "out.pfm", "--depth", "d.pfm"), "--calib", 2)
        self.assert_refused(self.compute("-o", "out.pfm", "--cloud", "c.ply"), "--calib", 2)
        self.assert_refused(self.compute("-o", "out.pfm", "--depth-sigma", "s.pfm"), "--calib", 2)
        self.assert_refused(self.compute("-o", "out.pfm", "--error", "e.png"), "--gt", 2)
        self.assert_left_alone([])

    def measure(self, *arguments):
        return self.run_command("measure", self.left, self.right, "--calib", self.calib, *arguments)

    def test_measure(self):
        for arguments, part in ((("--box", "1,2,3"), "--box is '1,2,3'"), (("--box", "1,2,3,4,"), "1,2,3,4,"),
                                (("--box", "nan,1,2,3"), "nan"), (("--box", "1e12,1,2,3"), "1e12"),
                                (("--box", "1,2,0,4"), "box is empty"), (("--circle", "5,5,-1"), "radius"),
                                (("--polygon", "1,2,3"), "--polygon"), (("--polygon", "1,2,3,4"), "three corners"),
                                (("--mask", "absent.png"), "absent.png"), (("--point", "5"), "--point"),
                                (("--box", "1,1,9,9", "--radius", "30"), "--radius"),
                                (("--box", "1,1,9,9", "--radius", "-30,4"), "--radius is '-30,4'; allowed"),
                                (("--box", "1,1,9,9", "--radius", "0,0"), "--radius is '0,0'; allowed"),
                                (("--box", "1,1,9,9", "--radius", "0.038,0.006"), "allowed: RADIUS,SIGMA in mm, from 1"),
                                (("--box", "1,1,9,9", "--radius", "38,0.006"), "allowed: RADIUS,SIGMA in mm, from 1"),
                                (("--box", "1,1,9,9", "--radius", "38000,6000"), "allowed: RADIUS,SIGMA in mm, from 1"),
                                (("--box", "1,1,9,9", "--radius", "38,6", "--shape", "surface"), "--shape is 'surface'")):
            self.assert_refused(self.measure(*arguments), part)
        self.assert_refused(self.measure(), "--box", 2)
        self.assert_refused(self.run_command("measure", self.left, self.right, "--box", "1,1,9,9"), "--calib", 2)
        self.assert_left_alone([])

    def test_render(self):
        for arguments, part in ((("forest",), "scene is 'forest'; allowed: orchard, storefront, indoor, chessboard, boxes, "
                                              "planes, spheres, trees"), (("boxes", "--size", "640"), "640"),
                                (("boxes", "--right-shift", "nan"), "right_shift_px is nan; allowed: -480 to 480"),
                                (("boxes", "--right-shift", "481"), "right_shift_px is 481"),
                                (("chessboard", "--rig", "seed-003", "--noise", "nan"), "--noise is nan"),
                                (("chessboard", "--rig", "seed-003", "--square", "-5"), "--square is -5"),
                                (("boxes", "--size", "8x8"), "width is 8"),
                                (("boxes", "--size", "64x99999"), "height is 99999"),
                                (("boxes", "--disparities", "999"), "999"),
                                (("boxes", "--distance", "1..2"), "--distance is no option of the scene 'boxes'"),
                                (("boxes", "--lens"), "--lens needs --rig"),
                                (("orchard", "--walls", "2"), "--walls is no option"),
                                (("chessboard", "--rig", "seed-003", "--blur", "1"), "--blur is no option"),
                                (("orchard", "--rig", "seed-004"), "seed-004"),
                                (("orchard", "--distance", "near"), "--distance is 'near'"),
                                (("orchard", "--distance", "0.1..1"), "nearest_m is 0.1; allowed: 0.3 to 10"),
                                (("orchard", "--distance", "1..0.5"), "farthest_m is 0.5; allowed: 1 to 10"),
                                (("orchard", "--fruits", "201"), "fruits is 201"),
                                (("orchard", "--blur", "much"), "--blur"),
                                (("orchard", "--size", "64x36", "--blur", "11"), "blur_px is 11; allowed: 0 to 10"),
                                (("orchard", "--size", "64x36", "--bits", "12"), "bits is 12"),
                                (("orchard", "--size", "8x8"), "width is 8; allowed: 16 to 8192"),
                                (("storefront", "--yaw", "-70..0"), "least_yaw_deg is -70")):
            self.assert_refused(self.run_command("render", *arguments, "-o", "scene"), part)
        self.put("file", "cam0=[900 0 300; 0 900 200; 0 0 1]\ndoffs=0\nbaseline=100\n")
        for size in ((), ("--size", "64x36")):
            self.assert_refused(self.run_command("render", "planes", "--rig", "file", *size, "-o", "scene"),
                                "file: the rig's image size is unknown")
        for output, part in (("file", "file: cannot be written: this is a file; allowed: a folder"),
                             ("file/sub", "there is no folder 'file'"), ("no/where", "there is no folder 'no'"),
                             ("", "this names no folder")):
            for verb in (("render", "boxes", "--size", "16x16"),
                         ("rectify", self.left, self.right, "--rig", self.calib)):
                self.assert_refused(self.run_command(*verb, "-o", output), part)
        for seed in ("x", "-1", "1.5", "1" + 18 * "0"):
            self.assert_refused(self.run_command("render", "boxes", "--seed", seed, "-o", "scene"),
                                f"--seed: is '{seed}'; allowed: a whole number")
        self.assert_left_alone(["file"])


class BadOutputs(CommandTest):
    def test_places(self):
        os.mkdir(os.path.join(self.folder, "sub"))
        self.refuse("absent/out.pfm", "-o", "absent/out.pfm")
        self.refuse("sub.pfm/x.png", "--color", "sub.pfm/x.png")
        self.refuse("/proc/out.pfm", "-o", "/proc/out.pfm")
        os.mkdir(os.path.join(self.folder, "folder.ply"))
        self.refuse("folder.ply", "--cloud", "folder.ply")
        self.refuse("n" * 300, "--error", "n" * 300 + ".png")

    def test_formats(self):
        for option, name in (("-o", "out.tif"), ("-o", "out"), ("--color", "a.jpg"), ("--state", "a.pfm"),
                             ("--confidence", "a.ply"), ("--depth", "a.exr"), ("--cloud", "a.obj"), ("--depth-sigma", "a.png"),
                             ("--error", "a.pfm")):
            self.refuse(f"'{name}'", option, name)
        self.refuse("--opencv-png", "--opencv-png")

    def test_names_that_collide(self):
        self.refuse("same.png', which is another output", "--color", "same.png", "--error", "./same.png")
        copy = os.path.join(self.folder, "left.png")
        shutil.copy(self.left, copy)
        self.refuse("which is an input", "--color", "left.png", left=copy)
        os.symlink(copy, os.path.join(self.folder, "link.png"))
        self.refuse("which is an input", "--color", "link.png", left=copy)
        self.assertEqual(self.bytes_of("left.png"), self.bytes_of(self.left))

    def test_negative_disparities_do_not_fit_a_png(self):
        image = self.put("constant.png", gray(40, 30))
        result = self.compute("-o", "out.png", "--min-disparity", "-8", "--max-disparity", "0", "--color", "c.png",
                              left=image, right=image)
        if result.returncode != 0:  # unless nothing was measured at all
            self.assert_refused(result, "out.png: disparity at x")
            self.assert_left_alone(["constant.png"])

    def test_file_size_limit(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, resource.RLIM_INFINITY))

        self.put("color.png", "old")
        result = self.compute("--calib", self.calib, "--gt", self.truth, *self.all_outputs(), preexec_fn=limit)
        self.assert_refused(result, "out.pfm: cannot be written: File too large")
        self.assert_left_alone(["color.png"])
        self.assertEqual(self.bytes_of("color.png"), b"old")

    def test_full_disk(self):
        disk = os.path.join(self.folder, "disk")
        os.mkdir(disk)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=48k", "tmpfs", disk], capture_output=True,
                                 check=False)
        if mounted.returncode != 0:
            self.skipTest("needs the right to mount a small tmpfs; test_file_size_limit stands in for it")
        try:
            result = self.compute("--calib", self.calib, "-o", "disk/out.pfm", "--color", "disk/color.png", "--cloud",
                                  "disk/cloud.ply")
            self.assert_refused(result, "cannot be written: No space left on device")
            self.assertEqual(os.listdir(disk), [])
            result = self.run_command("render", "boxes", "--size", "200x200", "-o", "disk/scene")
            self.assert_refused(result, "No space left on device")
            self.assertEqual(os.listdir(disk), [])
        finally:
            subprocess.run(["umount", disk], check=True)

    def test_standard_output_that_cannot_be_written(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run([COMMAND, "info"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (1, "pomona: error: standard output: cannot be written\n"))


if __name__ == "__main__":
    unittest.main()
