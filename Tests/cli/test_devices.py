"""End to end: pacini devices, whatever is connected and whether or not it was built with hidapi."""
import json
import subprocess
import unittest

from command import COMMAND, CommandTest


class Devices(CommandTest):
    def test_controllers_are_listed_or_it_is_said_why_not(self):
        done = subprocess.run([COMMAND, "devices", "--json"], capture_output=True, timeout=60)
        if done.returncode == 0:
            for entry in json.loads(done.stdout)["controllers"]:
                self.assertEqual(set(entry), {"number", "name", "haptics", "transport", "path"})
            self.assertNotEqual(self.succeeds("devices"), "")
        else:
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr.decode(), r"^pacini: .*HID.*\n$|^pacini: .*hidapi.*\n$")


if __name__ == "__main__":
    unittest.main()
