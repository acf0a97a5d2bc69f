#!/usr/bin/env python3
"""What takes the time: the ten slowest compilations and tests of a build folder, from what ninja and ctest have noted.

    slowest.py BUILD
"""
import pathlib
import sys


def compilations(log):
    """Seconds by output; what was built again counts once, as the last time."""
    took = {}
    for line in log.read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            start, end, _, output, _ = line.split("\t")
            took[output] = (int(end) - int(start)) / 1000
    return took


def tests(costs):
    """Seconds by test: ctest's mean over the runs so far."""
    took = {}
    for line in costs.read_text(encoding="utf-8").splitlines():
        if line == "---":
            break
        name, _, cost = line.rsplit(" ", 2)
        took[name] = float(cost)
    return took


def table(title, took):
    print(f"{title}: {len(took)}, together {sum(took.values()):.0f} s")
    for name, seconds in sorted(took.items(), key=lambda item: -item[1])[:10]:
        print(f"{seconds:8.1f}  {name}")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[1])
    for title, file, read in (("built", build / ".ninja_log", compilations),
                              ("tests", build / "Testing" / "Temporary" / "CTestCostData.txt", tests)):
        if file.exists():
            table(title, read(file))


if __name__ == "__main__":
    main()
