#!/usr/bin/env python3
"""pacini play and live on a DualSense that umockdev pretends to be there, on Bluetooth or on a cable.

check_dualsense.py PACINI LINK   LINK: bluetooth, cable (with a PulseAudio server whose sink stands for its sound card).
Exit 1 when a claim fails, 77 when something is missing. The device is as readings tell; none was at hand.
"""
import json
import math
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

from hid_test import COMMAND, check, clip, ended, main_under_umockdev, run, start
from host_test import Processes, needs, skip, until

LINK = sys.argv[2]
INTERVAL = 0.032 / 3
MAP = "front-left,front-right,rear-left,rear-right"


def is_signed(report):
    return zlib.crc32(b"\xa2" + report[:-4]) == struct.unpack("<I", report[-4:])[0]


def samples_of(report, first=13):
    return struct.unpack("64b", report[first:first + 64])


def check_samples(pad, path, number=0x32, size=142, first=13, *arguments):
    for attempt in range(10):  # should the machine be too slow for a moment
        time.sleep(attempt)
        pad.clear()
        code, out, error = run("play", path, *arguments)
        if "left out" not in out:
            break
    print("    ", out.strip())
    times, reports = zip(*pad.writes)
    name = f"report {number:x}"
    check(f"{name}: a clip is played to its end", code == 0 and error == "" and "played on" in out, out + error)
    check(f"{name}: one is tried first, then rumble is taken back", reports[0][0] == 0x32 and not any(samples_of(reports[0]))
          and reports[1][:4] == b"\x31\x00\x10\x00", reports[1].hex())
    stream = reports[2:-1]
    check(f"{name}: then there are samples only", all(r[0] == number and len(r) == size and is_signed(r) for r in stream))
    check(f"{name}: which are counted", all(r[1] == (i + 1) % 16 << 4 and r[10] == (i + 1) % 256 for i, r in enumerate(stream)))
    check(f"{name}: one every 10.667 ms", abs((times[-7] - times[2]) - INTERVAL * (len(stream) - 6)) < 0.03,
          f"{len(stream)} in {times[-7] - times[2]:.4f} s")
    check(f"{name}: they end with six silent ones", not any(any(samples_of(r, first)) for r in stream[-6:])
          and any(samples_of(stream[20], first)))
    check(f"{name}: and rumble is not left on", reports[-1][0] == 0x31 and reports[-1][3] == 0 and is_signed(reports[-1]))
    loudest = max(max(map(abs, samples_of(r, first))) for r in stream)
    check(f"{name}: as loud as the clip", 60 <= loudest <= 127, str(loudest))
    _, listed, _ = run("play", path, "--dry-run", *arguments)
    expected = [bytes.fromhex(line.split(maxsplit=1)[1]) for line in listed.splitlines()]
    if "left out" not in out:
        check(f"{name}: it is what --dry-run lists", list(reports[1:]) == expected)


def check_fallback(pad, path):
    pad.refused = (0x32, 0x36)
    pad.clear()
    code, out, error = run("play", path)
    reports = [report for _, report in pad.writes]
    check("where samples are refused, it plays by rumble", code == 0 and all(r[0] == 0x31 for r in reports)
          and any(r[5] or r[6] for r in reports) and reports[0][3] == 2, error)
    check("and says so", "plays by rumble: it refuses samples" in out, out)
    pad.refused = ()
    pad.clear()
    code, out, _ = run("play", path, "--dualsense", "rumble")
    check("it also does when it is told to", code == 0 and "plays by rumble" not in out
          and all(report[0] == 0x31 for _, report in pad.writes[1:]))


def check_ends(pad, path):
    for number in (signal.SIGINT, signal.SIGSEGV):
        pad.clear()
        process = start("play", path, "--loop")
        check(f"{number.name}: it plays", pad.wait_for(40))
        process.send_signal(number)
        code, _, error = ended(process)
        last = pad.writes[-1][1]
        quiet = last[0] == 0x31 and last[5:7] == b"\0\0"
        check(f"{number.name}: it is silent", code == -number and quiet and (number == signal.SIGINT or last[3] == 2),
              f"{code} {error} {last[:8].hex()}")
    pad.clear()
    process = start("play", path, "--loop")
    check("it plays until it is unplugged", pad.wait_for(20))
    pad.unplug()
    code, _, error = ended(process)
    check("which is an error in one line", code == 1 and error.count("\n") == 1 and "unplugged" in error, error)


def bluetooth(devices, folder):
    pad = devices.FakeController(devices.DUALSENSE_BLUETOOTH)
    pad.connect()
    short, long = clip(folder, "short.json", 2.0), clip(folder, "long.json", 20.0)
    listed = json.loads(run("devices", "--json")[1])["controllers"]
    check("it is listed", len(listed) == 1 and listed[0]["haptics"] == "DualSense" and listed[0]["transport"] == "Bluetooth"
          and listed[0]["soundCard"] is None, str(listed))
    check_samples(pad, short)
    check_samples(pad, short, 0x36, 398, 78, "--dualsense", "long-samples")
    check_fallback(pad, short)
    check_ends(pad, long)


def without_devices():
    return {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}


def record(processes, path):
    output = open(path, "wb")
    return processes.start("parec", "-d", "pad.monitor", "--channels=4", f"--channel-map={MAP}", "--format=float32le",
                           "--rate=48000", "--raw", "--latency-msec=20", env=without_devices(), stdout=output)


