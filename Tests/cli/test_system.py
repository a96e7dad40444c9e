"""End to end: what the system does to the command. Full disks, closed streams, signals, rights, strange names."""
import contextlib
import json
import os
import shutil
import signal
import subprocess
import unittest

from command import COMMAND, SANITIZED, CommandTest, noise, sine, wav, wav_header

NOBODY = 65534


class Streams(CommandTest):
    def test_a_full_standard_output_is_an_error(self):
        self.clip()
        for arguments in (["info", "clip.json"], ["info", "clip.json", "--json"], ["--help"], ["--version"],
                          ["encode", "--help"], ["render", "clip.json"], ["convert", "clip.json", "x.pacb", "--json"]):
            with open("/dev/full", "w") as full:
                self.fails(1, arguments, "pacini: standard output: the disk is full", stdout=full)

    def test_a_closed_standard_output_is_an_error_and_no_file_takes_its_place(self):
        self.clip()
        self.put("a.wav", wav(sine(100, 0.2)))
        for arguments in ("info clip.json", "--version", "render clip.json -o out.wav", "encode a.wav --json --force"):
            done = subprocess.run(["bash", "-c", f'"$0" {arguments} >&-', COMMAND], cwd=self.folder, timeout=60,
                                  stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
            self.assertEqual((done.returncode, done.stderr),
                             (1, b"pacini: standard output: is closed; open it or send it to a file\n"), arguments)
        self.assertNotIn(b"files", (self.folder / "a.json").read_bytes())

    def test_messages_never_land_in_a_file_when_standard_error_is_closed(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        for i in range(20):
            self.put(f"bad{i}.wav", "no sound")
        done = subprocess.run(["bash", "-c", '"$0" encode . -o out <&- 2>&-', COMMAND], cwd=self.folder, timeout=60,
                              stdout=subprocess.PIPE)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(json.loads((self.folder / "out/a.json").read_text())["format"], "pacini.clip")

    def test_a_reader_that_went_away_is_an_error_not_a_sudden_end(self):
        self.clip()
        for command in ("info clip.json", "render clip.json -o out.wav"):
            done = subprocess.run(["bash", "-c", f'(sleep 0.3; "$0" {command}; echo "$?" >&2) | true', COMMAND],
                                  cwd=self.folder, timeout=60, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
            self.assertEqual(done.stderr, b"pacini: standard output: the reader of the pipe has closed it\n1\n")
        self.assertEqual(self.names(), ["clip.json", "out.wav"])

    def test_a_clip_goes_through_a_pipe(self):
        self.clip()
        done = subprocess.run(["bash", "-c", '"$0" convert <(cat clip.json) /dev/stdout --format json --quiet | '
                               '"$0" info /dev/stdin --json', COMMAND],
                              cwd=self.folder, timeout=60, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.stderr, b"")
        self.assertEqual(json.loads(done.stdout)["duration"], 1.0)


class Disks(CommandTest):
    def test_a_disk_that_fills_up_leaves_the_old_file_and_no_other(self):
        self.clip()
        self.put("a.wav", wav(noise(48000)))
        self.put("out.wav", "old")
        self.put("a.json", "old")
        self.put("x.json", "old")
        for arguments, output in ((["render", "clip.json", "-o", "out.wav"], "out.wav"),
                                  (["encode", "a.wav", "-y"], "a.json"),
                                  (["convert", "clip.json", "-o", "x.json"], "x.json")):
            self.fails(1, arguments, f"{output}: the file would be larger than the system allows", file_limit=500)
            self.assertEqual((self.folder / output).read_text(), "old")
        self.fails(1, ["convert", "clip.json", "/dev/full", "--format", "json"], "/dev/full: the disk is full")

    @contextlib.contextmanager
    def small_disk(self, size="64k"):
        """The folder "small", which is a disk of that size."""
        disk = self.folder / "small"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "pacini-test", str(disk)],
                          stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("mounting is not allowed here")
        try:
            yield disk
        finally:
            subprocess.run(["umount", str(disk)], check=True)

    @unittest.skipUnless(os.geteuid() == 0, "needs root to mount a small disk")
    def test_a_small_disk_that_is_really_full(self):
        self.clip(seconds=60)
        with self.small_disk() as disk:
            self.fails(1, ["render", "clip.json", "-o", "small/out.wav"],
                       "pacini: clip.json: small/out.wav: the disk is full; free some space")
            self.assertEqual(os.listdir(disk), [])

    @unittest.skipUnless(os.geteuid() == 0, "needs root to mount a small disk")
    def test_a_live_recording_ends_before_the_disk_is_full_and_is_kept(self):
        with self.small_disk("20M") as disk:
            done = self.run_command("live", "-", "--raw", "f32", "--channels", "1", "-o", "small/x.wav", stdin=None,
                                    input=bytes(30_000_000))
            self.assertEqual((done.returncode, done.stderr.decode()),
                             (1, "pacini: small/x.wav: ends here, since the disk is full but for 16 MB\n"))
            self.assertEqual(os.listdir(disk), ["x.wav"])
            self.assertIn(b"wrote small/x.wav: 2", done.stdout)
            self.assertGreater((disk / "x.wav").stat().st_size, 3_000_000)

    @unittest.skipUnless(os.geteuid() == 0, "needs root to mount a small disk")
    def test_a_full_disk_stops_a_batch_at_once_with_one_line(self):
        for i in range(12):
            self.clip(f"in/{i:02}.json", seconds=60)
        with self.small_disk() as disk:
            for jobs in ("1", "4"):
                done = self.fails(1, ["render", "in", "-o", "small", "--json", "-j", jobs], "the disk is full")
                report = json.loads(done.stdout)
                self.assertEqual(len(report["failures"]), 12)
                self.assertIn("was skipped", report["failures"][-1]["message"])
                self.assertEqual(os.listdir(disk), [])

    def test_outputs_that_cannot_be_are_named(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        self.put("file", "kept")
        (self.folder / "dir").mkdir()
        self.fails(1, ["encode", "a.wav", "-o", "no/where/a.json"], "pacini: a.wav: no/where/a.json: ",
                   "create the folder first")
        self.fails(1, ["encode", "a.wav", "-o", "file/a.json"], "pacini: a.wav: file/a.json: ", "is not a folder")
        self.fails(1, ["encode", "a.wav", "-o", "file/"], "the folder file", "name another with -o")
        self.fails(2, ["encode", "a.wav", "a.wav", ".", "-o", "file"], "file: is not a folder", "name a folder with -o")
        self.assertEqual((self.folder / "file").read_text(), "kept")
        self.clip()
        self.fails(1, ["render", "clip.json", "--profile", "dir"], "dir: is neither a file nor a shipped profile")
        os.chmod(self.folder / "file", 0o444)
        self.fails(1, ["convert", "clip.json", "-o", "file", "--format", "json"], "file: is marked read-only")

    def test_inputs_that_cannot_be_are_named(self):
        os.mkdir(self.folder / "empty")
        os.symlink("nowhere", self.folder / "dangling.wav")
        os.symlink("loop.wav", self.folder / "loop.wav")
        for name, says in (("empty", "contains no files that this command reads"), ("dangling.wav", "does not exist"),
                           ("loop.wav", "symbolic links"), ("/dev/null", "is a device"),
                           ("x" * 300 + ".wav", "name is too long"),
                           ("", "no file name")):
            self.fails(1, ["encode", name, "-o", "out/"], says)
        self.fails(1, ["info", "empty"], "pacini: empty: is a folder")

    def test_rights_are_respected_and_told(self):
        # A copy, as the command may lie where only its owner can run it.
        command = {"executable": shutil.copy(COMMAND, self.folder)}
        other = {**command, "user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else command
        self.put("closed.wav", wav(sine(100, 0.2)))
        self.put("in/a.wav", wav(sine(100, 0.2)))
        self.put("locked/a.wav", wav(sine(100, 0.2)))
        (self.folder / "kept").mkdir()
        os.chmod(self.folder, 0o755)
        os.chmod(self.folder / "closed.wav", 0)
        os.chmod(self.folder / "locked", 0)
        os.chmod(self.folder / "kept", 0o555)
        try:
            self.fails(1, ["encode", "closed.wav", "-o", "kept/x.json"], "closed.wav: permission denied", **other)
            self.fails(1, ["encode", "locked", "-o", "kept"], "locked: cannot be listed: ", "permissions", **other)
            self.fails(1, ["encode", "in", "-o", "kept"], "in/a.wav: kept/a.json: permission denied", **other)
            self.fails(1, ["encode", "locked/a.wav", "-o", "kept/x.json"], "locked/a.wav: permission denied", **other)
        finally:
            os.chmod(self.folder / "locked", 0o755)


class Names(CommandTest):
    def test_any_name_that_the_system_allows_works_through_all_commands(self):
        sound = wav(sine(100, 0.2))
        for name in ("two words", "häptik ☃ 触覚", "-dash", "--json", "new\nline", "quote'\"$(x)`", "a.b.c", "x" * 240,
                     b"lat\xe9in", "tab\t\x1b[31mred", "%s%n{}", " "):
            stem = os.fsencode(name)
            path = os.path.join(os.fsencode(self.folder), stem + b".wav")
            with open(path, "wb") as file:
                file.write(sound)
            self.succeeds("encode", "-o", b"./" + stem + b".pacb", "--", stem + b".wav")
            self.succeeds("convert", "--", stem + b".pacb", stem + b".json")
            self.succeeds("render", "-q", "--", stem + b".pacb")
            text = self.succeeds("info", "--", stem + b".pacb")
            self.assertEqual(text.count("haptic clip"), 1)
            self.assertNotIn("\x1b", text)
            self.assertIsInstance(self.report("info", b"./" + stem + b".json"), dict)
            self.assertIsInstance(self.report("render", b"./" + stem + b".json", "-y"), dict)

    def test_messages_about_strange_names_stay_on_one_line(self):
        self.put("new\nline \x1b[31m.wav", "no sound")
        self.fails(1, ["encode", "."], "pacini: ./new\\nline \\x1b[31m.wav: ")
        self.fails(2, ["encode", "x", "--bad\noption"], "--bad\\noption")

    def test_links_are_followed_and_stay_links(self):
        self.put("real/a.wav", wav(sine(100, 0.2)))
        os.symlink("real/a.wav", self.folder / "link.wav")
        self.put("real/a.json", "{}")
        os.symlink("real/a.json", self.folder / "out.json")
        self.succeeds("encode", "link.wav", "-o", "out.json")
        self.assertTrue((self.folder / "out.json").is_symlink())
        self.assertIn("pacini.clip", (self.folder / "real/a.json").read_text())


class Signals(CommandTest):
    def interrupted(self, *numbers, start=None):
        """Renders for long, sends the signals once the temporary is there; returns the exit code."""
        process = self.started("render", "clip.json", "-o", "out.wav", until=self.writes, preexec_fn=start)
        for number in numbers:
            process.send_signal(number)
        try:
            process.communicate(timeout=60)
        finally:
            process.kill()
        return process.returncode

    def test_a_signal_leaves_the_old_file_and_no_other(self):
        self.clip(seconds=600)
        self.put("out.wav", "old")
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            self.assertEqual(self.interrupted(number), -number)
            self.assertEqual(self.names(), ["clip.json", "out.wav"])
            self.assertEqual((self.folder / "out.wav").read_text(), "old")

    def test_a_kill_leaves_the_old_file_and_a_hidden_temporary_that_folders_pass_over(self):
        self.clip(seconds=600)
        self.put("out.wav", "old")
        self.assertEqual(self.interrupted(signal.SIGKILL), -signal.SIGKILL)
        self.assertEqual((self.folder / "out.wav").read_text(), "old")
        rest = [name for name in os.listdir(self.folder) if ".pacini-" in name]
        self.assertEqual(len(rest), 1)
        self.assertTrue(all(name.startswith(".out.wav.pacini-") and name.endswith(".tmp") for name in rest), rest)
        self.clip("short.json")
        self.succeeds("render", "short.json")  # the next run in that folder clears up
        self.assertEqual(self.names(), ["clip.json", "out.wav", "short.haptic.wav", "short.json"])

    def test_two_quick_signals_leave_nothing_either(self):
        for i in range(8):
            self.clip(f"in/{i}.json", seconds=600)
        for attempt in range(20):
            out = self.folder / "out"
            process = self.started("render", "in", "-o", "out", "-j", "8",
                                   until=lambda: out.exists() and len(os.listdir(out)) >= 8)
            process.send_signal(signal.SIGTERM)
            process.send_signal((signal.SIGTERM, signal.SIGINT)[attempt % 2])
            process.communicate(timeout=60)
            self.assertIn(process.returncode, (-signal.SIGTERM, -signal.SIGINT))
            self.assertEqual([name for name in os.listdir(out) if name.endswith(".tmp")], [], attempt)

    def test_temporaries_of_running_programs_and_files_of_people_are_left(self):
        self.clip("long.json", seconds=3600)
        self.clip("short.json")
        theirs = [".a.wav.pacini-12345678", ".a.wav.pacini-xyz.tmp", "a.wav.pacini-12345678.tmp", ".pacini-12345678.tmp",
                  ".a.wav.pacini-1234567890.tmp", ".strange.pacini-00000000.tmp"]
        for name in theirs:
            self.put(name, "mine")
        process = self.started("render", "long.json", "-o", "out.wav", until=lambda: self.writes(".out.wav"))
        try:
            self.run_command("render", "short.json")
            self.assertTrue(self.writes(".out.wav"))
            self.assertIsNone(process.poll(), "ended too early")
        finally:
            process.terminate()
            process.communicate(timeout=60)
        left = sorted(name for name in os.listdir(self.folder) if "pacini-" in name)
        self.assertEqual(left, sorted(theirs))
        os.utime(self.folder / theirs[-1], (1, 1))  # another computer's, and old
        self.run_command("render", "short.json", "--force")
        self.assertNotIn(theirs[-1], os.listdir(self.folder))

    def test_a_signal_that_was_to_be_ignored_is_ignored(self):
        self.clip(seconds=60)
        ignore = lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)
        self.assertEqual(self.interrupted(signal.SIGHUP, start=ignore), 0)
        self.assertEqual(self.names(), ["clip.json", "out.wav"])


if __name__ == "__main__":
    unittest.main()
