#!/usr/bin/env python3
"""Computes every figure of pomona/evaluation.h once more, with numpy, and compares.

usage: metrics.py POMONA METRICS_DUMP [SCENES]

On rendered scenes always, and on the Middlebury-layout scenes below SCENES if that folder is there: dense and sparse
maps of the command, whole, and at a half and a quarter of the size. Figures must agree to 1e-9. Exits with 77
(skipped) where no Python with numpy is found.
"""

import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

try:
    import numpy as np
except ImportError:
    if os.path.realpath(sys.executable) != os.path.realpath("/usr/bin/python3") and os.path.exists("/usr/bin/python3"):
        os.execv("/usr/bin/python3", ["/usr/bin/python3", *sys.argv])
    print("skipped: no Python with numpy (package python3-numpy)")
    sys.exit(77)

TOLERANCE = 1e-9
F32 = np.float32


def read_pfm(path):
    with open(path, "rb") as file:
        kind, (width, height), scale = file.readline(), map(int, file.readline().split()), float(file.readline())
        assert kind.strip() == b"Pf", path
        values = np.frombuffer(file.read(), "<f4" if scale < 0 else ">f4").reshape(height, width)
    return values[::-1].astype(F32)


def write_pfm(path, values):
    with open(path, "wb") as file:
        file.write(b"Pf\n%d %d\n-1\n" % values.shape[::-1])
        file.write(values[::-1].astype("<f4").tobytes())


