#!/usr/bin/env python3
"""The standalone program on JACK's dummy driver, with a DualShock 4 that umockdev pretends to be there.

check_pad.py PACINI PROGRAM NO_CARDS [PICTURE]

NO_CARDS: see no_cards.c. PICTURE: where one of the window goes while the controller is unplugged. Exit 1 when a
claim fails, 77 when Xvfb, JACK or umockdev is missing
"""
import os
import signal
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli/hid"))
from hid_test import check, main_under_umockdev  # noqa: E402
from host_test import Processes, listed, needs, picture, until  # noqa: E402

PROGRAM = sys.argv[2]
NAME = "Wireless Controller"


def is_silent(report):
    return report[4:6] == b"\0\0"


def felt(controller):
    return sum(not is_silent(report) for _, report in list(controller.writes))


def start(processes, environment, *arguments):
    return processes.start(PROGRAM, "--fresh", "--device-type", "JACK", "--test-signal", *arguments, env=environment)


def claims(devices):
    needs("Xvfb", "jackd", "jack_lsp", "import")
    controller = devices.FakeController(devices.DUALSHOCK_4)
    controller.connect()
    preload = os.environ.pop("LD_PRELOAD")  # only the program needs the pretended device
    with tempfile.TemporaryDirectory() as folder, Processes() as processes:
        plain = dict(os.environ, HOME=folder, DISPLAY=processes.start_screen())
        check("the sound server runs", processes.start_sound_server(plain, block=256))
        environment = dict(plain, LD_PRELOAD=f"{sys.argv[3]}:{preload}", UMOCKDEV_DIR=controller.bed.get_root_dir())
        app = start(processes, environment)
        check("the program takes the interface", until(lambda: "JUCEJack:out_4" in listed(plain), 60))
        time.sleep(2)
        check("without a choice it sends nothing", not controller.writes)
        app.terminate()
        app.wait(30)

        app = start(processes, environment, "--controller", NAME)
        check("it plays the test signal on the controller", until(lambda: felt(controller) > 20, 60))
        controller.unplug()
        time.sleep(2.5)
        if len(sys.argv) > 4:
            picture(plain["DISPLAY"], sys.argv[4])
        check("it goes on when that is unplugged", app.poll() is None)
        controller.clear()
        check("and plays when it is back", until(lambda: felt(controller) > 20, 30))
        app.terminate()
        check("it ends when asked to", until(lambda: app.poll() is not None, 10))
        check("and the motors stop", is_silent(controller.writes[-1][1]))

        controller.clear()
        app = start(processes, environment, "--controller", NAME)
        check("it plays once more", until(lambda: felt(controller) > 20, 60))
        app.send_signal(signal.SIGSEGV)
        app.wait(30)
        check("the motors stop when it crashes", is_silent(controller.writes[-1][1]))


if __name__ == "__main__":
    main_under_umockdev(claims)
