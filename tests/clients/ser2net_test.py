"""A board whose line goes over the network: Debian's ser2net has its pseudo-terminal, and a virtual touch screen (raw TCP)
or pyserial (RFC 2217) talks to it from afar, as tools/guides/shelf.md says."""

import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

SER2NET = shutil.which("ser2net", path=os.environ.get("PATH", "") + ":/usr/sbin")
try:
    import serial
except ImportError:
    serial = None
if SER2NET is None or serial is None:
    print("skipped: Debian's packages are ser2net and python3-serial")
    sys.exit(77)

from board import PROGRAM, Board

GUIDE = pathlib.Path(__file__).resolve().parents[2] / "tools" / "guides" / "shelf.md"
SPEED = "10"
LIMIT_S = 300


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def listened_on(port):
    """Without connecting, which would open the line."""
    with open("/proc/net/tcp", encoding="ascii") as sockets:
        return any(words[1] == f"0100007F:{port:04X}" and words[3] == "0A" for words in map(str.split, sockets))


def fill(card):
    """A file whose print outlasts the buttons of its pages, and a folder."""
    moves = "G1 X10 Y10 F1200\nG1 X200 Y200\n" * 2000
    (card / "folder").mkdir()
    for file in (card / "pattern.gcode", card / "folder" / "cube.gcode"):
        file.write_text("G28\n" + moves, encoding="ascii")


class Network:
    """ser2net with a connection of the guide's configuration: the first is raw and has the screen's line, the second
    speaks RFC 2217 and has the USB port."""

    def __init__(self, which, board):
        self.which, self.board, self.port = which, board, free_port()

    def configure(self):
        device = (self.board.line, self.board.port)[self.which]
        [text] = re.findall(r"```yaml\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.S)
        head, *connections = re.split(r"(?m)^(?=connection:)", text)
        one = re.sub(r"127\.0\.0\.1,\d+", f"127.0.0.1,{self.port}", connections[self.which])
        return head + re.sub(r"serialdev,[^,]+", f"serialdev,{device}", one)

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="fauxboard-")
        file = pathlib.Path(self.folder.name) / "ser2net.yaml"
        file.write_text(self.configure(), encoding="utf-8")
        self.log = open(file.with_suffix(".log"), "w+", encoding="utf-8")
        self.program = subprocess.Popen([SER2NET, "-n", "-d", "-c", str(file)], stdout=self.log, stderr=self.log)
        end = time.monotonic() + LIMIT_S
        while not listened_on(self.port):
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


class OverTheNetwork(unittest.TestCase):
    def test_every_button_of_a_screen_by_raw_tcp(self):
        board = Board("geeetech-a30t", speed=SPEED)
        fill(board.card)
        with board, Network(0, board) as network:
            tour = subprocess.run([PROGRAM, "screen", "--tcp", f"127.0.0.1:{network.port}", "--speed", SPEED,
                                   "tour", "--json"], text=True, capture_output=True, timeout=LIMIT_S, check=False)
        buttons = json.loads(tour.stdout)["results"]
        # What was pressed is answered. On a busy computer a page that passes by may be over before its button is.
        met = [button for button in buttons if button["verdict"] == "met"]
        self.assertGreater(len(met), 0.95 * len(buttons), tour.stderr)
        self.assertEqual([button["sentence"] for button in buttons if button["verdict"] == "not met"], [])

    def test_pyserial_by_rfc2217(self):
        with Board("marlin", speed="1") as board, Network(1, board) as network:
            # A pseudo-terminal has no DTR that could be acknowledged.
            url = f"rfc2217://127.0.0.1:{network.port}?ign_set_control"
            with serial.serial_for_url(url, baudrate=115200, timeout=LIMIT_S) as port:
                port.write(b"M105\n")
                answer = next(line for line in iter(port.readline, b"") if line.startswith(b"ok T:"))
        self.assertRegex(answer, rb"^ok T:\d+\.\d+ /0\.00 B:")


if __name__ == "__main__":
    unittest.main(verbosity=2)
