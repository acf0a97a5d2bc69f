#!/usr/bin/env python3
"""Lines and branches that the tests run, by room.

    cmake --preset coverage && cmake --build --preset coverage && ctest --preset coverage
    tests/coverage/table.py [--json] [--files ROOM | --gaps ROOM] [BUILD_FOLDER]

Wants llvm-profdata and llvm-cov (Debian: llvm-14). What a killed program has run is not counted. A branch is one way
out of a condition: "a && b" has four.
"""

import argparse
import bisect
import collections
import json
import pathlib
import shutil
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
CORE = {"protocol", "machine", "filament", "resin", "dlp", "behaviour", "board", "screen", "touch", "control",
        "script", "fault"}


def tool(name):
    """Its path: Debian's carries its version in its name."""
    for each in (name + "-14", name):
        if found := shutil.which(each):
            return found
    sys.exit(f"{name} is not installed; Debian has it in llvm-14.")


def exported(build):
    """What llvm-cov says of every file, of all programs together."""
    raw = sorted(build.glob("coverage/*.profraw"))
    programs = sorted(p for p in [*build.glob("test_*"), build / "fauxboard"] if p.is_file())
    if not raw or not programs:
        sys.exit(f"Nothing has been run in {build}: ctest --preset coverage comes first.")
    merged = build / "coverage" / "all.profdata"
    subprocess.run([tool("llvm-profdata"), "merge", "-sparse", "-o", merged, *raw], check=True)
    objects = [word for program in programs[1:] for word in ("-object", str(program))]
    command = [tool("llvm-cov"), "export", f"-instr-profile={merged}", str(programs[0]), *objects]
    ran = subprocess.run(command, capture_output=True, text=True)
    if ran.returncode != 0:  # what it says otherwise is that many a program has a function and does not call it
        sys.exit(ran.stderr)
    return json.loads(ran.stdout)["data"][0]["files"]


def room_of(path):
    """protocol/x.cpp: protocol; emulator/dlp/profile/x.cpp: dlp. None for what is no part of the program's rooms."""
    parts = path.parts
    if parts[0] == "protocol":
        return "protocol"
    return parts[1] if parts[0] == "emulator" and len(parts) > 2 else None


class File:
    """How often each line ran, and each way out of each condition, by where the condition stands."""

    def __init__(self):
        self.times = collections.Counter()
        self.branches = collections.defaultdict(lambda: [0, 0])

    def add(self, entry):
        """One name's share of it: a header is known by one name to its own room and by another to the tests."""
        for line, times in line_counts(entry["segments"]):
            self.times[line] += times
        starts = [tuple(segment[:2]) for segment in entry["segments"]]
        for begin, column, end, end_column, yes, no, *_ in entry["branches"]:
            at = bisect.bisect_right(starts, (begin, column)) - 1
            if not (yes or no) and entry["segments"][at][2]:
                continue  # asked, and yet neither: the compiler knew, as in while (true)
            ways = self.branches[begin, column, end, end_column]
            ways[0] += yes
            ways[1] += no

    def counts(self):
        ways = [way for both in self.branches.values() for way in both]
        return {"lines": [sum(times > 0 for times in self.times.values()), len(self.times)],
                "branches": [sum(way > 0 for way in ways), len(ways)]}


def line_counts(segments):
    """(line, times) of each line with code, as llvm-cov counts them; a segment is where a count begins to hold:
    [line, column, count, has a count, is a region's begin, is a gap between regions]."""
    by_line = collections.defaultdict(list)
    for segment in segments:
        by_line[segment[0]].append(segment)
    before = None
    for line in range(min(by_line, default=0), max(by_line, default=-1) + 1):
        here = by_line.get(line, [])
        begun = [s[2] for s in here if s[3] and s[4] and not s[5]]
        skipped = bool(here) and not here[0][3] and here[0][4]
        wrapped = before is not None and before[3]
        if not skipped and (wrapped or begun):
            yield line, max([*begun, before[2] if wrapped else 0])
        before = here[-1] if here else before


def all_files(build):
    """{room: {path: File}}"""
    rooms = collections.defaultdict(lambda: collections.defaultdict(File))
    for entry in exported(build):
        path = pathlib.Path(entry["filename"]).resolve()
        path = path.relative_to(TOP) if path.is_relative_to(TOP) else path
        if name := room_of(path):
            rooms[name][str(path)].add(entry)
    return rooms


def total(counts):
    return {kind: [sum(each[kind][i] for each in counts) for i in (0, 1)] for kind in ("lines", "branches")}


def share(counts):
    return f"{100 * counts[0] / counts[1]:.1f} %" if counts[1] else "-"


def print_row(name, counts):
    print(f"| {name:<40} | {counts['lines'][1]:>6} | {share(counts['lines']):>7} "
          f"| {counts['branches'][1]:>6} | {share(counts['branches']):>7} |")


def print_gaps(path, file):
    """Each line that did not run, and each condition that always went one way."""
    text = (TOP / path).read_text().split("\n")
    if max(file.times, default=0) > len(text):
        sys.exit(f"{path} is not what was compiled any more: build and test again.")
    ways = collections.defaultdict(list)
    for (line, column, end, end_column), (yes, no) in file.branches.items():
        if not (yes and no):
            condition = text[line - 1][column - 1:end_column - 1 if end == line else None]
            ways[line].append(f"never {'true' if no else 'false' if yes else 'asked'}: {condition}")
    for line in sorted(ways.keys() | {line for line, times in file.times.items() if times == 0}):
        if text[line - 1].strip(" {};)"):
            print(f"{path}:{line}: {text[line - 1].strip()}")
            print("".join(f"    {way}\n" for way in ways[line]), end="")


def main():
    parser = argparse.ArgumentParser(description="Lines and branches that the tests run, by room.")
    parser.add_argument("build", nargs="?", default=TOP / "build-coverage", type=pathlib.Path)
    parser.add_argument("--json", action="store_true", help="all of it, files too, as JSON")
    parser.add_argument("--files", metavar="ROOM", help="the files of that room, the least covered first")
    parser.add_argument("--gaps", metavar="ROOM", help="what of that room the tests did not run")
    options = parser.parse_args()
    rooms = all_files(options.build)
    chosen = options.files or options.gaps
    if chosen and chosen not in rooms:
        sys.exit(f"\"{chosen}\" is no room; there are {', '.join(sorted(rooms))}.")
    if options.gaps:
        for path in sorted(rooms[chosen]):
            print_gaps(path, rooms[chosen][path])
        return
    files = {room: {path: file.counts() for path, file in of.items()} for room, of in rooms.items()}
    sums = {room: total(of.values()) for room, of in files.items()}
    if options.json:
        print(json.dumps({room: {**sums[room], "files": files[room]} for room in sorted(rooms)}, indent=2))
        return
    print("| Room                                     |  Lines |     run | Branch |     run |\n|---|---|---|---|---|")
    if options.files:
        of = files[chosen]
        for name in sorted(of, key=lambda n: of[n]["branches"][0] - of[n]["branches"][1]):
            print_row(name, of[name])
        return
    for name in sorted(rooms, key=lambda n: (n not in CORE, n)):
        print_row(name, sums[name])
    print_row("**the core**", total([of for room, of in sums.items() if room in CORE]))


if __name__ == "__main__":
    main()
