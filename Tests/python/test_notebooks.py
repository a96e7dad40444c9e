"""The notebooks run in a folder without anything, and put out the text and the figures that are stored in them."""

import base64
import importlib.util
import io
import os
import re
import unittest

import nbformat
import numpy as np
from sounds import SOURCE

FOLDER = SOURCE / "Resources/notebooks"
TIMED = {"methods": ("matplotlib",)}  # a figure with times of its own


def texts(cell):
    """What a cell says, without pictures and addresses."""
    said = []
    for output in cell.get("outputs", ()):
        if output["output_type"] == "stream":
            said.append(output["text"])
        elif "text/plain" in output.get("data", {}):
            said.append(output["data"]["text/plain"])
    return re.sub(r"0x[0-9a-f]+", "0x", "".join(said))


def pictures(cell):
    from PIL import Image

    for output in cell.get("outputs", ()):
        if png := output.get("data", {}).get("image/png"):
            yield np.asarray(Image.open(io.BytesIO(base64.b64decode(png))).convert("L"), np.float64)


class Notebooks(unittest.TestCase):
    def test_they_put_out_what_is_stored_in_them(self):
        spec = importlib.util.spec_from_file_location("make_notebooks", FOLDER / "make_notebooks.py")
        maker = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(maker)
        os.environ["PACINI_DEMO"] = str(SOURCE / "Resources/demo")
        self.assertEqual(sorted(path.stem for path in FOLDER.glob("*.ipynb")), sorted(maker.NAMES))
        for name in maker.NAMES:
            stored = nbformat.read(FOLDER / f"{name}.ipynb", 4)
            made = maker.executed(name)
            self.assertEqual([cell["source"] for cell in stored.cells], [cell["source"] for cell in made.cells], name)
            figures = 0
            for before, after in zip(stored.cells, made.cells):
                with self.subTest(notebook=name, cell=before["source"][:60]):
                    self.assertEqual(texts(before), texts(after))
                    for old, new in zip(pictures(before), pictures(after)):
                        figures += 1
                        self.assertLess(abs(old.shape[0] - new.shape[0]) + abs(old.shape[1] - new.shape[1]), 20)
                        if name not in TIMED and old.shape == new.shape:
                            self.assertLess(np.mean(np.abs(old - new)), 2.0)
            self.assertGreater(figures, 0, name)


if __name__ == "__main__":
    unittest.main()
