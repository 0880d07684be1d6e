# SPDX-FileCopyrightText: 2026 the semslam authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the buttons of the windows do, pressed by a mouse on a screen in memory."""
import re
import shutil
import signal
import time
import unittest

import harness
import terminal
import xserver
from harness import BIN, CLIP

WIDTH, HEIGHT = 1440, 900
SECONDS_PER_FRAME = 0.06
NUM_PASSES = 16  # Through the clip, to and fro.
# Where the buttons of the window on a run are.
PLACES = {
    "pause": (40, 48), "step": (87, 48), "save": (131, 48), "reset": (177, 48),
    "localisation only": (29, 74),
    "photo": (29, 104), "segments": (97, 104), "classes": (188, 104), "height": (265, 104),
    "follow": (29, 128), "view": (105, 128), "top": (145, 128), "left": (272, 128),
    "objects": (29, 153), "keyframes": (105, 153), "edges": (202, 153),
    "way": (29, 178), "floor": (86, 178), "depth": (146, 178),
    "last object": (1200, 866)}
SCENE = (360, 1120, 0, 900)       # Left, right, top, bottom of what no panel covers,
OBJECTS = (1132, 1430, 480, 730)  # and of the panel that tells about an object, above its list.
NOTHING = (340, 890)              # A place beside the scene, and without a panel.
MAP_SECONDS = 3.5                 # After that time the labelled map is that of the newest frame.
PATIENCE = 30                     # Seconds.


def difference(a, b):
    """Mean of that of some bytes of two pictures."""
    return sum(abs(x - y) for x, y in zip(a[::61], b[::61])) / len(a[::61])


class ButtonsTest(harness.EndToEndTest):

    def setUp(self):
        super().setUp()
        self.screen = xserver.Screen(WIDTH, HEIGHT)
        self.addCleanup(self.screen.close)

    def tap(self, name):
        """Presses a button; the mouse must stay there until something comes of it."""
        self.screen.click(*PLACES[name])

    def click(self, name):
        """Presses a button and waits for each answer: that it is pointed at, held, and let go."""
        x, y = PLACES[name]
        mark = (x - 9, x - 3, y - 4, y + 4)  # Of the button, beside the mouse.
        for act in [lambda: self.screen.move(x, y), lambda: self.screen.press(1, True),
                    lambda: self.screen.press(1, False), lambda: self.screen.move(*NOTHING)]:
            before = self.look(mark)
            act()
            self.wait_until(lambda before=before: self.look(mark) != before, f"{name} is dead")

    def look(self, part=SCENE):
        left, right, top, bottom = part
        return b"".join(row[4 * left:4 * right] for row in self.screen.pixels()[top:bottom])

    def wait_until(self, is_so, what):
        end = time.monotonic() + PATIENCE
        while not is_so():
            self.assertLess(time.monotonic(), end, f"{what}: {self.program.text[-300:]}")
            time.sleep(0.05)

    def settled(self, part=SCENE, seconds=xserver.PICTURE):
        """That part of the screen once it stays as it is for so long."""
        picture, since, end = self.look(part), time.monotonic(), time.monotonic() + PATIENCE
        while time.monotonic() - since < seconds:
            self.assertLess(time.monotonic(), end, "it does not come to rest")
            time.sleep(0.05)
            before, picture = picture, self.look(part)
            if before != picture:
                since = time.monotonic()
        return picture

    def drag(self, button, before):
        """Moves the mouse over the scene with the button down, as far as it takes for something to
        move. The picture then."""
        places = iter(range(600, 1000, 4))
        self.screen.move(next(places), 100)
        time.sleep(xserver.PICTURE)
        self.screen.press(button, True)
        while difference(picture := self.look(), before) < 10:
            self.screen.move(next(places), 130)
            time.sleep(0.05)
        self.screen.press(button, False)
        time.sleep(2 * xserver.PICTURE)  # Or it moves further.
        self.screen.move(*NOTHING)
        return picture

    def after(self, name, before, part=SCENE):
        """What is shown instead of `before` after a button was pressed."""
        self.tap(name)
        self.wait_until(lambda: self.look(part) != before, f"{name} changes nothing")
        return self.settled(part)

    def assert_back(self, name, before, part=SCENE):
        self.tap(name)
        self.wait_until(lambda: self.look(part) == before, f"{name} does not undo it")


