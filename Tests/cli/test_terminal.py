"""End to end: what is shown to someone who watches a terminal, and what is not shown to others."""
import fcntl
import os
import pty
import struct
import subprocess
import termios
import unittest

from command import COMMAND, SANITIZED, CommandTest, sine, wav, wav_header


class Terminal(CommandTest):
    def setUp(self):
        super().setUp()
        # Long enough for progress to appear: hours of silence, which cost nothing to make.
        rate, seconds = 8000, 900 if SANITIZED else 4 * 3600
        with open(self.folder / ("long " + "x" * 150 + ".wav"), "wb") as file:
            file.write(wav_header(2 * rate * seconds, rate))
            file.truncate(44 + 2 * rate * seconds)
        self.long = "long " + "x" * 150 + ".wav"

    def on_terminal(self, *arguments, columns=60, **environment):
        """What a terminal gets from stderr; stdout is a pipe."""
        try:
            master, slave = pty.openpty()
        except OSError as error:
            self.skipTest(f"no terminal can be made here: {error}")
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        process = subprocess.Popen([COMMAND, *arguments], cwd=self.folder, stdin=slave, stderr=slave,
                                   stdout=subprocess.PIPE, env={**os.environ, "TERM": "xterm", **environment})
        os.close(slave)
        shown = b""
        try:
            while True:
                shown += os.read(master, 65536)
        except OSError:
            pass  # the other end is closed: the command is done
        os.close(master)
        printed = process.communicate(timeout=300)[0]
        self.assertEqual(process.returncode, 0, shown)
        return shown.decode(), printed.decode()

    def test_long_work_shows_progress_on_one_line_that_is_taken_back(self):
        shown, printed = self.on_terminal("encode", self.long, "-o", "out.pacb")
        self.assertIn("%", shown)
        self.assertIn("1 of 1  long x", shown)
        self.assertNotIn("\n", shown)
        self.assertTrue(shown.endswith("\r\x1b[K"), shown[-20:])
        for line in shown.split("\r\x1b[K"):
            self.assertLess(len(line), 60)
        self.assertNotIn("\x1b", printed)
        self.assertNotIn("\x1b[3", shown, "colours")

    def test_there_is_no_progress_where_it_is_not_wanted(self):
        for options, environment in ((["--quiet"], {}), ([], {"TERM": "dumb"})):
            shown, _ = self.on_terminal("encode", self.long, "-o", "out.pacb", "--force", *options, **environment)
            self.assertEqual(shown, "")
        self.succeeds("encode", self.long, "-o", "out.pacb", "--force")  # nothing on a stderr that is a pipe

    def test_short_work_shows_no_progress_and_no_colours(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        for environment in ({}, {"NO_COLOR": "1"}):
            shown, printed = self.on_terminal("encode", "a.wav", "--force", **environment)
            self.assertEqual(shown, "")
            self.assertRegex(printed, "^wrote a.json[^\x1b]*\n1 encoded[^\x1b]*\n$")


if __name__ == "__main__":
    unittest.main()
