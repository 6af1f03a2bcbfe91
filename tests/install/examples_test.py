"""Runs the examples, built against the installed library, on rendered frames, and checks what they measure.

Usage: examples_test.py POMONA HARVEST_ROBOT COMPUTE_DISPARITY, all paths of programs, and PLUGIN, the folder of one
"""

import array
import csv
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

POMONA, HARVEST, COMPUTE, PLUGIN = sys.argv[1:]
PICK = re.compile(r"frame (\d+)  box [\d,]+  ([\d.]+) \+- ([\d.]+) m  centre \((\S+), (\S+), (\S+)\) m  radius")


def run(*arguments, **options):
    return subprocess.run(arguments, check=True, capture_output=True, text=True, timeout=300, **options).stdout


def refusal(*arguments, status=1, **environment):
    merged = {name: value for name, value in {**os.environ, **environment}.items() if value is not None}
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=300, env=merged)
    assert done.returncode == status and done.stdout == "", done
    return done.stderr


def distances_once(picks, fruits):
    """Which fruits the picks' centres lie in, and how far off each distance is; asserts that none lies elsewhere."""
    found = {}
    for _, distance, _, x, y, z in picks:
        inside = [fruit for fruit in fruits if math.dist(fruit["center_m"], (float(x), float(y), float(z))) <
                  fruit["radius_m"] * 0.7]
        assert len(inside) == 1 and inside[0]["id"] not in found, picks
        found[inside[0]["id"]] = abs(float(distance) / inside[0]["near_distance_m"] - 1)
    return found


def read_pfm(path):
    with open(path, "rb") as file:
        file.readline()
        width, height = map(int, file.readline().split())
        file.readline()
        samples = array.array("f")
        samples.frombytes(file.read())
    return [samples[y * width:(y + 1) * width] for y in reversed(range(height))]


def read_calibration(path):
    with open(path, encoding="ascii") as file:
        values = dict(line.strip().split("=", 1) for line in file if "=" in line)
    focal, _, cx, _, _, cy = map(float, re.findall(r"[-\d.]+", values["cam0"])[:6])
    return focal, cx, cy, float(values["baseline"]) / 1000, int(values["ndisp"])


