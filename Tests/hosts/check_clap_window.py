#!/usr/bin/env python3
"""The window of the CLAP plugin in a window of a host of our own: sizes, gestures, presets of the command and for it,
undo, the two sides, many openings, with a timer of the host and without, and while sound plays.

check_clap_window.py PLUGIN.clap PACINI [PICTURE]     exit 0, 1 on a failed check, 77 when something is not there
"""

import ctypes
import json
import os
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from host_test import Processes, check, failures, needs, picture, skip, until

try:
    import numpy as np
    from clap_host import BEGIN, CONTINUE, END, VALUE, Hints, Library, Plugin, Window, c
except ImportError as error:
    skip(error)

X11 = b"x11"


class Screen:
    """A connection of the host to the screen."""

    def __init__(self, display):
        self.x = ctypes.CDLL("libX11.so.6")
        self.x.XOpenDisplay.restype = ctypes.c_void_p
        self.x.XCreateSimpleWindow.restype = ctypes.c_ulong
        self.display = ctypes.c_void_p(self.x.XOpenDisplay(display.encode()))

    def open(self, width, height):
        root = self.x.XDefaultRootWindow(self.display)
        window = self.x.XCreateSimpleWindow(self.display, ctypes.c_ulong(root), 0, 0, width, height, 0, 0, 0)
        self.x.XMapWindow(self.display, ctypes.c_ulong(window))
        self.x.XSync(self.display, 0)
        return window

    def close(self, window):
        self.x.XDestroyWindow(self.display, ctypes.c_ulong(window))
        self.x.XSync(self.display, 0)

    def resize(self, window, width, height):
        self.x.XResizeWindow(self.display, ctypes.c_ulong(window), width, height)
        self.x.XSync(self.display, 0)


def size(plugin, name="get_size", width=0, height=0):
    wide, high = c.c_uint32(width), c.c_uint32(height)
    return (wide.value, high.value) if plugin.call("gui", name, c.byref(wide), c.byref(high)) else None


def opened(plugin, screen):
    """A host's way to a window. Returns the one that it is in."""
    if not plugin.call("gui", "create", X11, False):
        return None
    window = screen.open(*size(plugin))
    parent = Window(X11, window)
    return window if plugin.call("gui", "set_parent", c.byref(parent)) and plugin.call("gui", "show") else None


def closed(plugin, screen, window):
    plugin.call("gui", "destroy")
    screen.close(window)


def children(window, environment):
    return subprocess.run(
        ["xwininfo", "-children", "-id", str(window)], capture_output=True, text=True, check=False, env=environment
    ).stdout


def colours(display, path):
    """How many different colours are on the screen."""
    picture(display, path)
    return int(
        subprocess.run(["identify", "-format", "%k", str(path)], capture_output=True, text=True, check=True).stdout
    )


def check_window(plugin, screen, display, path, environment):
    check(
        "X11, embedded, and nothing else",
        plugin.call("gui", "is_api_supported", X11, False)
        and not any(
            plugin.call("gui", "is_api_supported", api, floating)
            for api, floating in ((X11, True), (b"wayland", False), (None, False))
        ),
    )
    api, floating = c.c_char_p(), c.c_bool(True)
    check(
        "which it prefers",
        plugin.call("gui", "get_preferred_api", c.byref(api), c.byref(floating))
        and (api.value, floating.value) == (X11, False),
    )
    check(
        "without a window there is no size",
        size(plugin) is None
        and not plugin.call("gui", "show")
        and not plugin.call("gui", "set_size", 1000, 700)
        and not plugin.call("gui", "create", X11, True),
    )
    plugin.call("gui", "destroy")
    window = opened(plugin, screen)
    check("it opens", window is not None)
    first = size(plugin)
    check("of at least the least size", first[0] >= 936 and first[1] >= 608, first)
    plugin.run(1.0)
    check("it lies in the host's window and fills it", f"{first[0]}x{first[1]}+0+0" in children(window, environment))
    check("and is painted", colours(display, path) > 100)
    hints = Hints()
    check(
        "it can be resized",
        plugin.call("gui", "can_resize")
        and plugin.call("gui", "get_resize_hints", c.byref(hints))
        and (hints.across, hints.along, hints.ratio) == (True, True, False),
    )
    check(
        "to what is possible",
        (
            size(plugin, "adjust_size", 10, 10),
            size(plugin, "adjust_size", 1100, 700),
            size(plugin, "adjust_size", 4000000000, 4000000000),
        )
        == ((936, 608), (1100, 700), (2400, 1600)),
    )
    screen.resize(window, 1100, 700)
    check("by the host", plugin.call("gui", "set_size", 1100, 700) and size(plugin) == (1100, 700))
    plugin.run(0.5)
    check("on the screen too", "1100x700+0+0" in children(window, environment))
    check("without asking the host in return", not any(what == "resize" for what, *_ in plugin.record))
    check(
        "a scale of 200 % is double",
        plugin.call("gui", "set_scale", 2.0) and size(plugin) == (2200, 1400),
        size(plugin),
    )
    check("and 100 % as before", plugin.call("gui", "set_scale", 1.0) and size(plugin) == (1100, 700), size(plugin))
    check(
        "no scale is none",
        not plugin.call("gui", "set_scale", float("nan")) and not plugin.call("gui", "set_scale", 0.0),
    )
    return window


