"""What the tests in hosts share: claims, what must be there, programs that end with the test, a screen nobody sees."""
import fcntl
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

RATE = 48000
PLACES = Path("/dev/shm/jack-shm-registry")
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

    def start_sound_server(self, environment, block=1024, inputs=4, outputs=4):
        """JACK without a sound card at RATE, for programs with `environment`, which is changed: the process, or None.

        It waits for slow programs: on a busy machine it would throw them out. JACK has eight places for servers, and one
        that is killed keeps its place until the machine starts again: where none is left and no server runs any more,
        all eight are freed (jackd 1.9.21 does not know --replace-registry, which its help names).
        """
        environment.setdefault("JACK_DEFAULT_SERVER", f"pacini{os.getpid()}")
        environment["JACK_NO_AUDIO_RESERVATION"] = "1"
        with open(Path(tempfile.gettempdir()) / "pacini-tests-jack.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            for _ in range(2):
                server = self.start("jackd", "-r", "-t", "8000", "-n", environment["JACK_DEFAULT_SERVER"], "-d",
                                    "dummy", "-r", RATE, "-p", block, "-C", inputs, "-P", outputs, env=environment)
                answers = until(
                    lambda: server.poll() is not None or f"system:playback_{outputs}" in listed(environment))
                if server.poll() is None:
                    return server if answers else None
                if subprocess.run(["pgrep", "-x", "-r", "R,S,D,T", "jackd"], capture_output=True).returncode == 1:
                    PLACES.unlink(missing_ok=True)
        return None

    def __exit__(self, *_):
        for process in reversed(self.running):
            process.terminate()
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def picture(display, path):
    """The whole screen as a file."""
    return subprocess.run(["import", "-display", display, "-window", "root", str(path)], timeout=60).returncode == 0
