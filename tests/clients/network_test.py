"""A board whose line goes over the network, as tools/guides/shelf.md says: a virtual touch screen on another machine (a
network namespace, where that can be had) presses all its buttons by TCP, through Debian's ser2net, and through ser2net
and pyserial's RFC 2217."""

import concurrent.futures
import contextlib
import json
import pathlib
import subprocess
import sys
import unittest

import network
try:
    import serial
except ImportError:
    serial = None

from board import PROGRAM, Board

SPEED = "10"
BRIDGE = pathlib.Path(__file__).with_name("rfc2217_bridge.py")
HAS_SER2NET = network.SER2NET is not None and serial is not None
NEEDS_SER2NET = "Debian's packages are ser2net and python3-serial"


def fill(card):
    """A file whose print outlasts the buttons of its pages, and a folder. A pause waits for the moves already planned: short ones."""
    moves = "G1 X10 Y10 F1200\nG1 X30 Y30\n" * 2000
    (card / "folder").mkdir()
    for file in (card / "pattern.gcode", card / "folder" / "cube.gcode"):
        file.write_text("G28\n" + moves, encoding="ascii")


@contextlib.contextmanager
def board_on_the_shelf(machines, line=("--pty",)):
    board = Board("geeetech-a30t", speed=SPEED)
    board.arguments = machines.shelf + board.arguments + list(line)
    fill(board.card)
    with board:
        yield board


def tour(machines, *line):
    """Every button, from afar; what came of each."""
    said = subprocess.run(machines.far + [PROGRAM, "screen", *line, "--speed", SPEED, "tour", "--json"], text=True,
                          capture_output=True, timeout=network.LIMIT_S, check=False)
    if not said.stdout:
        raise AssertionError(said.stderr)
    return json.loads(said.stdout)["results"]


def by_tcp(machines):
    with board_on_the_shelf(machines, ("--tcp", machines.address + ":0")) as board:
        return tour(machines, "--tcp", board.line)


def by_ser2net(machines):
    with board_on_the_shelf(machines) as board, network.Ser2net("raw", machines, board.line) as server:
        return tour(machines, "--tcp", f"{machines.address}:{server.port}")


def by_rfc2217(machines):
    with board_on_the_shelf(machines) as board, network.Ser2net("rfc2217", machines, board.line) as server:
        # A pseudo-terminal has no DTR that could be acknowledged.
        url = f"rfc2217://{machines.address}:{server.port}?ign_set_control"
        with subprocess.Popen(machines.far + [sys.executable, str(BRIDGE), url], text=True,
                              stdout=subprocess.PIPE) as bridge:
            try:
                return tour(machines, "--port", bridge.stdout.readline().strip())
            finally:
                bridge.terminate()


class FromAfar(unittest.TestCase):
    """The three tours go on side by side: they wait most of the time."""

    @classmethod
    def setUpClass(cls):
        cls.machines = network.two_machines()
        cls.addClassCleanup(cls.machines.close)
        ways = [by_tcp] + ([by_ser2net, by_rfc2217] if HAS_SER2NET else [])
        with concurrent.futures.ThreadPoolExecutor() as pool:
            cls.tours = {way: pool.submit(way, cls.machines) for way in ways}

    def all_answered(self, way):
        buttons = self.tours[way].result()
        # What was pressed is answered. On a busy computer a page that passes by may be over before its button is.
        met = [button for button in buttons if button["verdict"] == "met"]
        print(f"{way.__name__}: {len(met)} of {len(buttons)} buttons met, "
              + ("from another network namespace" if self.machines.apart else "on the loopback"))
        self.assertGreater(len(met), 0.95 * len(buttons))
        self.assertEqual([button["sentence"] for button in buttons if button["verdict"] == "not met"], [])

    def test_every_button_by_tcp(self):
        self.all_answered(by_tcp)

    @unittest.skipUnless(HAS_SER2NET, NEEDS_SER2NET)
    def test_every_button_by_ser2net(self):
        self.all_answered(by_ser2net)

    @unittest.skipUnless(HAS_SER2NET, NEEDS_SER2NET)
    def test_every_button_by_rfc2217(self):
        self.all_answered(by_rfc2217)

    @unittest.skipUnless(HAS_SER2NET, NEEDS_SER2NET)
    def test_pyserial_on_the_usb_side(self):
        here = network.Loopback()
        with Board("marlin", speed="1") as board, network.Ser2net("rfc2217", here, board.port) as server:
            url = f"rfc2217://{here.address}:{server.port}?ign_set_control"
            with serial.serial_for_url(url, baudrate=115200, timeout=network.LIMIT_S) as port:
                port.write(b"M105\n")
                answer = next(line for line in iter(port.readline, b"") if line.startswith(b"ok T:"))
        self.assertRegex(answer, rb"^ok T:\d+\.\d+ /0\.00 B:")


if __name__ == "__main__":
    unittest.main(verbosity=2)
