"""Where the demo sounds and the command are, and sounds that are made here."""

from __future__ import annotations

import os
import subprocess
import unittest
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import numpy.typing as npt

SOURCE = Path(os.environ["PACINI_SOURCE_DIR"])
COMMAND = os.environ["PACINI_COMMAND"]
DEMO = sorted((SOURCE / "Resources/demo").glob("*.flac"))
RATE = 48000


def knocks(seconds: float = 1.0, rate: int = RATE, seed: int = 1) -> npt.NDArray[np.float32]:
    """A tone of 120 Hz with a knock every quarter of a second."""
    time = np.arange(round(seconds * rate)) / rate
    noise = np.random.default_rng(seed).standard_normal(len(time))
    sound = 0.2 * np.sin(2 * np.pi * 120 * time) + 0.5 * noise * np.exp(-40.0 * (time % 0.25))
    return sound.astype(np.float32)


def run(*arguments: object, folder: Path | None = None) -> str:
    """What the command prints."""
    done = subprocess.run([COMMAND, *map(str, arguments)], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{arguments}: {done.stderr}")
    return done.stdout


class FolderTest(unittest.TestCase):
    """A test with a folder of its own."""

    folder: Path

    def setUp(self) -> None:
        made = TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = Path(made.name)

    def refuses(self, where: str, code: str, call: Any, *arguments: Any, **options: Any) -> None:
        """Checks the place and the code of the error that a call raises."""
        import pacini

        with self.assertRaises(pacini.Error) as caught:
            call(*arguments, **options)
        self.assertEqual((caught.exception.where, caught.exception.code), (where, code), str(caught.exception))
