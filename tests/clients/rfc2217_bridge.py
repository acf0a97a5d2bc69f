"""A pseudo-terminal here for a line that a server of RFC 2217 has: prints its path, and passes on what comes.

    rfc2217_bridge.py URL
"""

import os
import sys
import termios
import threading
import tty

import serial

with serial.serial_for_url(sys.argv[1], baudrate=115200, timeout=0.5) as far:
    near, line = os.openpty()
    tty.setraw(line, termios.TCSANOW)

    def bring():
        while True:
            os.write(near, far.read(max(1, far.in_waiting)))

    threading.Thread(target=bring, daemon=True).start()
    print(os.ttyname(line), flush=True)
    while data := os.read(near, 4096):
        far.write(data)
