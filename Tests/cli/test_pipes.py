"""End to end: standard input and output, pipes and devices in place of files."""
import json
import os
import struct
import subprocess
import threading
import unittest

from command import COMMAND, LONGEST, SOURCE, CommandTest, noise, sine, wav, wav_header


def endless_header(content):
    """A WAV as programs write it that cannot go back to fill in the lengths."""
    at = content.index(b"data")
    return content[:4] + b"\xff\xff\xff\xff" + content[8:at + 4] + b"\xff\xff\xff\xff" + content[at + 8:]


class Pipes(CommandTest):
    def setUp(self):
        super().setUp()
        samples = [x + y for x, y in zip(sine(110, 0.5, level=0.4), noise(24000, level=0.1))]
        self.sound = wav(samples)
        self.put("a.wav", self.sound)

    def chain(self, first, *commands):
        """Runs commands, each on what the one before wrote; returns the last output. stderr is not looked at."""
        data = first
        running = []
        source = subprocess.PIPE
        for command in commands:
            process = subprocess.Popen([COMMAND, *command], cwd=self.folder, stdin=source, stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE)
            if running:
                running[-1].stdout.close()
            source = process.stdout
            running.append(process)
        writer = threading.Thread(target=lambda: (running[0].stdin.write(data), running[0].stdin.close()))
        writer.start()
        result = running[-1].stdout.read()
        writer.join()
        for process, command in zip(running, commands):
            text = process.stderr.read().decode()
            process.stderr.close()
            self.assertEqual((process.wait(LONGEST), text.count("pacini:")), (0, 0), (command, text))
        running[-1].stdout.close()
        return result

    def test_a_sound_goes_through_four_commands(self):
        text = self.chain(self.sound, ["encode", "-", "-o", "-", "--format", "packed"],
                          ["convert", "-", "-o", "-", "--format", "json"], ["render", "-", "-o", "-"],
                          ["info", "-", "--json"]).decode()
        report = json.loads(text)
        self.assertEqual((report["kind"], report["sampleRate"], report["channels"]), ("audio", 48000, 1))
        self.assertAlmostEqual(report["duration"], 0.5, delta=0.1)
        self.assertEqual(self.names(), ["a.wav"])

    def test_what_goes_through_a_pipe_is_what_goes_through_files(self):
        self.succeeds("encode", "a.wav", "-o", "a.pacb")
        piped = self.chain(self.sound, ["encode", "-", "-o", "-"])
        from_file = self.chain(b"", ["encode", "a.wav", "-o", "-"])
        clip, other = json.loads(piped), json.loads(from_file)
        self.assertEqual((clip["name"], other["source"]["file"]), ("stdin", "a.wav"))
        self.assertEqual(clip["bands"], other["bands"])
        packed = (self.folder / "a.pacb").read_bytes()
        self.assertEqual(self.chain(b"", ["encode", "a.wav", "-o", "-", "--format", "packed"]), packed)
        self.succeeds("render", "a.pacb", "-o", "b.wav")
        drive = (self.folder / "b.wav").read_bytes()
        piped = self.chain(packed, ["render", "-", "-o", "-"])
        data = lambda content: content[content.index(b"data"):]
        self.assertEqual(data(piped), data(drive))
        self.assertEqual(self.chain(packed, ["convert", "-", "-"] + ["--format", "packed"]), packed)

    def test_sounds_of_any_format_and_unknown_length_come_through_pipes(self):
        flac = (SOURCE / "Resources/demo/knock_wood_bridge.flac").read_bytes()
        for content in (endless_header(self.sound), flac):
            self.assertEqual(json.loads(self.chain(content, ["encode", "-", "-o", "-"]))["format"], "pacini.clip")
            self.assertEqual(json.loads(self.chain(content, ["info", "-", "--json"]))["kind"], "audio")
        for content in (b"", b"no sound at all"):
            done = self.run_command("encode", "-", "-o", "-", stdin=None, input=content)
            self.assertEqual((done.returncode, done.stdout), (1, b""))
            self.assertTrue(done.stderr.startswith(b"pacini: -: "), done.stderr)

    def test_notes_keep_out_of_the_way(self):
        done = self.run_command("encode", "a.wav", "-o", "-")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(json.loads(done.stdout)["format"], "pacini.clip")
        self.assertIn(b"1 encoded", done.stderr)
        self.assertEqual(self.run_command("encode", "a.wav", "-o", "-", "-q").stderr, b"")
        self.clip("c.json")
        for arguments in (["encode", "a.wav"], ["render", "c.json"], ["convert", "c.json", "--format", "packed"]):
            self.fails(2, [*arguments, "-o", "-", "--json"], "-: is used by the report of --json")
        self.fails(2, ["encode", "-"], "name a file with -o")
        self.fails(2, ["render", "-"], "name a file with -o")
        self.fails(2, ["encode", "a.wav", "-", "-o", "-"], "is not a folder")
        self.fails(2, ["convert", "c.json", "-"], "--format")

    def test_named_pipes_and_devices_are_written_to(self):
        for command in (["encode", "a.wav", "--format", "packed"], ["encode", "a.wav"]):
            done = self.run_command(*command, "-o", "/dev/stdout", "-q")
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            self.assertTrue(done.stdout[:4] in (b"PACB", b'{\n  '), done.stdout[:20])
            self.assertEqual(self.succeeds(*command, "-o", "/dev/null", "-q"), "")
        pipe = self.folder / "pipe.wav"
        os.mkfifo(pipe)
        self.clip("c.json")
        for command in (["encode", "a.wav", "--format", "packed"], ["render", "c.json"],
                        ["convert", "c.json", "--format", "json"]):
            got = []
            reader = threading.Thread(target=lambda: got.append(pipe.read_bytes()))
            reader.start()
            done = self.run_command(*command, "-o", "pipe.wav", timeout=60)
            reader.join(60)
            self.assertEqual((done.returncode, done.stderr), (0, b""), command)
            self.assertGreater(len(got[0]), 50)
            self.assertTrue(pipe.is_fifo())
        writer = threading.Thread(target=lambda: pipe.write_bytes(self.sound))
        writer.start()
        self.succeeds("encode", "pipe.wav", "-o", "b.json", timeout=60)
        writer.join()

    def test_appending_to_a_file_keeps_what_is_there(self):
        path = self.put("all.txt", "before\n")
        with open(path, "ab") as file:
            for name in ("-", "/dev/stdout"):
                done = self.run_command("encode", "a.wav", "-o", name, "-q", stdout=file)
                self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(path.read_bytes()[:7], b"before\n")
        self.assertEqual(path.read_bytes().count(b'"pacini.clip"'), 2)

    def test_a_reader_that_goes_away_is_an_error(self):
        read, write = os.pipe()
        os.close(read)
        done = self.run_command("encode", "a.wav", "-o", "-", stdout=write)
        os.close(write)
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"pipe has closed it", done.stderr)

    def test_a_long_sound_is_the_same_clip_from_a_pipe(self):
        second = os.urandom(8000)
        sound = wav_header(1500 * len(second), rate=8000, bits=8) + b"".join(
            second[i % 8000:] + second[:i % 8000] for i in range(1500))
        self.succeeds("encode", self.put("noise.wav", sound), "-o", "file.json")
        with open(self.folder / "noise.wav", "rb") as piped:
            self.succeeds("encode", "-", "-o", "pipe.json", stdin=piped)
        clips = [json.loads((self.folder / name).read_text()) for name in ("file.json", "pipe.json")]
        for clip in clips:
            for differs in ("name", "source"):
                del clip[differs]
            del clip["encoder"]["seal"]
        self.assertTrue(clips[0] == clips[1])


if __name__ == "__main__":
    unittest.main()
