#!/usr/bin/env python3
"""Runs every fuzz target for a number of executions with sanitizers, and prints what came of it as a table.

    python3 Tests/fuzz/run.py                        a million executions of each (Clang; Debian: clang libclang-rt-14-dev)
    python3 Tests/fuzz/run.py --runs 10000 csv tact  fewer, of two targets
    python3 Tests/fuzz/run.py --seconds 600          as many as fit into ten minutes each

Inputs found on the way are kept below --work, so that a second run goes on where the first has ended. An input that
breaks something is named, and belongs into regressions/TARGET together with its fix. Exits with 1 if there is any.
"""
import argparse
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def words_of(folders):
    """What stands in quotes or between commas in the stored inputs: the words of the format."""
    words = set()
    for folder in folders:
        for path in folder.iterdir():
            text = path.read_bytes()
            words.update(re.findall(rb'"[A-Za-z][A-Za-z0-9_ ./-]{1,40}"', text))
            words.update(re.findall(rb"(?<=[,\n])[A-Za-z_]{3,40}(?=[,\n])", text))
    return sorted(words)


def dictionary(target, folders, place):
    lines = [(HERE / "json.dict").read_text()]
    for word in words_of(folders):
        escaped = "".join(chr(b) if 32 <= b < 127 and chr(b) not in '"\\' else f"\\x{b:02x}" for b in word)
        lines.append(f'"{escaped}"\n')
    path = place / f"{target}.dict"
    path.write_text("".join(lines))
    return path


class Outcome:
    def __init__(self, target, log, exit_code, seconds):
        text = log.read_text(errors="replace")
        self.target, self.log, self.exit_code, self.seconds = target, log, exit_code, seconds
        number = lambda pattern: int(re.findall(pattern, text)[-1]) if re.findall(pattern, text) else 0
        self.executions = number(r"stat::number_of_executed_units:\s*(\d+)") or number(r"#(\d+)")
        self.edges = number(r"cov: (\d+)")
        self.inputs = number(r"corp: (\d+)")
        self.slowest = number(r"stat::slowest_unit_time_sec:\s*(\d+)")
        self.memory = number(r"stat::peak_rss_mb:\s*(\d+)")
        self.finding = re.findall(r"Test unit written to (\S+)", text)
        self.reason = re.findall(r"(?:broken: .*|ERROR: .*|runtime error: .*)", text)

    def row(self):
        found = "none" if self.exit_code == 0 else (self.reason or ["see " + str(self.log)])[0][:90]
        rate = self.executions / self.seconds if self.seconds > 0 else 0
        return (f"| {self.target} | {self.executions} | {self.seconds:.0f} | {rate:.0f} | {self.edges} | {self.inputs} "
                f"| {self.slowest} | {self.memory} | {found} |")


def run(target, options):
    work = options.work / target
    work.mkdir(parents=True, exist_ok=True)
    seeds = [folder for folder in (HERE / "corpus" / target, HERE / "regressions" / target) if folder.is_dir()]
    log = options.work / f"{target}.log"
    command = [str(options.programs / f"fuzz_{target}"), f"-dict={dictionary(target, seeds, options.work)}",
               f"-max_len={options.longest}", "-timeout=20", "-rss_limit_mb=3000", "-print_final_stats=1",
               f"-seed={options.seed}", f"-artifact_prefix={options.work}/{target}-"]
    command += [f"-max_total_time={options.seconds}"] if options.seconds else [f"-runs={options.runs}"]
    command += [str(work)] + [str(seed) for seed in seeds]
    begin = time.monotonic()
    with open(log, "w") as out:
        code = subprocess.run(command, stdout=out, stderr=subprocess.STDOUT, check=False).returncode
    return Outcome(target, log, code, time.monotonic() - begin)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("targets", nargs="*", help="names such as csv; all if none is given")
    parser.add_argument("--runs", type=int, default=1_000_000, help="executions of each target (default: a million)")
    parser.add_argument("--seconds", type=int, help="time of each target instead")
    parser.add_argument("-j", dest="jobs", type=int, default=os.cpu_count() or 1, help="targets at the same time")
    parser.add_argument("--longest", type=int, default=4096, help="longest input in bytes (default 4096)")
    parser.add_argument("--seed", type=int, default=1, help="of the random numbers (default 1)")
    parser.add_argument("--work", type=Path, default=ROOT / "build/fuzz/work", help="for inputs that were found, and logs")
    parser.add_argument("--programs", type=Path, help="folder of the fuzz programs; built if it is not given")
    options = parser.parse_args()

    if options.programs is None:
        if shutil.which("clang++") is None:
            sys.exit("run.py: clang++ is missing; on Debian: apt-get install clang libclang-rt-14-dev")
        subprocess.run(["cmake", "--preset", "fuzz"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["cmake", "--build", "--preset", "fuzz"], cwd=ROOT, check=True)
        options.programs = ROOT / "build/fuzz/bin"
    known = sorted(path.name.removeprefix("fuzz_") for path in options.programs.glob("fuzz_*") if path.suffix == "")
    targets = options.targets or known
    if unknown := [target for target in targets if target not in known]:
        sys.exit(f"run.py: no such target: {', '.join(unknown)}; there are {', '.join(known) or 'none'}")
    options.work.mkdir(parents=True, exist_ok=True)

    print("| target | executions | s | per s | edges | inputs | slowest s | MB | findings |")
    print("|---|---|---|---|---|---|---|---|---|")
    failed = False
    with concurrent.futures.ThreadPoolExecutor(max_workers=options.jobs) as pool:
        for outcome in pool.map(lambda target: run(target, options), targets):
            print(outcome.row(), flush=True)
            for path in outcome.finding:
                print(f"  {path}")
            failed = failed or outcome.exit_code != 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
