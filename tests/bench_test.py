"""Every group of pomona_bench runs, and scripts/bench makes the right tables. No figure is judged.

Usage: bench_test.py POMONA_BENCH [unittest arguments]
"""

import importlib.util
import json
import re
import subprocess
import sys
import tempfile
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent.parent / "scripts" / "bench"
SIZE = "96x64/D16"
# One of each kind, so that a sanitizer's build can afford it.
SOME = (r"^frame/(balanced/dense|opencv-hh/checked)/.*|^stage/(frame/quality|parts/balanced)/.*t2"
        r"|^kernel/(second-pass|checks|medians|bilateral.*|refinement|scaling.*|fusion|filling|gray.*)/")

bench_binary = None


def load_script():
    loader = SourceFileLoader("bench", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("bench", loader))
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


def frame(name, round_, ms):
    width_height, disparities = name.split("/")[3:5]
    width, height = map(int, width_height.split("x"))
    giga_disparities = width * height * int(disparities[1:]) / 1e9
    return {"name": name, "round": round_, "ms": ms, "fps": 1e3 / ms, "s_per_GD": ms / 1e3 / giga_disparities}


def canned():
    runs = []
    for round_, (ours, hh) in enumerate([(10, 100), (20, 300), (10, 120)]):
        runs += [frame("frame/fast/sparse/1000x1000/D100/t1", round_, ours),
                 frame("frame/fast/sparse/1000x1000/D100/t2", round_, ours / 2),
                 frame("frame/fast/dense/1000x1000/D100/t1", round_, ours * 1.25),
                 frame("frame/fast/sparse/2000x1000/D100/t1", round_, ours * 2.2),
                 frame("frame/opencv-hh/checked/1000x1000/D100/t1", round_, hh)]
    runs += [{"name": "stage/frame/fast/1000x1000/D100/t1", "round": 0, "ms": 9, "stage:speckle": 1.5},
             {"name": "kernel/medians/scalar/1000x1000/D100", "round": 0, "ms": 8, "kernel:median3x3": 6.0},
             {"name": "kernel/medians/avx2/1000x1000/D100", "round": 0, "ms": 2, "kernel:median3x3": 1.5,
              "bytes:median3x3": 12}]
    machine = {"cpu": "a CPU", "cores": 2, "caches": ["L2 unified 2048K"], "virtual": True, "governor": "performance",
               "memory_GiB": 8, "system": "a system", "load_average": 1.5, "busy_cores": 0.7, "idle": False,
               "commit": "abc", "date": "2024-01-01"}
    return {"machine": machine, "context": {"input": "a pair", "isa": "avx2", "opencv": "4.6.0"}, "benchmarks": runs,
            "peak_bytes": {"frame/fast/sparse/1000x1000/D100/t1": 123e6, "nothing/1000x1000/D100": 50e6},
            "latency": [{"name": "frame/fast", "frames": 9, "p50": 2.0, "p99": 3.0, "max": 4.0}],
            "scaling": [{"preset": "fast", "size": SIZE, "stages": [
                {"stage": "frame", "serial_share": 0.125, "ms": {"1": 16.0, "2": 9.0}}]}]}


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.script = load_script()
        cls.text = cls.script.markdown(canned())
        cls.lines = cls.text.splitlines()

    def line(self, *beginnings):
        """The one that begins so, below the heading that is named before."""
        lines = self.lines
        for beginning in beginnings:
            at = next((i for i, line in enumerate(lines) if line.startswith(beginning)), None)
            self.assertIsNotNone(at, f"{beginning} not in\n{self.text}")
            lines = lines[at:]
        return lines[0]

    def test_ratios_are_formed_round_by_round(self):
        ratios = self.line("### Ratios to OpenCV with its own checks", "| 1000x1000, D100, 1 thr.: fast sparse")
        self.assertIn("| - | - | - | 12.0 (10.0 - 15.0) | - |", ratios)

    def test_frames(self):
        row = self.line("#### 1000x1000, D 100", "| fast sparse")
        self.assertIn("| 10.0 | 100 |", row)                      # the median's ms and fps
        self.assertIn("| 123 | 5.00 | 2.00 (2.00 - 2.00) |", row)  # MB, ms of two threads, gain
        self.assertIn("50.0 MB", self.text)

    def test_growth(self):
        self.assertIn("| 100 | 110 | 1.10 |", self.line("### Growth", "| fast sparse"))
        self.assertIn("| 1.25 | - |", self.line("### Growth", "| fast: dense / sparse"))

    def test_the_rest(self):
        self.assertIn("| 1.50 |", self.line("### Stages", "| speckle"))
        self.assertIn("| 6.00 | 1.50 | 4.00 | 12.0 | 8.00 |", self.line("### Kernels", "| median3x3 (medians)"))
        self.assertIn("| 16.0 | 9.00 | 0.125 |", self.line("### Threads", "| fast: frame"))
        self.assertIn("| 1.50 |", self.line("### Latency", "| frame/fast"))

    def test_a_busy_machine_is_told(self):
        self.assertIn("not idle", self.text)
        idle = canned()
        idle["machine"]["idle"] = True
        self.assertNotIn("not idle", self.script.markdown(idle))

    def test_only_what_lies_between_the_marks_is_renewed(self):
        with tempfile.TemporaryDirectory() as folder:
            self.script.README = Path(folder) / "README.md"
            self.script.README.write_text(f"before\n{self.script.BEGIN}\nold\n{self.script.END}\nafter\n")
            for _ in range(2):
                self.script.renew_readme("new")
            self.assertEqual(self.script.README.read_text(),
                             f"before\n{self.script.BEGIN}\n\nnew\n{self.script.END}\nafter\n")
            self.script.README.write_text("no marks")
            self.assertRaises(RuntimeError, self.script.renew_readme, "new")

    def test_the_project_has_the_marks(self):
        text = (SCRIPT.parent.parent / "bench" / "README.md").read_text()
        self.assertTrue(0 <= text.find(self.script.BEGIN) < text.find(self.script.END))


