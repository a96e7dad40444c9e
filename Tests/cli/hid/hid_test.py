"""What the tests in this folder share: a clip, running pacini, running under umockdev."""
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "hosts"))
from host_test import check, failures, needs, skip  # noqa: E402

COMMAND = sys.argv[1]
PYTHON = "/usr/bin/python3"  # the one that Debian's modules belong to
LONGEST = 60  # s; a hang fails the test
# How late a report may be, s: with PACINI_QUIET=1, on a machine that does nothing else, as promised; elsewhere only what
# waits in a queue is that late.
LATEST = 0.015 if os.environ.get("PACINI_QUIET") else 0.1


def clip(folder, name, seconds):
    """A clip that sounds all the time and has ten events a second; its path."""
    points = [{"time": 0, "amplitude": 0.5}, {"time": seconds, "amplitude": 0.4}]
    path = folder / name
    path.write_text(json.dumps({
        "format": "pacini.clip", "version": 1, "name": name, "duration": seconds, "envelope": [], "centroid": [],
        "bands": [{"lowFrequency": 80, "centreFrequency": 160, "highFrequency": 300, "priority": 0,
                   "amplitude": points, "pitch": []}],
        "transients": [{"time": 0.1 * i, "amplitude": 0.9, "sharpness": 1} for i in range(round(10 * seconds))]}))
    return str(path)


def start(*arguments):
    return subprocess.Popen([COMMAND, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def ended(process):
    """(exit code, stdout, stderr); a hang is a failed claim."""
    try:
        out, error = process.communicate(timeout=LONGEST)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        check("pacini ends", False)
        return None, "", ""
    return process.returncode, out, error


def run(*arguments):
    return ended(start(*arguments))


def check_unplugging(device, path, name, reports=20):
    """Unplugging a device after so many reports of a clip is an error of one line that names it."""
    device.clear()
    process = start("play", path, "--loop")
    check("it plays until it is unplugged", device.wait_for(reports))
    device.unplug()
    code, _, error = ended(process)
    check("unplugging is an error in one line", code == 1 and error.count("\n") == 1 and "unplugged" in error
          and name in error and error.startswith("pacini: "), error)
    device.clear()


def main_under_umockdev(claims):
    """Runs `claims`, which gets the module of devices, in a process that umockdev wraps; then exits."""
    if "umockdev" not in os.environ.get("LD_PRELOAD", ""):
        needs("umockdev-wrapper", PYTHON)
        os.execvp("umockdev-wrapper", ["umockdev-wrapper", PYTHON, "-B", *sys.argv])
    try:
        import fake_controller
    except (ImportError, ValueError) as error:
        skip(f"umockdev for Python is missing ({error})")
    # Who is started in the background may ignore these, and so would its children.
    for number in (signal.SIGINT, signal.SIGQUIT, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)
    claims(fake_controller)
    print("failed:", ", ".join(failures)) if failures else print("all claims hold")
    sys.exit(1 if failures else 0)
