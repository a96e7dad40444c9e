#!/usr/bin/env python3
"""Makes one site of all documentation: guides, formats, measurements, and what Python, C and C++ can call.

make_site.py [FOLDER]    FOLDER: where the site goes, else build/site. Needs MkDocs and mkdocstrings, which
`bash cmake/bootstrap.sh deps` installs into build/python-venv. A link that leads nowhere is an error.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "Resources" / "docs"

# Where the pages stand, in the order in which somebody needs them.
GUIDES = {
    "Start": ["index.md", "install.md", "doors.md", "getting-started.md", "glossary.md"],
    "How it works": ["guide-bands.md", "guide-breakpoints.md", "guide-actuators.md", "guide-scenes.md",
                     "guide-protection.md", "guide-time.md"],
    "Make and feel": ["editor.md", "plugin.md", "settings.md", "scenes.md", "textures.md", "profiles.md", "measuring.md", "devices.md", "video.md",
                      "formats.md"],
    "In games and programs": ["runtime.md", "engines.md", "csharp.md", "lua.md", "godot.md", "rust.md", "node.md", "web.md",
                              "sdl.md"],
    "Research": ["python.md", "study.md", "datasets.md", "quality.md", "measurements.md", "corpus.md", "transforms.md",
                 "thesis.md"],
    "Interfaces": ["api-python.md", "api-c.md", "api-cpp.md"],
    "The project": ["architecture.md", "contributing.md", "changelog.md"],
}
OUTSIDE = {"README.md": "index.md", "ARCHITECTURE.md": "architecture.md", "CONTRIBUTING.md": "contributing.md",
           "CHANGELOG.md": "changelog.md"}

CONFIGURATION = """\
site_name: Pacini
docs_dir: pages
site_dir: {site}
use_directory_urls: false
theme:
  name: readthedocs
  highlightjs: true
plugins:
  - search
  - mkdocstrings:
      handlers:
        python:
          paths: [{python}]
          options:
            show_source: false
            show_root_heading: true
            show_root_toc_entry: false
            heading_level: 2
            members_order: source
            show_if_no_docstring: true
            docstring_style: numpy
            docstring_section_style: list
markdown_extensions: [tables, fenced_code, toc]
validation:
  nav: {{omitted_files: warn, not_found: warn}}
  links: {{not_found: warn, anchors: warn, unrecognized_links: warn}}
nav:
"""


def linked(text):
    """Links as they are in the site, where all pages are in one folder."""
    text = text.replace("](../notebooks/", "](notebooks/")
    text = re.sub(r"\]\(Resources/docs/", "](", text)
    for name, page in OUTSIDE.items():
        text = re.sub(rf"\]\((\.\./\.\./)?{re.escape(name)}(?=[)#])", f"]({page}", text)
    return text


def c_page():
    header = (ROOT / "Source/library/include/pacini.h").read_text()
    return f"""# libpacini for C

What a program calls is one header; its comments are the documentation. [The runtime](runtime.md) shows it in use.

```c
{header}```
"""


def declarations(header):
    """Each `///` comment of a header with the declaration that it is of, as far as its body."""
    lines = header.splitlines()
    i = 0
    while i < len(lines):
        comment = []
        while i < len(lines) and lines[i].strip().startswith("///") and not lines[i].strip().startswith("///<"):
            comment.append(lines[i].strip()[3:].strip())
            i += 1
        if not comment:
            i += 1
            continue
        declared = []
        while i < len(lines) and len(declared) < 8:
            line = lines[i].split("///<")[0].rstrip()
            if line.strip() in ("", "{", "}"):
                break
            declared.append(line)
            if line.endswith((";", "}", "{")):
                break
            i += 1
        if declared:
            indent = min(len(line) - len(line.lstrip()) for line in declared)
            yield " ".join(comment), "\n".join(line[indent:] for line in declared)


def cpp_page():
    parts = ["# The core for C++\n",
             "`Core` is header-only; each header names its unit, ranges, errors and thread. "
             "[Architecture](architecture.md) says how its rooms lie.\n"]
    core = ROOT / "Core" / "pacini"
    rooms = [("All of it", core.glob("*.h"))]
    rooms += [(room.name, room.rglob("*.h")) for room in sorted(core.iterdir()) if room.is_dir()]
    for name, headers in rooms:
        parts.append(f"## {name}\n")
        for path in sorted(headers):
            text = path.read_text()
            summary = re.search(r"^#pragma once\n\n((?:// .*\n)+)", text)
            parts.append(f"### `<pacini/{path.relative_to(core)}>`\n")
            if summary:
                parts.append(" ".join(line[3:] for line in summary.group(1).splitlines()) + "\n")
            public = text.split("private:")[0] if text.count("private:") == 1 else text
            for comment, declaration in declarations(public):
                escaped = comment.replace("<", "&lt;").replace("[", "\\[").replace("*", "\\*").replace("_", "\\_")
                parts.append(f"{escaped}\n\n```cpp\n{declaration}\n```\n")
    return "\n".join(parts)


def write_pages(pages):
    shutil.rmtree(pages, ignore_errors=True)
    pages.mkdir(parents=True)
    for page in DOCS.glob("*.md"):
        (pages / page.name).write_text(linked(page.read_text()))
    # The guide of the web page, where its figures are computed.
    for page in (DOCS / "guide").glob("*.md"):
        text = re.sub(r'<div class="figure".*?</div>', "*The figure is computed on the [web page](web.md), in its guide.*",
                      page.read_text())
        (pages / f"guide-{page.name}").write_text(text.replace("](../", "]("))
    for picture in [*DOCS.glob("*.png"), *DOCS.glob("*.svg")]:
        shutil.copy(picture, pages)
    for name, page in OUTSIDE.items():
        (pages / page).write_text(linked((ROOT / name).read_text()))
    (pages / "notebooks").mkdir()
    for notebook in (ROOT / "Resources/notebooks").glob("*.ipynb"):
        shutil.copy(notebook, pages / "notebooks")
    (pages / "api-python.md").write_text(
        "# The package for Python\n\n[Python](python.md) shows it in use.\n\n::: pacini\n\n::: pacini.measure\n")
    (pages / "api-c.md").write_text(c_page())
    (pages / "api-cpp.md").write_text(cpp_page())


def main():
    if sys.argv[1:2] and sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    site = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT / "build" / "site"
    work = site.with_name(site.name + "-source")
    write_pages(work / "pages")
    configuration = CONFIGURATION.format(site=site, python=ROOT / "Source/python")
    for heading, pages in GUIDES.items():
        configuration += f"  - {heading}:\n" + "".join(f"      - {page}\n" for page in pages)
    (work / "mkdocs.yml").write_text(configuration)
    # Told quietly, warnings would not count.
    done = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "--clean",
                           "--config-file", str(work / "mkdocs.yml")], stderr=subprocess.PIPE, text=True)
    told = [line for line in done.stderr.splitlines() if not line.startswith("INFO")]
    if done.returncode != 0:
        print("\n".join(told), file=sys.stderr)
    else:
        print(site / "index.html")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
