#!/usr/bin/env python3
"""The installed tree: complete, found from where it lies after a move, and gone without a trace.

    install_test.py SOURCE BUILD
"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD = (os.path.abspath(path) for path in sys.argv[1:3])
ENVIRONMENT = {key: value for key, value in os.environ.items() if key != "FAUXBOARD_PROFILES"}


def run(*command, **more):
    return subprocess.run(command, check=True, text=True, env=ENVIRONMENT, timeout=300, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, **more).stdout


def files_of(folder):
    return sorted(os.path.relpath(os.path.join(place, name), folder)
                  for place, _, names in os.walk(folder) for name in names)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.first = os.path.join(cls.folder, "first")
        run("cmake", "--install", BUILD, "--prefix", cls.first)
        cls.moved = os.path.join(cls.folder, "some where", "else")
        shutil.copytree(cls.first, cls.moved, symlinks=True)
        cls.files = files_of(cls.first)
        run("cmake", f"-DMANIFEST={BUILD}/install_manifest.txt", f"-DPREFIX={cls.first}", "-P",
            f"{SOURCE}/tools/packaging/uninstall.cmake")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def program(self, *arguments):
        return run(os.path.join(self.moved, "bin", "fauxboard"), *arguments, cwd=self.folder)

    def test_all_is_there(self):
        for wanted in ("bin/fauxboard", "share/man/man1/fauxboard.1", "share/man/man1/fauxboard-run.1",
                       "share/bash-completion/completions/fauxboard", "share/fauxboard/fauxboard.lua",
                       "share/fauxboard/profiles/geeetech-a30t.json",
                       "share/fauxboard/profiles/screens/geeetech-a30t.json",
                       "share/fauxboard/profiles/scenarios/leveling-session.json",
                       "share/fauxboard/profiles/schemas/profile.schema.json",
                       "lib/systemd/system/fauxboard@.service"):
            self.assertIn(wanted, self.files)

    def test_the_unit_starts_what_was_installed(self):
        with open(os.path.join(self.moved, "lib/systemd/system/fauxboard@.service"), encoding="utf-8") as unit:
            [start] = [line for line in unit if line.startswith("ExecStart=")]
        self.assertTrue(start.startswith(f"ExecStart={self.first}/bin/fauxboard run "), start)

    def test_the_source_archive_is_whole(self):
        run("cpack", "--config", f"{BUILD}/CPackSourceConfig.cmake", "-G", "TGZ", "-B", self.folder, cwd=BUILD)
        [archive] = [name for name in os.listdir(self.folder) if name.endswith(".tar.gz")]
        shutil.unpack_archive(os.path.join(self.folder, archive), os.path.join(self.folder, "source"))
        top = os.path.join(self.folder, "source", archive.removesuffix(".tar.gz"))
        self.assertIn("CMakeLists.txt", os.listdir(top))
        if os.path.exists(os.path.join(SOURCE, ".git")) and shutil.which("git"):
            tracked = run("git", "-c", "safe.directory=*", "-C", SOURCE, "ls-files").splitlines()
            there = [name for name in tracked if os.path.exists(os.path.join(SOURCE, name))]
            self.assertEqual(sorted(set(there) - set(files_of(top))), [])

    def test_uninstalled_without_a_trace(self):
        self.assertEqual(files_of(self.first), [])
        folders = [place for place, _, _ in os.walk(self.first)]
        self.assertFalse([place for place in folders if "fauxboard" in os.path.relpath(place, self.first)])

    def test_moved_tree_finds_its_own(self):
        said = self.program("--version").splitlines()
        self.assertIn("commit", said[0])
        self.assertEqual(said[2].strip(), os.path.join(self.moved, "share/fauxboard/profiles"))
        self.assertIn("geeetech-a30t", self.program("profiles", "--names").split())
        self.assertIn("passed", self.program("run", "-q", "--script", "leveling-session", "--speed", "max"))

    def test_what_new_writes_fits_where_the_program_lies(self):
        self.program("new", "profile", "mine")
        self.assertEqual(self.program("check", "mine.json"), "mine.json: ok\n")

    @unittest.skipUnless(shutil.which("bash"), "there is no bash")
    def test_completion(self):
        page = os.path.join(self.moved, "share/bash-completion/completions/fauxboard")
        words = run("bash", "-c", f"source '{page}'; COMP_WORDS=(fauxboard scr); COMP_CWORD=1; _fauxboard;"
                    ' echo "${COMPREPLY[@]}"')
        self.assertIn("screen", words.split())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
