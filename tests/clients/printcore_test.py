"""Debian's Printrun (printcore) against a board: prints from the host and from the card, on a bad line too, is
stopped, and goes on. Every move must be carried out once and in order."""

import os
import sys
import unittest

try:
    import printrun.printcore  # noqa: F401
    import serial  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}; Debian's packages are printrun-common and python3-serial")
    sys.exit(77)

from board import Board, accepted, said_behind
from printer import Printer

# The long print; FAUXBOARD_MOVES=60000 takes printcore some five minutes.
MOVES = int(os.environ.get("FAUXBOARD_MOVES", "6000"))
BAD_LINE = ("garble:to_board,probability=0.01,seed=7,after=12", "drop:to_board,probability=0.01,seed=8,after=12")


def sliced(moves, seed=1):
    """A file of so many moves; where the head goes and how much it extrudes shows if one is left out, comes
    twice, or too early."""
    lines = ["G21", "G90", "M83", "G92 E0", "M302 S0"]
    state = seed
    for i in range(moves):
        state = (state * 1103515245 + 12345) % 2**31
        x, y = 100 + (state >> 8) % 400 / 100, 100 + (state >> 17) % 400 / 100
        lines.append(f"G1 X{x:.2f} Y{y:.2f} E{0.00001 * (i % 97 + 1):.5f} F12000")
    # If the last line of a print is lost nobody asks for it: printcore sends nothing behind it.
    return lines + ["M400"] * 5


def moves_of(lines):
    return [line for line in lines if line.startswith(("G0 ", "G1 "))]


def place(line):
    return {word[0]: float(word[1:]) for word in line.split()[1:]}


class Client:
    """What every board with a host's line must stand; `profile` is the board's."""

    def board(self, faults=()):
        return Board(self.profile, faults)

    @staticmethod
    def settle(board, printer):
        """Until all that was sent is carried out."""
        for _ in range(2):
            printer.until(lambda: not board.field("host.busy") and not board.field("motion.busy"), "rest")
            board.ask("advance", by=1)

    def printed(self, board, printer, lines, limit_s):
        printer.print_lines(lines)
        printer.until(lambda: not printer.printing, "the print's end", limit_s)
        self.settle(board, printer)

    def check(self, board, lines, before=0):
        """All of these moves, once, in order, and nothing else."""
        self.assertEqual(board.field("host.moves") - before, len(moves_of(lines)))
        end = place(moves_of(lines)[-1])
        self.assertAlmostEqual(board.field("position.x"), end["X"], 2)
        self.assertAlmostEqual(board.field("position.y"), end["Y"], 2)

    def print_file(self, faults, moves, limit_s):
        lines = sliced(moves)
        with self.board(faults) as board:
            printer = Printer(board.port)
            try:
                printer.until(lambda: printer.online, "the board")
                self.printed(board, printer, lines, limit_s)
                self.check(board, lines)
                resent = board.field("host.resends")
            finally:
                printer.leave()
        self.assertEqual(board.code, 0)
        by_the_rules = moves_of(accepted(board.talk))
        if by_the_rules != moves_of(lines):
            self.fail(f"{len(by_the_rules)} of {moves} moves; behind the last of them\n"
                      + said_behind(board.talk, by_the_rules[-1] if by_the_rules else "M110"))
        return resent

    def test_connects_and_prints(self):
        self.assertEqual(self.print_file((), 2000, 120), 0)

    def test_a_long_file_on_a_bad_line(self):
        resent = self.print_file(BAD_LINE, MOVES, 3500)
        self.assertGreater(resent, MOVES // 100)

    def test_cancel_and_a_second_print_at_once(self):
        lines = sliced(MOVES)
        with self.board(BAD_LINE) as board:
            printer = Printer(board.port)
            try:
                printer.until(lambda: printer.online, "the board")
                printer.print_lines(lines)
                printer.until(lambda: board.field("host.moves") > 500, "some moves", 300)
                printer.cancelprint()
                self.settle(board, printer)
                done = board.field("host.moves")
                self.assertLess(done, MOVES)
                second = sliced(1500, seed=2)
                self.printed(board, printer, second, 300)
                self.check(board, second, before=done)
            finally:
                printer.leave()
        carried_out = moves_of(accepted(board.talk))
        self.assertEqual(carried_out[:done], moves_of(lines)[:done])
        self.assertEqual(carried_out[done:], moves_of(second))

    def print_from_card(self, faults):
        lines = sliced(5000)
        with self.board(faults) as board:
            (board.card / "part.gco").write_text("\n".join(lines) + "\n", encoding="ascii")
            printer = Printer(board.port)
            try:
                printer.until(lambda: printer.online, "the board")
                printer.ask("M21", "ok")
                printer.ask("M20", "End file list")
                self.assertTrue(any(line.lower().startswith("part.gco") for line in printer.heard))
                printer.ask("M23 part.gco", "File selected")
                printer.ask("M24", "ok")
                # It answers while it prints, as ever.
                printer.ask("M105", "ok T:")
                printer.ask("M114", "X:")
                printer.until(lambda: not board.field("job.active"), "the print's end", 120)
                end = place(moves_of(lines)[-1])
                self.assertEqual(board.field("job.moves"), len(moves_of(lines)))
                self.assertAlmostEqual(board.field("position.x"), end["X"], 2)
                printer.until(lambda: any("Done printing" in line for line in printer.heard), "the word for it")
            finally:
                printer.leave()

    def test_card(self):
        self.print_from_card(())

    def test_card_on_a_bad_line(self):
        self.print_from_card(BAD_LINE)

    def test_stopped_at_once_and_again_after_a_reset(self):
        with self.board() as board:
            printer = Printer(board.port)
            try:
                printer.until(lambda: printer.online, "the board")
                printer.print_lines(sliced(MOVES))
                printer.until(lambda: board.field("host.moves") > 200, "some moves", 120)
                printer.pause()
                printer.send_now("M112")
                printer.until(lambda: "M112" in printer.sent, "the word on the line")
                printer.until(lambda: not board.field("motion.busy"), "a stop")
                board.ask("advance", by=1)
                stopped = board.field("host.moves")
                board.ask("do", do="board.reset")
                board.ask("advance", by=10)
                self.assertEqual(board.field("host.moves"), 0)
                self.assertGreater(stopped, 200)
                printer.cancelprint()
                printer.ask("M105", "ok T:")
                second = sliced(500, seed=3)
                self.printed(board, printer, second, 120)
                self.check(board, second)
            finally:
                printer.leave()


class A30T(Client, unittest.TestCase):
    profile = "geeetech-a30t"


class Marlin(Client, unittest.TestCase):
    profile = "marlin"


if __name__ == "__main__":
    unittest.main(verbosity=2)