with tempfile.TemporaryDirectory() as folder:
    frames = os.path.join(folder, "frames")
    drawn = os.path.join(folder, "drawn")
    os.mkdir(frames)
    os.mkdir(drawn)
    truths = []
    for frame in range(2):
        scene = os.path.join(folder, f"scene{frame}")
        run(POMONA, "render", "trees", "--seed",
            str(frame + 1), "--size", "800x500", "--disparities", "96", "-o", scene)
        shutil.copy(os.path.join(scene, "im0.png"), os.path.join(frames, f"left{frame}.png"))
        shutil.copy(os.path.join(scene, "im1.png"), os.path.join(frames, f"right{frame}.png"))
        truths.append(read_pfm(os.path.join(scene, "disp0GT.pfm")))
    calibration = os.path.join(scene, "calib.txt")
    focal, cx, cy, baseline, disparities = read_calibration(calibration)

    nearest, farthest = focal * baseline / disparities, focal * baseline / 10
    text = run(HARVEST, calibration, frames, drawn,
               env={**os.environ, "HARVEST_NEAREST_M": str(nearest), "HARVEST_FARTHEST_M": str(farthest)})
    print(text, end="")
    errors = []
    for frame, distance, sigma, x, y, z in PICK.findall(text):
        x, y, z = float(x), float(y), float(z)
        true = truths[int(frame)][round(cy + focal * y / z)][round(cx + focal * x / z)]
        along = math.sqrt(x * x + y * y + z * z) / z
        errors.append(abs(float(distance) / (focal * baseline / true * along) - 1))
        assert 0 < float(sigma) < 0.05 * float(distance), text
    assert len(errors) >= 6, text
    assert statistics.median(errors) < 0.01, errors
    assert "frames per second, reading and drawing included; latency p50" in text, text
    assert sorted(os.listdir(drawn)) == ["frame0000.jpg", "frame0001.jpg"]

    # Views that are exchanged have no partners: that rows are unknown is said once.
    exchanged = os.path.join(folder, "exchanged")
    os.mkdir(exchanged)
    for name in os.listdir(frames):
        other = name.replace("left", "Right").replace("right", "left").lower()
        shutil.copy(os.path.join(frames, name), os.path.join(exchanged, other))
    text = run(HARVEST, calibration, exchanged)
    assert text.count("unknown whether rows match") == 1 and "frame 1" in text, text

    # Fruits that touch, of one colour and behind leaves: each is on the list, and once.
    orchard = os.path.join(folder, "orchard")
    run(POMONA, "render", "orchard", "--seed", "11", "--distance", "1..1.2", "-o", orchard)
    for side, view in (("left", "im0.png"), ("right", "im1.png")):
        os.rename(os.path.join(orchard, view), os.path.join(orchard, side + ".png"))
    with open(os.path.join(orchard, "fruits.json"), encoding="ascii") as file:
        fruits = json.load(file)["fruits"]
    found = distances_once(PICK.findall(run(HARVEST, os.path.join(orchard, "calib.txt"), orchard)), fruits)
    assert {fruit["id"] for fruit in fruits if fruit["visible_share"] >= 0.3} <= found.keys(), found
    assert max(found.values()) < 0.01, found

    for nearest, part in (("abc", "HARVEST_NEAREST_M is 'abc'"), ("3", "HARVEST_FARTHEST_M is 3 to 1.98 m"),
                          ("0.02", "at most 1024 disparities"), ("1e-300", "is '1e-300'; allowed: 0.01 to 1000")):
        assert part in refusal(HARVEST, calibration, frames, HARVEST_NEAREST_M=nearest), part
    for source in ("99999999999", ""):
        assert f"{source}: no folder, no video and no camera" in refusal(HARVEST, calibration, source), source
    for place in (os.path.join(folder, "absent"), calibration):
        assert "is no folder that can be written to" in refusal(HARVEST, calibration, frames, place), place
    assert "there is no display" in refusal(HARVEST, calibration, frames, "window", DISPLAY=None, WAYLAND_DISPLAY=None)
    capitals = os.path.join(folder, "capitals")
    os.mkdir(capitals)
    for name in ("left0.PNG", "right0.PNG"):
        shutil.copy(os.path.join(frames, name.lower()[:-4] + ".png"), os.path.join(capitals, name))
    assert "frame 0" in run(HARVEST, calibration, capitals)
    unequal = os.path.join(folder, "unequal")
    os.mkdir(unequal)
    for name in ("left0.png", "left1.png", "right1.png", "right2.png"):  # as many of each side, but no pairs
        shutil.copy(os.path.join(frames, "left0.png"), os.path.join(unequal, name))
    assert "left0.png has no right0.png" in refusal(HARVEST, calibration, unequal)
    os.remove(os.path.join(unequal, "left0.png"))
    assert "right2.png has no left2.png" in refusal(HARVEST, calibration, unequal)
    assert "usage: compute_disparity LEFT" in refusal(COMPUTE, status=2)
    views = (os.path.join(frames, "left0.png"), os.path.join(frames, "right0.png"))
    assert "absent/out.png: cannot be written" in refusal(COMPUTE, *views, "absent/out.png")
    assert "compute_disparity: left is an empty image" in refusal(COMPUTE, "absent.png", "absent.png", "out.png")

    out = os.path.join(folder, "disparity.png")
    run(COMPUTE, os.path.join(frames, "left0.png"), os.path.join(frames, "right0.png"), out)
    # pomona itself reads it as the truth of its own map.
    text = run(POMONA, "compute", os.path.join(frames, "left0.png"), os.path.join(frames, "right0.png"), "-o",
               os.path.join(folder, "own.pfm"), "--gt", out)
    assert float(re.search(r"average error ([\d.]+) px", text).group(1)) < 0.01, text

    points = os.path.join(folder, "points.csv")
    text = run(POMONA, "range", os.path.join(frames, "left1.png"), os.path.join(frames, "right1.png"), "--calib",
               calibration, "--plugin", "corners", "--set", "count=100", "-o", points,
               env={**os.environ, "POMONA_PLUGIN_PATH": PLUGIN})
    with open(points, encoding="ascii", newline="") as file:
        rows = list(csv.DictReader(file))
    assert 30 <= len(rows) <= 100 and re.search(r"corners +100\b", text), text
    off = [abs(float(row["disparity_px"]) - truths[1][int(row["left_y_px"])][int(row["left_x_px"])]) for row in rows]
    assert statistics.median(off) < 1, off  # corners of leaves: half of each is background
    assert all(abs(float(row["z_m"]) * float(row["disparity_px"]) / (focal * baseline) - 1) < 1e-4 for row in rows)
print(f"{len(rows)} corners by an outside plugin, median error {statistics.median(off):.3f} px")
print(f"{len(errors)} fruits, median error {100 * statistics.median(errors):.2f} %")
