#!/usr/bin/env python3
"""pacini play on a haptic touchpad of HID page 0x0E that umockdev pretends to be there.

check_waveforms.py PACINI   exit 1 when a claim fails, 77 when umockdev is missing
"""
import json
import signal
import struct
import sys
import tempfile
from pathlib import Path

from hid_test import check, check_unplugging, clip, ended, main_under_umockdev, run, start

CLICK, BUZZ, RUMBLE, RELEASE, INK = 0x1003, 0x1004, 0x1005, 0x1007, 0x100B
STOP = 2  # the ordinal that all devices have


def told(report):
    """(ordinal, intensity) of a trigger without repeats, or nothing of another report."""
    if len(report) != 6 or report[0] != 6 or report[3:] != bytes(3):
        return None
    return report[1], report[2]


def check_listing():
    _, out, _ = run("devices", "--json")
    listed = json.loads(out)["controllers"]
    check("a haptic touchpad is listed as one", len(listed) == 1 and listed[0]["haptics"] == "Waveforms"
          and listed[0]["name"].endswith("Haptic Touchpad") and listed[0]["transport"] == "USB", out)


def check_stream(device, path):
    device.clear()
    device.asked.clear()
    code, out, error = run("play", path)
    check("a clip is played to its end", code == 0 and error == "" and "played on" in out, out + error)
    check("it asks once for the waveforms", device.asked == [5], str(device.asked))
    states = [told(report) for _, report in device.writes]
    check("all reports are triggers", None not in states, str(device.writes[:3]))
    clicks = [state for state in states if state[0] == 4]
    check("each event clicks, stronger than what it is in", len(clicks) == 20 and all(state[1] >= 55 for state in clicks),
          str(clicks))
    rumbles = [state for state in states if state[0] == 3]
    check("in between it rumbles along with the envelope",
          len(rumbles) >= 20 and all(39 <= state[1] <= 51 for state in rumbles) and rumbles[0] > rumbles[-1],
          str(rumbles))
    check("in the end it is stopped", states[-2:] == [(STOP, 0)] * 2, str(states[-3:]))
    code, listed, error = run("play", path, "--dry-run")
    expected = [bytes.fromhex(line.split(maxsplit=1)[1]) for line in listed.splitlines()]
    if "left out" not in out:
        check("it is what --dry-run lists", [report for _, report in device.writes] == expected, error)


def check_signal(device, path, number):
    device.clear()
    process = start("play", path, "--loop")
    check(f"{number.name}: it plays", device.wait_for(20))
    process.send_signal(number)
    code, _, error = ended(process)
    check(f"{number.name}: it is stopped at once", told(device.writes[-1][1]) == (STOP, 0) and code == -number,
          f"{code} {error} {device.writes[-1]}")


def claims(devices):
    with tempfile.TemporaryDirectory() as name:
        short, long = clip(Path(name), "short.json", 2.0), clip(Path(name), "long.json", 20.0)
        device = devices.FakeController(devices.touchpad((RUMBLE, CLICK, RELEASE), (0, 15, 15)))
        waiting = start("play", short, "--wait", "--device", "touchpad")
        device.connect()
        code, out, error = ended(waiting)
        check("--wait plays when it comes", code == 0 and "played on" in out, out + error)
        check_listing()
        check_stream(device, short)
        for number in (signal.SIGINT, signal.SIGTERM) + (() if "--by-hidapi" in sys.argv else (signal.SIGSEGV,)):
            check_signal(device, long, number)

        device.device["features"] = {5: struct.pack("<B3H3B", 5, RELEASE, CLICK, INK, 15, 15, 0)}
        device.clear()
        code, out, error = run("play", short)
        ordinals = {told(report)[0] for _, report in device.writes}
        check("without a lasting waveform it plays the events, and says so",
              code == 0 and ordinals == {4, STOP} and error.count("\n") == 1
              and "short.json: warning: only the events" in error, f"{ordinals} {error}")
        device.device["features"] = {}
        code, _, error = run("play", short)
        check("one that does not tell its waveforms is refused in one line",
              code == 1 and error.count("\n") == 1 and "Haptic Touchpad" in error, error)
        device.device["features"] = {5: struct.pack("<B3H3B", 5, RUMBLE, CLICK, BUZZ, 0, 15, 0)}
        check_unplugging(device, long, "Haptic Touchpad")


if __name__ == "__main__":
    main_under_umockdev(claims)