def turned(environment, plugin):
    """Drags at many places until a knob is under the hand; returns what the host hears."""
    for y in range(120, 680, 40):
        for x in range(60, 1060, 60):
            for command in (("mousemove", x, y), ("mousedown", 1), ("mousemove", x, y - 25), ("mouseup", 1)):
                subprocess.run(["xdotool", *map(str, command)], check=True, env=environment)
                plugin.run(0.03)
            sent = plugin.flush()
            if any(kind == VALUE for kind, *_ in sent):
                return sent
    return []


class Hands:
    """Mouse and keys on a window at the screen's corner."""

    def __init__(self, plugin, environment, path):
        self.plugin, self.environment, self.path = plugin, environment, path

    def tool(self, *words):
        subprocess.run(["xdotool", *map(str, words)], check=True, env=self.environment)
        self.plugin.run(0.3)

    def click(self, place):
        self.tool("mousemove", *place)
        self.tool("click", 1)

    def keys(self, *names):
        for name in names:
            self.tool("key", "--delay", 30, name)

    def look(self, left, top, width, height):
        """What a part of the screen shows, as something to compare."""
        self.tool("mousemove", 515, 63)  # no control is under it
        self.plugin.run(0.5)
        picture(self.environment["DISPLAY"], self.path)
        return subprocess.run(
            ["convert", str(self.path), "-crop", f"{width}x{height}+{left}+{top}", "-format", "%#", "info:"],
            capture_output=True, text=True, check=True,
        ).stdout


# In a window of 1024 x 648, as it opens.
PRESETS, SIDE_A, SIDE_B = (180, 24), (380, 24), (411, 24)
NAME = (88, 12, 170, 24)  # of the preset


def check_presets(library, screen, environment, path, pacini):
    """As somebody who makes a preset by the command, chooses it in the plugin, changes it, and saves another."""
    folder = Path(environment["HOME"]) / ".config" / "Pacini" / "Presets"
    folder.mkdir(parents=True)

    def command(*options):
        done = subprocess.run([pacini, "live", *map(str, options), "--print-settings"], capture_output=True, text=True,
                              check=True, timeout=60)
        return done.stdout

    (folder / "Mine.json").write_text(command("--intensity", -7, "--attack", 33))
    plugin = Plugin(library)
    window = opened(plugin, screen)
    plugin.run(1.0)
    hands = Hands(plugin, environment, path)

    def values():
        return plugin.value("Intensity"), plugin.value("Attack"), plugin.value("Release")

    usual = values()
    hands.click(PRESETS)
    hands.keys("Escape", *["Down"] * 12)  # behind all that are shipped
    sent = plugin.flush()
    check("a preset that the command printed is chosen in the window", values()[:2] == (-7, 33), values())
    check("the host hears of it as of gestures", len({i for kind, i, *_ in sent if kind == BEGIN}) > 2
          and len([1 for kind, *_ in sent if kind == BEGIN]) == len([1 for kind, *_ in sent if kind == END]), len(sent))
    hands.keys("ctrl+z")
    undone = values()
    sent = [plugin.flush()]
    hands.keys("ctrl+shift+z")
    sent.append(plugin.flush())
    check("undo and redo are of a preset, too", undone[:2] != (-7, 33) and values()[:2] == (-7, 33), undone)
    check("and the host hears of both", all(len([1 for kind, *_ in each if kind == END]) >= 2 for each in sent),
          [len(each) for each in sent])

    def named(release):
        plugin.set("Release", release)
        return hands.look(*NAME)

    named(77)  # the pointer has left the menu
    looks = [named(release) for release in (usual[2], 77, usual[2], 77)]
    check("a preset has a mark while a value is another one", looks[0] == looks[2] != looks[1] == looks[3])
    hands.click(PRESETS)
    hands.keys("Down", "Return")  # from the one that is chosen to Save preset
    hands.keys("ctrl+a")
    hands.tool("type", "Hers")
    hands.keys("Return")
    saved = folder / "Hers.json"
    check("it is saved under another name", until(saved.exists, 5))
    if not saved.exists():
        return
    read = json.loads(command("--settings", saved))["live"]
    check("the command reads it", (read["intensity"], read["attack"], read["release"]) == (-7, 33, 77))
    check("as it was written", json.loads(saved.read_text())["live"] == read)

    hands.click(SIDE_B)
    begins = values()
    plugin.set("Intensity", -3)
    hands.click(SIDE_A)
    a = values()
    hands.click(SIDE_B)
    check("the other side begins as this one, and each keeps its own", (begins, a, values())
          == ((-7, 33, 77), (-7, 33, 77), (-3, 33, 77)), (begins, a, values()))
    state = plugin.save()
    closed(plugin, screen, window)
    plugin.destroy()
    other = Plugin(library)
    check("the session has both", other.load(state) and other.value("Intensity") == -3)
    window = opened(other, screen)
    other.run(1.0)
    Hands(other, environment, path).click(SIDE_A)
    check("as the window shows", other.value("Intensity") == -7, other.value("Intensity"))
    closed(other, screen, window)
    other.destroy()


