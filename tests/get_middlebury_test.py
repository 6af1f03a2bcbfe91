"""scripts/get_middlebury against a server on this machine that is laid out as Middlebury's, and has bad days.

Usage: get_middlebury_test.py [unittest arguments]
"""

import http.server
import io
import os
import re
import subprocess
import sys
import tempfile
import threading
import unittest
import zipfile
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent.parent / "scripts" / "get_middlebury"
DATA, TRUTH = "MiddEval3-data-Q.zip", "MiddEval3-GT0-Q.zip"


def archive(files):
    bytes_ = io.BytesIO()
    with zipfile.ZipFile(bytes_, "w") as zipped:
        for name, content in files.items():
            zipped.writestr(name, content)
    return bytes_.getvalue()


class Server(http.server.ThreadingHTTPServer):
    """`files` by path; `ranges`: whether parts are served; `drops`: how many answers break off half-way."""

    def __init__(self):
        super().__init__(("127.0.0.1", 0), Handler)
        self.files, self.ranges, self.drops = {}, True, 0
        self.requests, self.bytes_sent = [], 0
        self.url = f"http://127.0.0.1:{self.server_port}/zip"


class Handler(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        content = self.server.files.get(os.path.basename(self.path))
        wanted = re.fullmatch(r"bytes=(\d+)-", self.headers.get("Range", ""))
        begin = int(wanted[1]) if wanted and self.server.ranges else 0
        self.server.requests.append((os.path.basename(self.path), begin))
        if content is None:
            self.send_error(404)
            return
        if wanted and begin >= len(content):
            self.send_response(416)
            self.send_header("Content-Range", f"bytes */{len(content)}")
            self.send_header("Content-Length", "0")
            self.end_headers()
            return
        self.send_response(206 if wanted and self.server.ranges else 200)
        self.send_header("Content-Length", str(len(content) - begin))
        if wanted and self.server.ranges:
            self.send_header("Content-Range", f"bytes {begin}-{len(content) - 1}/{len(content)}")
        self.end_headers()
        end = len(content)
        if self.server.drops > 0:
            self.server.drops -= 1
            end = (begin + end) // 2
        self.wfile.write(content[begin:end])
        self.server.bytes_sent += end - begin
        self.close_connection = True

    def log_message(self, *_):
        pass


class GetMiddlebury(unittest.TestCase):
    def setUp(self):
        self.server = Server()
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.addCleanup(self.server.server_close)
        self.addCleanup(self.server.shutdown)
        folder = tempfile.TemporaryDirectory(prefix="pomona-get-")
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name)
        self.noise = os.urandom(300000)
        self.server.files = {
            DATA: archive({"MiddEval3/trainingQ/Art/im0.png": self.noise, "MiddEval3/testQ/Bike/im0.png": b"test"}),
            TRUTH: archive({"MiddEval3/trainingQ/Art/disp0GT.pfm": b"truth"})}

    def get(self, *arguments):
        return subprocess.run([sys.executable, str(SCRIPT), "--base-url", self.server.url, "--out", str(self.out),
                               *arguments], capture_output=True, text=True, timeout=120, check=False)

    def assert_complete(self, result):
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual((self.out / "MiddEval3/trainingQ/Art/im0.png").read_bytes(), self.noise)
        self.assertEqual((self.out / "MiddEval3/trainingQ/Art/disp0GT.pfm").read_bytes(), b"truth")
        self.assertEqual((self.out / "MiddEval3/testQ/Bike/im0.png").read_bytes(), b"test")
        self.assertEqual(list(self.out.rglob("*.part")), [])

    def test_gets_everything_once(self):
        self.assert_complete(self.get())
        asked = list(self.server.requests)
        self.assertEqual(asked, [(DATA, 0), (TRUTH, 0)])
        (self.out / "MiddEval3/testQ/Bike/im0.png").unlink()
        self.assert_complete(self.get())
        self.assertEqual(self.server.requests, asked)

    def test_resumes_within_a_call(self):
        self.server.drops = 3
        self.assert_complete(self.get())
        self.assertEqual(self.server.bytes_sent, sum(map(len, self.server.files.values())))  # no byte twice
        self.assertGreater(self.server.requests[1][1], 0)

    def test_resumes_what_an_earlier_call_left(self):
        (self.out / "zip").mkdir()
        (self.out / "zip" / (DATA + ".part")).write_bytes(self.server.files[DATA][:1000])
        (self.out / "zip" / (TRUTH + ".part")).write_bytes(self.server.files[TRUTH])
        self.assert_complete(self.get())
        self.assertEqual(self.server.requests, [(DATA, 1000), (TRUTH, len(self.server.files[TRUTH]))])

    def test_a_server_without_ranges_starts_over(self):
        self.server.ranges = False
        (self.out / "zip").mkdir()
        (self.out / "zip" / (DATA + ".part")).write_bytes(b"x" * 1000)
        self.assert_complete(self.get())

    def test_gives_up_on_a_line_that_never_holds(self):
        self.server.drops = 1000
        result = self.get()
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"{DATA}: interrupted again and again", result.stderr)
        self.server.drops = 0
        self.assert_complete(self.get())

    def test_archives_that_are_none(self):
        self.server.files[DATA] = b""
        self.server.files[TRUTH] = self.server.files[TRUTH][:-30]
        result = self.get()
        self.assertEqual(result.returncode, 1)
        for name in (DATA, TRUTH):
            self.assertIn(f"{name}: not a complete zip archive", result.stderr)
        self.assertEqual(list(self.out.rglob("*.*")), [])

    def test_damage_is_found(self):
        damaged = bytearray(self.server.files[DATA])
        damaged[1000] ^= 1
        self.server.files[DATA] = bytes(damaged)
        result = self.get()
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"{DATA}: 'MiddEval3/trainingQ/Art/im0.png' in it is damaged", result.stderr)
        self.assertTrue((self.out / "MiddEval3/trainingQ/Art/disp0GT.pfm").exists())  # the other one came

    def test_an_archive_that_was_damaged_since_is_fetched_again(self):
        self.assert_complete(self.get())
        kept = self.out / "zip" / DATA
        content = bytearray(kept.read_bytes())
        content[1000] ^= 1
        for damaged in (bytes(content), content[:1000], b""):
            kept.write_bytes(damaged)
            (self.out / "MiddEval3/trainingQ/Art/im0.png").unlink()
            self.server.requests.clear()
            result = self.get()
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"{kept}: ", result.stderr)
            self.assertIn("fetching it again", result.stderr)
            self.assertEqual(self.server.requests, [(DATA, 0)])
            self.assertEqual((self.out / "MiddEval3/trainingQ/Art/im0.png").read_bytes(), self.noise)

    def test_what_cannot_be_unpacked_is_named_by_its_file(self):
        (self.out / "MiddEval3").write_bytes(b"in the way")
        result = self.get()
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"get_middlebury: {self.out / 'zip' / DATA}: ", result.stderr)

    def test_paths_that_lead_out_are_refused(self):
        self.server.files[DATA] = archive({"../outside": b"x"})
        self.assertIn("would be written outside", self.get().stderr)
        self.assertFalse((self.out.parent / "outside").exists())

    def test_missing_file_and_missing_server(self):
        del self.server.files[TRUTH]
        result = self.get()
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn(f"{TRUTH}: the server answers 404", result.stderr)
        result = self.get("--base-url", "http://127.0.0.1:9/zip", "--size", "H")
        self.assertEqual(result.returncode, 1)
        self.assertIn("MiddEval3-data-H.zip: [Errno 111]", result.stderr)

    def test_usage(self):
        self.assertEqual(self.get("--size", "X").returncode, 2)
        self.assertEqual(self.get("--base-url", "file:///etc").returncode, 2)


if __name__ == "__main__":
    unittest.main()
