"""Networks for the tests: two namespaces joined by a cable where that can be had, else the loopback; and Debian's
ser2net with a connection of the guide's configuration."""

import os
import pathlib
import re
import shutil
import socket
import subprocess
import tempfile
import time

GUIDE = pathlib.Path(__file__).resolve().parents[2] / "tools" / "guides" / "shelf.md"
SER2NET = shutil.which("ser2net", path=os.environ.get("PATH", "") + ":/usr/sbin")
IP = shutil.which("ip", path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")
LIMIT_S = 300


class Loopback:
    """One machine is both."""
    address, shelf, far = "127.0.0.1", [], []
    apart = False

    def close(self):
        pass


class Namespaces:
    """Two machines as far as the network is concerned: commands after `shelf` run beside the boards, those after
    `far` elsewhere. Throws where this may not be done."""
    address, far_address = "10.17.0.1", "10.17.0.2"
    apart = True

    def __init__(self):
        self.names = [f"fauxboard-{os.getpid()}-{end}" for end in ("shelf", "far")]
        self.shelf, self.far = ([IP, "netns", "exec", name] for name in self.names)
        try:
            for name in self.names:
                self.ip("netns", "add", name)
            self.ip("link", "add", "line", "netns", self.names[0], "type", "veth",
                    "peer", "name", "line", "netns", self.names[1])
            for name, address in zip(self.names, (self.address, self.far_address)):
                self.ip("-n", name, "address", "add", address + "/24", "dev", "line")
                for device in ("lo", "line"):
                    self.ip("-n", name, "link", "set", device, "up")
        except BaseException:
            self.close()
            raise

    @staticmethod
    def ip(*words):
        subprocess.run([IP, *words], check=True, capture_output=True, text=True, timeout=LIMIT_S)

    def close(self):
        for name in self.names:
            subprocess.run([IP, "netns", "delete", name], check=False, capture_output=True, timeout=LIMIT_S)


def two_machines():
    """Namespaces, or with a word the loopback."""
    if os.geteuid() != 0 or IP is None:
        print("on the loopback: another network namespace needs root, and Debian's package iproute2")
        return Loopback()
    try:
        return Namespaces()
    except subprocess.CalledProcessError as error:
        print(f"on the loopback: no network namespace to be had here: {error.stderr.strip()}")
        return Loopback()


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def listened_on(pid, address, port):
    """In that process's namespace, and without connecting, which would open the line."""
    wanted = f"{int.from_bytes(socket.inet_aton(address), 'little'):08X}:{port:04X}"
    with open(f"/proc/{pid}/net/tcp", encoding="ascii") as sockets:
        return any(words[1] == wanted and words[3] == "0A" for words in map(str.split, sockets))


class Ser2net:
    """ser2net beside the boards with a connection of the guide's configuration: `raw` has the screen's line,
    `rfc2217` the same by that protocol."""

    def __init__(self, which, network, device):
        self.which, self.network, self.device, self.port = which, network, device, free_port()

    def configure(self):
        [text] = re.findall(r"```yaml\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.S)
        head, *connections = re.split(r"(?m)^(?=connection:)", text)
        [one] = [text for text in connections if text.startswith(f"connection: &{self.which}\n")]
        one = re.sub(r"127\.0\.0\.1,\d+", f"{self.network.address},{self.port}", one)
        return head + re.sub(r"serialdev,[^,]+", f"serialdev,{self.device}", one)

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="fauxboard-")
        file = pathlib.Path(self.folder.name) / "ser2net.yaml"
        file.write_text(self.configure(), encoding="utf-8")
        self.log = open(file.with_suffix(".log"), "w+", encoding="utf-8")
        self.program = subprocess.Popen(self.network.shelf + [SER2NET, "-n", "-d", "-c", str(file)],
                                        stdout=self.log, stderr=self.log)
        end = time.monotonic() + LIMIT_S
        while not listened_on(self.program.pid, self.network.address, self.port):
            if self.ended(within_s=0.05) or time.monotonic() > end:
                self.log.seek(0)
                raise AssertionError("ser2net does not listen: " + self.log.read())
        return self

    def ended(self, within_s):
        try:
            return self.program.wait(within_s) is not None
        except subprocess.TimeoutExpired:
            return False

    def __exit__(self, *_):
        self.program.terminate()
        self.program.wait(60)
        self.log.close()
        self.folder.cleanup()
