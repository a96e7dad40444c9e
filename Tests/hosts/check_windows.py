#!/usr/bin/env python3
"""The plugin's windows in Ardour, as VST3 and LV2: opened and closed again and again, at several paces, while another
window takes the focus in between. Ardour ends when a plugin brings it an error of the X server.

check_windows.py FOLDER_OF_PLUGINS [OPENINGS_OF_EACH]     exit 0, 1 on a failed check, 77 when something is not there
"""
import ctypes
import itertools
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from check_ardour import HERE, LUA, find, run
from host_test import Processes, check, failures, needs, until

KINDS = {"LV2": "urn:pacini:translator", "VST3": "Pacini"}
TITLES = {kind: rf"Master: .*Pacini.*\[{kind}\]" for kind in KINDS}
SETTINGS = """<?xml version="1.0" encoding="UTF-8"?>
<Ardour version="7003">
  <Config><Option name="hide-dummy-backend" value="0"/></Config>
  <Extra><AudioMIDISetup><EngineStates>
    <State backend="None (Dummy)" driver="Normal Speed" device="Silence" input-device="" output-device=""
        sample-rate="48000" buffer-size="1024" n-periods="0" input-latency="0" output-latency="0" lm-input="" lm-output=""
        active="1" use-buffered-io="0" midi-option="1 in, 1 out, Silence" lru="1"><MIDIDevices/></State>
  </EngineStates></AudioMIDISetup></Extra>
</Ardour>
"""
PACES = (0.0, 0.02, 0.05, 0.1, 0.2, 0.4)  # seconds for which windows are open, and closed


class ClientMessage(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int), ("display", ctypes.c_void_p),
                ("window", ctypes.c_ulong), ("message", ctypes.c_ulong), ("format", ctypes.c_int),
                ("data", ctypes.c_long * 5), ("padding", ctypes.c_long * 24)]


