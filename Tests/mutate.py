#!/usr/bin/env python3
"""Do the tests notice? Changes one operator, constant, bound, condition or statement at a time in Core and Source/io, runs
the tests that reach it, and lists what survives.

mutate.py                                     300 random changes, every room: build/mutate/survivors.json
mutate.py --rooms actuator,realtime --count 60
mutate.py --at Core/pacini/simplify/GreedyBudget.h:85       every change in that line
mutate.py --newest --count 20                 changes of the lines that the last commits wrote, newest first
mutate.py --list ...                          only say what would be changed

Exit 1 when fewer than --at-least percent are caught. All changes are compiled into one program, in a copy of the
sources in build/mutate, and switched on one by one. First come the C++ tests that reach the change, those of its own room
before the others; what they leave is shown to the golden test of the command (cli/test_outputs.py). A survivor that no
test can catch is written in mutation/reasons.json with the reason, and is not counted.
"""
import argparse
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import time
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "mutation"))
from changes import blamed, changes_of, in_place  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "build/mutate"
FOLDERS = ["Core/pacini", "Source/io"]
REASONS = ROOT / "Tests/mutation/reasons.json"
# Rooms whose changes need no more than core and io: each folder below these with tests of its own.
TESTED = sorted({str(path.parent.relative_to(ROOT / "Tests")) for top in [*(ROOT / "Core/pacini").iterdir(), ROOT / "Source/io"]
                 if top.is_dir() for path in (ROOT / "Tests" / top.name).rglob("*Test.cpp")})
NEWEST_COMMITS, NEWEST_ROOMS = 60, 3
MEMORY = 6_000_000_000  # bytes; a change may make a loop that takes all there is


def room_of(path):
    """Core/pacini/clip/edits/Trim.h -> clip/edits, Source/io/formats/ahap/AhapWriter.cpp -> io/formats."""
    parts = Path(path).parts
    parts = parts[2:-1] if parts[0] == "Core" else parts[1:-1]
    return "/".join(parts[:2])


def all_changes(rooms, at):
    found = []
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            name = str(path.relative_to(ROOT))
            if path.suffix not in {".h", ".cpp"} or (rooms and not any(room_of(name).startswith(room) for room in rooms)):
                continue
            found += changes_of(name, path.read_text())
    if at:
        found = [change for change in found if f"{change.path}:{change.line}" in at]
    return found


def newest_of(every):
    """The changes in lines that one of the last commits wrote, the newest first, of few rooms: each has to be compiled."""
    def git(*command):
        return subprocess.run(["git", "-c", f"safe.directory={ROOT}", *command], cwd=ROOT, capture_output=True, text=True,
                              check=True).stdout
    commits = git("log", "--no-merges", f"-n{NEWEST_COMMITS}", "--format=%H", "--", *FOLDERS).split()
    rank = {commit: place for place, commit in enumerate(commits)}
    touched = set(git("log", "--no-merges", f"-n{NEWEST_COMMITS}", "--format=", "--name-only", "--", *FOLDERS).split("\n"))
    written = {path: [rank.get(line.split(" ", 1)[0]) for line in git("blame", "-l", "-s", "--root", path).splitlines()]
               for path in sorted(touched & {change.path for change in every})}
    newest = [(written[change.path][change.line - 1], number) for number, change in enumerate(every)
              if change.path in written and written[change.path][change.line - 1] is not None]
    chosen, rooms = [], []
    for _, number in sorted(newest):
        room = room_of(every[number].path)
        if room not in rooms and len(rooms) < NEWEST_ROOMS:
            rooms.append(room)
        if room in rooms:
            chosen.append(every[number])
    return chosen


def write_sources(chosen):
    """The tree in build/mutate/source with the changes in it; files that stay as they are keep their time."""
    by_path = defaultdict(list)
    for number, change in enumerate(chosen):
        if not change.dropped:
            by_path[change.path].append((number, change))
    kept = set()
    for name in (str(path.relative_to(ROOT)) for top in sorted(ROOT.iterdir()) if top.name not in ("build", ".git")
                 for path in ([top] if top.is_file() else sorted(top.rglob("*")))):
        source, target = ROOT / name, WORK / "source" / name
        if not source.is_file():
            continue
        kept.add(target)
        target.parent.mkdir(parents=True, exist_ok=True)
        if name in by_path:
            text = in_place(source.read_text(), by_path[name]).encode()
        else:
            text = source.read_bytes()
        if not target.exists() or target.read_bytes() != text:
            target.write_bytes(text)
            shutil.copymode(source, target)
    for target in (WORK / "source").rglob("*"):
        if target.is_file() and target not in kept:
            target.unlink()


