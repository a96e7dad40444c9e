#!/usr/bin/env python3
"""pacini live on a DualShock 4 that umockdev pretends to be there.

check_live.py PACINI [SECONDS]   exit 1 when a claim fails, 77 when umockdev is missing. SECONDS: for how long the pipe is
watched for drift and growing memory (3600 for an hour)
"""
import json
import math
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from hid_test import COMMAND, LATEST, check, ended, main_under_umockdev

RATE, BLOCK = 48000, 128
SECONDS = float(sys.argv[2]) if len(sys.argv) > 2 else 20.0
RAW = ("live", "-", "--raw", "f32", "--channels", "1")
TONE = struct.pack(f"<{BLOCK * 3}f", *(0.5 * math.sin(2 * math.pi * i / BLOCK) for i in range(BLOCK * 3)))  # 375 Hz
PULSE = struct.pack(f"<{BLOCK}f", *(0.9 * math.sin(2 * math.pi * i / BLOCK) for i in range(BLOCK)))
SILENCE = bytes(4 * BLOCK)


def start(*arguments):
    return subprocess.Popen([COMMAND, *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def is_silent(report):
    return report[4:6] == b"\0\0"


class Player(threading.Thread):
    """Writes a sound to a pipe block by block in real time, as a sound server does: a block when it has ended."""

    def __init__(self, pipe, block_at):
        super().__init__(daemon=True)
        self.pipe, self.block_at, self.over, self.written = pipe, block_at, False, 0
        self.begun = []  # times at which pulses begin
        self.start()

    def run(self):
        began = time.monotonic()
        try:
            while not self.over:
                content = self.block_at(self.written)
                due = began + (self.written + 1) * BLOCK / RATE
                time.sleep(max(0.0, due - time.monotonic()))
                if content is PULSE:
                    self.begun.append(time.monotonic() - BLOCK / RATE)
                self.pipe.write(content)
                self.pipe.flush()
                self.written += 1
        except (BrokenPipeError, ValueError):
            pass

    def end(self, process):
        """Ends the sound that `process` reads."""
        self.over = True
        self.join()
        process.stdin.close()
        process.stdin = None


def delays_of(controller, pulses):
    """Seconds from each pulse to the next report that is not silent."""
    found = []
    for begun in pulses:
        active = [when for when, report in controller.writes if when > begun and not is_silent(report)]
        if active and active[0] - begun < 0.2:
            found.append(active[0] - begun)
    return found


def memory_of(process):
    for line in Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1])
    return 0


def check_delay(controller):
    controller.clear()
    process = start(*RAW, "--json")
    player = Player(process.stdin, lambda n: PULSE if n % 163 == 162 else SILENCE)
    time.sleep(3.0)
    before = memory_of(process)
    time.sleep(SECONDS)
    after = memory_of(process)
    player.end(process)
    code, out, error = ended(process)
    check("it ends with the sound", code == 0 and not error, str(error))
    delays = delays_of(controller, player.begun[:-1])
    check("every impulse is felt", len(delays) == len(player.begun) - 1, f"{len(delays)} of {len(player.begun) - 1}")
    tenth = max(len(delays) // 10, 1)
    first, last = statistics.median(delays[:tenth * 3]), statistics.median(delays[-tenth * 3:])
    print(f"     impulse to report: median {1e3 * statistics.median(delays):.1f} ms, {1e3 * min(delays):.1f} to "
          f"{1e3 * max(delays):.1f} ms, {len(delays)} impulses; memory {before} to {after} kB; reports {len(controller.writes)}")
    check(f"in at most {1e3 * LATEST:.0f} ms, nine times of ten", sorted(delays)[len(delays) * 9 // 10] <= LATEST)
    check("at the end as at the beginning", abs(last - first) < LATEST / 3, f"{1e3 * (last - first):.2f} ms")
    check("in no more memory", after - before < 300, f"{after - before} kB")
    check("the last reports are silent", all(is_silent(report) for _, report in controller.writes[-2:]))
    report = json.loads(out)
    check("the report says what was sent", report["outputs"][0]["packets"] == len(controller.writes), out)


def check_measured(controller):
    process = start(*RAW, "--measure-latency", "--duration", "8", "--json")
    player = Player(process.stdin, lambda n: SILENCE)
    process.wait(30)
    player.over = True
    player.join()
    process.stdin = None
    code, out, _ = ended(process)
    told = json.loads(out)["latency"]
    check("it measures its delay by itself", code == 0 and told["impulses"] >= 14 and 1.3 < told["median"] <= 1e3 * LATEST, str(told))


def check_signal(controller, number):
    controller.clear()
    process = start(*RAW)
    player = Player(process.stdin, lambda n: TONE[:4 * BLOCK])
    check(f"{number.name}: it plays", controller.wait_for(4))
    sent = time.monotonic()
    process.send_signal(number)
    process.wait(10)
    player.over = True
    player.join()
    process.stdin = None
    code, _, error = ended(process)
    check(f"{number.name}: the motors stop", is_silent(controller.writes[-1][1]) and controller.writes[-1][0] - sent < 0.5)
    check(f"{number.name}: ends pacini as it would have", code == -number and not error, f"{code} {error}")


def check_unplugging(controller):
    controller.clear()
    process = start(*RAW, "--json")
    player = Player(process.stdin, lambda n: PULSE if n % 163 == 162 else SILENCE)
    check("it plays until it is unplugged", controller.wait_for(4))
    controller.unplug()
    time.sleep(1.5)
    check("and waits", process.poll() is None)
    controller.clear()
    check("it plays when it is back", controller.wait_for(4))
    player.end(process)
    code, out, error = ended(process)
    error = error.decode()
    check("both are told", code == 0 and error.count("\n") == 1 and "unplugged" in error and "Wireless Controller" in error
          and json.loads(out)["outputs"][0]["connections"] == 2, error + out.decode())


def check_file(controller):
    with tempfile.TemporaryDirectory() as name:
        drive, sound = Path(name) / "drive.wav", Path(name) / "sound.wav"
        samples = TONE * 100
        sound.write_bytes(b"RIFF" + struct.pack("<I", 36 + len(samples)) + b"WAVEfmt "
                          + struct.pack("<IHHIIHH", 16, 3, 1, RATE, 4 * RATE, 4, 32) + b"data"
                          + struct.pack("<I", len(samples)) + samples)
        controller.clear()
        began = time.monotonic()
        process = start("live", str(sound), "--device", "wireless", "-o", str(drive))
        code, _, error = ended(process)
        took = time.monotonic() - began
        check("a file is played at its rate, and written beside", code == 0 and not error and 0.75 < took < 2.0
              and drive.stat().st_size > len(samples), f"{took:.2f} s {error}")
        check("on the controller too", any(not is_silent(report) for _, report in controller.writes))


def check_waiting(controller):
    process = start(*RAW, "--wait")
    player = Player(process.stdin, lambda n: TONE[:4 * BLOCK])
    time.sleep(1)
    check("--wait waits", process.poll() is None)
    controller.connect()
    check("and plays when the controller comes", controller.wait_for(2))
    player.end(process)
    check("to the end", ended(process)[0] == 0)


def claims(devices):
    controller = devices.FakeController(devices.DUALSHOCK_4)
    check_waiting(controller)
    check_delay(controller)
    check_measured(controller)
    check_file(controller)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGSEGV):
        check_signal(controller, number)
    check_unplugging(controller)


if __name__ == "__main__":
    main_under_umockdev(claims)
