#!/usr/bin/env python3
"""Runs the fenced blocks of the documentation, literally and in order, one terminal a page.

    run_blocks.py SOURCE PROGRAM PAGE.md...
    run_blocks.py --pages SOURCE PAGE.md...     # runs nothing: counts, and fails when a page with blocks is not named

- a block ```sh is typed into one bash, command after command, in a folder of its own that has `build/fauxboard`,
  `profiles` and `tools` as a checkout has them;
- a block without a language right behind it is what it prints: each of its lines must be found, in order; `...` stands
  for anything;
- a block ```json whose comment before it says `<!-- file: NAME -->` is that file, and JSON blocks must be JSON;
- every command must end with 0; `<!-- exit: N -->` before a block says how its last one ends instead;
- `<!-- stays: WHY -->`: each of its lines gets a terminal of its own, and Ctrl-C when it has said something;
- `<!-- stand-in: A => B; C => D -->`: what the reader has and a test has not, and what is typed in its place;
- `<!-- prepare: COMMAND -->`: typed before, for what the reader is supposed to have;
- `<!-- tried by: TEST -->`: left to a test of its own, which names the page;
- `<!-- not run: WHY -->` leaves a block out, and the reason is printed.

Ends with a line a test runner can count: `N passed, N failed, N skipped`.
"""
import collections
import fcntl
import json
import os
import pty
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios

PATIENCE_S = 120
FENCE = re.compile(r"^```(\w*)\s*$")
MARK = re.compile(r"^<!--\s*(file|not run|exit|prepare|stays|stand-in|tried by):\s*(.*?)\s*-->\s*$")


class Block:
    def __init__(self, language, line, marks):
        self.language, self.line, self.marks, self.text = language, line, marks, []

    def body(self):
        return "\n".join(self.text) + "\n"

    def typed(self):
        """The body, with stand-ins for what a test has not."""
        text = self.body()
        for pair in filter(None, self.marks.get("stand-in", "").split("; ")):
            real, stand_in = pair.split(" => ")
            if real not in text:
                raise ValueError(f"no {real!r} to stand in for")
            text = text.replace(real, stand_in)
        return text

    def fate(self):
        """What becomes of it, for the sum."""
        for mark in ("not run", "tried by"):
            if mark in self.marks:
                return mark
        if self.language in ("sh", "json"):
            return "run with a stand-in" if "stand-in" in self.marks else "run"
        return "printed" if self.language == "" else "no commands"


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
                before = marks.get(mark.group(1))  # a mark may stand there more than once
                marks[mark.group(1)] = mark.group(2) if before is None else before + "\n" + mark.group(2)
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
        """What the commands printed, the last one's exit code, and what failed before it. Background jobs print into the
        same log, as on a terminal."""
        mark = "__end_of_command__"
        script = ("__failed=(); trap '__failed+=(\"$BASH_COMMAND\")' ERR\n"
                  f"{{ {command.rstrip()}\n}} >>{self.log} 2>&1 </dev/null\n"
                  f"__code=$?; trap - ERR; printf '%s %s %s\\n' {mark} $__code \"${{__failed[*]:0:${{#__failed[@]}}-!!__code}}\"\n")
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
                return self._since(before) + "(the shell ended)", 1, ""
        except TimeoutError:
            return self._since(before) + f"(no end after {PATIENCE_S} s)", 124, ""
        finally:
            signal.alarm(0)
        _, code, failed = line.rstrip("\n").split(" ", 2)
        return self._since(before), int(code), failed

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


def on_a_terminal(command, folder):
    """Types Ctrl-C when the command has said something; what it said, and its exit code."""
    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(folder)
        environment = dict(os.environ, HOME=folder, TERM="xterm", LC_ALL="C.UTF-8")
        os.execvpe("bash", ["bash", "--norc", "--noprofile", "-c", command], environment)
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 120, 0, 0))

    def too_long(*_):
        os.kill(pid, signal.SIGKILL)

    signal.signal(signal.SIGALRM, too_long)
    signal.alarm(PATIENCE_S)
    said = b""
    try:
        while piece := os.read(terminal, 4096):
            if not said:
                os.write(terminal, b"\x03")
            said += piece
    except OSError:  # a terminal whose last program has gone
        pass
    code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    signal.alarm(0)
    os.close(terminal)
    return said.decode(errors="replace"), code


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
        failed = ""
        if "prepare" in block.marks:
            self.printed, code, failed = self.terminal.run(block.marks["prepare"] + "\n:")
            if failed:
                self.fail(block, f"not prepared: {failed}; it printed:\n{self.printed}")
                return
        if "stays" in block.marks:
            self.printed, code = "", wanted
            for command in filter(str.strip, block.typed().splitlines()):
                said, code = on_a_terminal(command, self.folder)
                self.printed += said
                if code != wanted:
                    break
        else:
            self.printed, code, failed = self.terminal.run(block.typed())
        if failed:
            self.fail(block, f"failed: {failed}; it printed:\n{self.printed}")
        elif code != wanted:
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
                if block.fate() in ("not run", "tried by"):
                    self.skipped += 1
                    self.tell(block, block.fate(), block.marks[block.fate()])
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


def pages_with_blocks(source):
    """Each page of the tree that has fenced blocks, whatever their language and however far they are indented."""
    fence = re.compile(r"^\s*(```|~~~)", re.M)
    for folder, folders, files in os.walk(source):
        folders[:] = [name for name in folders if not name.startswith((".", "build"))]
        for name in files:
            path = os.path.join(folder, name)
            if name.endswith(".md"):
                with open(path, encoding="utf-8") as page:
                    fences = len(fence.findall(page.read()))
                if fences:
                    yield os.path.relpath(path, source), fences


def count(source, pages):
    """The sum over all pages, and what is wrong with them: a page or a block that would be passed over in silence."""
    wrong, fates, reasons = [], collections.Counter(), []
    named = {os.path.relpath(page, source) for page in pages}
    for page, fences in pages_with_blocks(source):
        blocks = blocks_of(os.path.join(source, page))
        if page not in named:
            wrong.append(f"{page} has blocks and is not among the pages that are run")
        if fences != 2 * len(blocks):
            wrong.append(f"{page} has {fences} fences, and {len(blocks)} blocks that begin in the first column")
        for block in blocks:
            fates[block.fate()] += 1
            where = f"{page}:{block.line}"
            if block.language in ("bash", "console", "shell", "zsh"):
                wrong.append(f"{where}: a block of commands is called sh")
            if block.fate() == "tried by":
                with open(os.path.join(source, block.marks["tried by"]), encoding="utf-8") as test:
                    if os.path.basename(page) not in test.read():
                        wrong.append(f"{where}: {block.marks['tried by']} does not name the page")
            if block.fate() in ("not run", "tried by"):
                reasons.append(f"  {where}: {block.fate()}: {block.marks[block.fate()]}")
    print(f"{sum(fates.values())} blocks on {len(named)} pages: " +
          ", ".join(f"{number} {fate}" for fate, number in sorted(fates.items())))
    print("\n".join(reasons + wrong))
    return 1 if wrong else 0


def main():
    if sys.argv[1] == "--pages":
        return count(sys.argv[2], sys.argv[3:])
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