def configure(rooms):
    tested = [room for room in TESTED if not rooms or any(room.startswith(wanted) for wanted in rooms)]
    flags = f"-std=c++20 -w -Wno-narrowing -fpermissive -D_GLIBCXX_ASSERTIONS -include {WORK}/source/Tests/mutation/Mutants.h"
    subprocess.run(["cmake", "-S", WORK / "source", "-B", WORK / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug",
                    "-DCMAKE_CXX_FLAGS_DEBUG=-O1", f"-DCMAKE_CXX_FLAGS={flags}", "-DPACINI_UNITY_BUILD=ON",
                    "-DPACINI_BUILD_PLUGIN=OFF", "-DPACINI_MUTATION=ON",
                    f"-DPACINI_TEST_ROOMS={';'.join(tested)}"], check=True, stdout=subprocess.DEVNULL)


def build(chosen, targets, jobs):
    """Compiles; a change that the language does not allow is dropped, and it starts again."""
    while True:
        write_sources(chosen)
        done = subprocess.run(["ninja", "-C", WORK / "build", "-j", str(jobs), "-k", "0", *targets],
                              capture_output=True, text=True)
        if done.returncode == 0:
            return
        errors = blamed(chosen, done.stdout)
        if not errors:
            sys.exit(done.stdout[-6000:] + "\nmutate: this does not compile, and no change is to blame")
        print(f"  {len(errors)} changes do not compile and are dropped", file=sys.stderr)
        for change in errors:
            change.dropped = True


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Tests:
    """The test program and what is known of its cases: how long they take and which changes they reach."""

    def __init__(self, outputs):
        self.program = WORK / "build/bin/pacini_tests"
        reached = WORK / "reached.txt"
        done = subprocess.run([self.program, "~[slow]~[.]"], env=os.environ | {"PACINI_MUTANTS_REACHED": str(reached)},
                              stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=WORK)
        if done.returncode not in (0, 1, 77):
            sys.exit(f"mutate: the tests end with {done.returncode} without any change")
        if done.returncode == 1:  # a test may be right for the release build only: such a one tells nothing here
            print("  tests that fail without any change are left out", file=sys.stderr)
        self.cases, self.seconds, self.first = defaultdict(list), {}, set()
        for line in reached.read_text().splitlines():
            seconds, numbers, name = line.split("\t", 2)
            if name.startswith("(before"):
                self.first = {int(number) for number in numbers.split()}
                continue
            self.seconds[name] = float(seconds)
            for number in numbers.split():
                self.cases[int(number)].append(name)
        # What the program does not find by its name would be taken for a test that fails.
        found = subprocess.run([self.program, "--list-test-names-only", "--input-file", self.listed("all", self.seconds)],
                               capture_output=True, text=True).stdout.splitlines()
        if not self.seconds or set(found) != set(self.seconds):
            sys.exit("mutate: the tests cannot be called by their names")
        self.outputs_told = outputs and not self.golden(None)
        if outputs and not self.outputs_told:
            print("  the golden outputs differ without any change and are left out", file=sys.stderr)

    def run(self, arguments, environment, timeout):
        """Whether something fails: a test, the program, or the time or memory that it may take."""
        try:
            done = subprocess.run([self.program, *arguments], env=os.environ | environment, preexec_fn=limited,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  timeout=timeout, cwd=WORK)
        except subprocess.TimeoutExpired:
            return True
        return done.returncode not in (0, 77)

    def listed(self, which, names):
        """A file of these names, as Catch reads them."""
        path = WORK / f"tests-{which}.txt"
        path.write_text("".join(re.sub(r'([\\,\[\]"~])', r"\\\1", name) + "\n" for name in names))
        return path

    def some(self, number, names):
        """Whether one of these tests catches the change."""
        if not names:
            return False
        listed = self.listed(number, names)
        timeout = 10 + 4 * sum(self.seconds[name] for name in names)
        caught = self.run(["--input-file", listed, "--abort", "--warn", "NoTests"], {"PACINI_MUTANT": str(number)}, timeout)
        listed.unlink()
        return caught

    def golden(self, number):
        """Whether the golden test of the command fails with this change."""
        environment = {"PACINI_COMMAND": str(WORK / "build/bin/pacini"), "PACINI_SOURCE_DIR": str(ROOT),  # profiles are found above the program
                       "PACINI_SANITIZE": ""}
        if number is not None:
            environment["PACINI_MUTANT"] = str(number)
        try:
            done = subprocess.run([sys.executable, "-B", WORK / "source/Tests/support/run_tests.py",
                                   WORK / "source/Tests/cli/test_outputs.py"], env=os.environ | environment,
                                  preexec_fn=limited, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL, timeout=300)
        except subprocess.TimeoutExpired:
            return True
        return done.returncode not in (0, 77)

    def catcher(self, number, change):
        """What catches the change, or None."""
        names = sorted(self.cases[number], key=self.seconds.get)
        own = [name for name in names if self.seconds[name] < 2.0][:60]
        if self.some(number, own):
            return "its tests"
        if number in self.first and self.some(number, [name for name in self.seconds if self.seconds[name] < 2.0]):
            return "its tests"
        golden = self.outputs_told and self.golden(number)  # 2 s, where the tests of long sounds take minutes
        if not golden and self.some(number, [name for name in names if name not in set(own)]):
            return "its tests"
        return "outputs" if golden else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--count", type=int, default=300, help="how many changes (300)")
    parser.add_argument("--seed", type=int, default=1, help="which ones (1)")
    parser.add_argument("--rooms", default="", help="folders of Core/pacini or Source, separated by commas (all)")
    parser.add_argument("--at", action="append", default=[], metavar="FILE:LINE", help="all changes of this line")
    parser.add_argument("--newest", action="store_true", help="only lines that the last commits wrote")
    parser.add_argument("--at-least", type=float, default=90.0, help="percent that must be caught (90)")
    parser.add_argument("--no-outputs", action="store_true", help="without the golden test of the command, which has to be built")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="how many at once")
    parser.add_argument("--list", action="store_true", help="only list the changes")
    arguments = parser.parse_args()
    rooms = [room for room in arguments.rooms.split(",") if room]

    every = all_changes(rooms, arguments.at)
    if arguments.newest:
        # Neighbouring lines are alike: a few of each hundred of the newest places.
        every = newest_of(every)[:10 * arguments.count]
        rooms = sorted({room_of(change.path) for change in every})
        if not every:
            print("mutate: the last commits changed nothing there")
            return 0
    if not every:
        sys.exit("mutate: nothing to change there")
    # Some of what is drawn does not compile: a fifth more is drawn, and what is too much left out in the end.
    drawn = every if arguments.at else random.Random(arguments.seed).sample(every, min(len(every), arguments.count * 6 // 5))
    if arguments.list:
        for change in drawn[:arguments.count]:
            print(change)
        return 0
    started = time.monotonic()
    WORK.mkdir(parents=True, exist_ok=True)
    write_sources(drawn)
    configure(rooms)
    build(drawn, ["pacini_tests"] if arguments.no_outputs else ["pacini_tests", "pacini"], arguments.jobs)
    built = time.monotonic()
    kept = [(number, change) for number, change in enumerate(drawn) if not change.dropped]
    if not arguments.at:
        kept = kept[:arguments.count]
    print(f"  {len(every)} places, {len(kept)} changes, built in {built - started:.0f} s", file=sys.stderr)
    tests = Tests(not arguments.no_outputs)
    results = {}
    (WORK / "survived-so-far.txt").write_text("number\tchange\ttests that reach it\n")

    def judge(item):
        results[item[0]] = tests.catcher(*item)
        if not results[item[0]]:  # as it is known: a run of hours may be broken off
            with open(WORK / "survived-so-far.txt", "a") as file:
                file.write(f"{item[0]}\t{item[1]}\t{len(tests.cases[item[0]])}\n")
        if sys.stderr.isatty():
            print(f"\r  {len(results)} of {len(kept)}", end="", file=sys.stderr, flush=True)

    with ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(judge, kept))

    reasons = {(entry["file"], entry["line"], entry["change"]): entry["why"]
               for entry in (json.loads(REASONS.read_text()) if REASONS.exists() else [])}
    changed, caught, excused, survivors = Counter(), Counter(), [], []
    for number, change in kept:
        room = room_of(change.path)
        if results[number]:
            caught[room] += 1
        elif why := reasons.get((change.path, change.text, change.what)):
            excused.append((change, why))
            continue
        else:
            survivors.append((number, change))
        changed[room] += 1
    print(f"\n{'room':<20}{'changes':>8}{'caught':>8}")
    for room in sorted(changed):
        print(f"{room:<20}{changed[room]:>8}{caught[room]:>8}")
    percent = 100.0 * caught.total() / max(1, changed.total())
    golden = sum(result == "outputs" for result in results.values())
    print(f"{'all':<20}{changed.total():>8}{caught.total():>8}   {percent:.1f} %"
          f" ({golden} by the golden outputs alone), seed {arguments.seed},"
          f" {(time.monotonic() - started) / 60:.1f} min")
    if survivors:
        print("\nSurvived:")
    for number, change in sorted(survivors, key=lambda item: str(item[1])):
        count = len(tests.cases[number])
        print(f"  {change}   {f'{count} tests reach it' if count else 'no test reaches it'}")
    if excused:
        print("\nNot counted, for a reason:")
    for change, why in excused:
        print(f"  {change}\n      {why}")
    (WORK / "survivors.json").write_text(json.dumps(
        [{"file": change.path, "line": change.text, "change": change.what, "why": ""} for _, change in survivors], indent=2))
    return 0 if percent >= arguments.at_least else 1


if __name__ == "__main__":
    sys.exit(main())
