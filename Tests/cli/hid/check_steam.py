#!/usr/bin/env python3
"""pacini play on a Steam Controller (2026) or a Steam Deck that umockdev pretends to be there.

check_steam.py PACINI DEVICE [--by-hidapi]   DEVICE: cable, receiver, deck, or keyboard, which a Deck also is. Exit 1 when a
claim fails, 77 when umockdev is missing. The devices are as readings tell; none was at hand.
"""
import json
import signal
import struct
import sys
import tempfile
import time
from pathlib import Path

from hid_test import check, check_unplugging, clip, ended, main_under_umockdev, run, start

DEVICE = sys.argv[2]
SAMPLES = 0x88


def told(report):
    """The levels of a Deck's motors."""
    if len(report) != 65 or report[:3] != b"\x00\xeb\x09" or any(report[12:]):
        return None
    return struct.unpack("<HH", report[6:10])


def is_silent(report):
    if DEVICE == "deck":
        return told(report) == (0, 0)
    return report[0] == SAMPLES and report[2:] == (bytes(62) if DEVICE == "cable" else b"\xff" * 62)


def check_listing():
    _, out, _ = run("devices", "--json")
    listed = json.loads(out)["controllers"]
    haptics, transport = {"cable": ("Steam", "USB"), "receiver": ("Steam", "Receiver"), "deck": ("Steam Deck", "USB")}[DEVICE]
    check("it is listed", len(listed) == 1 and "Steam" in listed[0]["name"] and listed[0]["haptics"] == haptics
          and listed[0]["transport"] == transport, out)


def check_samples(device, path):
    form, interval, count = (0, 1.875e-3, 30) if DEVICE == "cable" else (8, 3.875e-3, 31)
    for attempt in range(10):  # should the machine be too slow for a moment
        time.sleep(attempt)
        device.clear()
        code, out, error = run("play", path)
        if "left out" not in out:
            break
    print("    ", out.strip())
    times, reports = zip(*device.writes)
    check("a clip is played to its end", code == 0 and error == "" and "played on" in out, out + error)
    check("it is started", reports[:4] == (b"\x86\x01\x02\x00", b"\x86\x01\x05\x00", bytes([0x86, 2, 2, form]),
                                         bytes([0x86, 2, 5, form])), str(reports[:4]))
    check("and ended", reports[-4:] == (bytes([0x86, 1, 2, form]), bytes([0x86, 1, 5, form]), b"\x86\x01\x02\x00",
                                        b"\x86\x01\x05\x00") and times[-2] - times[-3] > 0.149, str(reports[-4:]))
    stream, when = reports[4:-4], times[4:-4]
    check("in between there are samples only", all(len(r) == 64 and r[0] == SAMPLES and r[1] == count for r in stream))
    check("which end in silence", all(map(is_silent, stream[-2:])) and not is_silent(stream[-20]))
    check("as many as the clip is long", abs(len(stream) - 2 - 2.0 / interval) < 3, str(len(stream)))
    check("eight reports are sent ahead", when[8] - when[0] < 4 * interval)
    check("then each at its time", abs((when[-3] - when[8]) - interval * (len(stream) - 11)) < 0.01,
          f"{len(stream)} reports in {when[-3] - when[8]:.4f} s")
    code, listed, error = run("play", path, "--dry-run")
    expected = [bytes.fromhex(line.split(maxsplit=1)[1]) for line in listed.splitlines()]
    if "left out" not in out:
        check("it is what --dry-run lists", list(reports) == expected, error)


def check_motors(device, path):
    device.clear()
    code, out, error = run("play", path)
    levels = [told(report) for _, report in device.writes]
    check("a clip is played to its end by feature reports", code == 0 and error == "" and None not in levels, out + error)
    between = [level for level in levels[1:-3] if level[1] < 1000]
    check("the band plays on the heavy motor",
          len(between) > 60 and all(abs(level[0] / 65535 - 0.45) < 0.1 for level in between), str(levels[:12]))
    check("events, which are high, on the light one too", sum(level[1] > 0.3 * 65535 for level in levels) >= 20,
          str(levels[:12]))
    gaps = [b[0] - a[0] for a, b in zip(device.writes, device.writes[1:-2])]
    check("it is told again before 50 ms are over", max(gaps) < 0.06, f"{max(gaps)}")
    check("in the end it is silent", levels[-2:] == [(0, 0)] * 2)


def check_signal(device, path, number):
    device.clear()
    process = start("play", path, "--loop")
    check(f"{number.name}: it plays", device.wait_for(300 if DEVICE != "deck" else 40))
    process.send_signal(number)
    code, _, error = ended(process)
    last = [report for _, report in device.writes[-2:]]
    if DEVICE == "deck":
        silent = told(last[-1]) == (0, 0)
    else:
        silent = [report[:2] for report in last] == [b"\x86\x01"] * 2 and {report[2] for report in last} == {2, 5}
    check(f"{number.name}: it is stopped at once", silent and code == -number, f"{code} {error} {[report[:10] for report in last]}")


def claims(devices):
    with tempfile.TemporaryDirectory() as name:
        short, long = clip(Path(name), "short.json", 2.0), clip(Path(name), "long.json", 20.0)
        device = devices.FakeController({"cable": devices.STEAM_CONTROLLER, "receiver": devices.STEAM_RECEIVER,
                                         "deck": devices.STEAM_DECK, "keyboard": devices.DECK_KEYBOARD}[DEVICE])
        device.connect()
        if DEVICE == "keyboard":
            _, out, _ = run("devices", "--json")
            check("the keyboard of a Deck is not listed", json.loads(out)["controllers"] == [], out)
            return
        check_listing()
        (check_motors if DEVICE == "deck" else check_samples)(device, short)
        for number in (signal.SIGINT, signal.SIGTERM) + (() if "--by-hidapi" in sys.argv else (signal.SIGSEGV,)):
            check_signal(device, long, number)
        check_unplugging(device, long, "Steam", reports=40)


if __name__ == "__main__":
    main_under_umockdev(claims)
