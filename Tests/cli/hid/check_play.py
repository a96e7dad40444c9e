#!/usr/bin/env python3
"""pacini play on a Pro Controller that umockdev pretends to be there.

check_play.py PACINI [--by-hidapi]   exit 1 when a claim fails, 77 when umockdev is missing

Through hidapi, as on systems other than Linux, a controller cannot be silenced while the program crashes, nor be locked.
"""
import json
import signal
import statistics
import sys
import tempfile
import time
from pathlib import Path

from hid_test import check, check_unplugging, clip, ended, main_under_umockdev, run, start

BY_HIDAPI = "--by-hidapi" in sys.argv
NEUTRAL = bytes.fromhex("0001404000014040")


def is_neutral(report):
    return report[:1] == b"\x10" and report[2:] == NEUTRAL


def check_listing():
    _, out, _ = run("devices", "--json")
    listed = json.loads(out)["controllers"]
    check("the controller is listed with its number", len(listed) == 1 and listed[0]["number"] == 1
          and listed[0]["name"].endswith("Pro Controller") and listed[0]["haptics"] == "HD rumble"
          and listed[0]["transport"] == "USB", out)


def check_stream(controller, path):
    _, listed, _ = run("play", path, "--dry-run", "--device", "pro")
    expected = [bytes.fromhex(line.split(maxsplit=1)[1]) for line in listed.splitlines()]
    for attempt in range(10):  # should the machine be too slow for a moment
        time.sleep(attempt)
        controller.clear()
        code, out, error = run("play", path, "--device", "1")
        if "left out" not in out:
            break
    print("    ", out.strip())
    times, reports = zip(*controller.writes)
    check("a clip is played to its end", code == 0 and error == "" and "played on" in out, out + error)
    check("on a cable it starts with the handshake", reports[:2] == (b"\x80\x02", b"\x80\x04"))
    check("the first report of the protocol enables vibration",
          reports[2][:2] == b"\x01\x02" and reports[2][2:] == NEUTRAL + b"\x48\x01", reports[2].hex())
    stream = reports[3:]
    check("all others are rumble", all(len(r) == 10 and r[0] == 0x10 for r in stream))
    check("counters count every report", [r[1] for r in stream] == [(3 + i) % 16 for i in range(len(stream))])
    check("the last two packets are neutral", all(map(is_neutral, stream[-2:])) and not is_neutral(stream[-4]))
    check("once in ten times no packet is left out", "left out" not in out, out)
    check("it is what --dry-run lists", list(reports) == expected)
    gaps = [1e3 * (b - a) for a, b in zip(times[3:], times[4:])]
    median = statistics.median(gaps)
    check("a packet comes every 15 ms", abs(median - 15) < 1,
          f"median {median:.3f} ms, {min(gaps):.2f} to {max(gaps):.2f}")
    check("there is no drift", abs((times[-1] - times[3]) - 0.015 * (len(stream) - 1)) < 0.05,
          f"{len(stream)} packets in {times[-1] - times[3]:.4f} s")


def check_signal(controller, path, number):
    controller.clear()
    process = start("play", path, "--loop")
    check(f"{number.name}: it plays", controller.wait_for(40))
    sent = time.monotonic()
    process.send_signal(number)
    code, _, error = ended(process)
    reports = [report for _, report in controller.writes]
    last = controller.writes[-1][0] - sent
    check(f"{number.name}: the last packets are neutral", all(map(is_neutral, reports[-2:])), reports[-1].hex())
    check(f"{number.name}: ends pacini as it would have", code == -number, f"{code} {error}")
    first = next(t for t, report in reversed(controller.writes) if not is_neutral(report))
    check(f"{number.name}: at once", first - sent < 0.25 and last < 0.5,
          f"last sound {1e3 * (first - sent):.1f} ms, last packet {1e3 * last:.1f} ms after the signal")


def check_second_program(controller, path):
    controller.clear()
    process = start("play", path, "--loop")
    check("the first program plays", controller.wait_for(10))
    code, _, error = run("play", path)
    check("a second one is told that it is in use", code == 1 and "in use by another program" in error, error)
    process.send_signal(signal.SIGTERM)
    ended(process)


def check_messages(path):
    for arguments, code, part in ((["--device", "2"], 1, "no such controller"),
                                  (["--device", "xbox"], 1, "no such controller"),
                                  (["--from", "5", "--to", "4"], 1, "nothing between")):
        got, _, error = run("play", path, *arguments)
        check(f"{' '.join(arguments)} is refused", got == code and part in error and error.count("\n") == 1, error)


def claims(devices):
    controller = devices.FakeController()
    with tempfile.TemporaryDirectory() as name:
        short, long = clip(Path(name), "short.json", 2.0), clip(Path(name), "long.json", 20.0)

        code, _, error = run("play", short)
        check("nothing connected is an error", code == 1 and "no supported game controller is connected" in error, error)
        waiting = start("play", short, "--wait")
        time.sleep(1)
        check("--wait waits", waiting.poll() is None)
        controller.connect()
        code, out, error = ended(waiting)
        check("and plays when the controller comes", code == 0 and "played on" in out, out + error)

        check_listing()
        check_stream(controller, short)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            check_signal(controller, long, number)
        if not BY_HIDAPI:
            for number in (signal.SIGSEGV, signal.SIGABRT):
                check_signal(controller, long, number)
            check_second_program(controller, long)
        check_messages(short)
        check_unplugging(controller, long, "Pro Controller")


if __name__ == "__main__":
    main_under_umockdev(claims)
