"""End to end: pacini devices, whatever is connected and whether or not it was built with hidapi. What it lists of devices
that are there is checked on pretended ones, in hid/check_play.py and hid/check_waveforms.py."""
import json
import shutil
import subprocess
import unittest
from pathlib import Path

from command import COMMAND, CommandTest


class Devices(CommandTest):
    def libraries(self):
        return subprocess.run([shutil.which("ldd"), COMMAND], capture_output=True, text=True, check=True).stdout

    def test_controllers_are_listed_or_it_is_said_why_not(self):
        done = self.run_command("devices", "--json", timeout=60)
        if done.returncode != 0:
            self.assertEqual(done.returncode, 1)
            message = done.stderr.decode()
            if "without hidapi" in message:
                self.assertNotIn("hidapi", self.libraries())
            else:
                self.assertRegex(message, r"^pacini: the system does not list its HID devices\n$")
                self.assertFalse(Path("/sys/class/hidraw").is_dir())
            return
        controllers = json.loads(done.stdout)["controllers"]
        lines = self.succeeds("devices").splitlines()
        if not controllers:
            self.assertEqual(lines, ["No known game controller is connected"])
        self.assertEqual([entry["number"] for entry in controllers], list(range(1, len(controllers) + 1)))
        for entry in controllers:
            self.assertEqual(set(entry), {"number", "name", "haptics", "transport", "path"})
            self.assertTrue(Path(entry["path"]).exists(), entry)
            self.assertTrue(any(entry["name"] in line for line in lines), entry)


if __name__ == "__main__":
    unittest.main()