class Smoke(unittest.TestCase):
    def bench(self, folder, *arguments):
        return subprocess.run([sys.executable, str(SCRIPT), "-o", folder, *arguments], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False)

    def test_all_groups_run_and_are_tabulated(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.bench(folder, "--binary", bench_binary, "--arguments", f"--sizes {SIZE} --detail-size {SIZE}",
                              "--min-time", "0.001", "--rounds", "2", "--frames", "2", "--latency", "3", "--filter",
                              SOME)
            self.assertEqual(done.returncode, 0, done.stderr)
            result = json.loads((Path(folder) / "bench.json").read_text())
            runs = {}
            for run in result["benchmarks"]:
                self.assertGreater(run["ms"], 0, run)
                runs.setdefault(run["name"], []).append(run)
            self.assertEqual({len(of_name) for of_name in runs.values()}, {2})
            self.assertEqual({name.split("/")[0] for name in runs}, {"frame", "stage", "kernel"})
            counters = {key for of_name in runs.values() for key in of_name[0]}
            for wanted in ("stage:matching", "stage:cost and aggregation", "kernel:aggregateLast", "kernel:prior",
                           "kernel:median5x5", "kernel:jointBilateral", "kernel:weightedMedian", "kernel:cubicRow",
                           "kernel:reduceRow", "kernel:planeDisparities", "kernel:difference1", "bytes:blendedCost"):
                self.assertIn(wanted, counters)
            frames = {name for name in runs if name.startswith("frame/")}
            self.assertEqual(set(result["peak_bytes"]), {*frames, f"nothing/{SIZE}"})
            self.assertEqual([entry["preset"] for entry in result["scaling"]], ["quality"])
            self.assertEqual(result["latency"][0]["frames"], 3)
            first = (Path(folder) / "bench.md").read_text()
            self.assertEqual(self.bench(folder, "--from", str(Path(folder) / "bench.json")).returncode, 0)
            self.assertEqual((Path(folder) / "bench.md").read_text(), first)

    def test_no_kernel_is_forgotten(self):
        root = SCRIPT.parent.parent
        timed = set(re.findall(r"TIMED\((?!table)\w+, (\w+)", (root / "bench/speed/kernels.cc").read_text()))
        for folder in ("sgm", "filters", "pyramid", "camera"):
            kernels = re.findall(r"^  \w+ \(\*(\w+)", (root / folder / "kernels.h").read_text(), re.MULTILINE)
            self.assertTrue(kernels)
            self.assertEqual(set(kernels) - timed, set(), folder)
        done = subprocess.run([bench_binary, "--detail-size", SIZE, "--benchmark_filter=^kernel/.*/scalar/",
                               "--benchmark_min_time=0.001", "--benchmark_format=json"], stdout=subprocess.PIPE,
                              text=True, check=True)
        self.assertEqual(timed, set(re.findall(r'"kernel:(\w+)', done.stdout)))

    def test_what_cannot_be_done_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.bench(folder, "--binary", bench_binary, "--filter", "no such benchmark")
            self.assertEqual(done.returncode, 1)
            self.assertIn("no such benchmark", done.stderr)
        for wrong in (["--sizes", "640x480"], ["--sizes", "0x480/D64"], ["--once", "frame/none"]):
            done = subprocess.run([bench_binary, *wrong], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 1, wrong)
            self.assertIn("pomona_bench: error:", done.stderr)


if __name__ == "__main__":
    bench_binary = sys.argv.pop(1)
    unittest.main()
