"""Printrun's printcore as a person's host uses it, with a watch that goes on where an answer was lost."""

import logging
import threading
import time

from printrun import gcoder
from printrun.printcore import printcore

logging.disable(logging.WARNING)  # its parser says at each start that it is the slow one


class Printer(printcore):
    """A lost line, or a lost `ok`, makes printcore wait for ever; its users press a button then. Here the next
    line goes out when nothing came for `patience_s`: the numbers of the lines do the rest.

    At a byte that is no UTF-8 it stops listening for good, and a board tells it its own garbled line as a command
    that it does not know; here such a byte is read as an escape.

    It also sends two lines for one error, at `Resend:` and at the `ok` behind it, so that ever more of them are
    under way and each error costs more; here the `ok` counts alone."""

    def __init__(self, port, patience_s=0.05):
        self.at_resend = False
        self.may_send = 0
        super().__init__()
        self.heard = []
        self.errors = []
        self.patience_s = patience_s
        self.last = time.monotonic()
        self.recvcb = self.hear
        self.errorcb = self.errors.append
        self.gone = threading.Event()
        threading.Thread(target=self.watch, daemon=True).start()
        self.connect(port, 115200)

    @property
    def clear(self):
        """Whether the next line may go out."""
        return self.may_send

    @clear.setter
    def clear(self, value):
        if value and self.at_resend:
            self.at_resend = False
        else:
            self.may_send = value

    def _readline_nb(self):
        line = super()._readline_nb()
        return line.decode("utf-8", "backslashreplace").encode("utf-8") if isinstance(line, bytes) else line

    def hear(self, line):
        self.last = time.monotonic()
        self.at_resend = line.startswith("Resend")
        self.heard.append(line.rstrip())
        if len(self.heard) > 100_000:
            del self.heard[:50_000]

    def watch(self):
        while not self.gone.wait(self.patience_s / 4):
            if self.printing and not self.clear and time.monotonic() - self.last > self.patience_s:
                self.last = time.monotonic()
                self.clear = True

    def until(self, there, what, limit_s=60):
        """Waits until there() is true."""
        end = time.monotonic() + limit_s
        while not there():
            assert time.monotonic() < end, f"in vain: a wait for {what}; last came {self.heard[-5:]}"
            time.sleep(0.01)

    def ask(self, command, wanted, times=20):
        """Says a command until a line comes that starts with `wanted`: on a bad line either may be lost."""
        for _ in range(times):
            seen = len(self.heard)
            self.send_now(command)
            end = time.monotonic() + 5
            while time.monotonic() < end:
                line = next((one for one in self.heard[seen:] if one.startswith(wanted)), None)
                if line is not None:
                    return line
                time.sleep(0.01)
        raise AssertionError(f"{command}: no line that starts with {wanted}; last came {self.heard[-5:]}")

    def print_lines(self, lines):
        """Prints them, to the end."""
        assert self.startprint(gcoder.LightGCode(lines))

    def leave(self):
        self.gone.set()
        self.printing = False
        # Its print thread starts the sender again, and must not be met in the middle of that.
        self.until(lambda: self.print_thread is None and self.send_thread and self.send_thread.is_alive(), "its end")
        self.disconnect()
