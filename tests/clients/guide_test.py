"""The Python of tools/guides/ci.md runs, and does what the guide says."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import serial  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}; Debian's package is python3-serial")
    sys.exit(77)

GUIDE = pathlib.Path(__file__).resolve().parents[2] / "tools" / "guides" / "ci.md"


class Guide(unittest.TestCase):
    def setUp(self):
        self.blocks = re.findall(r"```(\w+)\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.S)

    def test_the_ten_lines(self):
        [script] = [text for language, text in self.blocks if language == "python"]
        self.assertLessEqual(len(script.strip().splitlines()), 10)
        program = pathlib.Path(os.environ["FAUXBOARD_PROGRAM"]).resolve()
        with tempfile.TemporaryDirectory() as folder:
            path = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}"}
            run = subprocess.run([sys.executable, "-c", script], cwd=folder, env=path, text=True,
                                 capture_output=True, timeout=60, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(run.stdout.startswith("ok T:"), run.stdout)

    def test_the_job_runs_a_script_that_is_there(self):
        [job] = [text for language, text in self.blocks if language == "yaml"]
        self.assertIn("test_board.py", job)
        for package in re.findall(r"apt-get install -y (.*)", job):
            self.assertIn("python3-serial", package)


if __name__ == "__main__":
    unittest.main(verbosity=2)
