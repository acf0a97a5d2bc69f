#!/usr/bin/env python3
"""Lines and branches that the tests run, by room.

    cmake --preset coverage && cmake --build --preset coverage && ctest --preset coverage
    tests/coverage/table.py [--json] [--files ROOM] [BUILD_FOLDER]

Wants llvm-profdata and llvm-cov (Debian: llvm-14). What a killed program has run is not counted.
"""

import argparse
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
    command = [tool("llvm-cov"), "export", "-summary-only", f"-instr-profile={merged}", str(programs[0]), *objects]
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return json.loads(out)["data"][0]["files"]


def room_of(path):
    """protocol/x.cpp: protocol; emulator/dlp/profile/x.cpp: dlp. None for what is no part of the program's rooms."""
    parts = path.parts
    if parts[0] == "protocol":
        return "protocol"
    return parts[1] if parts[0] == "emulator" and len(parts) > 2 else None


def sums(files):
    """{room: {"files": {name: counts}, ...counts}}, each count [covered, all]."""
    rooms = {}
    for entry in files:
        path = pathlib.Path(entry["filename"])
        path = path.relative_to(TOP) if path.is_relative_to(TOP) else path
        name = room_of(path)
        if name is None:
            continue
        counts = {kind: [entry["summary"][kind]["covered"], entry["summary"][kind]["count"]]
                  for kind in ("lines", "branches")}
        room = rooms.setdefault(name, {"lines": [0, 0], "branches": [0, 0], "files": {}})
        room["files"][str(path)] = counts
        for kind, (covered, count) in counts.items():
            room[kind][0] += covered
            room[kind][1] += count
    return rooms


def share(counts):
    return f"{100 * counts[0] / counts[1]:.1f} %" if counts[1] else "-"


def print_row(name, counts):
    print(f"| {name:<40} | {counts['lines'][1]:>6} | {share(counts['lines']):>7} "
          f"| {counts['branches'][1]:>6} | {share(counts['branches']):>7} |")


def main():
    parser = argparse.ArgumentParser(description="Lines and branches that the tests run, by room.")
    parser.add_argument("build", nargs="?", default=TOP / "build-coverage", type=pathlib.Path)
    parser.add_argument("--json", action="store_true", help="all of it, files too, as JSON")
    parser.add_argument("--files", metavar="ROOM", help="the files of that room, the least covered first")
    options = parser.parse_args()
    rooms = sums(exported(options.build))
    if options.json:
        print(json.dumps(rooms, indent=2))
        return
    print("| Room                                     |  Lines |     run | Branch |     run |\n|---|---|---|---|---|")
    if options.files:
        files = rooms[options.files]["files"]
        for name in sorted(files, key=lambda n: files[n]["branches"][0] - files[n]["branches"][1]):
            print_row(name, files[name])
        return
    core = {kind: [sum(rooms[r][kind][i] for r in rooms if r in CORE) for i in (0, 1)]
            for kind in ("lines", "branches")}
    for name in sorted(rooms, key=lambda n: (n not in CORE, n)):
        print_row(name, rooms[name])
    print_row("**the core**", core)


if __name__ == "__main__":
    main()
