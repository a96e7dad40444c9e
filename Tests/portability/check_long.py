"""What is longer than 32 bits can count is encoded and played by 32-bit programs as by those of this machine, bit for
bit: long.cpp built for both, line by line. Each build stops at overflows of whole numbers, and at numbers that do not
fit the type that they are cast to.

check_long.py SOURCE EIGEN
"""
import platform
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from compiling import compile_program

SOURCE, EIGEN = Path(sys.argv[1]), sys.argv[2]
SANITIZERS = "-fsanitize=signed-integer-overflow,float-cast-overflow"
# machine -> compiler, its flags, what runs its programs
MACHINES = {
    "this machine": ("g++", [], []),
    "32-bit x86": ("i686-linux-gnu-g++", ["-msse2", "-mfpmath=sse", "-static"],
                   [] if platform.machine() == "x86_64" else ["qemu-i386"]),
}


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, check=False, text=True, timeout=600)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout.splitlines()


missing = sorted({tool for compiler, _, runner in MACHINES.values() for tool in [compiler, *runner[:1]]
                  if shutil.which(tool) is None})
if missing:
    print(f"SKIPPED: {', '.join(missing)} not found")
    sys.exit(77)

with tempfile.TemporaryDirectory() as folder:
    found = {}
    for machine, (compiler, flags, runner) in MACHINES.items():
        program = Path(folder) / compiler
        compile_program(SOURCE, EIGEN, compiler, [SANITIZERS, "-fsanitize-undefined-trap-on-error", *flags],
                        "Tests/portability/long.cpp", program)
        begun = time.monotonic()
        found[machine] = run(*runner, program)
        print(f"{machine}: {time.monotonic() - begun:.0f} s")
    expected, *others = found.values()
    for other in others:
        for line, wanted in zip(other, expected):
            if line != wanted:
                sys.exit(f"failed: '{line}' for '{wanted}'")
        if len(other) != len(expected):
            sys.exit(f"failed: {len(other)} lines for {len(expected)}")
    print("\n".join(expected))