def main():
    needs("Xvfb", "xdotool", "import", "identify", "convert", "xwininfo")
    library_path, pacini = (str(Path(argument).resolve()) for argument in sys.argv[1:3])
    with Processes() as processes, tempfile.TemporaryDirectory() as folder:
        display = processes.start_screen()
        environment = dict(os.environ, DISPLAY=display, HOME=folder)
        os.environ.update(DISPLAY=display, HOME=folder, XDG_CONFIG_HOME=f"{folder}/.config")
        path = Path(sys.argv[3] if len(sys.argv) > 3 else f"{folder}/window.png")
        screen = Screen(display)
        library = Library(library_path)
        plugin = Plugin(library)
        window = check_window(plugin, screen, display, path, environment)
        kept = plugin.save()
        plugin.activate()
        sent = turned(environment, plugin)
        kinds = [kind for kind, *_ in sent]
        check(
            "a knob that is turned is a gesture",
            kinds == [BEGIN, VALUE, END] or kinds[:1] == [BEGIN] and kinds[-1:] == [END],
            sent,
        )
        check(
            "of one parameter, with the value that it has now",
            len({identifier for _, identifier, *_ in sent}) == 1
            and any(
                plugin.value(name) == value
                for name, info in plugin.parameters.items()
                for kind, identifier, value, _ in sent
                if kind == VALUE and identifier == info.id
            ),
        )
        check("the host was asked to fetch it", ("flush",) in plugin.record and plugin.flush() == [])
        plugin.record.clear()
        plugin.load(kept)
        plugin.run(0.2)
        check("what a state brings is no gesture", plugin.flush() == [] and ("rescan", 1) in plugin.record)
        check("hidden and shown", plugin.call("gui", "hide") and plugin.call("gui", "show"))
        closed(plugin, screen, window)
        window = opened(plugin, screen)
        check("the size is kept", size(plugin) == (1100, 700), size(plugin))
        closed(plugin, screen, window)

        ends, statuses = threading.Event(), set()

        def play():
            sound = np.random.default_rng(1).normal(0, 0.2, (3, 256)).astype(np.float32)
            out = [np.zeros((2, 256), np.float32), np.zeros((1, 256), np.float32)]
            while not ends.is_set():
                statuses.add(plugin.process([sound[:2], sound[2:]], out, 0, 256))

        thread = threading.Thread(target=play)
        thread.start()
        for i in range(15):
            window = opened(plugin, screen)
            plugin.run((0.0, 0.05, 0.3)[i % 3])
            closed(plugin, screen, window)
        check("opened and closed again and again while sound plays", window is not None)
        ends.set()
        thread.join()
        check("and it plays on", statuses == {CONTINUE}, statuses)

        two = [Plugin(library), Plugin(library)]
        windows = [opened(each, screen) for each in two]
        two[0].run(0.3)
        two[1].run(0.3)
        check("two windows at once", all(windows))
        closed(two[0], screen, windows[0])
        two[0].destroy()
        two[1].run(0.3)
        check(
            "one stays when the other goes",
            children(windows[1], environment).count("x") > 2 and size(two[1]) is not None,
        )
        two[1].destroy()  # with its window
        screen.close(windows[1])
        plugin.deactivate()
        plugin.destroy()

        alone = Plugin(library, timers=False)
        window = opened(alone, screen)
        check("in a host without timers it is painted by itself", until(lambda: colours(display, path) > 100, 10))
        closed(alone, screen, window)
        alone.destroy()
        last = Plugin(library)
        window = opened(last, screen)
        last.run(1.0)
        check("and by a timer again", colours(display, path) > 100)
        closed(last, screen, window)
        last.destroy()
        check_presets(library, screen, environment, path, pacini)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
