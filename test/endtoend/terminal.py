# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""A program as somebody runs it who looks at a terminal."""
import os
import pty
import re
import subprocess
import threading
import time

TIMEOUT = 240  # Seconds; far above what is waited for, also under sanitizers.


class Terminal:
    """A program in a terminal, where it shows all of its progress at once."""

    def __init__(self, command, environment):
        self.text = ""
        self.reader, writer = pty.openpty()
        self.process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL,
                                        stdout=writer, stderr=writer, env=environment)
        os.close(writer)
        self.thread = threading.Thread(target=self._read)
        self.thread.start()

    def _read(self):
        while True:
            try:
                data = os.read(self.reader, 4096)
            except OSError:  # How a terminal ends.
                return
            if not data:
                return
            self.text += data.decode(errors="replace")

    def wait_for(self, pattern, seconds=TIMEOUT):
        """Until it is shown, or the program ends."""
        end = time.monotonic() + seconds
        while not re.search(pattern, self.text) and self.process.poll() is None:
            if time.monotonic() > end:
                raise TimeoutError(f"{pattern} is not shown")
            time.sleep(0.005)

    def finish(self):
        self.process.wait(timeout=TIMEOUT)
        self.thread.join(timeout=20)

    def close(self):
        self.process.kill()
        self.process.wait()
        self.thread.join(timeout=20)
        os.close(self.reader)
