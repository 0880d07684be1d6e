# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""Chromium without a window, through chromedriver and the W3C's WebDriver protocol."""
import base64
import json
import re
import shutil
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

CHROMIUM = shutil.which("chromium")
DRIVER = shutil.which("chromedriver")
MISSING = [name for name, path in [("chromium", CHROMIUM), ("chromedriver", DRIVER)] if not path]

# WebGL in software; nothing that looks for a network.
FLAGS = ["--headless", "--no-sandbox", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader"]
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # The protocol's name of a reference to one.
TIMEOUT = 120  # Seconds, of one command.


class Browser:
    """One browser with one page; close() ends it."""

    def __init__(self, width=1200, height=900, webgl=True):
        self.profile = tempfile.mkdtemp()
        self.driver = subprocess.Popen([DRIVER, "--port=0"], stdout=subprocess.PIPE,
                                       stderr=subprocess.STDOUT, text=True)
        self.session = None
        self.url = f"http://127.0.0.1:{self._read_port()}/session"
        flags = FLAGS if webgl else [*FLAGS[:-3], "--disable-gpu", "--disable-3d-apis"]
        options = {"binary": CHROMIUM,
                   "args": [*flags, f"--user-data-dir={self.profile}",
                            f"--window-size={width},{height}"]}
        capabilities = {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        try:
            self.session = self._send("POST", "", {"capabilities": {
                "alwaysMatch": capabilities}})["sessionId"]
        except Exception:
            self.close()
            raise

    def _read_port(self):
        for line in self.driver.stdout:
            match = re.search(r"successfully on port (\d+)", line)
            if match:
                return int(match.group(1))
        raise RuntimeError("chromedriver did not start")

    def _send(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.url + path, data=data, method=method,
                                         headers={"Content-Type": "application/json"})
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with opener.open(request, timeout=TIMEOUT) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{method} {path}: {error.read().decode()}") from None

    def call(self, method, path, body=None):
        """A command of the protocol in this session."""
        return self._send(method, f"/{self.session}{path}", body)

    def open(self, path):
        self.call("POST", "/url", {"url": path.absolute().as_uri()})

    def run(self, script, *arguments):
        """What the script returns; arguments[0] ... are given."""
        return self.call("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def click(self, selector):
        """As a user does: scrolls to the element and clicks its middle."""
        found = self.call("POST", "/element", {"using": "css selector", "value": selector})
        self.run("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", found)
        self.call("POST", f"/element/{found[ELEMENT]}/click", {})

    def wait_for(self, script, seconds=60):
        """Until the script returns something true; that, or what it returned last."""
        end = time.monotonic() + seconds
        while True:
            value = self.run(script)
            if value or time.monotonic() > end:
                return value
            time.sleep(0.1)

    def complaints(self):
        """What stands on the console: warnings and errors."""
        log = self.call("POST", "/se/log", {"type": "browser"})
        # How long pixels took to come back is no complaint of ours.
        return [entry["message"] for entry in log if entry["level"] in ("WARNING", "SEVERE")
                and "ReadPixels" not in entry["message"]]

    def devtools(self, command, **parameters):
        return self.call("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def emulate(self, scheme="light", medium="screen", width=None, height=900):
        """Light or dark, screen or print, and the width of a phone."""
        self.devtools("Emulation.setEmulatedMedia", media=medium,
                      features=[{"name": "prefers-color-scheme", "value": scheme}])
        if width:
            self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height,
                          deviceScaleFactor=1, mobile=width < 600)

    def save_picture(self, path):
        """Of the whole page, for people; also what lies below the window."""
        size = self.devtools("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}
        picture = self.devtools("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)
        path.write_bytes(base64.b64decode(picture["data"]))

    def close(self):
        if self.session:
            try:
                self.call("DELETE", "")
            except (OSError, RuntimeError):
                pass  # It is gone already.
        self.driver.terminate()
        self.driver.wait(timeout=20)
        self.driver.stdout.close()
        shutil.rmtree(self.profile, ignore_errors=True)
