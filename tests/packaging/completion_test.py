#!/usr/bin/env python3
"""Completion in the shells themselves, those of bash, zsh and fish that are installed.

    completion_test.py PROGRAM
"""
import os
import pty
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.path.abspath(sys.argv[1])
PATIENCE_S = 30

# What is typed before Tab, and what the last word becomes.
WORDS = [
    ("fauxboard scr", "screen"),
    ("fauxboard run --prof", "--profile"),
    ("fauxboard run --profile geeetech-a30t-n", "geeetech-a30t-no-card"),
    ("fauxboard run --log-level w", "warning"),
    ("fauxboard screen --port x pre", "press"),
    ("fauxboard ctl socket fau", "fault"),
    ("fauxboard ctl socket fault ad", "add"),
    ("fauxboard describe fie", "fields"),
    ("fauxboard check geeetech-a30t-n", "geeetech-a30t-no-card"),
    ("fauxboard new scr", "screen"),
    ("fauxboard completion f", "fish"),
    ("fauxboard manual soa", "soak"),
]

BASH = r"""
. "$1"
COMP_WORDS=($2) COMP_LINE=$2 COMP_POINT=${#2}
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_fauxboard && printf '%s\n' "${COMPREPLY[@]}"
"""


class Completion(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        os.symlink(PROGRAM, os.path.join(self.folder, "fauxboard"))
        self.environment = dict(os.environ, PATH=f"{self.folder}:{os.environ['PATH']}", HOME=self.folder, TERM="dumb")

    def script(self, shell):
        if shutil.which(shell) is None:
            self.skipTest(f"there is no {shell}")
        path = os.path.join(self.folder, "script." + shell)
        with open(path, "w", encoding="utf-8") as out:
            subprocess.run([PROGRAM, "completion", shell], stdout=out, check=True, timeout=PATIENCE_S)
        return path

    def lines_of(self, *command):
        done = subprocess.run(command, env=self.environment, cwd=self.folder, text=True, capture_output=True,
                              timeout=PATIENCE_S, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.splitlines()

    def test_bash(self):
        script = self.script("bash")
        for typed, word in WORDS:
            with self.subTest(typed):
                self.assertIn(word, self.lines_of("bash", "--norc", "-c", BASH, "bash", script, typed))

    def test_fish(self):
        script = self.script("fish")
        for typed, word in WORDS:
            with self.subTest(typed):
                found = self.lines_of("fish", "--no-config", "-c", f"source {script}; complete -C '{typed}'")
                self.assertIn(word, [line.split("\t")[0] for line in found])

    def test_zsh(self):
        script = self.script("zsh")
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.folder)
            os.execvpe("zsh", ["zsh", "-f", "-i"], self.environment)
        self.addCleanup(os.close, terminal)
        self.addCleanup(os.kill, pid, 9)
        os.write(terminal, f"autoload -U compinit; compinit -u -D; source {script}; PS1=; echo rea''dy\n".encode())
        self.wait_for(terminal, "ready")
        for typed, word in WORDS:
            with self.subTest(typed):
                os.write(terminal, typed.encode() + b"\t")
                whole = typed.rsplit(" ", 1)[0] + " " + word
                self.wait_for(terminal, whole)
                os.write(terminal, b"\x15")  # the line away

    def wait_for(self, terminal, text):
        """Until `text` was shown, backspaces and blanks of the line's editor aside."""
        shown, end = "", time.monotonic() + PATIENCE_S
        while text not in shown:
            ready, _, _ = select.select([terminal], [], [], end - time.monotonic())
            self.assertTrue(ready, f"{text!r} did not come: {shown!r}")
            shown += os.read(terminal, 4096).decode(errors="replace").replace("\a", "")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
