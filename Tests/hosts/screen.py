"""A screen that nobody sees, with one program, mouse and keys."""
import os
import subprocess
import time

from host_test import Processes, picture, until

LEAST_RING = 40  # pixels of a ring around the smallest button


class Screen(Processes):
    """A screen with one program, mouse and keys."""

    def __init__(self, home):
        super().__init__()
        self.display = self.start_screen()
        self.environment = dict(os.environ, DISPLAY=self.display, HOME=str(home))

    def tool(self, *arguments):
        return subprocess.run(["xdotool", *[str(a) for a in arguments]], env=self.environment, capture_output=True,
                              text=True, timeout=60)

    def find_window(self, title, width=None):
        """Whether a window of that title, and of that width, is seen; mouse and keys go there from now on."""
        found = self.tool("search", "--onlyvisible", "--name", title).stdout.split()
        if not found:
            return False
        self.window = found[-1]
        place = dict(line.split("=") for line in self.tool("getwindowgeometry", "--shell", self.window).stdout.split())
        self.left, self.top = int(place["X"]), int(place["Y"])
        return width is None or int(place["WIDTH"]) == width

    def focus(self):
        self.tool("windowfocus", self.window)
        time.sleep(0.3)

    def move(self, x, y):
        self.tool("mousemove", self.left + x, self.top + y)
        time.sleep(0.15)

    def drag(self, x, y, to_x, to_y):
        self.move(x, y)
        self.tool("mousedown", 1)
        for i in range(1, 6):
            self.move(x + (to_x - x) * i // 5, y + (to_y - y) * i // 5)
        self.tool("mouseup", 1)
        time.sleep(0.3)

    def keys(self, *names):
        for name in names:
            self.tool("key", "--clearmodifiers", name)
            time.sleep(0.25)

    def type(self, text):
        self.tool("type", "--delay", "20", text)
        time.sleep(0.3)

    def difference(self, one, other):
        """Pixels in which two pictures differ beyond the smoothing of edges."""
        found = subprocess.run(["compare", "-metric", "AE", "-fuzz", "5%", str(one), str(other), "null:"],
                               capture_output=True, text=True, timeout=60)
        return int(float(found.stderr.split()[0]))

    def unseen_stops(self, folder, most):
        """The stops of Tab, of `most`, at which nothing shows that the keyboard has gone on.

        The pointer rests outside of the window: a tool tip is no ring.
        """
        before, now = folder / "before.png", folder / "now.png"
        self.tool("mousemove", 2, 2)
        time.sleep(0.5)
        picture(self.display, before)

        def shows():
            picture(self.display, now)
            return self.difference(before, now) >= LEAST_RING

        unseen = []
        for stop in range(1, most + 1):
            self.keys("Tab")
            if not until(shows, 2):  # a busy machine paints later
                unseen.append(stop)
            before, now = now, before
        return unseen
