#!/usr/bin/env python3
"""pacini live on JACK's dummy driver, with a DualShock 4 that umockdev pretends to be there.

check_live.py PACINI [SECONDS]   exit 1 when a claim fails, 77 when JACK or umockdev is missing. SECONDS: how long impulses
are played (3600 for an hour)
"""
import json
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli/hid"))
from hid_test import COMMAND, LATEST, check, main_under_umockdev  # noqa: E402
from host_test import RATE, Processes, needs, skip, until  # noqa: E402

SECONDS = int(sys.argv[2]) if len(sys.argv) > 2 else 20
BLOCK = 128
SERVER = f"pacini{os.getpid()}"


def without_devices():
    """The environment of programs that need none of the devices that umockdev pretends to be there."""
    return {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}


def jack(command, *arguments):
    done = subprocess.run([command, *arguments], env=without_devices(), capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else ""


def live(*arguments):
    return subprocess.Popen([COMMAND, "live", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def memory_of(process):
    lines = Path(f"/proc/{process.pid}/status").read_text().splitlines()
    return next((int(line.split()[1]) for line in lines if line.startswith("VmRSS")), 0)


def check_missing():
    process = live("--sound-input", "jack", "-o", "-")
    _, error = process.communicate(timeout=30)
    if "needs RtAudio" in error:
        skip("librtaudio-dev was missing when pacini was built")
    wrong = live("--sound-input", "flute", "-o", "-")
    check("a system that there is not is wrong usage", "pacini: flute: begins with none of" in wrong.communicate(timeout=30)[1]
          and wrong.returncode == 2)
    check("a server that does not run is one line", process.returncode == 1
          and error == "pacini: jack: JACK does not run; start it first\n", error)


def check_delay():
    process = live("--sound-input", "jack", "--device", "wireless", "--measure-latency", "--duration", str(SECONDS), "--json")
    time.sleep(3)
    before = memory_of(process)
    time.sleep(max(SECONDS - 5, 1))
    after = memory_of(process)
    out, error = process.communicate(timeout=SECONDS + 30)
    told = json.loads(out or "{}")
    if not told.get("latency"):
        return check("it plays on JACK", False, f"{process.returncode} {out} {error}")
    print(f"     {told.get('latency')}, {told.get('interruptions')} interruptions, memory {before} to {after} kB")
    check("it plays for as long as it is told", process.returncode == 0 and told["seconds"] == SECONDS, error)
    check("every impulse is felt", told["latency"]["impulses"] >= int((SECONDS - 1.5) / 0.437) - 1, out)
    check(f"from impulse to report it takes at most {1e3 * LATEST:.0f} ms", told["latency"]["p90"] <= 1e3 * LATEST)
    check("in no more memory", after - before < 300)


def check_ports(folder):
    process = live("--sound-input", "jack", "--sound-output", "jack", "-o", str(folder / "drive.wav"), "--duration", "3",
                   "--json")
    check("its ports wait to be connected", until(lambda: "pacini:inport 0" in jack("jack_lsp")
                                                  and "pacini touch:outport 0" in jack("jack_lsp"), 10))
    check("to nothing yet", "   " not in jack("jack_lsp", "-c"))
    out, error = process.communicate(timeout=30)
    told = json.loads(out)
    check("it plays on a device and writes a file at once", process.returncode == 0
          and [sorted(o)[-1] for o in told["outputs"]] == ["output", "standstills"]
          and told["outputs"][0]["frames"] == 3 * RATE, error + out)


def check_signal(folder):
    process = live("--sound-input", "jack", "--device", "wireless", "-o", str(folder / "kept.wav"))
    time.sleep(1.5)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=30)
    check("Ctrl-C ends it, and keeps what was written", process.returncode == -signal.SIGINT and not error
          and (folder / "kept.wav").exists(), f"{process.returncode} {error}")


def check_file(folder):
    sound = folder / "sound.wav"
    samples = bytes(4 * RATE)
    sound.write_bytes(b"RIFF" + struct.pack("<I", 36 + len(samples)) + b"WAVEfmt "
                      + struct.pack("<IHHIIHH", 16, 3, 1, RATE, 4 * RATE, 4, 32) + b"data"
                      + struct.pack("<I", len(samples)) + samples)
    began = time.monotonic()
    out, error = live(str(sound), "--sound-output", "jack:system", "--json").communicate(timeout=30)
    took = time.monotonic() - began
    check("a file is played on a device at its rate, and ends", json.loads(out)["seconds"] == 1.0 and took > 0.9
          and not error, f"{took:.2f} s {error}")


def check_server_returns(folder, start):
    """A sound device that goes away is told, and plays again when it is back."""
    sound = folder / "long.wav"
    frames = 25 * RATE
    sound.write_bytes(b"RIFF" + struct.pack("<I", 36 + 2 * frames) + b"WAVEfmt "
                      + struct.pack("<IHHIIHH", 16, 1, 1, RATE, 2 * RATE, 2, 16) + b"data" + struct.pack("<I", 2 * frames)
                      + b"".join(struct.pack("<h", 9000 * (n // 300 % 2)) for n in range(frames)))
    server = start()
    process = live(str(sound), "--sound-output", "jack", "--json")
    check("it plays on JACK first", until(lambda: "pacini touch" in jack("jack_lsp"), 10))
    server.terminate()
    server.wait(20)
    time.sleep(3)
    server = start()
    check("it is back when the server is", until(lambda: "pacini touch" in jack("jack_lsp"), 10))
    out, error = process.communicate(timeout=60)
    check("a device that goes away is told", "jack: warning: does not answer any more; it plays again when it is back"
          in error, error)
    told = json.loads(out or "{}")
    check("and counted", process.returncode == 0 and told["outputs"][0]["connections"] == 2, f"{out} {error}")
    return server


def check_server_ends(folder, server):
    process = live("--sound-input", "jack", "-o", str(folder / "whole.wav"))
    time.sleep(1)
    server.terminate()
    server.wait(20)
    _, error = process.communicate(timeout=30)
    check("a server that ends is told", process.returncode == 1 and "does not answer any more" in error
          and (folder / "whole.wav").exists(), error)


def claims(devices):
    needs("jackd", "jack_lsp")
    os.environ.update(JACK_DEFAULT_SERVER=SERVER)
    check_missing()
    controller = devices.FakeController(devices.DUALSHOCK_4)
    controller.connect()
    with tempfile.TemporaryDirectory() as name, Processes() as processes:
        def start():
            server = processes.start_sound_server(without_devices(), BLOCK, 2, 2)
            if not server:
                skip("JACK does not start")
            return server

        server = start()
        check_delay()
        check_ports(Path(name))
        check_signal(Path(name))
        check_file(Path(name))
        server.terminate()
        server.wait(20)
        server = check_server_returns(Path(name), start)
        check_server_ends(Path(name), server)


if __name__ == "__main__":
    main_under_umockdev(claims)
