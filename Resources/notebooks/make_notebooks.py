"""Writes the notebooks of this folder anew, with what their cells put out: `make_notebooks.py [NAME...]`.

A notebook is a file NAME.py here, in cells: `# %% [markdown]` begins one of text, `# %%` one of code. It is run in an
empty folder, and finds the demo sounds of the repository by the variable PACINI_DEMO.
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

HERE = Path(__file__).resolve().parent
NAMES = ("first_clip", "methods", "measure")


def cells_of(name: str) -> list[nbformat.NotebookNode]:
    """The cells of NAME.py."""
    cells = []
    for kind, text in re.findall(r"(?ms)^# %%( \[markdown\])?\n(.*?)(?=^# %%|\Z)", (HERE / f"{name}.py").read_text()):
        text = text.strip()
        if kind:
            cells.append(new_markdown_cell(re.sub(r"(?m)^# ?", "", text)))
        else:
            cells.append(new_code_cell(text))
    for i, cell in enumerate(cells):
        cell["id"] = f"{name}-{i}"
    return cells


def executed(name: str) -> nbformat.NotebookNode:
    """The notebook of NAME.py after a run."""
    notebook = new_notebook(cells=cells_of(name))
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    os.environ.setdefault("PACINI_DEMO", str(HERE.parent / "demo"))
    with tempfile.TemporaryDirectory() as folder:
        NotebookClient(notebook, timeout=900, resources={"metadata": {"path": folder}}).execute()
    for cell in notebook.cells:
        cell.metadata.clear()  # times of day
    notebook.metadata.pop("language_info", None)
    return notebook


def main() -> None:
    for name in sys.argv[1:] or NAMES:
        nbformat.write(executed(name), HERE / f"{name}.ipynb")


if __name__ == "__main__":
    main()
