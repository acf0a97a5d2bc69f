#!/usr/bin/env python3
"""The package on a bare Debian 12: made by cpack, installed with what it depends on into a fresh root, tried, moved,
purged. Needs root, a network, Debian's mmdebstrap and dpkg-dev; skipped with a word without them.

    debian_test.py BUILD
"""
import glob
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.error
import urllib.request

BUILD = os.path.abspath(sys.argv[1])
MIRROR = "http://deb.debian.org/debian"
LIMIT_S = 1800

# A terminal on /tmp/line; `inside` has devices and processes.
TALK = """
fauxboard run -q --profile geeetech-a30t --no-pacing --pty=/tmp/line >/tmp/ready 2>/tmp/log &
board=$!
until grep -q ready /tmp/ready; do kill -0 $board || { cat /tmp/log; exit 1; }; sleep 0.1; done
fauxboard screen --port /tmp/line press "Hotend on" 2>&1
kill $board; wait $board
"""
COMPLETION = """
. /usr/share/bash-completion/bash_completion
_completion_loader fauxboard
COMP_WORDS=(fauxboard scr) COMP_CWORD=1 COMP_LINE="fauxboard scr" COMP_POINT=13
$(complete -p fauxboard | sed 's/.*-F \\([^ ]*\\).*/\\1/')
echo "${COMPREPLY[@]}"
"""


def why_not():
    if os.geteuid() != 0:
        return "making a root needs root"
    for program, package in (("mmdebstrap", "mmdebstrap"), ("dpkg-shlibdeps", "dpkg-dev"), ("file", "file"),
                             ("cpack", "cmake")):
        if shutil.which(program) is None:
            return f"there is no {program}: Debian's package is {package}"
    try:
        urllib.request.urlopen(MIRROR + "/dists/bookworm/Release", timeout=20).close()
    except (urllib.error.URLError, OSError) as error:
        return f"Debian's packages cannot be reached: {error}"
    return ""


def run(*command, **more):
    done = subprocess.run(command, check=False, text=True, timeout=LIMIT_S, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **more)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: {done.returncode}\n{done.stdout}")
    return done.stdout


class BareDebian(unittest.TestCase):
    """In this order: each test goes on where the one before has left the root."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.root = os.path.join(cls.folder, "root")
        run("cpack", "-G", "DEB", "--config", os.path.join(BUILD, "CPackConfig.cmake"), "-B", cls.folder, cwd=BUILD)
        [package] = glob.glob(cls.folder + "/*.deb")
        run("mmdebstrap", "--variant=minbase", "--quiet", "bookworm", cls.root, MIRROR)
        shutil.copy(package, os.path.join(cls.root, "fauxboard.deb"))
        shutil.copy("/etc/resolv.conf", os.path.join(cls.root, "etc/resolv.conf"))

    def inside(self, script):
        """Its mounts and processes go with it."""
        return run("unshare", "--mount", "--pid", "--fork", "sh", "-ec",
                   'mount --rbind /dev "$0/dev"; mount -t proc proc "$0/proc"; exec chroot "$0" env -i'
                   ' PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive bash -c "$1"',
                   self.root, script)

    def files(self):
        """But what dpkg and apt keep for themselves."""
        return set(self.inside("find / -xdev -path /proc -prune -o -path /dev -prune -o -path /tmp -prune"
                               " -o -path '/var/lib/dpkg/*' -o -path '/var/lib/apt/*' -o -path '/var/log/*'"
                               " -o -path '/var/cache/*' -o -print").splitlines())

    def test_1_installs(self):
        self.inside("apt-get update && apt-get install -y --no-install-recommends man-db bash-completion")
        depends = self.inside("dpkg-deb -f /fauxboard.deb Depends").strip()
        print(f"{os.path.getsize(self.root + '/fauxboard.deb') / 1e6:.1f} MB; depends on {depends}")
        before = self.inside("du -smx /usr /var/lib | cut -f1").split()
        self.inside("apt-get install -y --no-install-recommends /fauxboard.deb")
        after = self.inside("du -smx /usr /var/lib | cut -f1").split()
        print(f"with them it takes {sum(map(int, after)) - sum(map(int, before))} MB")

    def test_2_answers_on_a_pseudo_terminal(self):
        self.assertIn("met: Control/Filament/Hotend on", self.inside(TALK))

    def test_3_manual_and_completion(self):
        self.assertIn("fauxboard", self.inside("man fauxboard | head -40"))
        self.assertIn("--pty", self.inside("man fauxboard-run"))
        self.assertIn("screen", self.inside(COMPLETION).split())

    def test_4_knows_its_profiles(self):
        self.assertIn("geeetech-a30t", self.inside("fauxboard profiles --names").split())
        said = self.inside("fauxboard --version")
        self.assertIn("/usr/share/fauxboard/profiles", said)
        self.inside("fauxboard run -q --script leveling-session --speed max")

    def test_5_purged_without_a_trace_and_moved(self):
        self.inside("mkdir -p '/tmp/some where' && cp -a --parents /usr/bin/fauxboard /usr/share/fauxboard '/tmp/some where'")
        owned = [line for line in self.inside("dpkg -L fauxboard").splitlines() if "fauxboard" in line]
        self.assertGreater(len(owned), 50)
        self.inside("apt-get purge -y fauxboard")
        self.assertEqual([line for line in self.files() if "fauxboard" in line], ["/fauxboard.deb"])
        self.assertEqual([line for line in owned if os.path.lexists(self.root + line)], [])
        said = self.inside("'/tmp/some where/usr/bin/fauxboard' --version")
        self.assertIn("/tmp/some where/usr/share/fauxboard/profiles", said)
        self.assertIn("geeetech-a30t", self.inside("'/tmp/some where/usr/bin/fauxboard' profiles --names").split())


if __name__ == "__main__":
    if reason := why_not():
        print("skipped:", reason)
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
