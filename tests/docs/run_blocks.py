#!/usr/bin/env python3
"""Runs the fenced blocks of the documentation, literally and in order, one terminal a page.

    run_blocks.py SOURCE PROGRAM PAGE.md...

- a block ```sh is typed into one bash, command after command, in a folder of its own that has `build/fauxboard`,
  `profiles` and `tools` as a checkout has them;
- a block without a language right behind it is what it prints: each of its lines must be found, in order; `...` stands
  for anything;
- a block ```json whose comment before it says `<!-- file: NAME -->` is that file, and JSON blocks must be JSON;
- `<!-- not run: WHY -->` before a block leaves it out (hardware, another machine), and the reason is printed;
- `<!-- exit: N -->` before a block says how its last command ends, if not with 0.

Ends with a line a test runner can count: `N passed, N failed, N skipped`.
"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile

PATIENCE_S = 120
FENCE = re.compile(r"^```(\w*)\s*$")
MARK = re.compile(r"^<!--\s*(file|not run|exit|prepare):\s*(.*?)\s*-->\s*$")


class Block:
    def __init__(self, language, line, marks):
        self.language, self.line, self.marks, self.text = language, line, marks, []

    def body(self):
        return "\n".join(self.text) + "\n"


def blocks_of(page):
    blocks, block, marks = [], None, {}
    with open(page, encoding="utf-8") as lines:
        for number, raw in enumerate(lines, 1):
            line = raw.rstrip("\n")
            if block is not None:
                if line.strip() == "```":
                    blocks.append(block)
                    block = None
                else:
                    block.text.append(line)
                continue
            fence, mark = FENCE.match(line), MARK.match(line)
            if fence:
                block, marks = Block(fence.group(1), number, marks), {}
            elif mark:
                marks[mark.group(1)] = mark.group(2)
            elif line.strip():
                marks = {}
    return blocks


def expected(line):
    """A pattern for one printed line: `...` stands for anything, runs of blanks are one."""
    parts = [re.escape(" ".join(part.split())) for part in line.split("...")]
    return re.compile(r".*?".join(parts))


class Terminal:
    """One bash, fed command by command; what each prints is kept."""

    def __init__(self, folder):
        environment = dict(os.environ, HOME=folder, TERM="dumb", LC_ALL="C.UTF-8")
        self.log = os.path.join(folder, ".printed")
        self.shell = subprocess.Popen(["bash", "--norc", "--noprofile"], cwd=folder, env=environment,
                                      stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                      start_new_session=True, text=True, bufsize=1)

    def run(self, command):
        """What the command printed, and its exit code. Background jobs print into the same log, as on a terminal."""
        mark = "__end_of_command__"
        script = (f"{{ {command.rstrip()}\n}} >>{self.log} 2>&1 </dev/null\n"
                  f"printf '%s %s\\n' {mark} $?\n")
        before = os.path.getsize(self.log) if os.path.exists(self.log) else 0
        self.shell.stdin.write(script)
        self.shell.stdin.flush()
        signal.signal(signal.SIGALRM, self._too_long)
        signal.alarm(PATIENCE_S)
        try:
            for line in self.shell.stdout:
                if line.startswith(mark):
                    break
            else:
                return self._since(before) + "(the shell ended)", 1
        except TimeoutError:
            return self._since(before) + f"(no end after {PATIENCE_S} s)", 124
        finally:
            signal.alarm(0)
        return self._since(before), int(line.split()[1])

    def _too_long(self, *_):
        raise TimeoutError

    def _since(self, start):
        with open(self.log, encoding="utf-8", errors="replace") as log:
            log.seek(start)
            return log.read()

    def close(self):
        try:
            os.killpg(self.shell.pid, signal.SIGTERM)
            self.shell.wait(10)
        except (ProcessLookupError, subprocess.TimeoutExpired):
            os.killpg(self.shell.pid, signal.SIGKILL)


def folder_like_a_checkout(source, program):
    folder = tempfile.mkdtemp()
    os.mkdir(os.path.join(folder, "build"))
    os.symlink(program, os.path.join(folder, "build", "fauxboard"))
    shutil.copytree(os.path.join(source, "profiles"), os.path.join(folder, "profiles"))
    os.symlink(os.path.join(source, "tools"), os.path.join(folder, "tools"))
    return folder


def check_printed(block, printed):
    """The first line of `block` that was not printed, in order; None when all were."""
    rest = "\n".join(" ".join(line.split()) for line in printed.splitlines())
    for line in block.text:
        if not line.strip() or line.strip() == "...":
            continue
        hit = expected(line).search(rest)
        if hit is None:
            return line
        rest = rest[hit.end():]
    return None


class Page:
    def __init__(self, source, program, path):
        self.name = os.path.relpath(path, source)
        self.blocks = blocks_of(path)
        self.folder = folder_like_a_checkout(source, program)
        self.terminal = Terminal(self.folder)
        self.printed = None
        self.passed = self.failed = self.skipped = 0

    def tell(self, block, verdict, why=""):
        print(f"{self.name}:{block.line}: {verdict}{': ' + why if why else ''}", flush=True)

    def fail(self, block, why):
        self.failed += 1
        self.tell(block, "FAILED", why)

    def run_shell(self, block):
        wanted = int(block.marks.get("exit", "0"))
        self.printed, code = self.terminal.run(block.body())
        if code != wanted:
            self.fail(block, f"exit code {code}, expected {wanted}; it printed:\n{self.printed}")
        else:
            self.passed += 1

    def run_json(self, block):
        try:
            json.loads(block.body())
        except ValueError as error:
            self.fail(block, f"no JSON: {error}")
            return
        if "file" in block.marks:
            with open(os.path.join(self.folder, block.marks["file"]), "w", encoding="utf-8") as out:
                out.write(block.body())
        self.passed += 1

    def run(self):
        try:
            for at, block in enumerate(self.blocks):
                follows_shell = at > 0 and self.blocks[at - 1].language == "sh"
                if "not run" in block.marks:
                    self.skipped += 1
                    self.tell(block, "not run", block.marks["not run"])
                    self.printed = None
                elif block.language == "sh":
                    self.run_shell(block)
                elif block.language == "json":
                    self.run_json(block)
                elif block.language == "" and follows_shell and self.printed is not None:
                    missing = check_printed(block, self.printed)
                    if missing is None:
                        self.passed += 1
                    else:
                        self.fail(block, f"not printed: {missing!r}; printed was:\n{self.printed}")
                else:
                    self.skipped += 1
                    self.tell(block, "not run", f"nothing to run in it ({block.language or 'a picture'})")
        finally:
            self.terminal.close()
            shutil.rmtree(self.folder, ignore_errors=True)


def main():
    source, program, pages = sys.argv[1], sys.argv[2], sys.argv[3:]
    passed = failed = skipped = 0
    for path in pages:
        page = Page(os.path.abspath(source), os.path.abspath(program), os.path.abspath(path))
        page.run()
        passed, failed, skipped = passed + page.passed, failed + page.failed, skipped + page.skipped
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
