"""How fast the package is beside the command, and how many processors four threads keep busy, by processor time, which
hangs less on what else the machine does:

    PACINI_COMMAND=... PYTHONPATH=build/release/python build/python-venv/bin/python -B Tests/python/measure_speed.py

No test: a busy machine gives other figures. Wanted are 1.03 times the command's time, and 1.8 of two processors.
"""

import os
import resource
import shutil
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import pacini
from sounds import DEMO, FolderTest, knocks, run

ROUNDS = 15
COPIES = 6


def cpu(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


class Speed(FolderTest):
    def command_seconds(self, folder):
        before = cpu(resource.RUSAGE_CHILDREN)
        run("encode", folder, "-o", f"{self.folder}/out/", "--format", "packed", "--force", "--overwrite", "-j1", "-q")
        return cpu(resource.RUSAGE_CHILDREN) - before

    def package_seconds(self, folder):
        before = cpu(resource.RUSAGE_SELF)
        for path in sorted(folder.iterdir()):
            pacini.encode(path).save(self.folder / "out" / f"{path.stem}.pacb")
        return cpu(resource.RUSAGE_SELF) - before

    def test_files_take_as_long_as_by_the_command(self):
        few, many = self.folder / "few", self.folder / "many"
        for folder, copies in ((few, 1), (many, 1 + COPIES)):
            folder.mkdir()
            for path in DEMO:
                for i in range(copies):
                    shutil.copy(path, folder / f"{path.stem}{i}.flac")
        # The least of each, as the rest is what else the machine does; the difference is without what starting takes.
        taken = [
            [work(folder) for work in (self.command_seconds, self.package_seconds) for folder in (few, many)]
            for _ in range(ROUNDS)
        ]
        command_few, command_many, package_few, package_many = map(min, zip(*taken))
        command, package = command_many - command_few, package_many - package_few
        print(
            f"command {1e3 * command:.0f} ms, package {1e3 * package:.0f} ms of processor time, {package / command:.3f}"
        )

    @unittest.skipIf((os.cpu_count() or 1) < 2, "one processor")
    def test_a_thousand_encodes_in_four_threads_scale(self):
        """By the processors that are busy; on a machine that does other things as well, fewer may be had."""
        sound = knocks(0.5)

        def encode(_):
            return pacini.encode(sound, 48000).breakpoints

        alone = [encode(i) for i in range(1000)]
        found = []
        for _ in range(3):
            before, start = cpu(resource.RUSAGE_SELF), time.perf_counter()
            with ThreadPoolExecutor(4) as pool:
                self.assertEqual(list(pool.map(encode, range(1000))), alone)
            found.append((cpu(resource.RUSAGE_SELF) - before) / (time.perf_counter() - start))
        print("four threads keep busy: " + ", ".join(f"{busy:.2f}" for busy in found) + " processors")


if __name__ == "__main__":
    unittest.main()