def levels_of(path):
    """Largest magnitude of each channel, and for how many seconds the third sounds."""
    content = path.read_bytes()
    samples = struct.unpack(f"<{len(content) // 16 * 4}f", content[:len(content) // 16 * 16])
    channels = [samples[c::4] for c in range(4)]
    heard = [i for i, sample in enumerate(channels[2]) if abs(sample) > 1e-3]
    return [max(map(abs, channel), default=0.0) for channel in channels], (heard[-1] - heard[0]) / 48000 if heard else 0.0


def check_sound(processes, folder, name, *arguments):
    path = folder / "heard.raw"
    recorder = record(processes, path)
    time.sleep(0.7)
    code, out, error = run(*arguments)
    time.sleep(0.3)
    recorder.terminate()
    recorder.wait(10)
    peaks, seconds = levels_of(path)
    check(f"{name}: it plays on its sound device without being asked to", code == 0 and not error, out + error)
    check(f"{name}: on the coils, and not on headphones or speaker", peaks[0] == peaks[1] == 0.0 and peaks[2] > 0.4
          and abs(peaks[3] - peaks[2]) < 1e-6, str(peaks))
    # Live, what comes too late for a busy machine is left out.
    least = 0.7 if name == "live" and not os.environ.get("PACINI_QUIET") else 1.7
    check(f"{name}: for as long as it lasts", least < seconds < 2.4, f"{seconds:.2f} s")
    return out


def cable(devices, folder):
    needs("pulseaudio", "parec", "pactl")
    socket = folder / "native"
    os.environ.update(PULSE_SERVER=f"unix:{socket}", XDG_RUNTIME_DIR=str(folder), HOME=str(folder))
    pad = devices.FakeController(devices.DUALSENSE)
    pad.connect()
    short, long = clip(folder, "short.json", 2.0), clip(folder, "long.json", 20.0)
    listed = json.loads(run("devices", "--json")[1])["controllers"]
    check("its sound card is found", [each.get("soundCard") for each in listed] == [7], str(listed))
    if not Path("/proc/asound").exists():  # ALSA's library ends programs under umockdev
        code, out, _ = run("play", short)
        check("where it cannot be opened, it plays by rumble and says so", code == 0 and "plays by rumble: it has a sound device" in out
              and any(report[3] or report[4] for _, report in pad.writes), out)
    with Processes() as processes:
        processes.start("pulseaudio", "-n", "--daemonize=no", "--use-pid-file=no", "--exit-idle-time=-1", "-L",
                        f"module-native-protocol-unix auth-anonymous=1 socket={socket}", "-L",
                        "module-null-sink sink_name=other", "-L",
                        f"module-null-sink sink_name=pad channels=4 channel_map={MAP} sink_properties=alsa.card=7",
                        env=without_devices())
        if not until(lambda: subprocess.run(["pactl", "info"], env=without_devices(), capture_output=True).returncode == 0, 15):
            skip("PulseAudio does not start")
        told = subprocess.run([COMMAND, "devices", "--sound", "--json"], env=without_devices(), capture_output=True).stdout
        listed = json.loads(told)["soundDevices"]
        names = {each["name"]: (each["inputs"], each["outputs"]) for each in listed}
        check("sound devices are listed", names.get("pulse:pad") == (0, 4) and names.get("pulse:pad.monitor") == (4, 0), str(names))
        for option, kind in (("--sound-input", "sources"), ("--sound-output", "sinks")):
            arguments = [option, "pulse:flute", "-o", "-"] + ([] if "input" in option else [short.replace(".json", ".wav")])
            if "output" in option:
                samples = bytes(4 * 4800)
                Path(arguments[-1]).write_bytes(b"RIFF" + struct.pack("<I", 36 + len(samples)) + b"WAVEfmt " + struct.pack(
                    "<IHHIIHH", 16, 3, 1, 48000, 192000, 4, 32) + b"data" + struct.pack("<I", len(samples)) + samples)
            code, _, error = run("live", *arguments)
            check(f"{option}: a name that PulseAudio does not know is an error that lists those it knows", code == 1
                  and f"pulse:flute: is none of the {kind} of pulse: " in error and "pad" in error and "other" in error, error)
        pad.clear()
        out = check_sound(processes, folder, "play", "play", short)
        check("play: rumble is taken back first, nothing else is sent", [report[:4] for _, report in pad.writes] == [b"\x02\0\0\0"],
              str(pad.writes))
        check("play: says which way", "by its sound device" in out, out)
        sound = folder / "sound.wav"
        samples = struct.pack("<96000f", *(0.7 * math.sin(2 * math.pi * 150 * i / 48000) for i in range(96000)))
        sound.write_bytes(b"RIFF" + struct.pack("<I", 36 + len(samples)) + b"WAVEfmt " + struct.pack(
            "<IHHIIHH", 16, 3, 1, 48000, 192000, 4, 32) + b"data" + struct.pack("<I", len(samples)) + samples)
        check_sound(processes, folder, "live", "live", str(sound), "--device", "dualsense")
        process = start("play", long, "--loop")
        time.sleep(1.5)
        check("a loop goes on", process.poll() is None)
        process.send_signal(signal.SIGINT)
        check("until Ctrl-C", ended(process)[0] == -signal.SIGINT)
        process = start("play", long)
        time.sleep(1.5)
        pad.take_away()
        code, _, error = ended(process)
        check("unplugging is an error in one line", code == 1 and error.count("\n") == 1 and "unplugged" in error, f"{code} {error}")


def claims(devices):
    with tempfile.TemporaryDirectory() as name:
        (bluetooth if LINK == "bluetooth" else cable)(devices, Path(name))


if __name__ == "__main__":
    main_under_umockdev(claims)
