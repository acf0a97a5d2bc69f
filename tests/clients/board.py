"""A board of the real program for a client: started, reached into, ended."""

import json
import os
import pathlib
import socket
import subprocess
import tempfile

PROGRAM = os.environ.get("FAUXBOARD_PROGRAM", "fauxboard")


class Board:
    """Runs `fauxboard run` on pseudo-terminals in a folder of its own. Use it in a `with`."""

    def __init__(self, profile, faults=(), speed="1000"):
        """`faults` go onto the USB side, which is the host's."""
        self.folder = tempfile.TemporaryDirectory(prefix="fauxboard-")
        self.path = pathlib.Path(self.folder.name)
        self.card = self.path / "card"
        self.card.mkdir()
        self.recording = self.path / "talk.jsonl"
        self.arguments = [PROGRAM, "run", "-q", "--profile", profile, "--no-pacing", "--speed", speed,
                          "--sd", str(self.card), "--control", str(self.path / "control"),
                          "--record", str(self.recording), "--host-pty"]
        for fault in faults:
            self.arguments += ["--fault", fault + ",line=usb"]

    def __enter__(self):
        with open(self.path / "log", "w", encoding="utf-8") as log:
            self.program = subprocess.Popen(self.arguments, stdout=subprocess.PIPE, stderr=log, text=True)
        ready = json.loads(self.program.stdout.readline().removeprefix("ready "))
        self.port = ready["host"]["path"]
        self.line = ready.get("path")  # the screen's, where the board has one
        self.control = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.control.connect(ready["control"])
        self.answers = self.control.makefile("r", encoding="utf-8")
        return self

    def __exit__(self, *_):
        """Afterwards: `code`, what it said to people in `log`, and in `talk` what went over the USB side."""
        self.answers.close()
        self.control.close()
        self.program.terminate()
        self.code = self.program.wait(60)
        self.program.stdout.close()
        self.log = (self.path / "log").read_text(encoding="utf-8")
        self.talk = list(self.recorded())
        self.folder.cleanup()

    def ask(self, op, **parameters):
        """One request on the control channel; its answer, which must be a good one."""
        self.control.sendall((json.dumps({"op": op, **parameters}) + "\n").encode())
        answer = json.loads(self.answers.readline())
        assert answer["ok"], answer
        return answer

    def field(self, name):
        return self.ask("get", fields=name)["fields"][name]

    def recorded(self):
        """Pairs of who said it (True: the host) and the line."""
        with open(self.recording, encoding="ascii") as lines:
            for line in lines:
                entry = json.loads(line)
                if entry["from"] in ("host", "usb"):
                    yield entry["from"] == "host", entry["line"]


def is_number(text):
    """Of the line's digits alone: to Python a superscript two, which one flipped bit makes of a 2, is one too."""
    return text.isascii() and text.isdigit()


def said_behind(talk, command, lines=12):
    """What was said around the last time that this command was heard, for somebody who must find out why it was
    the last that counted."""
    at = max((i for i, (from_host, line) in enumerate(talk) if from_host and command in line), default=0)
    return "\n".join(f"{'> ' if from_host else '< '}{line!r}" for from_host, line in talk[max(0, at - 3) : at + lines])


def accepted(talk):
    """The numbered commands that a board must have carried out, in order: by the rules of line numbers and
    checksums alone, whatever this one did."""
    last = 0
    for from_host, line in talk:
        number, _, rest = line.lstrip(" ").partition(" ")
        body, star, checksum = rest.rpartition("*")
        if not from_host or not number.startswith("N") or not star or not is_number(checksum):
            continue
        total = 0
        for byte in line[: line.rindex("*")].encode("latin-1"):
            total ^= byte
        if total != int(checksum) or not is_number(number[1:].lstrip("-")):
            continue
        if body.startswith("M110"):
            _, n, new = body.partition("N")
            last = int(new) if n else int(number[1:])
        elif int(number[1:]) == last + 1:
            last += 1
            yield body