def soon(condition, seconds):
    """Whether a condition holds within that time, looked at often."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.01)
    return True


class Desktop:
    """What a person and a window manager do: find, focus, and close windows, and click."""

    def __init__(self, display):
        self.x = ctypes.CDLL("libX11.so.6")
        self.x.XOpenDisplay.restype = ctypes.c_void_p
        self.x.XInternAtom.restype = ctypes.c_ulong
        self.ignore = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda *_: 0)
        self.x.XSetErrorHandler(self.ignore)
        self.display = ctypes.c_void_p(self.x.XOpenDisplay(display.encode()))
        self.environment = dict(os.environ, DISPLAY=display)

    def tool(self, *arguments):
        return subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, capture_output=True, text=True,
                              timeout=30).stdout

    def windows(self, title):
        return [int(line) for line in self.tool("search", "--onlyvisible", "--name", title).split()]

    def close(self, window):
        atom = lambda name: self.x.XInternAtom(self.display, name, 0)
        event = ClientMessage(type=33, window=window, message=atom(b"WM_PROTOCOLS"), format=32)
        event.data[0] = atom(b"WM_DELETE_WINDOW")
        self.x.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(event))
        self.x.XSync(self.display, 0)

    def focus(self, window):
        self.x.XSetInputFocus(self.display, ctypes.c_ulong(window), 2, ctypes.c_ulong(0))
        self.x.XSync(self.display, 0)


def make_session(folder, plugins):
    """The environment in which Ardour finds the plugins and a session with both."""
    lv2 = [str(p) for p in [plugins / "LV2", *sorted(Path("/usr/lib").glob("*/lv2")), Path("/usr/lib/lv2")]]
    environment = dict(os.environ, HOME=str(folder), XDG_CONFIG_HOME=str(folder / "config"),
                       SESSION_DIR=str(folder / "session"), LV2_PATH=os.pathsep.join(lv2),
                       VST3_PATH=str(plugins / "VST3"), KINDS=" ".join(f"{kind}={name}" for kind, name in KINDS.items()))
    scanner = find("ardour-vst3-scanner*")
    if scanner:
        subprocess.run([scanner, "-f", str(plugins / "VST3" / "Pacini.vst3")], timeout=120, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, env=dict(environment, LD_LIBRARY_PATH=str(Path(scanner).parent)))
    for _ in run("ardour_windows.lua", environment):
        shutil.rmtree(folder / "session", ignore_errors=True)
    version = re.search(r"\d+", Path(LUA).name).group()
    settings = folder / "config" / f"ardour{version}"
    settings.mkdir(parents=True, exist_ok=True)
    (settings / "config").write_text(SETTINGS)
    (settings / f".a{version}").touch()  # or it asks what it asks at its first start
    return environment


def main():
    needs("Xvfb", "xdotool", "ardour")
    plugins = Path(sys.argv[1]).resolve()
    wanted = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    with tempfile.TemporaryDirectory() as folder, Processes() as processes:
        folder = Path(folder)
        environment = make_session(folder, plugins)
        if failures:
            return 1
        display = processes.start_screen()
        desktop = Desktop(display)
        log = folder / "ardour.log"
        with log.open("w") as output:
            ardour = processes.start("ardour", "-a", "-n", "-O", folder / "session" / "pacini.ardour", stdout=output,
                                     stderr=subprocess.STDOUT, env=dict(environment, DISPLAY=display))
        check("Ardour opens the session", until(lambda: desktop.windows("^pacini - Ardour$")))
        if failures:
            print(log.read_text()[-2000:])
            return 1
        editor = desktop.windows("^pacini - Ardour$")[0]
        time.sleep(2)
        desktop.focus(editor)
        desktop.tool("windowsize", editor, 1280, 960, "mousemove", 600, 600, "key", "shift+e")  # shows the master's strip
        time.sleep(1)

        clicks = itertools.count()

        def shown():
            return {kind: window for kind, title in TITLES.items() for window in desktop.windows(title)}

        def double_click(y, condition, patience=2.0):
            """On an entry of the strip; never twice at one place, which would be a triple click."""
            desktop.tool("mousemove", 40 + 20 * (next(clicks) % 2), y, "click", "--repeat", 2, "--delay", 20, 1)
            return soon(lambda: condition() or ardour.poll() is not None, patience)

        # Which entry is which. Their windows are then where they do not hide the strip.
        entries = {}
        for y in (190, 236, 228, 244, 198):  # not between them: there another window opens
            if len(entries) == len(KINDS) or not double_click(y, shown, 6.0):  # the first time takes longer
                continue
            for kind, window in shown().items():
                entries.setdefault(kind, y)
                desktop.tool("windowmove", window, 200, 200 + 100 * len(entries))
                time.sleep(0.3)
                desktop.close(window)
            soon(lambda: not shown(), 10)
        check("both windows can be opened", set(entries) == set(KINDS), f"{entries}")

        opened = dict.fromkeys(KINDS, 0)
        begin = time.monotonic()
        for i in range(wanted if not failures else 0):
            for kind in list(KINDS)[:: 1 if i % 2 else -1]:
                if any(double_click(entries[kind], lambda: kind in shown()) for _ in range(5)):
                    desktop.focus(shown().get(kind, editor))
                    opened[kind] += ardour.poll() is None
            if ardour.poll() is not None:
                break
            time.sleep(PACES[i % len(PACES)])
            for window in list(shown().values())[:: 1 if i % 4 < 2 else -1]:
                if i % 3 == 0:
                    desktop.focus(window)
                elif i % 3 == 1:
                    desktop.focus(editor)
                desktop.close(window)
                if i % 5 == 0:
                    desktop.focus(editor)
            soon(lambda: not shown() or ardour.poll() is not None, 10)
            time.sleep(PACES[(i // len(PACES)) % len(PACES)])
        check(f"Ardour lives after {wanted} openings of each window",
              ardour.poll() is None and set(opened.values()) == {wanted}, f"{opened}, {time.monotonic() - begin:.0f} s")
        if failures:
            print("\n".join(log.read_text(errors="replace").splitlines()[-20:]))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
