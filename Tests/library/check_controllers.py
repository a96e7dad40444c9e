#!/usr/bin/env python3
"""libpacini on controllers that umockdev pretends to be there.

check_controllers.py PLAY_ON_CONTROLLER RANDOM_CALLS   exit 1 when a claim fails, 77 when umockdev is missing
"""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli/hid"))
from hid_test import check, clip, ended, main_under_umockdev  # noqa: E402

PLAY, RANDOM = sys.argv[1:3]
NEUTRAL = bytes.fromhex("0001404000014040")


def begun(path, how):
    return subprocess.Popen([PLAY, path, how], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def is_neutral(report):
    return report[:1] == b"\x10" and report[2:] == NEUTRAL


def check_play(controller, path):
    controller.clear()
    code, out, error = ended(begun(path, "play"))
    check("a game plays a clip on a Pro Controller", code == 0 and "Pro Controller haptics 0 connection 1" in out, out + error)
    # After the last, it is attached once more, and destroyed at once.
    opens = [i for i, (_, report) in enumerate(controller.writes) if report == b"\x80\x02"]
    check("attached twice", len(opens) == 2)
    times, reports = zip(*controller.writes[:opens[1]])
    check("vibration is enabled first", reports[2][:1] == b"\x01" and reports[2][10:] == b"\x48\x01")
    stream = reports[3:]
    check("then there is rumble, which ends in silence", all(r[0] == 0x10 for r in stream) and all(map(is_neutral, stream[-2:])))
    loud = [t for t, r in zip(times, reports) if r[0] == 0x10 and not is_neutral(r)]
    check("as long as the clip", 0.9 < loud[-1] - loud[0] < 1.2, f"{loud[-1] - loud[0]:.3f} s")
    gaps = sorted(b - a for a, b in zip(times[3:], times[4:]))
    check("every 15 ms", abs(gaps[len(gaps) // 2] - 0.015) < 0.001, f"{gaps[len(gaps) // 2]}")
    left, right = {r[2:6] for r in stream}, {r[6:10] for r in stream}
    check("in the middle, both sides play alike", left == right and len(left) > 5)


def check_end(controller, path, how):
    controller.clear()
    code, out, error = ended(begun(path, how))
    reports = [report for _, report in controller.writes]
    check(f"{how}: it is silent in the end", code == 0 and out.endswith("ended\n") and all(map(is_neutral, reports[-2:]))
          and not is_neutral(reports[-6]), out + error)


def check_unplugging(controller, path):
    controller.clear()
    process = begun(path, "unplug")
    process.stdout.readline()
    check("it plays", process.stdout.readline() == "unplug\n" and controller.wait_for(20))
    controller.unplug()
    code, out, error = ended(process)
    check("a game is told that it is gone, and its plays end", code == 0 and "gone: does not answer any more" in out
          and out.endswith("ended\n"), out + error)
    controller.clear()


def claims(devices):
    with tempfile.TemporaryDirectory() as name:
        path = clip(Path(name), "short.json", 1.0)
        controller = devices.FakeController()
        controller.connect()
        check_play(controller, path)
        for how in ("destroy", "exit"):
            check_end(controller, path, how)
        code, out, error = ended(begun(path, "two"))
        check("a controller plays one engine", code == 0, out + error)
        random = subprocess.run([RANDOM, "300", "3", "attached"], capture_output=True, text=True, timeout=300)
        check("random calls with a controller", random.returncode == 0, random.stdout + random.stderr)
        check_unplugging(controller, path)


if __name__ == "__main__":
    main_under_umockdev(claims)
