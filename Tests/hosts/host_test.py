"""What the tests in hosts share: claims, what must be there, programs that end with the test, a screen nobody sees."""
import os
import shutil
import subprocess
import sys
import time

RATE = 48000
failures = []


def check(claim, holds, detail=""):
    print("ok  " if holds else "FAIL", claim, detail, flush=True)
    if not holds:
        failures.append(claim)


def skip(why):
    """Ends the test as one that could not be made."""
    print("SKIPPED:", why, "- cmake/bootstrap.sh test installs it")
    sys.exit(77)


def needs(*programs):
    for program in programs:
        if not shutil.which(program):
            skip(f"{program} is missing")


def until(condition, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.2)
    return False


def listed(environment):
    """The ports of the sound server and their connections."""
    done = subprocess.run(["jack_lsp", "-c"], env=environment, capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else ""


class Processes:
    """Ends what it started, the newest first."""

    def __init__(self):
        self.running = []

    def __enter__(self):
        return self

    def start(self, *arguments, **options):
        options.setdefault("stdout", subprocess.DEVNULL)
        options.setdefault("stderr", subprocess.DEVNULL)
        process = subprocess.Popen([str(a) for a in arguments], **options)
        self.running.append(process)
        return process

    def start_screen(self):
        """Xvfb of 1280 x 960, on a number that no other test takes. It says when it is there."""
        read, write = os.pipe()
        display = f":{1000 + os.getpid()}"
        self.start("Xvfb", display, "-displayfd", write, "-screen", "0", "1280x960x24", pass_fds=[write])
        os.close(write)
        with os.fdopen(read) as numbers:
            numbers.readline()
        return display

    def start_sound_server(self, environment):
        """JACK without a sound card, four channels at RATE, for programs with `environment`, which is changed."""
        server = f"pacini{os.getpid()}"
        environment.update(JACK_DEFAULT_SERVER=server, JACK_NO_AUDIO_RESERVATION="1")
        self.start("jackd", "-r", "-n", server, "-d", "dummy", "-r", RATE, "-p", "1024", "-C", "4", "-P", "4",
                   env=environment)
        return until(lambda: "system:playback_4" in listed(environment))

    def __exit__(self, *_):
        for process in reversed(self.running):
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def picture(display, path):
    """The whole screen as a file."""
    return subprocess.run(["import", "-display", display, "-window", "root", str(path)], timeout=60).returncode == 0
