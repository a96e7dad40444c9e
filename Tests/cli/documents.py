"""What the documents print: the commands of their code blocks, code within the text, and tables."""
import re
from pathlib import Path

from command import SOURCE

STARTS = re.compile(r"(?:.* \| )?pacini |(?:bash|cmake|ctest|python3) |build/|Tests/\S+\.py\s")


class Printed:
    """Something that a document prints, and where: its line and the heading that it stands under."""

    def __init__(self, document, line, heading, text):
        self.document, self.line, self.heading, self.text = document, line, heading, text

    @property
    def command(self):
        """Without the comment behind it."""
        return re.sub(r"\s+#.*", "", self.text).strip()

    @property
    def comment(self):
        return self.text.partition(" #")[2].strip()

    def __repr__(self):
        return f"{self.document}:{self.line}: {self.text}"


class Document:
    """A Markdown file of the sources, named by its path in them."""

    def __init__(self, name):
        self.name = name
        self.text = (SOURCE / name).read_text()
        self.blocks = []  # lists of Printed, a line each
        self.spans = []   # code within the text
        self.rows = []    # (heading, cells) of tables
        self.parse()

    def parse(self):
        heading, block, fenced, paragraph, start = "", None, False, [], 0
        for number, line in enumerate([*self.text.split("\n"), ""], 1):
            fence = line.lstrip().startswith("```")
            indented = line.startswith("    ") and (block or not paragraph)
            if fenced and not fence or not fence and indented:
                block = block if block is not None else []
                block.append(Printed(self.name, number, heading, line if fenced else line[4:]))
                continue
            if fence:
                fenced = not fenced
            if block and (line.strip() or not fenced):
                self.blocks.append(block)
                block = None
            if line.startswith("#"):
                heading = line.lstrip("# ")
            cells = [cell.strip() for cell in line.strip().strip("|").split(" | ")] if line.startswith("|") else []
            if cells and not set(line) <= set("|- "):
                self.rows.append((heading, cells))
            if line.strip() and not fence:
                start = start or number
                paragraph.append(line)
            if not line.strip() or line.startswith("|"):
                for span in re.findall(r"`([^`]+)`", "\n".join(paragraph)):
                    self.spans.append(Printed(self.name, start, heading, " ".join(span.split())))
                paragraph, start = [], 0

    def commands(self):
        """Of the blocks, each a list; blocks without one are left out."""
        found = [[line for line in block if STARTS.match(line.text)] for block in self.blocks]
        return [block for block in found if block]

    def links(self):
        """What the document points to, without what lies elsewhere."""
        return [link for link in re.findall(r"\]\(([^)\s]+)\)", self.text) if "://" not in link]

    def anchors(self):
        """The names of its headings, as Markdown pages have them."""
        headings = re.findall(r"(?m)^#+ (.*)$", self.text)
        return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}

    def inline_commands(self):
        return [span for span in self.spans if STARTS.match(span.text)]


PAGES = "Resources/docs/"


def documents():
    """The README first, then the others at the top, the pages that the README links, and the editor's manual."""
    others = [SOURCE / "ARCHITECTURE.md", SOURCE / "CONTRIBUTING.md", *sorted(Path(SOURCE, PAGES).glob("*.md")),
              *sorted(Path(SOURCE, "Resources/help").glob("*.md"))]
    return [Document("README.md"), *(Document(str(path.relative_to(SOURCE))) for path in others)]
