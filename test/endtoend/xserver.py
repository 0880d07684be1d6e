# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""A screen in memory (Xvfb), and what a user does on it: looks, closes windows, moves the mouse."""
import ctypes
import ctypes.util
import mmap
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time

XVFB = shutil.which("Xvfb")
X11 = ctypes.util.find_library("X11")
XTST = ctypes.util.find_library("Xtst")
MISSING = [name for name, found in [("Xvfb", XVFB), ("libX11", X11), ("libXtst", XTST)]
           if not found]
IS_SKIPPED = bool(MISSING) and "SEMSLAM_REQUIRE_VIEWER" not in os.environ
PICTURE = 0.5  # Seconds; a window drawn in software on a busy machine shows a picture in that time.
ERROR_HANDLER = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)


def skip_if_missing():
    """Ends a test program that cannot have a screen."""
    if IS_SKIPPED:
        print(f"skipped: {' and '.join(MISSING)} not found; "
              "scripts/install_dependencies.sh --with-browser installs them")
        sys.exit(77)  # CTest's "skipped", as in CMakeLists.txt.


class ClientMessage(ctypes.Structure):
    """XClientMessageEvent, padded to the size of any XEvent."""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong),
                ("message_type", ctypes.c_ulong), ("format", ctypes.c_int),
                ("data", ctypes.c_long * 5), ("padding", ctypes.c_long * 24)]


class Screen:
    """A screen of its own; close() ends it. One at a time."""

    def __init__(self, width=1280, height=800):
        self.width, self.height = width, height
        self.folder = tempfile.mkdtemp()
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            [XVFB, "-displayfd", str(writer), "-screen", "0", f"{width}x{height}x24", "-fbdir",
             self.folder, "-nolisten", "tcp"], pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as numbers:
            number = numbers.readline().strip()
        if not number:
            raise RuntimeError("Xvfb did not start")
        self.name = f":{number}"
        self.x11, self.tester = ctypes.CDLL(X11), ctypes.CDLL(XTST)
        self.ignore = ERROR_HANDLER(lambda display, error: 0)
        self.x11.XSetErrorHandler(self.ignore)  # A window may go before it is closed.
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(self.name.encode()))
        self.x11.XDefaultRootWindow.restype = ctypes.c_ulong
        self.x11.XInternAtom.restype = ctypes.c_ulong
        self.root = ctypes.c_ulong(self.x11.XDefaultRootWindow(self.display))

    def environment(self):
        return {**os.environ, "DISPLAY": self.name}

    def windows(self):
        """Those that programs show."""
        root, parent = ctypes.c_ulong(), ctypes.c_ulong()
        children, count = ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        self.x11.XQueryTree(self.display, self.root, ctypes.byref(root), ctypes.byref(parent),
                            ctypes.byref(children), ctypes.byref(count))
        found = []
        for i in range(count.value):
            name = ctypes.c_char_p()
            if self.x11.XFetchName(self.display, ctypes.c_ulong(children[i]), ctypes.byref(name)):
                found.append(children[i])
        return found

    def wait_for_window(self, process, seconds=60):
        """The first window, or None if the process ends without one."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if windows := self.windows():
                return windows[0]
            if process.poll() is not None:
                return None
            time.sleep(0.02)
        raise TimeoutError("no window")

    def close_window(self, window):
        """As the button in a window's frame does."""
        def atom(name):
            return self.x11.XInternAtom(self.display, name, 0)
        event = ClientMessage(type=33, window=window, message_type=atom(b"WM_PROTOCOLS"),
                              format=32)
        event.data[0] = atom(b"WM_DELETE_WINDOW")
        self.x11.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(0),
                            ctypes.byref(event))
        self.x11.XFlush(self.display)

    def move(self, x, y):
        """Moves the mouse there."""
        self.tester.XTestFakeMotionEvent(self.display, 0, x, y, ctypes.c_ulong(0))
        self.x11.XFlush(self.display)

    def press(self, button, is_down):
        """A button of the mouse: 1 left, 3 right, 4 the wheel forward."""
        self.tester.XTestFakeButtonEvent(self.display, button, is_down, ctypes.c_ulong(0))
        self.x11.XFlush(self.display)

    def click(self, x, y, button=1):
        """Moves the mouse there and presses a button."""
        self.move(x, y)
        time.sleep(0.1)
        self.press(button, True)
        self.press(button, False)

    def pixels(self):
        """The screen as rows of bytes: blue, green, red, unused."""
        path = pathlib.Path(self.folder) / "Xvfb_screen0"  # In the format of xwd.
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            header = struct.unpack(">25I", data[:100])
            start = header[0] + 12 * header[19]
            return [data[start + row * header[12]:start + row * header[12] + 4 * self.width]
                    for row in range(self.height)]

    def num_colors(self, left=0, right=None, top=0, bottom=None):
        """Among every third pixel of a part."""
        right = right or self.width
        return len({row[i:i + 3] for row in self.pixels()[top:bottom:3]
                    for i in range(4 * left, 4 * right, 12)})

    def wait_for_colors(self, least, seconds=60, **part):
        """Until so many different ones are shown; how many there were at last."""
        end = time.monotonic() + seconds
        while True:
            count = self.num_colors(**part)
            if count >= least or time.monotonic() > end:
                return count
            time.sleep(0.05)

    def close(self):
        self.x11.XCloseDisplay(self.display)
        self.server.terminate()
        self.server.wait(timeout=20)
        shutil.rmtree(self.folder, ignore_errors=True)