class RunWindowTest(ButtonsTest):
    """The window on a run, in which frames come slowly."""

    def setUp(self):
        super().setUp()
        self.program = terminal.Terminal(
            [BIN / "rgbd_tum", harness.VOCABULARY, CLIP / "settings.yaml", CLIP,
             self.slow_associations(), "--output", self.output, "--detections",
             self.folder / "detections", "--realtime", "--viewer-stays"],
            self.screen.environment())
        self.addCleanup(self.program.close)

    def slow_associations(self):
        """The clip forward, backward, forward ..."""
        detections = self.folder / "detections"
        detections.mkdir()
        shutil.copy(CLIP / "detections" / "classes.names", detections)
        frames = [line.split() for line in (CLIP / "associations.txt").read_text().splitlines()]
        lines = []
        for i, (name, color, _, depth) in enumerate((frames + frames[::-1]) * (NUM_PASSES // 2)):
            time_text = f"{1000 + SECONDS_PER_FRAME * i:.6f}"
            lines.append(f"{time_text} {color} {time_text} {depth}\n")
            shutil.copy(CLIP / "detections" / f"{name}.txt", detections / f"{time_text}.txt")
        path = self.folder / "associations.txt"
        path.write_text("".join(lines))
        return path

    def progress(self):
        """Number of the newest frame, and of keyframes by then."""
        lines = re.findall(r"frame (\d+)/\d+ [^\r]*? (\d+) keyframes", self.program.text)
        return tuple(map(int, lines[-1])) if lines else (0, 0)

    def pause(self):
        self.click("pause")
        return self.progress_at_rest()

    def progress_at_rest(self):
        time.sleep(4 * SECONDS_PER_FRAME)
        before = self.progress()
        time.sleep(8 * SECONDS_PER_FRAME)
        self.assertEqual(self.progress(), before, "it goes on")
        return before

    def step(self):
        self.click("step")
        return self.progress_at_rest()

    def go_on_until(self, is_so, what):
        self.click("pause")  # Which is called "go on" then.
        self.wait_until(lambda: is_so(*self.progress()), what)

    def test_each_button_does_what_it_says(self):
        self.screen.wait_for_window(self.program.process)
        self.wait_until(lambda: self.progress()[1] > 1, "no keyframes")
        self.check_pause_and_step()
        self.check_follow()
        self.check_colors()
        self.check_switches()
        self.check_views()
        self.check_objects()
        self.check_save()
        self.check_reset()
        self.check_localization()
        self.program.process.send_signal(signal.SIGINT)
        self.program.finish()
        self.assertIn(self.program.process.returncode, (0, 2), self.program.text)

    def check_pause_and_step(self):
        self.pause()
        frame, _ = self.step()
        self.assertEqual(self.step()[0], frame + 1)

    def check_colors(self):
        pictures = [self.settled(seconds=MAP_SECONDS)]
        for name in ["segments", "classes", "height"]:
            pictures.append(self.after(name, pictures[-1]))
        self.assertEqual(len(set(pictures)), 4)
        self.assert_back("photo", pictures[0])

    def check_switches(self):
        before = self.settled()
        for name in ["objects", "keyframes", "edges", "way", "floor", "depth"]:
            self.tap(name)
            self.wait_until(lambda: self.look() != before, f"{name} changes nothing")
            self.assert_back(name, before)

    def check_views(self):
        pictures = [self.settled()]
        for name in ["top", "left", "view"]:
            pictures.append(self.after(name, pictures[-1]))
        self.assertEqual(len(set(pictures)), 4)
        self.drag(1, pictures[-1])
        turned = self.settled()
        self.screen.click(700, 100, button=4)
        self.wait_until(lambda: self.look() != turned, "the wheel does not zoom")
        self.assert_back("view", pictures[-1])

    def check_objects(self):
        scene, panel = self.settled(), self.look(OBJECTS)
        self.after("last object", panel, OBJECTS)
        shown = self.settled(OBJECTS, 4 * xserver.PICTURE)  # The panel finds its size by and by.
        self.assertNotEqual(self.look(), scene, "the camera does not fly there")
        self.screen.click(*NOTHING)
        self.wait_until(lambda: self.look(OBJECTS) != shown, "it stays selected")
        empty = self.settled(OBJECTS, 4 * xserver.PICTURE)
        self.screen.click(WIDTH // 2, HEIGHT // 2)  # On the object, at which the camera looks.
        self.wait_until(lambda: self.look(OBJECTS) == shown, "another object, or none")
        self.screen.click(*NOTHING)
        self.wait_until(lambda: self.look(OBJECTS) == empty, "it stays selected")

    def check_follow(self):
        """A view that is moved away comes back while it follows the camera, and else stays."""
        for follows in [True, False]:
            before = self.look() if follows else self.settled()
            moved = self.drag(3, before)
            away = difference(moved, before)
            if follows:
                self.wait_until(lambda: difference(self.look(), moved) > 0.5 * away,
                                "it does not follow")
                self.click("follow")
            else:
                self.assertGreater(difference(self.settled(), before), 0.8 * away)
        self.click("view")
        self.screen.move(700, 100)
        for _ in range(6):  # So far away that the keyframes are seen too.
            self.screen.click(700, 100, button=5)
        self.screen.move(*NOTHING)

    def check_save(self):
        snapshot = self.output / "snapshot"
        self.click("save")
        self.wait_until(lambda: snapshot.is_dir() and sorted(
            path.name for path in snapshot.iterdir()) == harness.MAP_FILES, "nothing is saved")

    def check_reset(self):
        frame, keyframes = self.progress()
        self.assertGreater(keyframes, 1)
        self.click("reset")
        self.assertEqual(self.step(), (frame + 1, 1))

    def check_localization(self):
        """No keyframes are made where they are made else."""
        begin, _ = self.progress()
        self.click("localisation only")
        self.go_on_until(lambda frame, _: frame > begin + harness.NUM_FRAMES, "it does not go on")
        self.assertEqual(self.progress()[1], 1)
        self.click("localisation only")
        self.wait_until(lambda: self.progress()[1] > 1, "no keyframes are made again")


if __name__ == "__main__":
    xserver.skip_if_missing()
    unittest.main()
