# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""report.html in a browser: it opens without complaints, draws, and can be used.

With SEMSLAM_SCREENSHOTS=DIR it leaves pictures of the page there, for people to look at.
"""
import os
import pathlib
import sys
import unittest

import browser
import harness
from harness import CLIP, run

# Of the canvas: number of different colours among every so many pixels, and a sum that tells one
# picture from another.
LOOK = """
const canvas = document.getElementById("canvas");
const copy = document.createElement("canvas");
[copy.width, copy.height] = [canvas.width, canvas.height];
const context = copy.getContext("2d", {willReadFrequently: true});
context.drawImage(canvas, 0, 0);
const {data} = context.getImageData(0, 0, copy.width, copy.height);
const colors = new Set();
let sum = 0;
for (let i = 0; i < data.length; i += 28) {
  const color = data[i] << 16 | data[i + 1] << 8 | data[i + 2];
  colors.add(color);
  sum = (sum * 31 + color) % 1000000007;
}
return {colors: colors.size, sum};
"""
EYE = "return document.getElementById('canvas').dataset.eye"
ARRIVED = "return document.getElementById('canvas').dataset.flies === 'no'"


class ReportTest(unittest.TestCase):
    """One run, and its page in one browser."""

    @classmethod
    def setUpClass(cls):
        folder = harness.WORK / "report"
        summary = run("rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
                      CLIP / "associations.txt", "--output", folder, "--sequential",
                      "--detections", CLIP / "detections")
        assert summary.returncode == 0, summary.stderr
        cls.page = folder / "report.html"
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.emulate(width=1200)
        self.browser.open(self.page)

    def look(self):
        return self.browser.run(LOOK)

    def wait_for_arrival(self):
        self.assertTrue(self.browser.wait_for(ARRIVED))

    def test_the_page_opens_without_complaints(self):
        self.assertIn(CLIP.name, self.browser.run("return document.title"))
        self.assertTrue(self.browser.run("return document.getElementById('message').hidden"))
        self.assertEqual(self.browser.complaints(), [])

    def test_the_view_draws_the_map(self):
        self.assertGreater(self.look()["colors"], 200)

    def test_the_switch_changes_the_colours(self):
        sums = []
        for mode in ["photo", "segments", "classes"]:
            self.browser.click(f"label:has(input[value={mode}])")
            sums.append(self.look()["sum"])
        self.assertEqual(len(set(sums)), 3)
        self.browser.click("label:has(input[value=photo])")
        self.assertEqual(self.look()["sum"], sums[0])

    def test_clicking_an_object_flies_to_it(self):
        before = self.browser.run(EYE)
        self.browser.click("tr[data-object] .fly")
        self.wait_for_arrival()
        self.assertNotEqual(self.browser.run(EYE), before)
        distance = self.browser.run("""
            const scene = JSON.parse(document.getElementById("scene").textContent);
            const place = document.querySelector("tr[data-object]").dataset.object;
            const eye = document.getElementById("canvas").dataset.eye.split(" ").map(Number);
            return Math.hypot(...eye.map((x, i) => x - scene.objects[place].center[i]));""")
        self.assertLess(distance, 2.5)
        self.assertEqual(self.browser.run(
            "return document.querySelectorAll('tr.selected').length"), 1)
        self.browser.click("#reset")
        self.assertTrue(self.browser.wait_for(f"{EYE} === '{before}'"))
        self.assertEqual(self.browser.complaints(), [])

    def test_clicking_a_keyframe_looks_from_there(self):
        self.browser.click("[data-keyframe='0']")
        self.wait_for_arrival()
        eye = [float(x) for x in self.browser.run(EYE).split()]
        self.assertLess(max(map(abs, eye)), 0.01)  # The first camera is the origin.

    def test_dragging_turns_the_view(self):
        before, eye = self.look()["sum"], self.browser.run(EYE)
        self.browser.call("POST", "/actions", {"actions": [{
            "type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [
                {"type": "pointerMove", "duration": 0, "x": 600, "y": 500},
                {"type": "pointerDown", "button": 0},
                {"type": "pointerMove", "duration": 50, "x": 700, "y": 540},
                {"type": "pointerUp", "button": 0}]}]})
        self.assertTrue(self.browser.wait_for(f"{EYE} !== '{eye}'"))
        self.assertNotEqual(self.look()["sum"], before)
        self.assertEqual(self.browser.complaints(), [])

    def test_it_fits_a_phone(self):
        self.browser.emulate(width=360, height=740)
        self.browser.open(self.page)
        self.assertLessEqual(
            self.browser.run("return document.documentElement.scrollWidth"), 360)
        self.assertGreater(self.look()["colors"], 200)

    def test_dark_is_dark_and_print_is_light(self):
        shade = "return getComputedStyle(document.body).backgroundColor.match(/\\d+/)[0]"
        shades = {}
        for scheme, medium in [("light", "screen"), ("dark", "screen"), ("dark", "print")]:
            self.browser.emulate(scheme=scheme, medium=medium, width=1200)
            shades[scheme, medium] = int(self.browser.run(shade))
        self.assertGreater(shades["light", "screen"], 200)
        self.assertLess(shades["dark", "screen"], 60)
        self.assertGreater(shades["dark", "print"], 200)

    def test_screenshots_can_be_taken(self):
        folder = os.environ.get("SEMSLAM_SCREENSHOTS")
        if not folder:
            self.skipTest("SEMSLAM_SCREENSHOTS names no folder")
        folder = pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        for name, settings in [("light", {"width": 1280}),
                               ("dark", {"width": 1280, "scheme": "dark"}),
                               ("phone", {"width": 390, "height": 780}),
                               ("print", {"width": 800, "medium": "print"})]:
            self.browser.emulate(**settings)
            self.browser.open(self.page)
            self.browser.save_picture(folder / f"report_{name}.png")


class WithoutWebGlTest(unittest.TestCase):
    """A browser that cannot draw in three dimensions."""

    def test_the_page_says_so_and_shows_the_rest(self):
        folder = harness.WORK / "report_without_webgl"
        result = run("rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
                     CLIP / "associations.txt", "--output", folder, "--no-semantics")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = browser.Browser(webgl=False)
        self.addCleanup(page.close)
        page.open(folder / "report.html")
        message = "return document.getElementById('message')"
        self.assertFalse(page.run(f"{message}.hidden"))
        self.assertIn("no WebGL 2", page.run(f"{message}.textContent"))
        self.assertGreater(page.run("return document.querySelectorAll('.plot svg').length"), 4)


if __name__ == "__main__":
    if browser.MISSING:
        print(f"skipped: {' and '.join(browser.MISSING)} not found; "
              "scripts/install_dependencies.sh --with-browser installs them")
        sys.exit(77)  # CTest's "skipped", as in CMakeLists.txt.
    unittest.main()
