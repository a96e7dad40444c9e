"""Compiles a program of one source for some machine, by ccache where that is there: it knows what another checkout made."""
import os
import shutil
import subprocess
import sys
from pathlib import Path


def compile_program(root, eigen, compiler, flags, source, program):
    """`source` is named from `root`, as all of the core is: paths without the checkout's place are the same in each."""
    launcher = ["ccache"] if shutil.which("ccache") else []
    made = Path(f"{program}.o")
    compiling = [*launcher, compiler, "-std=c++20", "-O2", "-ffp-contract=off", "-Werror=conversion",
                 "-Werror=sign-conversion", *flags, "-ICore", "-isystem", eigen, "-c", source, "-o", made]
    for command in (compiling, [compiler, *flags, made, "-o", program]):
        done = subprocess.run([str(part) for part in command], cwd=root, env={**os.environ, "CCACHE_NOHASHDIR": "1"},
                              capture_output=True, check=False, text=True, timeout=900)
        if done.returncode != 0:
            sys.exit(f"failed: {' '.join(map(str, command))}\n{done.stderr}")
