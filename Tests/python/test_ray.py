"""Many sounds on a Ray cluster of this machine: the same bytes as the command, whoever dies meanwhile."""

import contextlib
import hashlib
import os
import signal
import subprocess
import sys
import threading
import time
import unittest
from pathlib import Path

import pacini
from sounds import COMMAND, DEMO, FolderTest, knocks, run

try:
    import ray
    from pacini import ray as pacini_ray
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

FILES = int(os.environ.get("PACINI_RAY_FILES", "1500"))


def workers() -> list[int]:
    """Processes that encode now."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError):
                if (entry / "cmdline").read_bytes().startswith(b"ray::_encode_batch"):
                    found.append(int(entry.name))
    return found


def memory() -> int:
    """Bytes that this process has in memory."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Cluster(FolderTest):
    @classmethod
    def setUpClass(cls) -> None:
        # Without its memory monitor, which ends workers on machines that others fill.
        os.environ["RAY_memory_monitor_refresh_ms"] = "0"
        os.environ["RAY_AUTH_MODE"] = "disabled"  # which keeps a token in the user's home
        ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, object_store_memory=100_000_000)

    @classmethod
    def tearDownClass(cls) -> None:
        ray.shutdown()

    def sounds(self, count: int, seconds: float = 0.25) -> Path:
        folder = self.folder / "sounds"
        folder.mkdir()
        for i in range(min(count, 20)):
            pacini.write_audio(folder / f"{i:06}.wav", knocks(seconds, seed=i), 48000)
        for i in range(20, count):
            subfolder = folder / f"{i // 1000:03}"
            subfolder.mkdir(exist_ok=True)
            os.link(folder / f"{i % 20:06}.wav", subfolder / f"{i:06}.wav")
        return folder

    def test_clips_have_the_bytes_of_the_command_and_the_table_says_so(self) -> None:
        clips = self.folder / "clips"
        table = pacini_ray.encode(DEMO, clips, compare=True, batch=3)
        run("encode", *DEMO, "-o", f"{self.folder}/own/", "--format", "packed", "-q")
        rows = {Path(row["input"]).stem: row for row in table.to_pylist()}
        self.assertEqual(len(rows), len(DEMO))
        for sound in DEMO:
            data = (clips / f"{sound.stem}.pacb").read_bytes()
            row = rows[sound.stem]
            self.assertEqual(data, (self.folder / "own" / f"{sound.stem}.pacb").read_bytes())
            self.assertEqual((row["bytes"], row["sha256"]), (len(data), hashlib.sha256(data).hexdigest()))
            self.assertIsNone(row["error"])
            self.assertGreater(row["hts"], 40)
            self.assertGreater(row["seconds"], 0)
        names = {f"{sound.stem}.pacb" for sound in DEMO} | {"run.parquet"}
        self.assertEqual({path.name for path in clips.iterdir()}, names)

    def test_what_cannot_be_read_is_a_row_and_the_others_go_on(self) -> None:
        folder = self.sounds(3)
        (folder / "broken.wav").write_bytes(b"RIFF no sound")
        (folder / "not.txt").write_text("not a sound")
        table = pacini_ray.encode(folder, self.folder / "clips").to_pylist()
        self.assertEqual(len(table), 4)
        failed = [row for row in table if row["error"]]
        self.assertEqual([Path(row["input"]).name for row in failed], ["broken.wav"])
        with self.assertRaisesRegex(pacini.Error, "would both become"):
            pacini_ray.encode([folder / "000000.wav", self.folder / "000000.flac"], self.folder / "other")
        with self.assertRaisesRegex(pacini.Error, "must be one of"):
            pacini_ray.encode(folder, self.folder / "clips", format="nonsense")
        with self.assertRaisesRegex(pacini.Error, "must be 1 or more"):
            pacini_ray.encode(folder, self.folder / "clips", batch=0)

    def test_a_second_run_does_what_is_missing_failed_or_changed(self) -> None:
        folder, clips = self.sounds(20), self.folder / "clips"
        first = pacini_ray.encode(folder, clips)
        (clips / "000003.pacb").unlink()
        (clips / "000004.pacb").write_bytes((clips / "000004.pacb").read_bytes()[:-1])
        pacini.write_audio(folder / "000005.wav", knocks(0.5, seed=99), 48000, overwrite=True)
        done: list[float] = []
        before = {path.name: path.stat().st_mtime_ns for path in clips.glob("*.pacb")}
        again = pacini_ray.encode(folder, clips, progress=done.append)
        self.assertEqual(len(done), 3)
        # What may be somebody's is left as it is, until it is said.
        [row] = [row for row in again.to_pylist() if row["error"]]
        self.assertEqual(row["where"], str(clips / "000004.pacb"))
        self.assertIn("nothing in it says that Pacini made it", row["error"])
        again = pacini_ray.encode(folder, clips, overwrite=True)
        self.assertEqual(again["error"].null_count, 20)
        changed = {path.name for path in clips.glob("*.pacb") if path.stat().st_mtime_ns != before.get(path.name)}
        self.assertEqual(changed, {"000003.pacb", "000004.pacb", "000005.pacb"})
        self.assertEqual(again.num_rows, first.num_rows)
        # Other settings are other clips.
        done.clear()
        pacini_ray.encode(folder, clips, bands=4, progress=done.append)
        self.assertEqual(len(done), 20)

    def test_a_run_is_not_made_worse_by_the_next(self) -> None:
        folder, clips = self.sounds(6), self.folder / "clips"
        good = pacini_ray.encode(folder, clips, compare=True).to_pylist()
        self.assertTrue(all(row["hts"] > 10 and not row["error"] for row in good))
        before = (clips / "run.parquet").read_bytes()
        # What would fail for every sound is told, and nothing is done.
        for wrong in ({"bandz": 3}, {"bands": 1000}, {"method": "none"}, {"allow-nan": True}):
            with self.assertRaises(pacini.Error):
                pacini_ray.encode(folder, clips, compare=True, **wrong)
        with self.assertRaisesRegex(pacini.Error, "bandz: is no argument of encode.*did you mean bands"):
            pacini_ray.encode(folder, clips, bandz=3)
        self.assertEqual((clips / "run.parquet").read_bytes(), before)
        # Nor does a run without measures lose them,
        done: list[float] = []
        self.assertEqual(pacini_ray.encode(folder, clips, progress=done.append).to_pylist(), good)
        self.assertEqual(done, [])
        # although a clip is made again, as long as it becomes the same;
        (clips / "000002.pacb").unlink()
        again = pacini_ray.encode(folder, clips).to_pylist()
        self.assertEqual([row["hts"] for row in again], [row["hts"] for row in good])
        # measures of what has changed are none.
        pacini.write_audio(folder / "000003.wav", knocks(0.5, seed=99), 48000, overwrite=True)
        again = pacini_ray.encode(folder, clips).to_pylist()
        self.assertEqual([row["hts"] is None for row in again], [i == 3 for i in range(6)])
        again = pacini_ray.encode(folder, clips, compare=True).to_pylist()
        self.assertTrue(all(row["hts"] for row in again))
        # A sound that fails keeps what is known of the clip that is there.
        (folder / "000004.wav").write_bytes(b"RIFF no sound")
        failed = pacini_ray.encode(folder, clips, compare=True).to_pylist()[4]
        self.assertTrue(failed["error"])
        self.assertEqual({**failed, "error": None, "where": None}, again[4])

    def test_nothing_but_clips_of_its_own_is_replaced(self) -> None:
        folder, clips = self.sounds(4), self.folder / "clips"
        clips.mkdir()
        (clips / "run.parquet").write_bytes(b"a table of somebody")
        with self.assertRaisesRegex(pacini.Error, "is no table of pacini.ray"):
            pacini_ray.encode(folder, clips)
        self.assertEqual((clips / "run.parquet").read_bytes(), b"a table of somebody")
        (clips / "run.parquet").unlink()
        edited = pacini.encode(folder / "000000.wav")
        edited.envelope = []
        edited.save(clips / "000000.pacb")
        pacini.encode(folder / "000001.wav").save(clips / "000001.pacb")  # as the command makes them
        pacini.encode(folder / "000001.wav").save(clips / "000002.pacb")  # of another sound
        before = {path.name: path.read_bytes() for path in clips.iterdir()}
        rows = pacini_ray.encode(folder, clips, bands=4).to_pylist()
        self.assertEqual([bool(row["error"]) for row in rows], [True, False, True, False])
        self.assertIn("was edited since it was encoded", rows[0]["error"])
        for name in ("000000.pacb", "000002.pacb"):
            self.assertEqual((clips / name).read_bytes(), before[name])
        # The same at a URL, and sounds are replaced by nothing.
        rows = pacini_ray.encode(f"file://{folder}", f"file://{clips}", bands=5).to_pylist()
        self.assertEqual([bool(row["error"]) for row in rows], [True, False, True, False])
        rows = pacini_ray.encode(folder, clips, bands=4, overwrite=True).to_pylist()
        self.assertEqual([row["error"] for row in rows], [None] * 4)
        sounds = {path.name: path.read_bytes() for path in folder.iterdir()}
        for output in (folder, f"{folder}/../{folder.name}"):
            with self.assertRaisesRegex(pacini.Error, "would be replaced by the clip of"):
                pacini_ray.encode(folder, output, format="wav16", overwrite=True)
        self.assertEqual({path.name: path.read_bytes() for path in folder.iterdir()}, sounds)

    def test_workers_that_are_killed_cost_nothing(self) -> None:
        folder, clips = self.sounds(4000, 1.0), self.folder / "clips"
        over = threading.Event()
        killed = []

        def kill() -> None:
            while not over.wait(0.15) and len(killed) < 6:
                for process in workers()[:1]:
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(process, signal.SIGKILL)
                        killed.append(process)

        killer = threading.Thread(target=kill)
        killer.start()
        table = pacini_ray.encode(folder, clips, batch=10, retries=8)
        over.set()
        killer.join()
        self.assertGreaterEqual(len(killed), 2)
        self.assertEqual([row["error"] for row in table.to_pylist() if row["error"]], [])
        expected = {}
        for i in range(20):
            data = pacini.encode(folder / f"{i:06}.wav").to_bytes()
            expected[i] = hashlib.sha256(data).hexdigest()
        self.assertEqual(len(list(clips.rglob("*.pacb"))), 4000)
        for row in table.to_pylist():
            if int(Path(row["input"]).stem) < 20:
                self.assertEqual(row["sha256"], expected[int(Path(row["input"]).stem)])

    def test_a_run_that_is_killed_is_taken_up(self) -> None:
        folder, clips = self.sounds(4000, 1.0), self.folder / "clips"
        command = [sys.executable, "-m", "pacini.ray", str(folder), "-o", str(clips), "-q", "--address", "auto"]
        first = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        while sum(1 for _ in clips.rglob("*.pacb")) < 500:
            time.sleep(0.05)
        first.kill()
        first.wait()
        time.sleep(1.0)  # its workers end
        there = sum(1 for _ in clips.rglob("*.pacb"))
        self.assertLess(there, 4000)
        table = pacini_ray.encode(folder, clips)
        self.assertEqual(table.num_rows, 4000)
        self.assertEqual(sum(1 for _ in clips.rglob("*.pacb")), 4000)
        self.assertEqual([row for row in table.to_pylist() if row["error"]], [])
        left = [path.name for path in clips.rglob(".*") if path.name.startswith(".pacini-run")]
        self.assertEqual(left, [])

    def test_a_sound_that_kills_workers_is_an_error_alone(self) -> None:
        folder = self.sounds(8)
        mine = folder / "000005.wav"
        original = pacini_ray._encode_batch

        def deadly(items, settings):  # type: ignore[no-untyped-def]
            if any(item.input == str(mine) for item in items):
                os.kill(os.getpid(), signal.SIGKILL)
            return original(items, settings)

        pacini_ray._encode_batch = deadly
        try:
            table = pacini_ray.encode(folder, self.folder / "clips", batch=4, retries=1).to_pylist()
        finally:
            pacini_ray._encode_batch = original
        self.assertEqual([row["input"] for row in table if row["error"]], [str(mine)])
        self.assertIn("a worker ended", next(row["error"] for row in table if row["error"]))

    def test_urls_of_fsspec(self) -> None:
        folder = self.sounds(3)
        table = pacini_ray.encode(f"file://{folder}", f"file://{self.folder}/clips", format="json").to_pylist()
        self.assertEqual([row["error"] for row in table], [None] * 3)
        for i in range(3):
            made = (self.folder / "clips" / f"{i:06}.json").read_bytes()
            self.assertEqual(made, pacini.encode(folder / f"{i:06}.wav").to_bytes("json"))
        done: list[float] = []
        pacini_ray.encode(f"file://{folder}", f"file://{self.folder}/clips", format="json", progress=done.append)
        self.assertEqual(done, [])

    def test_many_files_take_memory_that_does_not_grow_and_time_that_is_linear(self) -> None:
        folder, clips = self.sounds(FILES), self.folder / "clips"
        few = self.folder / "few"
        pacini_ray.encode([folder / f"{i:06}.wav" for i in range(20)], few)  # workers have started
        times: list[float] = []
        started, least = time.monotonic(), memory()
        most = least

        def watch(_share: float) -> None:
            nonlocal most
            times.append(time.monotonic() - started)
            most = max(most, memory())

        table = pacini_ray.encode(folder, clips, progress=watch)
        self.assertEqual(table.num_rows, FILES)
        self.assertEqual(sum(1 for _ in clips.rglob("*.pacb")), FILES)
        self.assertLess(most - least, 40e6 + 3000 * FILES)
        half = times[len(times) // 2]
        print(f"{FILES} files in {times[-1]:.1f} s, the second half {(times[-1] - half) / half:.2f} times the first, "
              f"{(most - least) / 1e6:.1f} MB more")  # fmt: skip

    def test_the_command_has_it(self) -> None:
        path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
        clips = self.folder / "clips"

        def encode(*arguments: object) -> subprocess.CompletedProcess[str]:
            command = [COMMAND, "encode", *map(str, arguments)]
            return subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PATH": path})

        done = encode(*DEMO[:3], "-o", clips, "--bands", 5, "--spacing", "linear", "--ray", "auto", "-q")
        self.assertEqual(done.returncode, 0, done.stderr)
        run("encode", *DEMO[:3], "-o", f"{self.folder}/own/", "--bands", 5, "--spacing", "linear", "-q")
        for sound in DEMO[:3]:
            made = (clips / f"{sound.stem}.json").read_bytes()
            self.assertEqual(made, (self.folder / "own" / f"{sound.stem}.json").read_bytes())
        for wrong, word in (
            (("--manifest", self.folder / "m.json"), "cannot be combined with --ray"),
            (("--shard", "1/2"), "cannot be combined with --ray"),
            ((), "name a folder"),
        ):
            where = ("-o", clips) if wrong else ()
            done = encode(DEMO[0], *where, "--ray", "auto", *wrong)
            self.assertEqual(done.returncode, 2)
            self.assertIn(word, done.stderr)
        # Where the package is not there it is said what to do.
        bare = {"PATH": "/usr/bin:/bin", "HOME": str(self.folder)}
        if subprocess.run(["/usr/bin/python3", "-c", "import ray"], capture_output=True, env=bare).returncode:
            command = [COMMAND, "encode", str(DEMO[0]), "-o", str(clips), "--ray", "auto"]
            done = subprocess.run(command, capture_output=True, text=True, env=bare)
            self.assertEqual(done.returncode, 1)
            self.assertIn("pip install 'pacini[ray]'", done.stderr)

    def test_the_command_line(self) -> None:
        folder = self.sounds(2)
        (folder / "broken.wav").write_bytes(b"RIFF no sound")
        command = [sys.executable, "-m", "pacini.ray", str(folder), "-o", str(self.folder / "clips"), "-q"]
        done = subprocess.run([*command, "--address", "auto"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("2 encoded, 1 failed", done.stdout)
        self.assertIn("broken.wav", done.stderr)
        wrong = subprocess.run([*command, "--format", "nonsense"], capture_output=True, text=True)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("must be one of", wrong.stderr)


if __name__ == "__main__":
    unittest.main()
