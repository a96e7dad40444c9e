"""End to end: pacini devices, whatever is connected. What it lists of devices that are there is checked on pretended ones,
in hid/."""
import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from command import COMMAND, CommandTest


class Devices(CommandTest):
    def test_on_linux_nothing_is_needed_to_list_them(self):
        if sys.platform == "linux":
            libraries = subprocess.run([shutil.which("ldd"), COMMAND], capture_output=True, text=True, check=True).stdout
            if "libc++.so" not in libraries:  # Clang links what is named, needed or not
                self.assertNotIn("hidapi", libraries)
            self.succeeds("devices")

    def test_controllers_are_listed_or_it_is_said_why_not(self):
        done = self.run_command("devices", "--json", timeout=60)
        if done.returncode != 0:
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr.decode(), r"^pacini: (the system does not list its HID devices|.*without hidapi)")
            return
        controllers = json.loads(done.stdout)["controllers"]
        lines = self.succeeds("devices").splitlines()
        if not controllers:
            self.assertEqual(lines, ["No supported game controller is connected"])
        self.assertEqual([entry["number"] for entry in controllers], list(range(1, len(controllers) + 1)))
        for entry in controllers:
            self.assertEqual(set(entry) - {"soundCard"}, {"number", "name", "haptics", "transport", "path"})
            self.assertTrue(Path(entry["path"]).exists(), entry)
            self.assertTrue(any(entry["name"] in line for line in lines), entry)

    def test_sound_devices_are_listed_by_the_names_that_live_takes(self):
        done = self.run_command("devices", "--sound", "--json", timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        for entry in json.loads(done.stdout)["soundDevices"]:
            self.assertEqual(set(entry), {"name", "description", "inputs", "outputs"})
            self.assertRegex(entry["name"], "^(jack|pulse|alsa|core):.")
        self.assertTrue(self.succeeds("devices", "--sound").strip())


if __name__ == "__main__":
    unittest.main()