def read_gray_png(path):
    """8-bit gray, not interlaced, as the PNG specification describes it."""
    data = Path(path).read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert (depth, color, interlaced) == (8, 0, 0), path
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, width + 1)
    image = np.zeros((height + 1, width + 1), np.int64)  # with a row and a column of zeros before it
    for y in range(height):
        method, line, above, out = rows[y, 0], rows[y, 1:].tolist(), image[y].tolist(), [0] * (width + 1)
        for x in range(1, width + 1):
            a, b, c = out[x - 1], above[x], above[x - 1]
            p = a + b - c
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            out[x] = (line[x - 1] + (0, a, b, (a + b) // 2, nearest)[method]) & 255
        image[y + 1] = out
    return image[1:, 1:]


def percent(part, whole):
    return 100.0 * float(part) / float(whole) if whole else None


def root(value):
    return None if value is None else float(np.sqrt(value))


def mean(values):
    return float(np.mean(values.astype(np.float64))) if values.size else None


def compared(disparity, truth, mask):
    """Of the pixels that count: disparity in pixels of the truth, and truth."""
    counts = np.isfinite(truth)
    if mask is not None:
        counts &= mask == 255
    return disparity[counts], truth[counts]


def error_figures(prefix, disparity, truth, mask, clip=None, largest=None):
    ratio = truth.shape[0] // disparity.shape[0]
    large = np.repeat(np.repeat(disparity, ratio, axis=0), ratio, axis=1)
    d, t = compared(large, truth, mask)
    d = np.where(np.isfinite(d), d, F32(np.nan))
    if largest is not None:
        d = np.where(np.abs(d) <= largest, d, F32(np.nan))
    d = d * F32(ratio)
    if clip is not None:
        d = np.clip(d, F32(0), F32(clip * ratio))
    found = ~np.isnan(d)
    error = np.sort(np.abs(d[found] - t[found]))
    n, m = d.size, error.size
    figures = {"known": n, "invalid": percent(n - m, n), "coverage": percent(m, n), "avgerr": mean(error),
               "rms": root(mean(error.astype(np.float64) ** 2))}
    for i, threshold in enumerate((0.5, 1, 2, 4)):
        wrong = np.count_nonzero(error > threshold)
        figures[f"bad{i}"] = percent(wrong, n)
        figures[f"totbad{i}"] = percent(wrong + n - m, n)
        figures[f"wrong{i}"] = percent(wrong, m)
    for quantile in (50, 90, 95, 99):
        figures[f"A{quantile}"] = float(error[m * quantile // 100]) if m else None
    return {prefix + key: value for key, value in figures.items()}


def kitti_figures(disparity, truth, objects):
    known, found = np.isfinite(truth), np.isfinite(disparity)
    with np.errstate(invalid="ignore"):
        error = np.abs(disparity - truth).astype(np.float64)
        outlier = known & found & (error > 3) & (20 * error > np.abs(truth.astype(np.float64)))
    foreground = np.zeros(truth.shape, bool) if objects is None else objects != 0

    def d1(region):
        return percent(np.count_nonzero(region & (outlier | ~found)), np.count_nonzero(region))

    return {"kitti.bg": d1(known & ~foreground), "kitti.fg": d1(known & foreground), "kitti.all": d1(known),
            "kitti.found": percent(np.count_nonzero(outlier), np.count_nonzero(known & found))}


def curve_figures(disparity, confidence, truth, mask):
    """The expected number of wrong pixels among the k most confident ones, straight from its definition."""
    d, t = compared(disparity, truth, mask)
    c, _ = compared(confidence, truth, mask)
    found = np.isfinite(d)
    wrong = (np.abs(d[found] - t[found]) > 1).astype(np.float64)
    c = c[found].astype(np.float64)
    n = wrong.size
    if not n:
        return {"curve.area": None, "curve.oracle_area": None}
    levels = np.unique(c)[::-1]
    group = np.searchsorted(-levels, -c)
    size, bad = np.bincount(group), np.bincount(group, wrong)
    share = np.repeat(bad / size, size)  # of each rank
    kept = np.arange(1, n + 1)
    curve = 100 * np.cumsum(share) / kept
    oracle = 100 * np.maximum(0, kept - (n - wrong.sum())) / kept
    figures = {"curve.area": mean(curve), "curve.oracle_area": mean(oracle)}
    steps = min(7, n)
    for i in range(steps):
        k = n * (i + 1) // steps
        figures[f"curve.coverage{i}"] = percent(k, d.size)
        figures[f"curve.wrong{i}"] = float(curve[k - 1])
        figures[f"curve.oracle{i}"] = float(oracle[k - 1])
    return figures


def subpixel_figures(disparity, truth, mask):
    d, t = compared(disparity, truth, mask)
    with np.errstate(invalid="ignore"):
        inlier = np.isfinite(d) & (np.abs(d - t) <= 1)
    error, t = (d - t)[inlier].astype(np.float64), t[inlier].astype(np.float64)
    part = ((t - np.floor(t)) * 8).astype(int)
    figures = {"subpixel.bias": mean(error), "subpixel.rms": root(mean(error**2))}
    for i in range(8):
        of_bin = error[part == i]
        figures[f"subpixel.count{i}"] = of_bin.size
        figures[f"subpixel.bias{i}"] = mean(of_bin)
        figures[f"subpixel.rms{i}"] = root(mean(of_bin**2))
    return figures


def sigma_figures(disparity, sigma, truth, mask):
    d, t = compared(disparity, truth, mask)
    s, _ = compared(sigma, truth, mask)
    usable = np.isfinite(d) & np.isfinite(s) & (s >= 0)
    error, s = np.abs(d - t)[usable].astype(np.float64), s[usable].astype(np.float64)
    return {f"sigma.within{k}": percent(np.count_nonzero(error <= k * s), s.size) for k in (1, 2, 3)}


def all_figures(disparity, confidence, sigma, truth, mask):
    figures = error_figures("plain.", disparity, truth, mask)
    figures |= error_figures("middlebury.", disparity, truth, mask, clip=20)
    figures |= error_figures("eth3d.", disparity, truth, mask, largest=30)
    if disparity.shape == truth.shape:
        figures |= kitti_figures(disparity, truth, mask)
        figures |= curve_figures(disparity, confidence, truth, mask)
        figures |= subpixel_figures(disparity, truth, mask)
        figures |= sigma_figures(disparity, sigma, truth, mask)
    return figures


class Comparison:
    def __init__(self, pomona, dump, folder):
        self.pomona, self.dump, self.folder = pomona, dump, folder
        self.maps = self.figures = 0
        self.differences = []

    def run(self, *command):
        result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(f"{command}: {result.stderr}")
        return result.stdout

    def compare(self, name, disparity, confidence, sigma, truth, mask_path):
        """The first three are arrays; the files that the evaluator reads hold the same values."""
        paths = [self.folder / f"{leaf}.pfm" for leaf in ("disparity", "confidence", "sigma", "truth")]
        for path, values in zip(paths, (disparity, confidence, sigma, truth)):
            write_pfm(path, values)
        masks = [mask_path] if mask_path else []
        found = json.loads(self.run(self.dump, *paths, *masks))
        mask = read_gray_png(mask_path) if mask_path else None
        for key, expected in all_figures(disparity, confidence, sigma, truth, mask).items():
            self.figures += 1
            value = found[key]
            if (value is None) != (expected is None) or (value is not None and abs(value - expected) > TOLERANCE):
                self.differences.append(f"{name}: {key}: {value}, numpy {expected}")
        self.maps += 1

    def scene(self, scene):
        truth = read_pfm(scene / "disp0GT.pfm")
        mask = scene / "mask0nocc.png" if (scene / "mask0nocc.png").exists() else None
        largest = np.max(truth[np.isfinite(truth)])
        for mode in ("dense", "sparse"):
            out, sure = self.folder / "out.pfm", self.folder / "sure.pfm"
            self.run(self.pomona, "compute", scene / "im0.png", scene / "im1.png", "--preset", "fast", "--mode", mode,
                     "--max-disparity", int(min(largest + 4, truth.shape[1])), "-o", out, "--confidence", sure)
            disparity, confidence = read_pfm(out), read_pfm(sure)
            # Any map will do for a standard deviation; this one has holes and values that must be left out.
            sigma = (F32(1.25) - confidence) * F32(2) - F32(0.6)
            sigma[::7, ::5] = np.nan
            name = f"{scene.name} {mode}"
            self.compare(name, disparity, confidence, sigma, truth, mask)
            if mask:
                self.compare(name + ", all", disparity, confidence, sigma, truth, None)
            for ratio in (2, 4):
                rows, columns = (length // ratio * ratio for length in truth.shape)
                small = disparity[:rows:ratio, :columns:ratio] / F32(ratio)
                self.compare(f"{name}, 1/{ratio}", small, small, small, truth[:rows, :columns], None)


def main():
    pomona, dump, scenes = sys.argv[1], sys.argv[2], Path(sys.argv[3]) if len(sys.argv) > 3 else None
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        comparison = Comparison(pomona, dump, folder)
        for name in ("boxes", "spheres", "trees"):
            comparison.run(pomona, "render", name, "-o", folder / name, "--size", "203x97")
            comparison.scene(folder / name)
        if scenes and scenes.is_dir():
            for truth in sorted(scenes.rglob("disp0GT.pfm")):
                if (truth.parent / "im1.png").exists():
                    comparison.scene(truth.parent)
    for difference in comparison.differences[:20]:
        print(difference)
    print(f"{comparison.figures} figures of {comparison.maps} maps, {len(comparison.differences)} differ")
    sys.exit(1 if comparison.differences or not comparison.figures else 0)


if __name__ == "__main__":
    main()
